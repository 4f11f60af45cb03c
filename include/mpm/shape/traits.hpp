// Facts that a shape function says of itself, and defaults of those that only some of them have.
#pragma once

namespace mpm {

enum class ShapeKind {
  dirac,          ///< hat functions at the particle's centre: classic MPM
  ugimp,          ///< averaged over a box that keeps its size
  ugimp_stretch,  ///< averaged over a box that stretches with the diagonal of F
  cpdi,           ///< averaged over the deformed box, linear between its corners
  qcpdi,          ///< as cpdi, but biquadratic on nine points; planar
  bspline2,       ///< quadratic B-splines at the centre
  bspline3,       ///< cubic ones
};

/// Part of a particle's deformation that its domain follows. A domain that follows any is stored at the start of a step
/// and constant in it.
enum class Follows { nothing, stretch, deformation };

/// Facts about a shape function, for those who ask: constants of its class. Those without a default in ShapeDefaults
/// have to be said for it to compile.
struct ShapeTraits {
  ShapeKind kind;
  const char* name;        ///< in a scene
  const char* other_name;  ///< in a scene, too; null if there is none
  /// Degree of the spline at the particle's centre, of which the hat is the first; 0: averages of hats over a domain.
  int degree;
  Follows follows;
  int nodes;           ///< most nodal values along an axis that the functions of one particle are made of
  int surface_degree;  ///< degree of the spline that spreads what acts at a point of a surface (step/point_weights.hpp)
  /// Integral of the spline over the cells beyond the node next to its middle one, which a wall there cuts off [cells].
  double beyond_next;
  bool massless_at_axis;   ///< a node beside an axis of symmetry may have a gradient and no mass (boundary/axis.hpp)
  bool shear_limits_step;  ///< the longest stable step falls with the shear of domains (shape/domain_shear.hpp)
  bool takes_implicit;     ///< implicit steps have it

  constexpr bool point() const { return degree == 1; }
  constexpr bool spline() const { return degree > 1; }
  constexpr bool follows_deformation() const { return follows != Follows::nothing; }
  /// True for parallelograms, whose corners may run apart.
  constexpr bool shears() const { return follows == Follows::deformation; }
  /// Number of components of a domain that are stored for each particle, on `dim` axes.
  constexpr int stored(int dim) const { return shears() ? dim * dim : follows_deformation() ? dim : 0; }
  /// Layers of nodes beyond a wall that particles may reach.
  constexpr int wall_layers() const { return shears() ? 2 : 1; }
};

/// Defaults of the constants that not all shape functions have; a class derives from this and hides those that it
/// defines itself.
struct ShapeDefaults {
  static constexpr const char* kOtherName = nullptr;
  static constexpr int kSurfaceDegree = 1;
  static constexpr double kBeyondNext = 0.0;
  static constexpr bool kMasslessAtAxis = false;
  static constexpr bool kShearLimitsStep = false;
  static constexpr bool kTakesImplicit = false;

  static constexpr bool kStretches = false;     ///< each particle has a half-width of its own
  static constexpr bool kFoldsAtWalls = false;  ///< has fold(), which removes weight beyond walls
  static constexpr bool kAxisymmetric = false;  ///< has radial(), the function along a radius (shape/axisymmetric.hpp,
                                                ///< shape/axisymmetric_points.hpp)
};

}  // namespace mpm
