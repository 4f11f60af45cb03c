// An artificial run, written to a bag as the node writes it, with closed forms for all reported numbers.
#pragma once

#include <mpm_ros/BodyStates.h>
#include <mpm_ros/Command.h>
#include <mpm_ros/ContactForces.h>
#include <mpm_ros/RunInfo.h>
#include <mpm_ros/SolverState.h>
#include <rosbag/bag.h>
#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/MarkerArray.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "mpm/math/constants.hpp"

namespace mpm_ros::test {

using mpm::kPi;

/// A tool that moves along x and turns about y under a half sine of force along x, F = A sin(pi t / T).
struct HalfSineRun {
  static constexpr double kAmplitude = 40.0;  // A [N]
  static constexpr int kIntervals = 101;      // odd: one interval lies in the middle
  static constexpr double kStep = 1e-3;       // time between messages, the sync period [s]
  static constexpr double kSpeed = 0.2;       // [m/s]
  static constexpr double kTurnRate = 0.5;    // [rad/s]
  static constexpr double kWeight = -3.0;     // weight of the material, along z [N]
  static constexpr double kDuration = kIntervals * kStep;

  /// Impulse on the tool since the start, A T / pi (1 - cos(pi t / T)) [N s].
  static double impulse(double t) { return kAmplitude * kDuration / kPi * (1.0 - std::cos(kPi * t / kDuration)); }
  /// Mean force over an interval [N].
  static double mean(double begin, double end) { return (impulse(end) - impulse(begin)) / (end - begin); }

  /// Called with each message before it is written; if it returns false the message is left out. `index` counts the
  /// messages of a topic.
  std::function<bool(int index, SolverState& message)> on_state = [](int, SolverState&) { return true; };
  std::function<bool(int index, ContactForces& message)> on_forces = [](int, ContactForces&) { return true; };
  std::function<bool(int index, BodyStates& message)> on_bodies = [](int, BodyStates&) { return true; };
  std::function<bool(int index, sensor_msgs::PointCloud2& message)> on_particles = [](int, auto&) { return true; };
  bool with_info = true;
  std::string name_space = "/mpm";
  ros::Time origin;  // stamp of simulated time zero

  void write(const std::string& path) const {
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    write(bag);
    bag.close();
  }
  void write(rosbag::Bag& bag) const;

