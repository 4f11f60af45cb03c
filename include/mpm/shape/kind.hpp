// The shape functions and their names in a scene. Each has a file in this folder that states what it does and where it
// is weak.
#pragma once

#include <array>

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

/// In the order of ShapeKind.
inline constexpr std::array<const char*, 7> kShapeNames = {"dirac", "ugimp",    "ugimp_stretch", "cpdi",
                                                           "qcpdi", "bspline2", "bspline3"};
inline const char* shape_name(ShapeKind kind) { return kShapeNames[static_cast<int>(kind)]; }

/// True if the particle's domain follows its deformation; it is then stored at the start of a step and constant in it.
constexpr bool follows_deformation(ShapeKind kind) {
  return kind == ShapeKind::ugimp_stretch || kind == ShapeKind::cpdi || kind == ShapeKind::qcpdi;
}

}  // namespace mpm
