// The two sides of a tool thinner than the reach of the shape functions: where a point lies, and whether the tool is
// between two points. Sides are those of a mid surface that is continued beyond the tool's edges:
//
//   plate  most of the surface faces one way: the plane through the middle, across that way, in the body's frame
//   round  wires, rods, small spheres: the plane through the middle across the way that it moves; turned when that has
//          turned by more than 30 degrees
//   shell  tubes, cups, scoops: where the nearest face looks away from the middle, and where it looks towards it
//
// A tool is a shell if that rule puts more pairs of opposite faces on two sides than a plane does. Weak: sheets bent
// both ways (an S) have opposite faces on one side, as distinguished() reports; a round tool that turns back sharply
// has one side in places; for material that streams past a round tool at rest the sides are above and below.
#pragma once

#include "mpm/math/geometry_kind.hpp"
#include "mpm/rigid/rigid_body.hpp"

namespace mpm {

/// True if material on two sides of the body may share nodes: it is thinner than three cells. On the axis of an
/// axisymmetric scene a rod has one side only. `cell`: the smallest edge [m].
bool is_thin(const RigidBodyDefinition& body, GeometryKind geometry, double cell);
/// True if its sides have a field each. For bodies made of particles only if the scene says so.
inline bool has_sides(const RigidBodyDefinition& body, GeometryKind geometry, double cell) {
  return body.sides == Sides::two ||
         (body.sides == Sides::automatic && !body.particles && is_thin(body, geometry, cell));
}
/// True if a tool whose sides have a field each divides this deformable body: all, unless it names some.
bool divides(const RigidBodyDefinition& tool, const std::string& body);

class ThinTool {
 public:
  /// `body` must outlive this object.
  ThinTool(const RigidBody& body, GeometryKind geometry);

  const RigidBody& body() const { return *body_; }
  /// The fraction of opposite faces that lie on two sides; 1 for a tool that the sides describe well.
  double distinguished() const { return distinguished_; }
  /// Turns the mid plane of a round tool towards the body's present motion.
  void aim();
  /// Writes or reads the direction of a round tool, for checkpoints.
  void serialise(StateArchive& archive) { archive.value("across", across_); }
  /// The side of a world point [m], 0 or 1.
  int side(const Vec3& point) const;
  /// True if the surface is at most `band` [m] away from a world point; then `found` is the surface there, in the
  /// body's frame.
  bool within(const Vec3& point, double band, SurfacePoint& found) const;
  /// True if the straight line from one world point to the other meets the tool.
  bool between(const Vec3& from, const Vec3& to) const;

 private:
  enum class Kind { plate, round, shell };
  void find_directions(GeometryKind geometry);
  int side_in_body(const Vec3& at) const;
  double count_apart() const;

  const RigidBody* body_;
  Kind kind_ = Kind::plate;
  Vec3 middle_ = Vec3::Zero();   ///< in the body's frame [m]
  Vec3 across_ = Vec3::UnitZ();  ///< out of side 0, in the body's frame
  double distinguished_ = 1.0;
  Mat3 possible_ = Mat3::Zero();  ///< projection onto the directions along which a round tool is thin
};

}  // namespace mpm
