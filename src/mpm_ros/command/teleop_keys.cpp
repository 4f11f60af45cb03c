#include "mpm_ros/command/teleop_keys.hpp"

#include <fmt/format.h>

#include <cctype>

namespace mpm_ros {

namespace {

constexpr double kFaster = 1.25;   // a press of +
constexpr char kEndOfText = 0x03;  // Ctrl-C
// Keys of each axis: the one that moves it on and the one that moves it back; in the order of a twist.
constexpr std::array<std::array<char, 2>, 6> kKeys{
    {{'w', 's'}, {'a', 'd'}, {'r', 'f'}, {'l', 'j'}, {'i', 'k'}, {'u', 'o'}}};

}  // namespace

TeleopKeys::TeleopKeys(double speed, double rotation_rate, double hold)
    : speed_(speed), rotation_rate_(rotation_rate), hold_(hold) {}

TeleopKeys::Action TeleopKeys::press(char key, double now) {
  switch (key) {
    case ' ':
      axes_ = {};
      return Action::stop;
    case '+':
    case '=':
      speed_ *= kFaster;
      rotation_rate_ *= kFaster;
      return Action::move;
    case '-':
      speed_ /= kFaster;
      rotation_rate_ /= kFaster;
      return Action::move;
    case 'q':
    case kEndOfText:
      return Action::quit;
    default:
      break;
  }
  const char lower = static_cast<char>(std::tolower(static_cast<unsigned char>(key)));
  for (std::size_t i = 0; i < kKeys.size(); ++i) {
    for (const double sign : {1.0, -1.0}) {
      if (kKeys[i][sign > 0.0 ? 0 : 1] != lower) continue;
      Axis& axis = axes_[i];
      const bool repeated = axis.sign == sign && now - axis.pressed < kRepeated;
      axis = {sign, now, now + (repeated ? kRepeated : hold_)};
      return Action::move;
    }
  }
  return Action::none;
}

mpm::Twist TeleopKeys::twist(double now) const {
  mpm::Twist twist;
  for (int i = 0; i < 3; ++i) {
    if (now < axes_[i].until) twist.linear[i] = axes_[i].sign * speed_;
    if (now < axes_[i + 3].until) twist.angular[i] = axes_[i + 3].sign * rotation_rate_;
  }
  return twist;
}

std::string TeleopKeys::status(double now) const {
  const mpm::Twist t = twist(now);
  return fmt::format(
      "velocity {:+.3g} {:+.3g} {:+.3g} m/s, rotation {:+.3g} {:+.3g} {:+.3g} rad/s | a key: {:.3g} m/s, {:.3g} rad/s",
      t.linear.x(), t.linear.y(), t.linear.z(), t.angular.x(), t.angular.y(), t.angular.z(), speed_, rotation_rate_);
}

std::string TeleopKeys::help() {
  return "hold a key to move (world axes):   w s  along x   a d  along y   r f  along z\n"
         "                                   l j  about x   i k  about y   u o  about z\n"
         "space stops   + - faster and slower   q quits\n";
}

}  // namespace mpm_ros
