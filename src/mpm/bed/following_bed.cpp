#include "mpm/bed/following_bed.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mpm/particles/append.hpp"

namespace mpm {
namespace {

constexpr int kKept = 2;          ///< columns by which a body has to be farther than where ground is made
constexpr double kStopped = 2.0;  ///< distances from a body beyond which ground stops

}  // namespace

FollowingBed::FollowingBed(const BedDefinition& definition, BedParts parts)
    : definition_(definition),
      parts_(parts),
      layout_(parts.fields.front()->layout),
      columns_(layout_),
      kept_(columns_, *definition_.source,
            layout_.node_position({0, 0, 0}, 0).z() +
                (layout_.last_node(layout_.dim() - 1) - 0.5) * layout_.cell(layout_.dim() - 1)),
      virgin_(columns_.count(), 1),
      laid_(columns_.count(), 0) {
  account_.name = "ground";
  for (const RigidBody& body : parts_.bodies) {
    const auto& names = definition_.follow;
    if (std::find(names.begin(), names.end(), body.name()) != names.end()) followed_.push_back(&body);
  }
  present_ = columns_with_ground(columns_, places(), definition_.within);
  for (int column = 0; column < columns_.count(); ++column) virgin_[column] = present_[column] == 0 ? 1 : 0;
  find_rim();
  laid_ = rim_;
  next_id_ = parts_.sets.front().id.size();
  parts_.sleep.keep_asleep([this](std::uint64_t key) { return rim_[columns_.of_block(layout_.block(key))] != 0; });
}

std::vector<Vec3> FollowingBed::places() const {
  std::vector<Vec3> list;
  for (const RigidBody* body : followed_) list.push_back(body->pose().position);
  return list;
}

void FollowingBed::find_rim() {
  rim_.assign(columns_.count(), 0);
  for (int column = 0; column < columns_.count(); ++column) {
    if (present_[column] != 0) continue;
    columns_.each_beside(column, [&](int beside) { rim_[beside] = present_[beside]; });
  }
}

Vec3 FollowingBed::place_of(const ParticleSet& set, std::uint32_t particle) const {
  Vec3 place = Vec3::Zero();
  for (int k = 0; k < layout_.dim(); ++k) place[layout_.axis(k)] = set.x[k][particle];
  return place;
}

std::optional<std::string> FollowingBed::fault() const {
  const double margin = kNearTool * layout_.largest_cell();
  for (const RigidBody& body : parts_.bodies) {
    const bool is_followed = std::find(followed_.begin(), followed_.end(), &body) != followed_.end();
    if (!is_followed && body.twist().linear.isZero(0.0) && body.twist().angular.isZero(0.0)) continue;
    Box box = body.world_bounds();
    if (layout_.dim() == 2) box.min.y() = box.max.y() = 0.0;
    if (!box.min.allFinite() || !box.max.allFinite()) continue;
    box = box.grown(margin);
    if (box.min.z() > definition_.source->top() || box.max.z() < definition_.source->bottom()) continue;
    BedColumns::Flags under(columns_.count(), 0);
    columns_.mark_in(box, under);
    for (int column = 0; column < columns_.count(); ++column) {
      if (under[column] == 0 || (present_[column] != 0 && rim_[column] == 0)) continue;
      return fmt::format(
          "rigid body '{}' at ({:.4g}, {:.4g}, {:.4g}) m comes nearer than {:g} cells to where the ground ends that is "
          "there, which stays at rest; {}",
          body.name(), body.pose().position.x(), body.pose().position.y(), body.pose().position.z(), kNearTool,
          is_followed ? "raise terrain.within, to more than the body reaches and moves in a sync period"
                      : "name it in terrain.follow, or raise terrain.within");
    }
  }
  return std::nullopt;
}

BedColumns::Flags FollowingBed::awake() const {
  BedColumns::Flags flags(columns_.count(), 0);
  for (const auto& grid : parts_.fields) {
    for (int owner = 0; owner < grid->blocks.owners(); ++owner) {
      flags[columns_.of_block(grid->blocks.block(grid->blocks.owner_block(owner)))] = 1;
    }
  }
  return flags;
}

bool FollowingBed::look() {
  const std::vector<Vec3> at = places();
  const BedColumns::Flags wanted = columns_with_ground(columns_, at, definition_.within);
  const BedColumns::Flags kept = columns_with_ground(columns_, at, definition_.within + kKept * columns_.width());
  const BedColumns::Flags may_move = columns_with_ground(columns_, at, kStopped * definition_.within);
  const BedColumns::Flags moving = awake();
  BedColumns::Flags leaves(columns_.count(), 0);
  to_make_.clear();
  to_put_away_.clear();
  to_stop_.clear();
  strays_ = false;
  for (int column = 0; column < columns_.count(); ++column) {
    if (wanted[column] != 0 && present_[column] == 0) to_make_.push_back(column);
    leaves[column] = present_[column] != 0 && kept[column] == 0 && moving[column] == 0;
    if (present_[column] != 0 && kept[column] == 0 && may_move[column] == 0 && moving[column] != 0)
      to_stop_.push_back(column);
    strays_ = strays_ || (present_[column] == 0 && moving[column] != 0);
  }
  for (int column = 0; column < columns_.count(); ++column) {
    if (leaves[column] == 0) continue;
    bool stands = true;  // true if what will be outermost is at rest
    columns_.each_beside(column,
                         [&](int beside) { stands = stands && (present_[beside] == 0 || moving[beside] == 0); });
    if (stands) to_put_away_.push_back(column);
  }
  return strays_ || !to_make_.empty() || !to_put_away_.empty() || !to_stop_.empty();
}

bool FollowingBed::stop_far() {
  if (to_stop_.empty()) return false;
  for (const int column : to_stop_) laid_[column] = 1;
  lay_asleep();
  return true;
}

// Particles may have masses of their own, which are rounded to the precision of the run.
double FollowingBed::whole_mass() const {
  const ParticleSet& set = parts_.sets.front();
  return set.masses.empty() ? set.mass : ParticleScalar(set.precision, 1, set.mass)[0];
}

void FollowingBed::keep(int column, const ParticleSet& set, std::uint32_t particle) {
  const double mass = set.mass_of(static_cast<int>(particle));
  kept_.keep(column, place_of(set, particle), mass);
  put_away_ += mass;
}

void FollowingBed::put_away() {
  BedColumns::Flags leaves(columns_.count(), 0);
  for (const int column : to_put_away_) leaves[column] = 1;
  std::vector<BlockName> names;
  for (const auto& one : parts_.sleep.asleep().all()) {
    if (leaves[columns_.of_block(layout_.block(one.first.key))] != 0) names.push_back(one.first);
  }
  sort_names(names);
  for (const BlockName& name : names) {
    const SleepingBlock& block = *parts_.sleep.asleep().own(name);
    const int column = columns_.of_block(layout_.block(name.key));
    for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
      for (const std::uint32_t p : block.particles[s]) keep(column, parts_.sets[s], p);
    }
    parts_.sleep.take_away(name);
  }
  if (strays_) put_strays_away();
  for (const int column : to_put_away_) present_[column] = 0;
  for (const int column : to_make_) present_[column] = laid_[column] = 1;
  find_rim();
}

