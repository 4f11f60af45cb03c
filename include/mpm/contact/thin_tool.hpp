// The two sides of a tool thinner than the reach of the shape functions: where a point lies, and whether the tool is
// between two points. Sides are those of a mid surface that is continued beyond the tool's edges:
//
//   plate  most of the surface faces one way: the plane through the middle, across that way, in the body's frame
//   round  wires, rods, small spheres: the plane through the middle across the way that it moves; turned when that has
//          turned by more than 30 degrees
//   shell  tubes, cups, scoops: where the nearest face looks away from the middle, and where it looks towards it
//
// A shell is what is told apart better that way: faces that lie opposite to each other have to be on two sides. Weak:
// sheets bent both ways (an S) have faces that are not, which told_apart() says; a round tool that turns back sharply
// has one side in places; material that streams past a round tool at rest finds its sides above and below.
#pragma once

#include "mpm/math/geometry_kind.hpp"
#include "mpm/rigid/rigid_body.hpp"

namespace mpm {

/// Whether material on two sides of the body may share nodes: it is thinner than three cells. On the axis of an
/// axisymmetric scene a rod has one side only. `cell`: the smallest edge [m].
bool is_thin(const RigidBodyDefinition& body, GeometryKind geometry, double cell);
/// Whether its sides have a field each. Of bodies made of particles only if the scene says so.
inline bool has_sides(const RigidBodyDefinition& body, GeometryKind geometry, double cell) {
  return body.sides == Sides::two ||
         (body.sides == Sides::automatic && !body.particles && is_thin(body, geometry, cell));
}

class ThinTool {
 public:
  /// `body` outlives this.
  ThinTool(const RigidBody& body, GeometryKind geometry);

  const RigidBody& body() const { return *body_; }
  /// Of the faces that lie opposite to each other, the part that is on two sides: 1 when all is well.
  double told_apart() const { return told_apart_; }
  /// Turns the mid plane of a round tool towards the body's present motion.
  void aim();
  /// For checkpoints: where a round tool was aimed.
  void serialise(StateArchive& archive) { archive.value("across", across_); }
  /// 0 or 1. `point`: world [m]
  int side(const Vec3& point) const;
  /// Whether the surface is at most `band` [m] away from a world point; then what it says there, in the body's frame.
  bool within(const Vec3& point, double band, SurfacePoint& found) const;
  /// Whether the straight line from one world point to the other meets the tool.
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
  double told_apart_ = 1.0;
  Mat3 possible_ = Mat3::Zero();  ///< onto the directions that a round tool is as thin along
};

}  // namespace mpm
