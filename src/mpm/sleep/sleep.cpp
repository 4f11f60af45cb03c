#include "mpm/sleep/sleep.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace mpm {
namespace {

constexpr SleepPace kExplicit{8, 4, 8};
constexpr SleepPace kImplicit{1, 1, 1};  // steps, of which one costs as much as many of the others
constexpr int kWorthThreads = 1000;      ///< nodes
constexpr double kAtOnce = 3.0;          ///< times `wake`, from which on a block wakes after this step
constexpr double kFromRest = 0.1;        ///< part of `balance` by which a load may change in `after`, to fall asleep
constexpr double kSlowNodes = 4.0;       ///< times the speed of sleep, below which nodes are damped

}  // namespace

Sleep::Sleep(const SleepDefinition& definition, SleepParts parts)
    : definition_(definition),
      parts_(std::move(parts)),
      pace_(parts_.implicit ? kImplicit : kExplicit),
      layout_(parts_.fields.front()->layout),
      asleep_(parts_.sets, layout_, parts_.averaged),
      watch_(definition.speed, definition.after),
      borders_(parts_.fields.size(), SleepBorder(layout_)) {
  account_.name = "sleep";
  if (parts_.halo != nullptr) across_ = std::make_unique<SleepAcrossRanks>(*parts_.halo, parts_.fields, asleep_);
}

bool Sleep::tool_near(const std::array<int, 3>& block, double dt) const {
  const Box box{layout_.node_position(block, 0), layout_.node_position(block, layout_.nodes_per_block() - 1)};
  const double half = 0.5 * box.size().norm();
  for (const RigidBody& body : parts_.bodies) {
    const Box bounds = body.world_bounds();
    // Finds how far its surface comes until the next look.
    const Vec3 size = bounds.size().unaryExpr([](double c) { return std::isfinite(c) ? c : 0.0; });
    const double speed = body.twist().linear.norm() + size.norm() * body.twist().angular.norm();
    const double margin = kNearTool * layout_.largest_cell() + pace_.between_looks * dt * speed;
    SurfacePoint point;
    if (bounds.intersects(box.grown(margin)) &&
        body.surface().within(body.pose().to_body(box.center()), half + margin, point)) {
      return true;
    }
  }
  return false;
}

bool Sleep::other_near(int field, std::uint64_t key) const {
  for (std::size_t f = 0; f < parts_.fields.size(); ++f) {
    if (static_cast<int>(f) != field && parts_.fields[f]->blocks.find(key) >= 0) return true;
  }
  return false;
}

void Sleep::look(const StepContext& context) {
  for (const auto& [name, block] : asleep_.all()) {
    if (tool_near(layout_.block(name.key), context.dt) || other_near(name.field, name.key)) to_wake_.push_back(name);
  }
  ask_partners(context, false);
  if (across_) across_->add_met(to_wake_);
  watch_.look(parts_.fields, parts_.sets, context.start, parts_.threads);
  const RestTimes times{std::max(0.0, context.start - definition_.after), context.start,
                        context.start + ahead_of_looks() * context.dt, kFromRest * definition_.balance};
  for (std::size_t f = 0; f < parts_.fields.size(); ++f) {
    const Grid& grid = *parts_.fields[f];
    for (int owner = 0; owner < grid.blocks.owners(); ++owner) {
      if (!watch_.at_rest(grid.first_owner + owner)) continue;
      const int block = grid.blocks.owner_block(owner);
      const BlockName name{static_cast<int>(f), grid.blocks.key(block)};
      if (tool_near(grid.blocks.block(block), context.dt) || other_near(name.field, name.key)) continue;
      if (is_kept_awake(awake_block(name.field, owner), times)) continue;
      sleepers_.push_back({name, grid.first_owner + owner, 0.0, 0.0, nullptr});
    }
  }
}

bool Sleep::follow_sort(const StepContext& context) {
  const std::uint64_t generation = context.fields.front()->blocks.generation();
  const bool sorted = generation_ != generation;
  if (!sorted && !just_read_) return false;
  if (sorted) watch_.follow(context.fields, context.start);
  generation_ = generation;
  if (just_read_) {
    find_owners_of_sleepers();
    if (across_) across_->meet(borders_);
    just_read_ = false;
  }
  for (std::size_t f = 0; f < borders_.size(); ++f) {
    Grid& grid = *context.fields[f];
    borders_[f].find(static_cast<int>(f), grid, asleep_, parts_.halo);
    for (SleepBorder::Node& node : borders_[f].nodes()) {
      for (const RestPartner* partner : parts_.partners)
        node.at_wall = node.at_wall || partner->holds(static_cast<int>(f), grid, node.ref);
    }
    grid.at_rest.clear();
    grid.means_at_rest.clear();
    for (const SleepBorder::Node& node : borders_[f].nodes()) {
      grid.at_rest.push_back(node.ref);
      if (parts_.averaged) grid.means_at_rest.push_back({node.ref, node.mass, node.stress});
    }
  }
  return sorted;
}

