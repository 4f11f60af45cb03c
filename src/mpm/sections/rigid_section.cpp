// rigid_bodies and contact: tools, their surfaces, poses, motions and friction.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/math/constants.hpp"
#include "mpm/sections/section_tables.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

/// In cells. A mesh that is thinner has most often another unit than its scene says; a sheet that is meant to be thin
/// can be as thick as this without any effect.
constexpr double kThinnestMesh = 0.01;

std::unique_ptr<Surface> read_mesh(const Value& value, const SimulationDefinition& definition) {
  const GeometryKind geometry = definition.geometry;
  if (axisymmetric(geometry))
    value.fail(
        "a mesh is not a body of revolution; write its section as revolved, or cylinder, cone, ring, sphere, plane");
  if (planar(geometry))
    value.fail(
        "a planar scene has no mesh; write polygon, box, sphere, cylinder, capsule, plane or height_field, each "
        "without end along y");
  if (geometry == GeometryKind::line) value.fail("a line has no mesh; write box, sphere or plane");
  const Map map(value, {"file", "scale"});
  const Value file = map.at("file");
  const std::string path = file_from_scene(file);
  const auto scale_key = map.find("scale");
  const double scale = scale_key ? scale_key->positive(kLength) : value.context().units.factor(kLength);
  try {
    return make_mesh(load_mesh(path, scale), thinnest_mesh(definition));
  } catch (const RigidError& error) {
    file.fail(error.what());
  }
}

std::unique_ptr<Surface> read_box_surface(const Value& value, GeometryKind geometry) {
  if (axisymmetric(geometry)) value.fail("a box is not a body of revolution; write cylinder or ring");
  const Value size_value = Map(value, {"size"}, {{"min", "write size, and put the body by its pose"}}).at("size");
  Vec3 size = size_value.vector(kLength);
  for (const int axis : axes_beside(geometry)) size[axis] = kInfinity;
  if (!(size.array() > 0.0).all()) size_value.fail("an edge is not greater than 0; write the lengths of its edges");
  return make_box(size);
}

std::unique_ptr<Surface> read_sphere_surface(const Value& value, GeometryKind geometry) {
  const double radius = Map(value, {"radius"}).at("radius").positive(kLength);
  if (geometry == GeometryKind::line) return make_box({2.0 * radius, kInfinity, kInfinity});
  if (planar(geometry)) return make_cylinder(radius, kInfinity, 1);
  return make_sphere(radius);
}

std::unique_ptr<Surface> read_cylinder_surface(const Value& value, GeometryKind geometry) {
  if (geometry == GeometryKind::line) value.fail("a line has no cylinder; write box or sphere, each an interval of it");
  const Map map(value, {"radius", "height", "axis"});
  const double radius = map.at("radius").positive(kLength);
  const auto axis_key = map.find("axis");
  const auto height = map.find("height");
  if (planar(geometry)) {
    if (axis_key && axis_key->choice({"x", "y", "z"}) != 1)
      axis_key->fail("a planar scene's cylinder lies along y; write y");
    if (height) height->fail("a planar scene's cylinder has no end along y; leave it out");
    return make_cylinder(radius, kInfinity, 1);
  }
  const int axis = axis_key ? static_cast<int>(axis_key->choice({"x", "y", "z"})) : 2;
  if (axisymmetric(geometry) && axis != 2)
    axis_key->fail("across the axis a cylinder is not axisymmetric; write z, or leave it out");
  return make_cylinder(radius, map.at("height").positive(kLength), axis);
}

std::unique_ptr<Surface> read_plane(const Value& value, const SimulationDefinition& definition) {
  const Map map(value, {"normal"}, {{"point", "a plane goes through the body's origin; put it by pose"}});
  Vec3 normal = Vec3::UnitZ();
  if (definition.geometry == GeometryKind::line) normal = Vec3::UnitX();
  if (const auto key = map.find("normal")) {
    normal = key->vector(kPlain);
    if (!(normal.norm() > 0.0)) key->fail("its length is 0; write the direction out of the body, such as that of up");
    if (axisymmetric(definition.geometry) && normal.x() != 0.0)
      key->fail("a plane that is not across the axis is not a body of revolution; write [0, 1], [0, -1] or a cone");
  }
  Vec3 domain = definition.grid.max - definition.grid.min;
  for (const int axis : axes_beside(definition.geometry)) domain[axis] = 0.0;
  return make_plane(normal, domain.norm());
}

std::unique_ptr<Surface> read_capsule(const Value& value, GeometryKind geometry) {
  if (geometry == GeometryKind::line) value.fail("a line has no capsule; write box or sphere, each an interval of it");
  const Map map(value, {"radius", "length", "axis"},
                {{"height", "write length, of the straight part between the ends"}});
  const double radius = map.at("radius").positive(kLength), length = map.at("length").positive(kLength);
  const auto axis_key = map.find("axis");
  const int axis = axis_key ? static_cast<int>(axis_key->choice({"x", "y", "z"})) : 2;
  if (planar(geometry) && axis == 1) axis_key->fail("along y a capsule is a cylinder in a planar scene; write x or z");
  if (axisymmetric(geometry) && axis != 2)
    axis_key->fail("across the axis a capsule is not axisymmetric; write z, or leave it out");
  return make_capsule(radius, length, axis, planar(geometry));
}

