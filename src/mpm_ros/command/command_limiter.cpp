#include "mpm_ros/command/command_limiter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mpm/simulation/projected.hpp"

namespace mpm_ros {

namespace {

/// Two velocities or places are one when they differ by less than this part of their size: round-off.
constexpr double kSame = 1e-9;

mpm::Vec3 shortened(const mpm::Vec3& vector, double longest) {
  const double size = vector.stableNorm();
  return size > longest ? mpm::Vec3(longest / size * vector) : vector;
}

/// From one velocity towards another by a change of `most`, or to it.
mpm::Vec3 towards(const mpm::Vec3& from, const mpm::Vec3& to, double most) {
  const mpm::Vec3 change = to - from;
  const double size = change.stableNorm();
  return size <= (1.0 + kSame) * most ? to : mpm::Vec3(from + most / size * change);
}

/// Velocity in the next period on the way to a place `way` from here, to be reached in `time` >= period [s].
mpm::Vec3 velocity_along(const mpm::Vec3& way, const mpm::Vec3& present, double speed, double acceleration, double time,
                         double period) {
  const double distance = way.stableNorm();
  mpm::Vec3 wanted = mpm::Vec3::Zero();
  if (distance > 0.0) {
    wanted = std::min({distance / time, speed, braking_speed(distance, acceleration, period)}) / distance * way;
  }
  return towards(present, wanted, acceleration * period);
}

bool same(const mpm::Vec3& a, const mpm::Vec3& b) { return (a - b).stableNorm() <= kSame * b.stableNorm(); }

/// The prescribed part of a twist; forces decide about the rest.
mpm::Twist prescribed_part(const mpm::RigidBody& body, const mpm::Twist& twist) {
  const mpm::FreeMotion* free = body.free_motion();
  return free == nullptr ? twist : free->merged({}, twist);
}

/// The prescribed part of the body's present motion. At the start of a run it has not moved yet.
mpm::Twist present_twist(const mpm::RigidBody& body, std::int64_t now) {
  return prescribed_part(body,
                         body.drive() == mpm::Drive::functions ? body.twist_at(mpm::seconds_of(now)) : body.twist());
}

}  // namespace

double braking_speed(double distance, double acceleration, double period) {
  const double step = acceleration * period;  // change of speed in a period
  if (!std::isfinite(step)) return distance / period;
  // From (n + f) steps, f < 1, it goes on for f, 1 + f, ..., n + f steps of speed: n (n + 1) / 2 + f (n + 1) in all.
  const double share = distance / (step * period);
  if (!std::isfinite(share)) return share;
  const double whole = std::floor(0.5 * (std::sqrt(1.0 + 8.0 * share) - 1.0));
  const double rest = (share - 0.5 * whole * (whole + 1.0)) / (whole + 1.0);
  return (whole + rest) * step;
}

namespace {

/// Refuses now what the body would refuse once it is applied. @throws mpm::RigidError
void check_prescribed(const AppliedCommand& command, const mpm::Simulation& simulation) {
  mpm::RigidBody body = simulation.rigid_body(command.body);
  if (command.kind == CommandKind::velocity) {
    body.command_velocity(command.twist);
  } else {
    body.command_pose(command.pose, command.effect, command.arrival);
  }
}

}  // namespace

CommandLimiter::CommandLimiter(std::vector<mpm::MotionLimits> limits, NodeHealth& health)
    : limits_(std::move(limits)), health_(health) {}

bool CommandLimiter::take(const AppliedCommand& command, const mpm::Simulation& simulation) {
  const auto body = static_cast<std::size_t>(command.body);
  if (body >= limits_.size() || !limits_[body].any() || command.kind == CommandKind::wrench) return false;
  Goal goal{command};
  const mpm::GeometryKind geometry = simulation.definition().geometry;
  const mpm::RigidBodyDefinition& definition = simulation.rigid_body(command.body).definition();
  if (command.kind == CommandKind::velocity) {
    goal.command.twist =
        prescribed_part(simulation.rigid_body(command.body), mpm::projected(command.twist, geometry, definition));
    AppliedCommand fastest = goal.command;
    fastest.twist.linear = shortened(fastest.twist.linear, limits_[body].speed);
    fastest.twist.angular = shortened(fastest.twist.angular, limits_[body].rotation_rate);
    check_travel(fastest, simulation);
  } else {
    goal.command.pose = mpm::projected(command.pose, geometry, definition);
    // Only what nothing keeps slow can be too far.
    if (std::isinf(limits_[body].speed) && std::isinf(limits_[body].acceleration))
      check_travel(goal.command, simulation);
  }
  check_prescribed(goal.command, simulation);
  goals_[command.body] = goal;
  return true;
}

std::vector<AppliedCommand> CommandLimiter::next(const mpm::Simulation& simulation) {
  std::vector<AppliedCommand> commands;
  for (auto entry = goals_.begin(); entry != goals_.end();) {
    auto& [index, goal] = *entry;
    const mpm::RigidBody& body = simulation.rigid_body(index);
    bool reached = false;
    commands.push_back(goal.command.kind == CommandKind::velocity ? towards_velocity(goal, body, simulation, reached)
                                                                  : towards_pose(goal, body, simulation, reached));
    health_.limit(body.name(), report_[index]);
    entry = reached ? goals_.erase(entry) : std::next(entry);
  }
  return commands;
}

AppliedCommand CommandLimiter::towards_velocity(Goal& goal, const mpm::RigidBody& body,
                                                const mpm::Simulation& simulation, bool& reached) {
  const mpm::MotionLimits& limits = limits_[static_cast<std::size_t>(goal.command.body)];
  const double period = mpm::seconds_of(simulation.sync_period());
  const mpm::Twist present = present_twist(body, simulation.time());
  const mpm::Twist wanted{shortened(goal.command.twist.linear, limits.speed),
                          shortened(goal.command.twist.angular, limits.rotation_rate)};
  AppliedCommand command = goal.command;
  command.effect = simulation.time();
  command.twist = {towards(present.linear, wanted.linear, limits.acceleration * period),
                   towards(present.angular, wanted.angular, limits.rotation_acceleration * period)};
  reached = command.twist.linear == wanted.linear && command.twist.angular == wanted.angular;
  if (command.twist.linear != goal.command.twist.linear || command.twist.angular != goal.command.twist.angular) {
    count(goal);
  }
  report_[command.body].behind = report_[command.body].behind_angle = 0.0;
  return command;
}

AppliedCommand CommandLimiter::towards_pose(Goal& goal, const mpm::RigidBody& body, const mpm::Simulation& simulation,
                                            bool& reached) {
  const mpm::MotionLimits& limits = limits_[static_cast<std::size_t>(goal.command.body)];
  const std::int64_t now = simulation.time(), sync = simulation.sync_period();
  const double period = mpm::seconds_of(sync);
  const double time = mpm::seconds_of(std::max(goal.command.arrival - now, sync));
  const mpm::Twist present = present_twist(body, now);
  const mpm::Twist way = prescribed_part(body, mpm::twist_between(body.pose(), goal.command.pose, 1.0));
  const mpm::Twist twist{
      velocity_along(way.linear, present.linear, limits.speed, limits.acceleration, time, period),
      velocity_along(way.angular, present.angular, limits.rotation_rate, limits.rotation_acceleration, time, period)};

  AppliedCommand command = goal.command;
  command.effect = now;
  command.arrival = now + sync;
  command.pose = mpm::integrate(body.pose(), twist, period);
  const bool there = same(period * twist.linear, way.linear), turned = same(period * twist.angular, way.angular);
  if (there) command.pose.position = goal.command.pose.position;
  if (turned) command.pose.orientation = goal.command.pose.orientation;
  reached = there && turned;
  if (!same(time * twist.linear, way.linear) || !same(time * twist.angular, way.angular)) count(goal);
  // Behind is who should have been there and is not.
  const bool late = now >= goal.command.arrival && !reached;
  report_[command.body].behind = late ? way.linear.stableNorm() : 0.0;
  report_[command.body].behind_angle = late ? way.angular.stableNorm() : 0.0;
  return command;
}

void CommandLimiter::count(Goal& goal) {
  if (!std::exchange(goal.limited, true)) ++report_[goal.command.body].limited;
}

void CommandLimiter::drop(int body) {
  goals_.erase(body);
  report_[body].behind = report_[body].behind_angle = 0.0;
}

void CommandLimiter::take_over(const CommandLimiter& other) {
  limits_ = other.limits_;
  goals_ = other.goals_;
  report_ = other.report_;
}

void CommandLimiter::serialise(mpm::StateArchive& archive) {
  const mpm::StateArchive::Group group(archive, "limiter");
  std::vector<std::pair<int, Goal>> goals(goals_.begin(), goals_.end());
  archive.rows("goals", goals);
  archive.column("goals/body", goals, [](auto& one) -> int& { return one.first; });
  const auto column = [&](const std::string& name, auto&& member) {
    archive.column("goals/" + name, goals, [&](auto& one) -> decltype(auto) { return member(one.second.command); });
  };
  column("kind", [](AppliedCommand& c) -> CommandKind& { return c.kind; });
  column("linear", [](AppliedCommand& c) -> mpm::Vec3& { return c.twist.linear; });
  column("angular", [](AppliedCommand& c) -> mpm::Vec3& { return c.twist.angular; });
  column("position", [](AppliedCommand& c) -> mpm::Vec3& { return c.pose.position; });
  column("orientation", [](AppliedCommand& c) -> mpm::Quat& { return c.pose.orientation; });
  column("effect", [](AppliedCommand& c) -> std::int64_t& { return c.effect; });
  column("arrival", [](AppliedCommand& c) -> std::int64_t& { return c.arrival; });
  column("sec", [](AppliedCommand& c) -> std::uint32_t& { return c.requested.sec; });
  column("nsec", [](AppliedCommand& c) -> std::uint32_t& { return c.requested.nsec; });
  archive.column("goals/limited", goals, [](auto& one) -> bool& { return one.second.limited; });
  if (!archive.reading()) return;
  for (auto& [body, goal] : goals) goal.command.body = body;
  goals_ = std::map<int, Goal>(goals.begin(), goals.end());
}

std::vector<AppliedCommand> CommandLimiter::goals() const {
  std::vector<AppliedCommand> commands;
  for (const auto& [body, goal] : goals_) commands.push_back(goal.command);
  return commands;
}

}  // namespace mpm_ros