// Both are in the order of names.
void Sleep::find_owners_of_sleepers() {
  std::vector<SleepingBlocks::Sleeper> own;
  auto next = sleepers_.begin();
  for (std::size_t f = 0; f < parts_.fields.size(); ++f) {
    const Grid& grid = *parts_.fields[f];
    for (int owner = 0; owner < grid.blocks.owners(); ++owner) {
      const BlockName name{static_cast<int>(f), grid.blocks.key(grid.blocks.owner_block(owner))};
      while (next != sleepers_.end() && next->name < name) ++next;
      if (next == sleepers_.end() || !(next->name == name)) continue;
      next->owner = grid.first_owner + owner;
      own.push_back(std::move(*next));
    }
  }
  sleepers_ = std::move(own);
}

void Sleep::momentum_gathered(StepContext& context) {
  const bool sorted = follow_sort(context);
  if (!begun_ && definition_.from_start) {
    watch_.trust_all();
    looks_waited_ = pace_.looks_to_wait;
  }
  if (begun_ && ++steps_ < pace_.between_looks) {
    if (sorted) ask_partners(context, true);
    return;
  }
  if (across_ ? across_->ranks().any(!sleepers_.empty()) : !sleepers_.empty()) ++looks_waited_;
  steps_ = 0;
  sleepers_.clear();
  look(context);
}

void Sleep::before_strain(StepContext& context) {
  for (std::size_t f = 0; f < borders_.size(); ++f) {
    Grid& grid = *context.fields[f];
    for (const SleepBorder::Node& node : borders_[f].nodes()) {
      for (int k = 0; k < layout_.dim(); ++k) grid.velocity.at(node.ref.block, k, node.ref.node) = 0.0;
    }
  }
}

bool Sleep::needs_sort() const {
  if (!to_wake_.empty() && (at_once_ || steps_waited_ >= pace_.steps_to_wait)) return true;
  return !sleepers_.empty() && looks_waited_ >= pace_.looks_to_wait;
}

void Sleep::find_unrest(const Grid& grid, SleepBorder& border, double dt) {
  std::vector<SleepBorder::Node>& nodes = border.nodes();
  const int count = static_cast<int>(nodes.size());
  const double part = std::min(1.0, dt / definition_.after);
  unrest_.assign(nodes.size(), {});
  for_all("sleep: unrest at the border", count > kWorthThreads ? parts_.threads : 1, count, [&](int i) {
    if (!grid.carries(nodes[i].ref.block, nodes[i].ref.node)) return;
    const NodeRef ref = nodes[i].ref;
    Vec3 of_awake = nodal_vector(grid.force, layout_, ref);
    if (parts_.implicit) of_awake = grid.mass.at(ref.block, 0, ref.node) * (of_awake - parts_.gravity);
    unrest_[i] = SleepBorder::find_unrest(nodes[i], grid, of_awake, parts_.gravity, part);
  });
  for (int i = 0; i < count; ++i) {
    const bool wave = unrest_[i].speed > definition_.wake;
    if (!wave && !(unrest_[i].lost > definition_.balance)) continue;
    border.add_names(nodes[i], grid, to_wake_);
    at_once_ = at_once_ || unrest_[i].speed > kAtOnce * definition_.wake;
  }
}

void Sleep::forces_gathered(StepContext& context) {
  if (!parts_.implicit) find_unrest(context);
}

// In an implicit step forces are known with the velocities, as accelerations.
void Sleep::find_unrest(StepContext& context) {
  for (std::size_t f = 0; f < borders_.size(); ++f) find_unrest(*context.fields[f], borders_[f], context.dt);
  leave_what_stays();
  if (to_wake_.empty()) return;
  ++steps_waited_;
  sort_names(to_wake_);  // those that a look has found are in no order
}

