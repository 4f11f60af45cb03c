#include "mpm_ros/command/turning_twists.hpp"

#include <utility>

namespace mpm_ros {

void TurningTwists::hold(int body, const mpm::Twist& twist, const mpm::Quat& orientation) {
  held_[body] = {twist, orientation};
}

std::vector<AppliedCommand> TurningTwists::next(const std::vector<mpm::BodyState>& bodies, std::int64_t now) {
  std::vector<AppliedCommand> commands;
  for (auto& [body, held] : held_) {
    const mpm::Quat& orientation = bodies[static_cast<std::size_t>(body)].pose.orientation;
    if (orientation.coeffs() == held.orientation.coeffs()) continue;
    held.orientation = orientation;
    AppliedCommand& command = commands.emplace_back();
    command.body = body;
    command.effect = now;
    command.twist = {orientation * held.twist.linear, orientation * held.twist.angular};
  }
  return commands;
}

void TurningTwists::serialise(mpm::StateArchive& archive) {
  const mpm::StateArchive::Group group(archive, "turning");
  std::vector<std::pair<int, Held>> held(held_.begin(), held_.end());
  archive.rows("held", held);
  archive.column("held/body", held, [](auto& one) -> int& { return one.first; });
  archive.column("held/linear", held, [](auto& one) -> mpm::Vec3& { return one.second.twist.linear; });
  archive.column("held/angular", held, [](auto& one) -> mpm::Vec3& { return one.second.twist.angular; });
  archive.column("held/orientation", held, [](auto& one) -> mpm::Quat& { return one.second.orientation; });
  if (archive.reading()) held_ = std::map<int, Held>(held.begin(), held.end());
}

}  // namespace mpm_ros
