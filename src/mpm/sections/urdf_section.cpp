// rigid_bodies.<name>.shape.urdf: the collision geometry of a robot's link.
#include <string>

#include "mpm/rigid/urdf.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {

std::unique_ptr<Surface> read_urdf_link(const Value& value, const SimulationDefinition& definition) {
  if (definition.geometry != GeometryKind::solid)
    value.fail("a robot's link is of a solid scene; write box, sphere or cylinder, as the scene's geometry has them");
  const Map map(value, {"file", "link"},
                {{"parameter", "a scene is read without ROS; write the robot_description to a file, and name that"},
                 {"scale", "a URDF is in metres"}});
  const Value file = map.at("file");
  const std::string link = map.at("link").text();
  const std::string path = path_from_scene(file);
  try {
    return load_urdf_link(path, link, thinnest_mesh(definition));
  } catch (const RigidError& error) {
    value.fail(error.what());
  }
}

}  // namespace mpm