Sleep::Taken Sleep::hold(Grid& grid, const SleepBorder& border, double dt) {
  const std::vector<SleepBorder::Node>& nodes = border.nodes();
  return sums_.over("sleep: nodes held", nodes.size(), parts_.threads, [&](std::size_t i, Taken& taken) {
    const NodeRef ref = nodes[i].ref;
    if (!grid.carries(ref.block, ref.node)) return;
    const double mass = grid.mass.at(ref.block, 0, ref.node);
    const Vec3 change = -nodal_vector(grid.velocity, layout_, ref);
    add_nodal_vector(grid.velocity, layout_, ref, change);
    add_nodal_vector(grid.force, layout_, ref, change / dt);
    if (!grid.counts(ref.block)) return;
    taken.impulse += mass * change;
    taken.energy += nodal_vector(grid.momentum, layout_, ref).squaredNorm() / (2.0 * mass);
  });
}

Sleep::Taken Sleep::damp(Grid& grid, double dt) {
  const int nodes = layout_.nodes_per_block();
  const double slow = kSlowNodes * definition_.speed;
  const std::size_t count = static_cast<std::size_t>(grid.blocks.size()) * nodes;
  return sums_.over("sleep: slow nodes", count, parts_.threads, [&](std::size_t i, Taken& taken) {
    const NodeRef ref{static_cast<int>(i / nodes), static_cast<int>(i % nodes)};
    if (!grid.carries(ref.block, ref.node)) return;
    const Vec3 velocity = nodal_vector(grid.velocity, layout_, ref), rate = nodal_vector(grid.force, layout_, ref);
    const double speed = velocity.norm();
    if (!(speed < slow)) return;
    const double part = definition_.damping * (1.0 - speed / slow) * dt;
    Vec3 change = Vec3::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      const double most = std::abs(velocity[axis]);
      change[axis] = -std::copysign(std::min(part * std::abs(rate[axis]), most), velocity[axis]);
    }
    add_nodal_vector(grid.velocity, layout_, ref, change);
    add_nodal_vector(grid.force, layout_, ref, change / dt);
    if (!grid.counts(ref.block)) return;
    const double mass = grid.mass.at(ref.block, 0, ref.node);
    taken.impulse += mass * change;
    taken.energy -= mass * change.dot(velocity + 0.5 * change);
  });
}

void Sleep::momentum_updated(StepContext& context) {
  if (parts_.implicit) find_unrest(context);
  for (std::size_t f = 0; f < borders_.size(); ++f) {
    Grid& grid = *context.fields[f];
    const Taken held = hold(grid, borders_[f], context.dt);
    given_ += held.impulse;
    energy_ += held.energy;
    if (definition_.damping == 0.0) continue;
    const Taken damped = damp(grid, context.dt);
    given_ += damped.impulse;
    damped_ += damped.energy;
  }
}

void Sleep::velocity_found(StepContext& context) {
  for (std::size_t f = 0; f < borders_.size(); ++f) {
    NodalField& velocity = context.fields[f]->increment;
    for (const SleepBorder::Node& node : borders_[f].nodes()) {
      for (int k = 0; k < layout_.dim(); ++k) velocity.at(node.ref.block, k, node.ref.node) = 0.0;
    }
  }
}

void Sleep::increment_found(StepContext& context) {
  for (std::size_t f = 0; f < borders_.size(); ++f) {
    Grid& grid = *context.fields[f];
    for (const SleepBorder::Node& node : borders_[f].nodes()) {
      if (!grid.carries(node.ref.block, node.ref.node)) continue;
      const Vec3 change = -nodal_vector(grid.increment, layout_, node.ref);
      add_nodal_vector(grid.increment, layout_, node.ref, change);
      if (grid.counts(node.ref.block)) given_ += grid.mass.at(node.ref.block, 0, node.ref.node) * change;
    }
  }
}

// In the first step nothing moves yet; what its force would set in motion within the time is not at rest.
void Sleep::strike_what_sets_off(StepContext& context) {
  double lightest = std::numeric_limits<double>::infinity();
  for (const ParticleSet& set : parts_.sets) {
    if (set.size() > 0) lightest = std::min(lightest, set.least_whole_mass());
  }
  if (across_) {
    double greatest = -lightest;
    across_->ranks().largest(&greatest, 1);
    lightest = -greatest;
  }
  const auto sets_off = [&](const SleepingBlocks::Sleeper& sleeper) {
    const Grid& grid = *context.fields[sleeper.name.field];
    const int* blocks = grid.blocks.neighbours(sleeper.owner - grid.first_owner);
    for (int i = 0; i < neighbours_of(layout_.dim()); ++i) {
      for (int n = 0; n < layout_.nodes_per_block(); ++n) {
        if (grid.mass.at(blocks[i], 0, n) < 0.5 * lightest) continue;
        const Vec3 rate = nodal_vector(grid.force, layout_, {blocks[i], n});
        if (!(rate.norm() * definition_.after <= definition_.speed)) return true;
      }
    }
    return false;
  };
  for (const SleepingBlocks::Sleeper& sleeper : sleepers_) {
    if (sets_off(sleeper)) watch_.begin_again(sleeper.owner);
  }
  const auto struck = [&](const SleepingBlocks::Sleeper& sleeper) { return !watch_.at_rest(sleeper.owner); };
  sleepers_.erase(std::remove_if(sleepers_.begin(), sleepers_.end(), struck), sleepers_.end());
}

