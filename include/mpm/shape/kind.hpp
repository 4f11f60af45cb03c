// The closed list of shape functions. Each has a file in this folder that states what it does, where it is weak, and
// the facts that others ask of it (traits.hpp): they ask by trait, not by name. To add one: a name in ShapeKind, a file
// beside these and its class below; doc/architecture.md says what its kernels need.
#pragma once

#include <array>
#include <cstddef>

#include "mpm/shape/bspline.hpp"
#include "mpm/shape/cpdi.hpp"
#include "mpm/shape/dirac.hpp"
#include "mpm/shape/qcpdi.hpp"
#include "mpm/shape/traits.hpp"
#include "mpm/shape/ugimp.hpp"
#include "mpm/shape/ugimp_stretch.hpp"

namespace mpm {

template <class... Shape>
constexpr std::array<ShapeTraits, sizeof...(Shape)> traits_of_shapes() {
  return {{{Shape::kKind, Shape::kName, Shape::kOtherName, Shape::kDegree, Shape::kFollows, Shape::kMostNodes,
            Shape::kSurfaceDegree, Shape::kBeyondNext, Shape::kMasslessAtAxis, Shape::kShearLimitsStep,
            Shape::kTakesImplicit}...}};
}

/// In the order of ShapeKind.
inline constexpr auto kShapeTraits = traits_of_shapes<Dirac<double>, Ugimp<double>, UgimpStretch<double>, Cpdi<2>,
                                                      Qcpdi<2>, QuadraticSpline<double>, CubicSpline<double>>();

constexpr bool shapes_in_order() {
  for (std::size_t i = 0; i < kShapeTraits.size(); ++i) {
    if (kShapeTraits[i].kind != static_cast<ShapeKind>(i)) return false;
  }
  return true;
}
static_assert(shapes_in_order());

constexpr const ShapeTraits& traits_of(ShapeKind kind) { return kShapeTraits[static_cast<std::size_t>(kind)]; }
constexpr const char* shape_name(ShapeKind kind) { return traits_of(kind).name; }

}  // namespace mpm
