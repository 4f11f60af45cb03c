#include "mpm_ros/report/report_statistics.hpp"

#include <algorithm>
#include <stdexcept>

#include "mpm_ros/message/quantities.hpp"

namespace mpm_ros {

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

mpm::Vec3 as_vector(const Value& value) {
  const mpm::Vec3* vector = std::get_if<mpm::Vec3>(&value);
  return vector != nullptr ? *vector : mpm::Vec3(std::get<double>(value), 0.0, 0.0);
}

template <class Report, class Message>
void take_contact(ContactStatistics& known, const Message& message, std::int64_t time,
                  const std::vector<Quantity<Report, Message>>& quantities) {
  if (known.numbers.empty()) {
    for (const Quantity<Report, Message>& one : quantities) {
      NumberStatistics& number = known.numbers.emplace_back();
      number.name = one.name;
      number.unit = one.unit;
      number.vector = std::holds_alternative<mpm::Vec3>(one.of_message(message));
      number.axisymmetric = one.axisymmetric;
      number.figures = one.figures;
    }
  }
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    NumberStatistics& number = known.numbers[i];
    number.end = as_vector(quantities[i].of_message(message));
    number.peak.offer(number.end, time);
    number.integral += number.end * message.interval;
  }
  known.duration += message.interval;
  if (known.numbers.front().end.squaredNorm() > 0.0) {  // the force
    if (!known.contact) known.contact.emplace(time, time);
    known.contact->second = time;
  }
}

}  // namespace

const NumberStatistics& ContactStatistics::of(const std::string& number) const {
  for (const NumberStatistics& one : numbers) {
    if (one.name == number) return one;
  }
  throw std::out_of_range(name + " has no " + number);
}

mpm::Vec3 ContactStatistics::mean(const NumberStatistics& number) const {
  return number.integral / (duration > 0.0 ? duration : 1.0);  // without messages the integral is zero
}

void RunStatistics::contact_forces(std::int64_t time, const ContactForces& message) {
  for (const ContactForce& body : message.bodies) {
    take_contact(entry_of(bodies_, body.name), body, time, contact_quantities());
  }
  for (const ContactPair& pair : message.pairs) {
    take_contact(entry_of(pairs_, pair.name), pair, time, pair_quantities());
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

void RunStatistics::robots(std::int64_t time, const RobotStates& message) {
  for (std::size_t r = 0; r < message.robots.size(); ++r) {
    if (r == robots_.size()) robots_.emplace_back();
    robots_[r].take(time, message.robots[r]);
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
  const auto force = [](const BodyStatistics& body) {
    return body.numbers.empty() ? Extreme() : body.of("force").peak;
  };
  const auto weaker = [&](const BodyStatistics& a, const BodyStatistics& b) { return force(a).norm < force(b).norm; };
  const auto strongest = std::max_element(bodies_.begin(), bodies_.end(), weaker);
  if (strongest == bodies_.end() || force(*strongest).norm == 0.0) return std::nullopt;
  return force(*strongest).time;
}

}  // namespace mpm_ros
