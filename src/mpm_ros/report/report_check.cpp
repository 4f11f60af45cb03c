#include "mpm_ros/report/report_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "mpm/rules/method_rules.hpp"
#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/quantities.hpp"
#include "mpm_ros/report/report_cloud.hpp"
#include "mpm_ros/report/report_values.hpp"

namespace mpm_ros {
namespace {

constexpr std::int64_t kStampRounding = 1;  // [ns]: a time in double precision is rounded to whole nanoseconds
constexpr double kStepRounding = 1e-9;      // rounding of steps: N equal steps between sync points of whole nanoseconds
constexpr double kUnitLimit = 1e-9;         // error of a quaternion's norm: it is renormalised every step
constexpr std::size_t kGapsListed = 10;
constexpr double kBalanceLimit = 0.01;  // part of the energy that was spent
// Limit for impulses on bodies over their size: sums on the grid, which is double whatever the particles are.
constexpr double kImpulseLimit = audit_limit(mpm::Precision::float64);

bool finite(const mpm::Vec3& vector) { return vector.allFinite(); }

/// `difference` in units of `scale`; a difference where nothing was exchanged is infinitely wrong.
double relative(double difference, double scale) {
  if (difference == 0.0) return 0.0;
  return scale > 0.0 ? difference / scale : std::numeric_limits<double>::infinity();
}

}  // namespace

RunChecks::RunChecks(double sync_period, mpm::Precision precision, std::vector<std::string> missing, bool axisymmetric)
    : sync_period_(mpm::nanoseconds_of(sync_period)),
      audit_limit_(audit_limit(precision)),
      missing_(std::move(missing)),
      axisymmetric_(axisymmetric) {}

void RunChecks::fail(const std::string& name, std::int64_t time, const std::string& what) {
  failures_.emplace(name, fmt::format("at {} s: {}", mpm::nearest_seconds(time), what));
}

void RunChecks::gap(const std::string& text) {
  failures_.emplace("gaps", text);
  if (gaps_.size() < kGapsListed) gaps_.push_back(text);
}

void RunChecks::space(const std::string& topic, std::int64_t time) {
  Spacing& known = spacing_[topic];
  ++known.count;
  if (!known.first) {
    known.first = known.last = time;
    return;
  }
  const std::int64_t interval = time - known.last;
  known.last = time;
  if (interval == 0) return;  // the closing message of a run repeats the last time
  if (interval < 0) {
    gap(fmt::format("{}: time goes back by {} s to {} s (was the run reset?)", topic, mpm::nearest_seconds(-interval),
                    mpm::nearest_seconds(time)));
    return;
  }
  if (known.interval == 0) {
    known.interval = interval;
    if (sync_period_ > 0 && interval % sync_period_ != 0) {
      gap(fmt::format("{}: {} s between messages is no multiple of the sync period, {} s", topic,
                      mpm::nearest_seconds(interval), mpm::nearest_seconds(sync_period_)));
    }
    return;
  }
  // Messages come at multiples of their interval: a run that goes on from between two of them begins with less.
  if (known.count == 3 && interval > known.interval && *known.first % interval != 0) known.interval = interval;
  if (known.shorter) {
    gap(fmt::format("{}: only {} s before {} s, {} s elsewhere", topic, mpm::nearest_seconds(*known.shorter),
                    mpm::nearest_seconds(known.last - interval), mpm::nearest_seconds(known.interval)));
    known.shorter.reset();
  }
  if (interval < known.interval) known.shorter = interval;
  if (interval > known.interval) {
    gap(fmt::format("{}: {} s missing before {} s", topic, mpm::nearest_seconds(interval - known.interval),
                    mpm::nearest_seconds(time)));
  }
}

void RunChecks::contact_forces(std::int64_t time, const ContactForces& message) {
  for (const ContactForce& body : message.bodies) {
    add_up(impulses_[body.name], time, body, from_message(body.wrench.force));
    if (!finite(from_message(body.wrench.torque))) {
      fail("impulse", time, "the torque on " + body.name + " is not finite");
    }
    if (state_ && state_time_ == time) check_against_material(body.name, time, from_message(body.impulse));
  }
  for (const ContactPair& pair : message.pairs) {
    add_up(pair_impulses_[pair.name], time, pair, from_message(pair.force));
  }
}

template <class Contact>
void RunChecks::add_up(KnownImpulse& known, std::int64_t time, const Contact& contact, const mpm::Vec3& force) {
  const std::string& name = contact.name;
  const mpm::Vec3 impulse = from_message(contact.impulse);
  const std::int64_t begin = time - mpm::nanoseconds_of(contact.interval);
  bool whole = true;  // the interval begins where the last one ended
  if (known.time && std::llabs(begin - *known.time) > kStampRounding) {
    whole = false;
    gap(fmt::format("contact_forces: the interval of {} that ends at {} s begins at {} s, the last ended at {} s", name,
                    mpm::nearest_seconds(time), mpm::nearest_seconds(begin), mpm::nearest_seconds(*known.time)));
  }
  if (!known.time && std::llabs(begin) > kStampRounding)
    whole = false;  // recorded from later on: no known impulse before
  const mpm::Vec3 gained = force * contact.interval;
  known.exchanged += gained.norm();
  if (whole) {
    const double error = relative((known.impulse + gained - impulse).norm(), known.exchanged);
    worst_impulse_ = std::max(worst_impulse_, error);
    if (!(error <= kImpulseLimit)) {
      fail("impulse", time,
           fmt::format("the forces on {} add up to another impulse than is reported, by {:.3g} of it", name, error));
    }
  }
  known.impulse = impulse;
  known.time = time;
  if (!finite(force) || !finite(impulse)) fail("impulse", time, "force or impulse of " + name + " is not finite");
}

void RunChecks::check_against_material(const std::string& body, std::int64_t time, const mpm::Vec3& impulse) {
  const std::vector<Impulse>& impulses = state_->impulses;
  const auto named = [&body](const Impulse& other) { return other.name == "contact/" + body; };
  const auto on_material = std::find_if(impulses.begin(), impulses.end(), named);
  if (on_material == impulses.end()) {
    fail("complete", time, "the audit has no impulse contact/" + body);
    return;
  }
  // About an axis the audit has the radial sum, which is no force on the body.
  mpm::Vec3 difference = impulse + from_message(on_material->impulse);
  if (axisymmetric_) difference.x() = 0.0;
  const double error = relative(difference.norm(), state_->momentum_exchanged);
  worst_reaction_ = std::max(worst_reaction_, error);
  if (!(error <= kImpulseLimit)) {
    fail("reaction", time,
         fmt::format("impulse on {} and on the material differ by {:.3g} of the momentum exchanged", body, error));
  }
}

void RunChecks::bodies(std::int64_t time, const BodyStates& message) {
  space("bodies", time);
  for (const mpm::BodyState& state : body_states_of(message)) {
    posed_.insert(state.name);
    const mpm::Pose& pose = state.pose;
    if (!finite(pose.position) || !pose.orientation.coeffs().allFinite()) {
      fail("bodies", time, "pose of " + state.name + " is not finite");
    } else if (std::abs(pose.orientation.norm() - 1.0) > kUnitLimit) {
      fail("bodies", time, fmt::format("quaternion of {} has norm {}", state.name, pose.orientation.norm()));
    }
    if (!finite(state.twist.linear) || !finite(state.twist.angular)) {
      fail("bodies", time, "twist of " + state.name + " is not finite");
    }
  }
}

void RunChecks::solver_state(std::int64_t time, const SolverState& message) {
  space("solver_state", time);
  const std::int64_t off = std::llabs(mpm::nanoseconds_of(message.time) - time);
  worst_stamp_ = std::max(worst_stamp_, mpm::nearest_seconds(off));
  if (off > kStampRounding) {
    fail("stamps", time,
         fmt::format("the solver's time is {} s, {:.3g} s off the stamp", message.time, mpm::nearest_seconds(off)));
  }
  check_steps(time, message);

  const mpm::Vec3 initial = from_message(message.initial_momentum);
  mpm::Vec3 residual = from_message(message.momentum) - initial;
  for (const Impulse& impulse : message.impulses) residual -= from_message(impulse.impulse);
  const double scale = std::max({message.momentum_exchanged, message.momentum_carried, initial.norm()});
  const double error = std::max(relative(residual.norm(), scale), message.momentum_error);
  worst_audit_ = std::max(worst_audit_, error);
  if (!(error <= audit_limit_)) {
    fail("audit", time, fmt::format("residual {:.3g} of the momentum exchanged, limit {:.0e}", error, audit_limit_));
  }

  for (const StateQuantity& one : state_quantities()) {
    if (one.unit == "J" && !std::isfinite(std::get<double>(one.of_message(message)))) {
      fail("energy", time, one.name + " is not finite");
    }
  }
  check_balance(time, message);
  min_j_ = std::min(min_j_, message.min_j);
  if (message.failed) fail("run", time, "the run failed: " + message.failure);
  if (!state_) {
    from_start_ = time == 0;
    refused_before_ = message.commands_refused;
  }
  commands_before_ = last_command_ < time ? commands_ : earlier_commands_;
  commands_until_ = commands_;
  applied_ = message.commands_applied;
  late_ = message.commands_late;
  refused_ = message.commands_refused - std::min<std::uint64_t>(message.commands_refused, refused_before_);
  if (!(message.min_j > 0.0)) fail("volume", time, fmt::format("the smallest det F is {}", message.min_j));

  std::vector<std::string> names;
  for (const Impulse& impulse : message.impulses) names.push_back(impulse.name);
  if (!state_) impulse_names_ = names;
  if (names != impulse_names_) fail("complete", time, "the audit's impulses are not those of the first message");

  state_ = message;
  state_time_ = time;
  for (const auto& [body, known] : impulses_) {
    if (known.time == time) check_against_material(body, time, known.impulse);
  }
}

void RunChecks::check_steps(std::int64_t time, const SolverState& state) {
  if (!state_) return;
  if (state.steps < state_->steps) {
    fail("steps", time, fmt::format("steps went back from {} to {}", state_->steps, state.steps));
    return;
  }
  const double elapsed = mpm::nearest_seconds(time - state_time_),
               steps = static_cast<double>(state.steps - state_->steps);
  if (steps == 0.0 || elapsed <= 0.0) {
    // Only the message that closes a run repeats a time; a run that failed may have stepped on from it.
    if (elapsed > 0.0) fail("steps", time, fmt::format("{} s passed in no step", elapsed));
    return;
  }
  const double mean = elapsed / steps;
  if (mean < state.dt_min * (1.0 - kStepRounding) || mean > state.dt_max * (1.0 + kStepRounding)) {
    fail("steps", time,
         fmt::format("{} steps in {} s are {:.6g} s each, not within {:.6g} s to {:.6g} s", steps, elapsed, mean,
                     state.dt_min, state.dt_max));
  }
}

void RunChecks::check_balance(std::int64_t time, const SolverState& state) {
  const auto named = [](const NamedValue& one) { return one.name == kBalance && one.value.size() == 1; };
  const auto found = std::find_if(state.values.begin(), state.values.end(), named);
  if (found == state.values.end()) return;
  if (!first_state_) {
    first_state_ = state;
    first_balance_ = found->value[0];
  }
  const double change = std::abs(found->value[0] - *first_balance_);
  if (!(change <= worst_balance_)) {
    worst_balance_ = change;
    worst_balance_time_ = time;
  }
  const auto gained = [](double now, double before) { return std::max(now - before, 0.0); };
  const SolverState& first = *first_state_;
  spent_ = std::max(spent_, gained(state.contact_work, first.contact_work) + gained(state.load_work, first.load_work) +
                                gained(first.energy_kinetic, state.energy_kinetic) +
                                gained(first.energy_elastic, state.energy_elastic) +
                                gained(first.energy_interface, state.energy_interface) +
                                gained(first.energy_potential, state.energy_potential));
}

void RunChecks::command(std::int64_t time, const Command& /*message*/) {
  if (time > last_command_) earlier_commands_ = commands_;
  last_command_ = time;
  ++commands_;
  if (state_ && state_time_ == time) commands_until_ = commands_;
}

void RunChecks::global_quantities(std::int64_t time, const GlobalQuantities& message) {
  if (message.values.size() != message.names.size() || message.units.size() != message.names.size()) {
    fail("global", time,
         fmt::format("{} names, {} units and {} values", message.names.size(), message.units.size(),
                     message.values.size()));
  }
  for (std::size_t i = 0; i < std::min(message.names.size(), message.values.size()); ++i) {
    if (!std::isfinite(message.values[i])) fail("global", time, message.names[i] + " is not finite");
  }
  ++spacing_["global_quantities"].count;
}

void RunChecks::robots(std::int64_t time, const RobotStates& message) {
  for (const ComparedValue& value : values_of(message)) {
    if (!std::isfinite(value.number)) fail("robots", time, value.field + " is not finite");
  }
  ++spacing_["robots"].count;
}

void RunChecks::clock(std::int64_t time) {
  if (clocks_++ > 0 && time < last_clock_) {
    fail("clock", time, fmt::format("/clock goes back by {} s", mpm::nearest_seconds(last_clock_ - time)));
  }
  // Stamp zero means no time to ROS: the first one may be a nanosecond.
  if (sync_period_ > 0 && time > kStampRounding && time % sync_period_ != 0) {
    fail("clock", time, fmt::format("/clock is not at a sync point, every {} s", mpm::nearest_seconds(sync_period_)));
  }
  last_clock_ = time;
}

void RunChecks::particles(std::int64_t time, const sensor_msgs::PointCloud2& message) {
  ++spacing_["particles"].count;
  const std::optional<std::string> field = field_not_finite(message);
  if (field) fail("particles", time, "a value of " + *field + " is not finite");
}

std::vector<CheckResult> RunChecks::results() const {
  std::map<std::string, std::string> failures = failures_;
  std::vector<std::string> missing = missing_;
  for (const auto& [body, known] : impulses_) {
    if (posed_.count(body) == 0) missing.push_back("pose of " + body);
  }
  if (!missing.empty()) failures.emplace("complete", fmt::format("missing: {}", fmt::join(missing, ", ")));

  // A state of a sync point comes before the commands that take effect there, so that those of a run that was killed
  // are in no state; the state that closes a run comes after them.
  if (from_start_ && (applied_ < commands_before_ || applied_ > commands_until_)) {
    failures.emplace("commands", fmt::format("{} were applied, {} are in the bag", applied_, commands_until_));
  }
  if (refused_ > 0) {
    failures.emplace("commands",
                     fmt::format("{} were refused and changed nothing ({} applied, {} late); /diagnostics said why",
                                 refused_, applied_, late_));
  }
  const double residual = relative(worst_balance_, spent_);
  if (first_balance_ && !(residual <= kBalanceLimit)) {
    failures.emplace("balance",
                     fmt::format("at {} s: {:.4g} J have no account, {:.2g} % of the {:.4g} J spent; a "
                                 "method.update=usavg or a smaller time.cfl may help",
                                 mpm::nearest_seconds(worst_balance_time_), worst_balance_, 100.0 * residual, spent_));
  }
  std::map<std::string, std::string> not_made;
  if (!first_balance_) {
    not_made.emplace("balance",
                     fmt::format("made of {} alone, moved by flip in explicit steps; not with contact between "
                                 "deformable bodies or tools of particles",
                                 mpm::law_names(mpm::closes_energy)));
  } else if (spent_ == 0.0) {
    not_made.emplace("balance", "no energy was spent");
  }
  if (clocks_ == 0) not_made.emplace("clock", "/clock is not in the bag");
  if (spacing_.count("global_quantities") == 0) not_made.emplace("global", "the scene asks for no global quantities");
  if (spacing_.count("robots") == 0) not_made.emplace("robots", "the scene has no robots");

  const auto spacing = spacing_.find("solver_state");
  Spacing states;
  if (spacing != spacing_.end()) states = spacing->second;
  const auto snapshots = spacing_.find("particles");
  const std::pair<const char*, std::string> passed[] = {
      {"audit",
       fmt::format("residual at most {:.2g} of the momentum exchanged, limit {:.0e}", worst_audit_, audit_limit_)},
      {"energy", "finite throughout"},
      {"balance", fmt::format("work and stored energy of {:.4g} J are found again to {:.2g} %, limit {:g} %", spent_,
                              100.0 * residual, 100.0 * kBalanceLimit)},
      {"gaps",
       fmt::format("{} states, every {} s from {} s to {} s", states.count, mpm::nearest_seconds(states.interval),
                   mpm::nearest_seconds(states.first.value_or(0)), mpm::nearest_seconds(states.last))},
      {"stamps", fmt::format("at most {:.2g} s off the solver's time", worst_stamp_)},
      {"steps", "as many as the time between states asks for, none backwards"},
      {"clock", fmt::format("{} messages, at sync points, none backwards", clocks_)},
      {"commands", fmt::format("{} applied, {} of them late, none refused", applied_, late_)},
      {"global", "all values finite"},
      {"volume", fmt::format("smallest det F {:.4g}", min_j_)},
      {"bodies", "poses and twists finite, quaternions of unit length"},
      {"robots", "joints, sensors and energies finite"},
      {"impulse", fmt::format("forces add up to the impulses, within {:.2g} of them", worst_impulse_)},
      {"reaction",
       fmt::format("impulses on bodies and on the material are opposite, within {:.2g} of the momentum exchanged",
                   worst_reaction_)},
      {"particles",
       fmt::format("{} snapshots, all values finite", snapshots == spacing_.end() ? 0 : snapshots->second.count)},
      {"complete", "every topic and every body is there"},
      {"run", "did not fail"}};
  std::vector<CheckResult> results;
  for (const auto& [name, detail] : passed) {
    const auto failure = failures.find(name);
    if (failure == failures.end() && not_made.count(name) > 0) {
      results.push_back({name, true, not_made.at(name), false});
    } else if (failure == failures.end()) {
      results.push_back({name, true, detail});
    } else {
      results.push_back({name, false, failure->second});
    }
  }
  return results;
}

}  // namespace mpm_ros