std::unique_ptr<Surface> read_surface(const Value& value, const SimulationDefinition& definition,
                                      RigidBodyDefinition& body) {
  const GeometryKind geometry = definition.geometry;
  const auto [kind, shape] = only_key(value, {"mesh", "urdf", "box", "sphere", "cylinder", "capsule", "plane",
                                              "height_field", "polygon", "revolved", "cone", "ring"});
  try {
    if (kind == "capsule") return read_capsule(shape, geometry);
    if (kind == "plane") return read_plane(shape, definition);
    if (kind == "polygon") return read_polygon(shape, definition);
    if (kind == "height_field") return read_height_field(shape, definition);
    if (kind == "mesh") return read_mesh(shape, definition);
    if (kind == "urdf") return read_urdf_link(shape, definition);
    if (kind == "box") return read_box_surface(shape, geometry);
    if (kind == "sphere") return read_sphere_surface(shape, geometry);
    if (kind == "cylinder") return read_cylinder_surface(shape, geometry);
    return read_revolved_shape(kind, shape, body);
  } catch (const RigidError& error) {
    shape.fail(error.what());
  }
}

Quat read_rpy(const Value& value) {
  const std::vector<Value> angles = value.elements();
  if (angles.size() != 3) value.fail("write three angles, [roll, pitch, yaw], about x, y and z in that order");
  // REP-103: fixed axes, roll about x first.
  return Quat(Eigen::AngleAxisd(angles[2].number(kAngle), Vec3::UnitZ()) *
              Eigen::AngleAxisd(angles[1].number(kAngle), Vec3::UnitY()) *
              Eigen::AngleAxisd(angles[0].number(kAngle), Vec3::UnitX()));
}

Quat read_quaternion(const Value& value) {
  const std::vector<Value> parts = value.elements();
  if (parts.size() != 4) value.fail("write four numbers, [x, y, z, w]");
  const Quat given(parts[3].number(kPlain), parts[0].number(kPlain), parts[1].number(kPlain), parts[2].number(kPlain));
  // As for commands: normalised within 1e-3, refused beyond.
  if (std::abs(given.norm() - 1.0) > 1e-3) {
    value.fail(fmt::format("its length is {:.6g}, not 1; write [0, 0, 0, 1] for no rotation", given.norm()));
  }
  return given.normalized();
}

std::array<Function, 3> read_rotation_rate(const Value& value, GeometryKind geometry) {
  if (geometry == GeometryKind::line) value.fail("nothing turns in a line; leave it out");
  if (axisymmetric(geometry))
    value.fail("a tool that turns is not axisymmetric; leave it out, or make the scene solid");
  if (!planar(geometry)) return value.three_functions(kAngularRate);
  if (!value.is_text()) value.fail("a planar scene turns about y alone; write one number or expression");
  return {Function(), value.function(kAngularRate), Function()};
}

void read_motion(const Value& value, GeometryKind geometry, RigidBodyDefinition& body) {
  const Map map(value, {"velocity", "rotation_rate"},
                {{"pose", "use velocity and rotation_rate, or pose commands on a topic"},
                 {"file", "use velocity and rotation_rate, or commands from a bag"}});
  if (const auto velocity = map.find("velocity")) {
    body.velocity = velocity->functions(kVelocity);
    if (axisymmetric(geometry) && body.inner_radius == 0.0 && !body.velocity[0].is_zero())
      velocity->fail("off the axis the tool is not axisymmetric; write [0, z], or make it a ring, which opens along x");
  }
  if (const auto rate = map.find("rotation_rate")) body.rotation_rate = read_rotation_rate(*rate, geometry);
}

/// Refuses particles that would not fill the body.
void check_normals(const Value& value, const RigidBodyDefinition& body) {
  if (!body.particles) return;
  if (body.reach > 0.0) value.fail("particles reach as far as their functions do; leave out reach");
  const Box bounds = body.surface->bounds();
  for (const int axis : axes_of(value.context().geometry)) {
    if (!std::isfinite(bounds.max[axis] - bounds.min[axis])) {
      value.fail("a body without end cannot be filled with particles; write surface");
    }
  }
}

void read_divides(const Value& value, const Scene& scene, RigidBodyDefinition& body) {
  if (body.sides == Sides::one) value.fail("with sides: one the body divides nothing; leave out one of the two keys");
  if (!value.is_list()) value.fail("write a list of deformable bodies, such as [soil]");
  for (const Value& element : value.elements()) {
    const std::string name = element.text();
    const bool known = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                   [&](const BodyDefinition& other) { return other.name == name; });
    if (!known) element.fail(fmt::format("no deformable body is called '{}'; name one of 'bodies'", name));
    body.divides.push_back(name);
  }
}

