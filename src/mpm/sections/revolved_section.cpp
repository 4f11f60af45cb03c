// Shapes of rigid bodies that are defined by their section: revolved, cone, ring.
#include <fmt/format.h>

#include <cmath>

#include "mpm/math/constants.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

std::unique_ptr<Surface> read_revolved(const Value& value) {
  Profile profile;
  for (const Value& point : Map(value, {"profile"}).at("profile").elements()) {
    const std::vector<Value> parts = point.elements();
    if (parts.size() != 2) point.fail(fmt::format("found {} numbers; write a point as [r, z]", parts.size()));
    profile.emplace_back(parts[0].number(kLength), parts[1].number(kLength));
  }
  return make_revolved(profile);
}

std::unique_ptr<Surface> read_cone(const Value& value) {
  const Map map(value, {"radius", "height", "angle", "shaft"});
  const double radius = map.at("radius").positive(kLength);
  const auto height_key = map.find("height");
  const auto angle_key = map.find("angle");
  if (height_key.has_value() == angle_key.has_value())
    value.fail("a cone has height or angle (the whole angle at its tip); write one of them");
  double height = 0.0;
  if (height_key) {
    height = height_key->positive(kLength);
  } else {
    const double angle = angle_key->positive(kAngle);
    if (!(angle < kPi)) angle_key->fail("the whole angle at the tip is less than 180 deg; a flat end is a cylinder's");
    height = radius / std::tan(0.5 * angle);
  }
  const auto shaft = map.find("shaft");
  return make_cone(radius, height, shaft ? shaft->non_negative(kLength) : 0.0);
}

std::unique_ptr<Surface> read_ring(const Value& value, GeometryKind geometry, RigidBodyDefinition& body) {
  const Map map(value, {"inner", "outer", "height"});
  const double inner = map.at("inner").positive(kLength);
  const Value outer_value = map.at("outer");
  const double outer = outer_value.positive(kLength);
  if (!(outer > inner))
    outer_value.fail("the outer radius is not greater than the inner one; write the larger one here");
  const double height = map.at("height").positive(kLength);
  if (axisymmetric(geometry)) {
    body.inner_radius = inner;
    body.outer_radius = outer;
  }
  return make_ring(inner, outer, height, axisymmetric(geometry));
}

}  // namespace

std::unique_ptr<Surface> read_revolved_shape(const std::string& kind, const Value& value, RigidBodyDefinition& body) {
  const GeometryKind geometry = value.context().geometry;
  if (geometry == GeometryKind::line) value.fail(fmt::format("a line has no {}; write box or sphere", kind));
  if (planar(geometry)) {
    value.fail(
        fmt::format("a planar scene has no {}: nothing turns about an axis in its plane; write box, sphere or "
                    "cylinder, or make the scene axisymmetric or solid",
                    kind));
  }
  if (kind == "revolved") return read_revolved(value);
  if (kind == "cone") return read_cone(value);
  return read_ring(value, geometry, body);
}

}  // namespace mpm
