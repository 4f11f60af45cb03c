#include "over_ranks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "mpm/math/byte_hash.hpp"
#include "mpm/ranks/lists.hpp"
#include "mpm/step/step_context.hpp"

namespace mpm {
namespace {

constexpr double kAround = 4.0;  ///< cells beside a tool whose nodes contact with it may need
constexpr double kMoves = 2.0;   ///< cells that a tool may move before ranks meet again

/// Largest distance of a point of the body from where it was [m].
double moved(const RigidBody& body, const Pose& from, const GridLayout& layout) {
  const Box bounds = body.surface().bounds();
  const Vec3 corner = bounds.min.cwiseAbs().cwiseMax(bounds.max.cwiseAbs());
  double squared = 0.0;
  for (int k = 0; k < layout.dim(); ++k) squared += std::pow(corner[layout.axis(k)], 2);
  const double turned = from.orientation.angularDistance(body.pose().orientation);
  const double by_turning = turned > 0.0 ? turned * std::sqrt(squared) : 0.0;  // endless bodies need not turn
  return (body.pose().position - from.position).norm() + by_turning;
}

}  // namespace

OverRanks::OverRanks(Communicator& ranks, const GridLayout& layout, const std::vector<RigidBody>& bodies)
    : ranks_(ranks),
      layout_(layout),
      bodies_(bodies),
      territory_(layout, ranks.size()),
      hand_over_(ranks, territory_, layout),
      halo_(ranks, territory_) {}

Halo::Everywhere OverRanks::near_tool() const {
  Vec3 half = Vec3::Zero();
  for (int k = 0; k < layout_.dim(); ++k) half[layout_.axis(k)] = 0.5 * (kBlockEdge - 1) * layout_.cell(k);
  const double reach = half.norm() + (kAround + kMoves) * layout_.largest_cell();
  return [this, half, reach](const std::array<int, 3>& block) {
    const Vec3 middle = layout_.node_position(block, 0) + half;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      SurfacePoint point;
      if (bodies_[b].surface().within(met_at_[b].to_body(middle), reach, point)) return true;
    }
    return false;
  };
}

void OverRanks::hand_over(std::vector<ParticleSet>& sets, const Fields& fields) {
  hand_over_.hand_over(sets, owner_keys(fields));
}

void OverRanks::settle(std::vector<ParticleSet>& sets, ParticleRef& at) {
  at.index = static_cast<int>(orders()[at.set].number_of(at.index));
  hand_over_.settle(sets);
}

void OverRanks::meet(Fields& fields) {
  met_at_.clear();
  for (const RigidBody& body : bodies_) met_at_.push_back(body.pose());
  halo_.meet(fields, near_tool());
}

// Keeps where tools were when ranks met: by it they had their blocks, and from there tools may move.
void OverRanks::meet_as_read(Fields& fields) { halo_.meet(fields, near_tool()); }

bool OverRanks::tools_have_moved() const {
  const double most = 0.5 * kMoves * layout_.smallest_cell();  // the rest is for the step that follows
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!(moved(bodies_[b], met_at_[b], layout_) < most)) return true;
  }
  return false;
}

StepFlags OverRanks::shared(const StepFlags& own, const Mechanics& mechanics) {
  const Mechanics::Mixed mixed = mechanics.mixed();
  const auto flag = [](bool is_so) { return is_so ? 1.0 : 0.0; };
  // In one exchange: on how many ranks it is so, and the sums.
  double sums[] = {flag(own.failed), flag(own.sorts || mechanics.must_sort()),
                   flag(own.stops),  flag(tools_have_moved()),
                   mixed.groups,     mixed.parts};
  ranks_.sum(sums, 6);
  const Mechanics::Mixed of_all{sums[4], sums[5]};
  return {sums[0] > 0.0, sums[1] > 0.0 || of_all.too_much(), sums[2] > 0.0, sums[3] > 0.0};
}

