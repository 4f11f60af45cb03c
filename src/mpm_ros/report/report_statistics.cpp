#include "mpm_ros/report/report_statistics.hpp"

#include <algorithm>

namespace mpm_ros {

void Extreme::offer(const mpm::Vec3& candidate, std::int64_t when) {
  if (candidate.norm() <= norm) return;
  norm = candidate.norm();
  vector = candidate;
  time = when;
}

namespace {

/// The entry of that name, made where there is none.
template <typename Entry>
Entry& entry_of(std::vector<Entry>& entries, const std::string& name) {
  const auto named = [&name](const Entry& known) { return known.name == name; };
  const auto found = std::find_if(entries.begin(), entries.end(), named);
  if (found != entries.end()) return *found;
  entries.emplace_back();
  entries.back().name = name;
  return entries.back();
}

/// What statistics of a body and of a pair have in common: force, impulse, area, friction and time of contact.
template <typename Statistics, typename Report>
void take_contact(Statistics& known, const mpm::Vec3& force, const Report& report, std::int64_t time) {
  known.force.offer(force, time);
  known.force_integral += force * report.interval;
  known.impulse = report.impulse;
  known.duration += report.interval;
  known.largest_area = std::max(known.largest_area, report.area);
  known.friction_energy = report.friction_energy;
  if (force.squaredNorm() > 0.0) {
    if (!known.contact) known.contact.emplace(time, time);
    known.contact->second = time;
  }
}

}  // namespace

void RunStatistics::contact_forces(std::int64_t time, const ContactForces& message) {
  for (const mpm::ContactReport& report : contact_reports_of(message)) {
    BodyStatistics& known = entry_of(bodies_, report.body);
    take_contact(known, report.mean.force, report, time);
    known.step_force.offer(report.peak.force, time);
    known.torque.offer(report.mean.torque, time);
    known.per_radian.offer(report.per_radian, time);
    known.per_radian_integral += report.per_radian * report.interval;
    known.torque_integral += report.mean.torque * report.interval;
  }
  for (const mpm::PairReport& report : pair_reports_of(message)) {
    PairStatistics& known = entry_of(pairs_, report.name);
    take_contact(known, report.force, report, time);
    known.interface_energy = report.interface_energy;
  }
}

void RunStatistics::bodies(std::int64_t /*time*/, const BodyStates& message) {
  for (const mpm::BodyState& state : body_states_of(message)) {
    BodyStatistics& known = entry_of(bodies_, state.name);
    if (!known.first) known.first = state.pose;
    known.last = state.pose;
    known.range.add(state.pose.position);
    known.largest_turn = std::max(known.largest_turn, known.first->orientation.angularDistance(state.pose.orientation));
  }
}

void RunStatistics::solver_state(std::int64_t /*time*/, const SolverState& message) {
  if (!first_state_) first_state_ = message;
  last_state_ = message;
  smallest_j_ = std::min(smallest_j_, message.min_j);
  worst_audit_ = std::max(worst_audit_, message.momentum_error);
}

void RunStatistics::global_quantities(std::int64_t /*time*/, const GlobalQuantities& message) {
  for (std::size_t i = 0; i < std::min({message.names.size(), message.units.size(), message.values.size()}); ++i) {
    const double value = message.values[i];
    if (i == global_.size()) global_.push_back({message.names[i], message.units[i], value});
    GlobalStatistics& known = global_[i];
    known.last = value;
    known.least = std::min(known.least, value);
    known.most = std::max(known.most, value);
  }
}

void RunStatistics::command(std::int64_t time, const Command& message) {
  CommandStatistics& known = commands_[{message.body, command_kind_name(message.kind)}];
  if (known.count++ == 0) known.first = time;
  known.last = time;
  if (!message.requested.isZero() && message.requested < message.header.stamp) ++known.late;
}

void RunStatistics::particles(std::int64_t time, const sensor_msgs::PointCloud2& /*message*/) {
  snapshots_.push_back(time);
}

std::optional<std::int64_t> RunStatistics::peak_time() const {
  const auto weaker = [](const BodyStatistics& a, const BodyStatistics& b) { return a.force.norm < b.force.norm; };
  const auto strongest = std::max_element(bodies_.begin(), bodies_.end(), weaker);
  if (strongest == bodies_.end() || strongest->force.norm == 0.0) return std::nullopt;
  return strongest->force.time;
}

}  // namespace mpm_ros
