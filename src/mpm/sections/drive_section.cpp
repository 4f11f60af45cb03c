// rigid_bodies.<name>.drive and .limits: the source of a body's commands, and the limits of its motion. The simulation
// does not use them: the node turns the frame into pose commands, and keeps commands within the limits.
#include <fmt/format.h>

#include "mpm/rigid/rigid_keys.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

/// The link of `shape: {urdf: …}`, or an empty name.
std::string link_of(const Map& body) {
  const YAML::Node urdf = body.at("shape").node()["urdf"];
  return urdf && urdf["link"] ? urdf["link"].as<std::string>() : std::string();
}

void read_drive(const Value& drive, const Map& body, const std::string& name, Scene& scene,
                CommandDefinition& commands) {
  if (body.find("free"))
    drive.fail("a free body moves by forces and cannot follow a frame; leave out one of drive and free");
  if (body.find("motion")) drive.fail("a body follows motion or a frame, not both; leave one out");
  const std::string link = link_of(body);
  commands.frame = read_frame(drive, link.empty() ? name : link);
  if (drive.is_map()) return;
  scene.choices.emplace_back(
      fmt::format("rigid_bodies.{}.drive", name),
      fmt::format("tf frame {}, {}", commands.frame, link.empty() ? "as the body's name" : "the link of its shape"));
}

}  // namespace

std::string read_frame(const Value& drive, const std::string& usual) {
  if (drive.is_map()) {
    const Value frame = Map(drive, {"tf"}).at("tf");
    const std::string name = frame.text();
    if (name.empty() || name.front() == '/')
      frame.fail("is not a name of a tf frame; write one such as tool0, without a slash before it");
    return name;
  }
  drive.choice({"tf"}, {{"velocity", "leave drive out: commands on topics need no word"},
                        {"pose", "leave drive out: commands on topics need no word"}});
  return usual;
}

void read_limits(const Value& value, MotionLimits& limits) {
  const Map map = read_keys(value, limit_keys(), limits);
  if (!limits.any()) map.fail("limits nothing; write one of speed, rotation_rate, acceleration, rotation_acceleration");
}

std::vector<std::string> commanded_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const RigidBodyDefinition& body : scene.definition.rigid_bodies) names.push_back(body.name);
  for (const RobotDefinition& robot : scene.definition.robots) {
    if (robot.base.kind == BaseKind::moving) names.push_back(robot.name);
  }
  return names;
}

CommandDefinition read_commands(const Map& body, const std::string& name, Scene& scene) {
  CommandDefinition commands;
  if (const auto drive = body.find("drive")) read_drive(*drive, body, name, scene, commands);
  if (const auto limits = body.find("limits")) read_limits(*limits, commands.limits);
  return commands;
}

}  // namespace mpm