void FollowingBed::put_strays_away() {
  for (ParticleSet& set : parts_.sets) {
    std::vector<std::uint32_t> strays;
    for (const auto& grid : parts_.fields) {
      for (int owner = 0; owner < grid->blocks.owners(); ++owner) {
        const int column = columns_.of_block(grid->blocks.block(grid->blocks.owner_block(owner)));
        if (present_[column] != 0) continue;
        const std::size_t number = static_cast<std::size_t>(grid->first_owner) + static_cast<std::size_t>(owner);
        for (std::uint32_t p = set.begin[number]; p < set.begin[number + 1]; ++p) {
          Vec3 momentum = Vec3::Zero();
          for (int k = 0; k < layout_.dim(); ++k) momentum[layout_.axis(k)] = set.v[k][p];
          account_.add(-set.mass_of(static_cast<int>(p)) * momentum);
          keep(column, set, p);
          strays.push_back(p);
        }
      }
    }
    std::sort(strays.begin(), strays.end());
    remove_awake(set, strays);
    parts_.sleep.follow_moves();
  }
}

void FollowingBed::fill(GroundParticles& ground) {
  const double mass = whole_mass();
  stacked_.clear();
  for (const int column : to_make_) {
    const std::size_t first = ground.positions.size();
    if (virgin_[column] != 0) add_column(columns_, column, *definition_.source, ground);
    virgin_[column] = 0;
    const std::size_t of_scene = ground.positions.size();
    kept_.stack(column, mass, first, ground);
    for (std::size_t p = of_scene; p < ground.positions.size(); ++p) stacked_.push_back(p);
  }
}

void FollowingBed::add(ParticleSet& made) {
  ParticleSet& set = parts_.sets.front();
  if (next_id_ + made.id.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw ModuleError(
        "terrain: every particle that is made has a number of its own, and these are used up; start a new run "
        "from a map of the ground (--terrain)");
  }
  made.mass = set.mass;
  for (const std::size_t p : stacked_) {
    if (!made.masses.empty()) made.masses[0].set(p, whole_mass());
  }
  for (std::size_t p = 0; p < made.id.size(); ++p) {
    made.id[p] = static_cast<std::uint32_t>(next_id_++);
    made_ += made.mass_of(static_cast<int>(p));
  }
  append_awake(set, made);
  parts_.sleep.follow_moves();
}

void FollowingBed::lay_asleep() {
  parts_.sleep.lay_asleep([this](std::uint64_t key) { return laid_[columns_.of_block(layout_.block(key))] != 0; });
  std::fill(laid_.begin(), laid_.end(), std::uint8_t{0});
}

void FollowingBed::numbers(std::vector<NamedNumber>& list) const {
  list.push_back({"ground_made", "kg", made_});
  list.push_back({"ground_put_away", "kg", put_away_});
  list.push_back({"ground_kept", "kg", kept_.mass()});
}

void FollowingBed::serialise(StateArchive& archive) {
  archive.list("present", present_);
  archive.list("virgin", virgin_);
  {
    const StateArchive::Group group(archive, "kept");
    kept_.serialise(archive);
  }
  archive.value("next_id", next_id_);
  archive.value("made", made_);
  archive.value("put_away", put_away_);
  account_.serialise(archive);
  archive.value("energy", energy_);
  if (archive.reading()) find_rim();
}

void FollowingBed::hashed(std::vector<double>& numbers) const {
  kept_.hashed(numbers);
  for (int column = 0; column < columns_.count(); ++column) {
    if (present_[column] != 0) numbers.push_back(column);
  }
  numbers.push_back(static_cast<double>(next_id_));
}

}  // namespace mpm