/// True if `contact` says the friction of tools without one of their own.
bool names_friction(const Map& root) {
  const auto contact = root.find("contact");
  return contact && contact->is_map() && (contact->node()["friction"] || contact->node()["law"]);
}

}  // namespace

Pose read_pose(const Value& value, GeometryKind geometry, double inner_radius) {
  const Map map(value, {"position", "rpy", "quaternion"}, {{"frame", "poses are in the world frame"}});
  Pose pose;
  const auto position = map.find("position");
  if (position) pose.position = position->vector(kLength);
  if (axisymmetric(geometry) && pose.position.x() != 0.0 && inner_radius == 0.0)
    position->fail("off the axis the tool is not axisymmetric; write [0, z], or make the scene solid");
  if (inner_radius > 0.0 && !(inner_radius + pose.position.x() > 0.0))
    position->fail(fmt::format("the ring is closed there: x changes its inner radius of {:g} m", inner_radius));
  const auto rpy = map.find("rpy");
  const auto quaternion = map.find("quaternion");
  if (rpy && quaternion) quaternion->fail("a pose has rpy or quaternion, not both; leave one out");
  if (rpy) pose.orientation = read_rpy(*rpy);
  if (quaternion) pose.orientation = read_quaternion(*quaternion);
  if (geometry == GeometryKind::line && (rpy || quaternion)) {
    (rpy ? *rpy : *quaternion).fail("nothing turns in a line; leave it out");
  }
  if (axisymmetric(geometry) && pose.orientation.vec().norm() > 1e-9)
    (rpy ? *rpy : *quaternion).fail("a turned tool is not axisymmetric; leave it out, or make the scene solid");
  // In a planar scene the body's y axis stays the world's.
  if (planar(geometry) && (pose.orientation * Vec3::UnitY() - Vec3::UnitY()).norm() > 1e-9) {
    (rpy ? *rpy : *quaternion)
        .fail("turns the body out of the plane; a planar scene turns about y alone: rpy: [0, pitch, 0]");
  }
  return pose;
}

double thinnest_mesh(const SimulationDefinition& definition) {
  return kThinnestMesh * definition.grid.cell.minCoeff();  // cell of a solid scene, which alone has meshes
}

void read_rigid_motion(const Map& map, GeometryKind geometry, RigidBodyDefinition& body) {
  if (const auto motion = map.find("motion")) read_motion(*motion, geometry, body);
}

void read_rigid_place(const Map& map, const SimulationDefinition& definition, RigidBodyDefinition& body) {
  body.surface = read_surface(map.at("shape"), definition, body);
  if (const auto pose = map.find("pose")) body.pose = read_pose(*pose, definition.geometry, body.inner_radius);
}

void read_rigid_shape(const Map& map, const SimulationDefinition& definition, RigidBodyDefinition& body) {
  read_rigid_place(map, definition, body);
  read_rigid_motion(map, definition.geometry, body);
}

FrictionLaw read_rigid_bodies(const Map& root, Scene& scene) {
  const auto section = root.find("rigid_bodies");
  const FrictionLaw friction = read_contact(root, scene, section.has_value() || root.find("robots").has_value());
  if (!section) return friction;
  bool smooth = false;  // a tool for which the scene names no friction
  for (const Value& value : section->elements()) {
    RigidBodyDefinition body;
    const Map map = read_keys(value, rigid_body_keys(), body);
    body.name = map.at("name").name();
    for (const RigidBodyDefinition& other : scene.definition.rigid_bodies) {
      if (other.name == body.name)
        value.fail(fmt::format("a second rigid body '{}'; give each its own name", body.name));
    }
    for (const BodyDefinition& other : scene.bodies) {
      if (other.name == body.name) {
        value.fail(fmt::format("'{}' is already the name of a deformable body; give each its own name", body.name));
      }
    }
    read_rigid_shape(map, scene.definition, body);
    scene.commands.push_back(read_commands(map, body.name, scene));
    const auto own_friction = map.find("friction");
    body.friction = own_friction ? read_friction(*own_friction) : friction;
    smooth = smooth || (!own_friction && !names_friction(root));
    read_free(map, scene.definition, body);
    if (const auto collide = map.find("collide")) body.collide = read_collide(*collide);
    if (const auto divides = map.find("divides")) read_divides(*divides, scene, body);
    const auto reach = map.find("reach");
    if (reach && scene.definition.contact.method == ContactMethod::points)
      reach->fail("it is of contact at nodes; leave it out, or write contact: {method: nodes}");
    if (const auto normals = map.find("normals")) check_normals(*normals, body);
    scene.definition.rigid_bodies.push_back(std::move(body));
  }
  if (smooth) scene.choices.emplace_back("contact.friction", "0: smooth tools, for the scene names none");
  return friction;
}

}  // namespace mpm