void OverRanks::warn_of_idle(const std::vector<ParticleSet>& sets, std::vector<std::string>& warnings) {
  const bool idle = std::all_of(sets.begin(), sets.end(), [](const ParticleSet& set) { return set.size() == 0; });
  const double count = ranks_.sum(idle ? 1.0 : 0.0);
  if (!(count > 0.0)) return;
  warnings.push_back(fmt::format(
      "{:.0f} of {} ranks have no particle: particles are shared out by blocks of {} cells along each axis, "
      "of which this scene has too few; start fewer ranks",
      count, ranks_.size(), kBlockEdge));
}

void OverRanks::share(StepLimit& limit, const Modules& modules, const Module* mechanics) {
  struct Told {
    double dt, speed, place[3];
    std::int32_t by, part, foreseen;
  };
  constexpr std::int32_t kNobody = -2, kMechanics = -1;
  const std::vector<Module*>& list = modules.list();
  std::int32_t by = limit.by == nullptr ? kNobody : kMechanics;
  if (const auto own = std::find(list.begin(), list.end(), limit.by); own != list.end()) {
    by = static_cast<std::int32_t>(own - list.begin());
  }
  const Told told{limit.dt, limit.speed, {limit.place.x(), limit.place.y(), limit.place.z()},
                  by,       limit.part,  limit.foreseen ? 1 : 0};
  Communicator::Bytes bytes(sizeof(Told));
  std::memcpy(bytes.data(), &told, sizeof(Told));
  limit = {};
  for (const Communicator::Bytes& other : ranks_.gather(bytes)) {
    Told heard{};
    std::memcpy(&heard, other.data(), sizeof(Told));
    StepLimit one;
    one.dt = heard.dt;
    if (heard.by != kNobody) one.by = heard.by == kMechanics ? mechanics : list[heard.by];
    one.part = heard.part;
    one.speed = heard.speed;
    one.place = {heard.place[0], heard.place[1], heard.place[2]};
    one.foreseen = heard.foreseen != 0;
    limit.tighten(one);
  }
}

void OverRanks::add_up(EnergyReport& report) {
  std::vector<double> values;
  for (const NamedEnergy& energy : report.list()) values.push_back(energy.value);
  ranks_.sum(values.data(), static_cast<int>(values.size()));
  report.replace(values);
}

void OverRanks::add_up(std::vector<ImpulseAccount>& accounts) {
  std::vector<double> values;
  for (const ImpulseAccount& account : accounts) {
    for (const double number : {account.impulse.x(), account.impulse.y(), account.impulse.z(), account.exchanged}) {
      values.push_back(number);
    }
  }
  ranks_.sum(values.data(), static_cast<int>(values.size()));
  for (std::size_t i = 0; i < accounts.size(); ++i) {
    accounts[i].impulse = {values[4 * i], values[4 * i + 1], values[4 * i + 2]};
    accounts[i].exchanged = values[4 * i + 3];
  }
}

void OverRanks::add_up(std::vector<NamedNumber>& numbers) {
  std::vector<double> values;
  for (const NamedNumber& number : numbers) values.push_back(number.value);
  ranks_.sum(values.data(), static_cast<int>(values.size()));
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i].value = values[i];
}

void OverRanks::add_up(Vec3& vector) { ranks_.sum(vector.data(), 3); }

std::uint64_t OverRanks::hash_of_all(std::uint64_t own) {
  ByteHash all;
  for (const std::uint64_t of_rank : gather_list(ranks_, std::vector<std::uint64_t>{own})) all.add(of_rank);
  return all.value();
}

void OverRanks::serialise(StateArchive& archive) {
  const StateArchive::Group group(archive, "ranks");
  const StateArchive::Same same(archive);
  territory_.serialise(archive);
  hand_over_.serialise(archive);
  archive.rows("met_at", met_at_);
  archive.column("met_at/position", met_at_, &Pose::position);
  archive.column("met_at/orientation", met_at_, &Pose::orientation);
}

}  // namespace mpm
