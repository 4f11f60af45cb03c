// `free` of a rigid body: its mass, and the directions in which it moves freely.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/rigid/rigid_keys.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

constexpr double kCentred =
    1e-6;  ///< part of its size: a centre of mass nearer to the origin than this counts as the origin

bool has(GeometryKind geometry, int velocity) {
  if (velocity >= 3) return turns_about(geometry, velocity - 3);
  if (axisymmetric(geometry)) return velocity == 2;
  const std::vector<int> axes = axes_of(geometry);
  return std::find(axes.begin(), axes.end(), velocity) != axes.end();
}

std::array<bool, 6> read_axes(const Value& value, GeometryKind geometry) {
  static const std::vector<std::string> kNames = {"x", "y", "z", "rx", "ry", "rz"};
  std::array<bool, 6> axes{};
  for (const Value& name : value.elements()) {
    const std::size_t axis = name.choice(kNames);
    if (!has(geometry, static_cast<int>(axis))) {
      name.fail(fmt::format("{} has no such motion; leave it out", scene_kind(geometry)));
    }
    axes[axis] = true;
  }
  if (axes == std::array<bool, 6>{}) value.fail("no axis is free; leave `free` out, or name x, z or ry");
  return axes;
}

/// Reads the inertia: in planar scenes one number, about y; else three principal moments, or six: xx, yy, zz, yz, xz,
/// xy.
Mat3 read_inertia(const Value& value, GeometryKind geometry) {
  if (planar(geometry)) return Mat3(Vec3(0.0, value.positive(kInertia), 0.0).asDiagonal());
  const std::vector<Value> parts = value.elements();
  if (parts.size() != 3 && parts.size() != 6) {
    value.fail(
        fmt::format("found {} numbers; write [xx, yy, zz] or [xx, yy, zz, yz, xz, xy], body axes", parts.size()));
  }
  Mat3 inertia = Mat3::Zero();
  for (int k = 0; k < 3; ++k) inertia(k, k) = parts[k].positive(kInertia);
  for (int k = 0; k < 3 && parts.size() == 6; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    inertia(i, j) = inertia(j, i) = parts[3 + k].number(kInertia);
  }
  return inertia;
}

/// Reads a vector along rotation axes: in a plane one number, about y.
Vec3 read_about(const Value& value, const Dimension& dimension, GeometryKind geometry) {
  if (planar(geometry)) return {0.0, value.number(dimension), 0.0};
  const std::vector<Value> parts = value.elements();
  if (parts.size() != 3) value.fail(fmt::format("found {} numbers; write three", parts.size()));
  return {parts[0].number(dimension), parts[1].number(dimension), parts[2].number(dimension)};
}

/// Mass, centre of mass and inertia; those that the scene leaves out follow from the shape.
void read_mass(const Map& map, const SimulationDefinition& definition, RigidBodyDefinition& body,
               FreeDefinition& free) {
  const GeometryKind geometry = definition.geometry;
  const auto mass = map.find("mass"), density = map.find("density"), inertia = map.find("inertia");
  const auto centre = map.find("centre");
  if (inertia) free.inertia = read_inertia(*inertia, geometry);
  const bool turns = free.axes[3] || free.axes[4] || free.axes[5];
  // The inertia of the shape is about its own centre of mass.
  if (turns && centre && !inertia)
    centre->fail("the inertia about this centre is not known; write inertia beside it, or leave out centre");
  const double across = planar(geometry) ? definition.thickness : std::sqrt(definition.area);
  const auto moments = body.surface->moments(across);
  if (!moments) {
    if (density) density->fail("the volume of this shape is not known; write its mass, and its inertia if it turns");
    if (turns && !inertia) map.fail("the inertia of this shape is not known; write it beside the mass");
    return;
  }
  if (density) free.mass = density->positive(kDensity) * moments->volume;
  if (!inertia) free.inertia = free.mass / moments->volume * moments->inertia();
  if (centre || (mass && inertia)) return;
  const Vec3 place = moments->centre;
  if (place.norm() > kCentred * std::cbrt(moments->volume)) free.centre = place;
}

}  // namespace

void read_free(const Map& body_map, const SimulationDefinition& definition, RigidBodyDefinition& body) {
  const auto key = body_map.find("free");
  if (!key) return;
  const GeometryKind geometry = definition.geometry;
  if (body.inner_radius > 0.0) key->fail("a ring that opens is not rigid; write another shape, or leave `free` out");
  FreeDefinition free;
  const Map map = read_keys(*key, free_keys(), free);
  for (int k = 0; k < 6; ++k) free.axes[k] = has(geometry, k);
  if (const auto axes = map.find("axes")) free.axes = read_axes(*axes, geometry);
  read_mass(map, definition, body, free);
  if (const auto value = map.find("rotation_rate")) free.velocity.angular = read_about(*value, kAngularRate, geometry);
  if (const auto value = map.find("torque")) free.wrench.torque = read_about(*value, kTorque, geometry);
  for (int k = 0; k < 6; ++k) {
    const Function& prescribed = k < 3 ? body.velocity[k] : body.rotation_rate[k - 3];
    if (free.axes[k] && !prescribed.is_zero()) {
      key->fail(
          "a free velocity is prescribed by `motion` too; leave it out of free.axes, or out of motion and write "
          "free.velocity for the start");
    }
    const double start = k < 3 ? free.velocity.linear[k] : free.velocity.angular[k - 3];
    if (!free.axes[k] && start != 0.0) {
      key->fail("a velocity at the start is given for a direction that is not free; write it into `motion`");
    }
  }
  for (int k = 0; k < 6; ++k) {
    if (has(geometry, k) && !free.axes[k] && free.centre != Vec3::Zero()) {
      key->fail(
          "the centre of mass is off the body's origin, and part of its motion is prescribed; put the origin at the "
          "centre of mass, or free all axes");
    }
  }
  body.free = free;
}

std::unique_ptr<Surface> read_polygon(const Value& value, const SimulationDefinition& definition) {
  if (!planar(definition.geometry))
    value.fail("a polygon is a shape of planar scenes; write mesh, or revolved for a body about an axis");
  Profile profile;
  for (const Value& point : Map(value, {"points"}).at("points").elements()) {
    const std::vector<Value> parts = point.elements();
    if (parts.size() != 2) point.fail(fmt::format("found {} numbers; write a point as [x, z]", parts.size()));
    profile.emplace_back(parts[0].number(kLength), parts[1].number(kLength));
  }
  return make_polygon(profile, definition.thickness);
}

}  // namespace mpm