 private:
  ros::Time stamp(int index) const {
    ros::Time time;
    time.fromNSec(origin.toNSec() + static_cast<std::uint64_t>(index) * 1000000U);
    return time.isZero() ? ros::TIME_MIN : time;
  }
};

inline void HalfSineRun::write(rosbag::Bag& bag) const {
  if (with_info) {
    RunInfo info;
    info.scene = "half_sine";
    info.sync_period = kStep;
    info.start = origin;
    info.version = "0.0.0";
    info.isa = "none";
    bag.write(name_space + "/run_info", stamp(0), info);
  }
  visualization_msgs::MarkerArray markers;
  markers.markers.resize(1);
  markers.markers[0].header.frame_id = "tool";
  markers.markers[0].type = visualization_msgs::Marker::TRIANGLE_LIST;
  markers.markers[0].pose.orientation.w = 1.0;
  // A tetrahedron: four corners, four faces.
  const double corners[4][3] = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
  const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  for (const auto& face : faces) {
    for (const int corner : face) {
      geometry_msgs::Point point;
      point.x = corners[corner][0];
      point.y = corners[corner][1];
      point.z = corners[corner][2];
      markers.markers[0].points.push_back(point);
    }
  }
  bag.write(name_space + "/markers", stamp(0), markers);

  Command command;
  command.header.stamp = stamp(10);
  command.body = "tool";
  command.kind = Command::VELOCITY;
  command.twist.linear.x = kSpeed;
  command.requested = stamp(8);
  bag.write(name_space + "/commands", stamp(10), command);

  for (int i = 0; i <= kIntervals; ++i) {
    const double t = i * kStep;
    ContactForces forces;
    forces.header.stamp = stamp(i);
    forces.bodies.resize(1);
    ContactForce& tool = forces.bodies[0];
    tool.name = "tool";
    tool.interval = i == 0 ? 0.0 : kStep;
    tool.wrench.force.x = i == 0 ? 0.0 : mean(t - kStep, t);
    tool.wrench.torque.y = -0.1 * tool.wrench.force.x;
    tool.peak.force.x = 2.0 * tool.wrench.force.x;
    tool.impulse.x = impulse(t);
    tool.nodes = 7;
    if (on_forces(i, forces)) bag.write(name_space + "/contact_forces", stamp(i), forces);

    BodyStates bodies;
    bodies.header.stamp = stamp(i);
    bodies.bodies.resize(1);
    bodies.bodies[0].name = "tool";
    bodies.bodies[0].pose.position.x = kSpeed * t;
    bodies.bodies[0].pose.position.z = 0.3;
    bodies.bodies[0].pose.orientation.w = std::cos(0.5 * kTurnRate * t);
    bodies.bodies[0].pose.orientation.y = std::sin(0.5 * kTurnRate * t);
    bodies.bodies[0].twist.linear.x = kSpeed;
    bodies.bodies[0].twist.angular.y = kTurnRate;
    bodies.bodies[0].drive = BodyState::VELOCITY;
    if (on_bodies(i, bodies)) bag.write(name_space + "/bodies", stamp(i), bodies);

    SolverState state;
    state.header.stamp = stamp(i);
    state.time = t;
    state.steps = static_cast<std::uint64_t>(10 * i);
    state.dt = state.dt_min = state.dt_max = kStep / 10;
    state.particles = 4;
    state.energy_kinetic = 1.0 + i;
    state.energy_elastic = 2.0;
    state.energy_potential = -4.0 - 0.5 * i;
    state.impulses.resize(2);
    state.impulses[0].name = "gravity";
    state.impulses[0].impulse.z = kWeight * t;
    state.impulses[1].name = "contact/tool";
    state.impulses[1].impulse.x = -impulse(t);
    state.initial_momentum.y = 0.25;
    state.momentum.x = -impulse(t);
    state.momentum.y = 0.25;
    state.momentum.z = kWeight * t;
    state.momentum_exchanged = impulse(t) + std::abs(kWeight) * t;
    state.min_j = 0.9;
    state.real_time_factor = 0.5;
    state.commands_applied = i >= 10 ? 1 : 0;
    if (on_state(i, state)) bag.write(name_space + "/solver_state", stamp(i), state);

    if (i % 10 != 0) continue;
    sensor_msgs::PointCloud2 cloud;
    cloud.header.stamp = stamp(i);
    const char* names[] = {"x", "y", "z", "id", "vx"};
    for (std::uint32_t field = 0; field < 5; ++field) {
      cloud.fields.emplace_back();
      cloud.fields.back().name = names[field];
      cloud.fields.back().offset = 4 * field;
      cloud.fields.back().count = 1;
      cloud.fields.back().datatype = field == 3 ? sensor_msgs::PointField::UINT32 : sensor_msgs::PointField::FLOAT32;
    }
    cloud.height = 1;
    cloud.width = 4;
    cloud.point_step = 20;
    cloud.row_step = 80;
    cloud.data.resize(80);
    for (std::uint32_t particle = 0; particle < 4; ++particle) {
      const float x = 0.01F * static_cast<float>(particle);
      const float values[] = {x, -x, 0.5F, 0.0F, static_cast<float>(i)};
      std::memcpy(cloud.data.data() + 20 * particle, values, 20);
      const std::uint32_t id = 3 * particle;  // as for a stride of 3
      std::memcpy(cloud.data.data() + 20 * particle + 12, &id, 4);
    }
    if (on_particles(i / 10, cloud)) bag.write(name_space + "/particles", stamp(i), cloud);
  }
}

}  // namespace mpm_ros::test
