// The surface of a rigid body as a signed distance in the body's own frame.
//
// Distances are exact (for a mesh that to the nearest triangle), normals are
// their gradients. Beyond an edge or a corner normals turn with the point, from one face's to the other's. Where the
// gradient is not defined, the normal is that of the first of several nearest faces (inside an edge, outside a notch),
// or on an edge or corner itself that of a face (for a mesh the mean of its faces').
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mpm/math/error.hpp"
#include "mpm/math/geometry.hpp"
#include "mpm/rigid/solid_moments.hpp"

namespace mpm {

/// A body or mesh that cannot serve as a rigid body.
class RigidError : public Error {
 public:
  using Error::Error;
};

/// The surface as seen from one point.
struct SurfacePoint {
  double distance = 0.0;        ///< signed distance [m], negative inside
  Vec3 normal = Vec3::UnitZ();  ///< outward unit normal at the nearest point of the surface
};

/// A ball in a body that reaches its surface; of a corner or an edge one without a radius.
struct TouchPoint {
  Vec3 place = Vec3::Zero();   ///< body frame [m]
  double radius = 0.0;         ///< [m]
  Vec3 inward = Vec3::Zero();  ///< from a corner or an edge into the body; a unit vector, or zero
};

class Surface {
 public:
  virtual ~Surface() = default;
  /// Signed distance and normal at a point of the body frame [m].
  virtual SurfacePoint at(const Vec3& point) const = 0;
  /// True, with the same answer as at(), when the signed distance is at most `band` [m]; else false, at less cost.
  virtual bool within(const Vec3& point, double band, SurfacePoint& result) const = 0;
  /// Bounds in the body frame [m]; infinite along an axis without end.
  virtual Box bounds() const = 0;
  /// The smallest thickness of the body [m] (for the warning about thin tools); a mesh estimates it.
  virtual double thickness() const = 0;
  /// Triangles for display (markers), body frame; three vertices each, counter-clockwise seen from outside. A body
  /// without end along an axis is drawn as long as it is wide.
  virtual std::vector<std::array<Vec3, 3>> triangles() const = 0;
  /// Balls that make up the body where it touches flat or hollow surfaces: one of a sphere, those along its axis of a
  /// capsule. Empty for others.
  virtual std::vector<TouchPoint> balls() const { return {}; }
  /// Moments of the enclosed solid; along an axis without end it is `across` [m] long, centred. Empty when they are not
  /// known.
  virtual std::optional<SolidMoments> moments(double /*across*/) const { return {}; }
};

/// A closed triangle mesh; indices are counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Vec3> vertices;  ///< [m]
  std::vector<std::array<int, 3>> triangles;
};

/// A closed polygon: points (r, z), r >= 0, in the half plane of a body of revolution; (x, z) in a plane [m]. The last
/// joins the first.
using Profile = std::vector<Vec2>;

/// A box by its edge lengths [m], all positive (infinite along axes that the scene does not have: y in a plane, y and z
/// in a line), centred on the origin.
/// @throws RigidError
std::unique_ptr<Surface> make_box(const Vec3& size);
/// A sphere at the origin; `radius` [m]. @throws RigidError
std::unique_ptr<Surface> make_sphere(double radius);
/// A cylinder, centred, with its axis along body x, y or z (`axis` 0, 1, 2; y in planar scenes); the height may be
/// infinite. @throws RigidError
std::unique_ptr<Surface> make_cylinder(double radius, double height, int axis = 2);
/// The body that the profile makes when turned about the body's z axis; points in either sense. An edge on the axis is
/// not part of the surface; on the axis normals have no component across it. The thickness is the 5 % quantile, over
/// the surface, of the length of rays inwards; a ray counts if the face that it meets encloses less than 45 degrees
/// with its own, since a blunt tip or edge ends a body without making it thin.
/// @throws RigidError, with the point: fewer than 3, not finite, r < 0, repeated, alone on the axis, or the profile
/// cuts or touches itself.
std::unique_ptr<Surface> make_revolved(const Profile& profile);
/// A closed polygon in planar scenes: points (x, z), without end along y; in either sense. Drawn `drawn` [m] long.
/// @throws RigidError, with the point: fewer than 3, not finite, repeated, or the polygon cuts or touches itself.
std::unique_ptr<Surface> make_polygon(const Profile& profile, double drawn = 1.0);
/// A cone with its tip at the origin, pointing down, under a shaft of the same radius (its length may be 0).
/// @throws RigidError
std::unique_ptr<Surface> make_cone(double radius, double height, double shaft = 0.0);
/// A tube about the z axis, centred; 0 < inner < outer radius. `in_half_plane`: the section moves in r, as that of a
/// ring that opens. Distance and normal are then those of the section at (x, z), for x < 0 as well; y does not count.
/// @throws RigidError
std::unique_ptr<Surface> make_ring(double inner, double outer, double height, bool in_half_plane = false);
/// Everything on the side of a plane through the origin that `normal` points away from; the normal's length does not
/// count. Drawn as a slab of side `drawn` [m]. @throws RigidError when the normal is zero or not finite, or `drawn` not
/// positive.
std::unique_ptr<Surface> make_plane(const Vec3& normal, double drawn = 1.0);
/// All points within `radius` of a straight piece of the axis, `length` long and centred: a cylinder with round ends,
/// 2 radius + length in all. `in_plane`: without end along y, as planar scenes have it; the axis is then x or z.
/// @throws RigidError
std::unique_ptr<Surface> make_capsule(double radius, double length, int axis = 2, bool in_plane = false);

/// Heights at the points of a regular grid over the rectangle from `low` to `high` in x and y [m].
struct HeightGrid {
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
  int columns = 0;              ///< points along x, the first at low.x, the last at high.x; at least 2
  int rows = 1;                 ///< points along y; 1 in planar scenes, where y does not count
  std::vector<double> heights;  ///< [m], row by row from low.y on, each from low.x on
};
/// The region below the heights, without end downwards, with upright sides at the ends of the rectangle. Between the
/// points the surface consists of straight pieces (planar), or of two triangles for each cell, cut from its corner at
/// low x and y to that at high x and y. Distances to it are exact. On an edge or corner, and where several faces are
/// equally near, the normal is that of one of the faces. The thickness is the rectangle's shorter side. @throws
/// RigidError
std::unique_ptr<Surface> make_height_field(const HeightGrid& grid);
/// A solid from a mesh; one that is inside out as a whole is turned. @throws RigidError when the mesh is empty,
/// degenerate, not closed or not consistently oriented, or half of its surface is less than `thinnest` [m] thick.
std::unique_ptr<Surface> make_mesh(const TriangleMesh& mesh, double thinnest = 0.0);

/// Reads any format that assimp reads, joining equal vertices; `scale` multiplies coordinates, which are taken in the
/// file's own axes (a COLLADA unit is applied, its up axis is not, as in RViz).
/// `path` may be `package://name/…` (searched along ROS_PACKAGE_PATH and CMAKE_PREFIX_PATH), `file:///…` or a file
/// path.
/// @throws RigidError with the path and the reason.
TriangleMesh load_mesh(const std::string& path, double scale = 1.0);

/// Resolves `package://name/rest` and `file:///path`; any other text is returned as it is. @throws RigidError when no
/// such package, or a file:// path that is not absolute.
std::string resolve_resource(const std::string& uri);

}  // namespace mpm
