// Random parts of commands: valid ones, and any that can arrive over the network.
#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Twist.h>
#include <ros/time.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <random>
#include <string>

namespace mpm_ros::test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Stamp of simulated time zero, late enough for a stamp 1e9 s before it to be valid.
inline const ros::Time kOrigin(1'500'000'000, 0);

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  int below(int count) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(count)); }
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  std::uint32_t word() { return static_cast<std::uint32_t>(engine_()); }
  template <typename Value>
  Value one_of(std::initializer_list<Value> values) {
    return *(values.begin() + below(static_cast<int>(values.size())));
  }

  double bad_number() { return one_of({kNaN, kInfinity, -kInfinity}); }
  double huge_number() { return std::copysign(std::pow(10.0, uniform(6.0, 307.0)), uniform(-1.0, 1.0)); }
  double number() {
    const int kind = below(20);
    if (kind == 0) return bad_number();
    if (kind == 1) return huge_number();
    if (kind == 2) return one_of({0.0, -0.0, 5e-324, 1e-300});
    return uniform(-0.05, 0.05);
  }
  geometry_msgs::Twist twist(bool sound = false) {
    geometry_msgs::Twist twist;
    for (double* value :
         {&twist.linear.x, &twist.linear.y, &twist.linear.z, &twist.angular.x, &twist.angular.y, &twist.angular.z}) {
      *value = sound ? uniform(-0.05, 0.05) : number();
    }
    // Others leave the plane of the scene, and are refused.
    if (sound || below(4) > 0) twist.linear.y = twist.angular.x = twist.angular.z = 0.0;
    return twist;
  }
  geometry_msgs::Pose pose(bool sound = false) {
    geometry_msgs::Pose pose;
    pose.position.x = 0.1 + (sound ? uniform(-0.05, 0.05) : number());
    pose.position.z = 0.1 + (sound ? uniform(-0.02, 0.02) : number());
    const int kind = sound ? 0 : below(4);
    const double angle = uniform(-1.0, 1.0), scale = kind == 1 ? uniform(0.0, 2.0) : 1.0;
    pose.orientation.w = scale * std::cos(angle);
    pose.orientation.y = scale * std::sin(angle);
    if (kind == 2) pose.orientation = geometry_msgs::Quaternion();  // zero, as in an empty message
    if (kind == 3) pose.orientation.x = number();
    return pose;
  }
  std::string unknown_frame() {
    std::string noise(below(300), ' ');
    for (char& c : noise) c = static_cast<char>(word());
    return one_of<std::string>(
        {"nowhere", "/world", "wor\nld", "\xff\xfe", std::string(1000, 'x'), "{}%s%n", noise + "!"});
  }
  std::string frame() {
    return below(8) == 0 ? unknown_frame() : one_of<std::string>({"", "world", "plate", "rod", "sensor"});
  }
  /// A stamp farther ahead than the hour that is accepted.
  ros::Time far_stamp(double now) {
    switch (below(3)) {
      case 0:
        return raw(4'000'000'000U + word() % 200'000'000U, word());  // more nanoseconds than a second has
      case 1:
        return raw(0xffffffffU, 0xffffffffU);
      default:
        return kOrigin + ros::Duration(now + uniform(3700.0, 1e9));
    }
  }
  ros::Time stamp(double now) {
    switch (below(6)) {
      case 0:
        return ros::Time();
      case 1:
        return far_stamp(now);
      case 2:
        return kOrigin + ros::Duration(uniform(-1e9, 1e9));
      case 3:
        return raw(word(), word());
      default:
        return kOrigin + ros::Duration(now + uniform(-0.1, 0.1));
    }
  }

 private:
  /// A stamp as it may arrive over the network, not normalised.
  static ros::Time raw(std::uint32_t sec, std::uint32_t nsec) {
    ros::Time time;
    time.sec = sec;
    time.nsec = nsec;
    return time;
  }

  std::mt19937_64 engine_;
};

}  // namespace mpm_ros::test