// Gravity is booked for all material; nothing in the step carries what is asleep.
void Sleep::grid_advanced(StepContext& context) {
  if (!begun_ && definition_.from_start) strike_what_sets_off(context);
  begun_ = true;
  now_ = context.start + context.dt;
  account_.add(given_ - asleep_.mass() * context.dt * parts_.gravity);
  given_.setZero();
}

void Sleep::energies(EnergyReport& report) const {
  report.add("sleep", NamedEnergy::Kind::dissipated, energy_);
  if (definition_.damping > 0.0) report.add("damping of slow material", NamedEnergy::Kind::dissipated, damped_);
}

void Sleep::numbers(std::vector<NamedNumber>& list) const {
  list.push_back({"asleep", "1", static_cast<double>(asleep_.particles())});
}

void Sleep::limit_step(const PeriodAhead& period, StepLimit& limit) const {
  if (asleep_.rate() == 0.0 || parts_.implicit) return;
  StepLimit own;
  own.by = this;
  own.dt = period.cfl / asleep_.rate();
  own.speed = asleep_.rate() * period.cell;
  limit.tighten(own);
}

std::string Sleep::limit_text(const StepLimit& limit) const {
  return fmt::format("wave speed of material asleep ({:.4g} m/s)", limit.speed);
}

void Sleep::serialise(StateArchive& archive) {
  asleep_.serialise(archive);
  {
    const StateArchive::Group group(archive, "watch");
    watch_.serialise(archive);
  }
  using Sleeper = SleepingBlocks::Sleeper;
  archive.rows("sleepers", sleepers_);
  archive.column("sleepers/field", sleepers_, [](Sleeper& sleeper) -> int& { return sleeper.name.field; });
  archive.column("sleepers/key", sleepers_, [](Sleeper& sleeper) -> std::uint64_t& { return sleeper.name.key; });
  archive.value("looks_waited", looks_waited_);
  archive.rows("to_wake", to_wake_);
  archive.column("to_wake/field", to_wake_, &BlockName::field);
  archive.column("to_wake/key", to_wake_, &BlockName::key);
  std::vector<std::uint32_t> waited{steps_waited_, at_once_ ? 1U : 0U};  // on this rank
  archive.list("waited", waited);
  archive.value("steps", steps_);
  archive.value("begun", begun_);
  archive.value("now", now_);
  account_.serialise(archive);
  archive.sum("energy", energy_);
  archive.sum("damped", damped_);
  archive.generation("sorts_since", generation_);
  for (std::size_t f = 0; f < borders_.size(); ++f) {
    const StateArchive::Group group(archive, "border_" + std::to_string(f));
    borders_[f].serialise(archive);
  }
  if (!archive.reading()) return;
  steps_waited_ = 0;
  at_once_ = false;
  for (std::size_t i = 0; i < waited.size(); i += 2) {  // values of each rank, if others read it
    steps_waited_ = std::max(steps_waited_, waited[i]);
    at_once_ = at_once_ || waited[i + 1] != 0;
  }
  sort_names(to_wake_);
  sort_by_name(sleepers_, [](const Sleeper& sleeper) { return sleeper.name; });
  given_.setZero();  // by a step that failed, if it is not zero
  just_read_ = true;
  if (across_) across_->begin_anew();
}

bool Sleep::none_asleep() const { return across_ ? across_->none_asleep() : asleep_.all().empty(); }

void Sleep::hashed(std::vector<double>& numbers) const {
  std::vector<BlockName> names;
  for (const auto& one : asleep_.all()) names.push_back(one.first);
  std::sort(names.begin(), names.end());
  for (const BlockName& name : names) {
    numbers.push_back(name.field);
    numbers.push_back(static_cast<double>(name.key));
  }
}

}  // namespace mpm
