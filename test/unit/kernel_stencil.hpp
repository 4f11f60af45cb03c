// The nodes of one particle with the value and the gradient of its shape function there, by the classes of shape/
// alone: products along the axes of three or five values, or sums over the points of a deformed domain, each point with
// the hat functions of its cell. Nodes of two points come twice. In double precision, whatever the kernels' is. Weak:
// slow, a list that is made anew for each particle. Source: method reference 2.1 to 2.7; the bound on a domain's size
// is that of kernel/domain.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <vector>

#include "mpm/kernel/kernels.hpp"
#include "mpm/shape/bspline.hpp"
#include "mpm/shape/cpdi.hpp"
#include "mpm/shape/dirac.hpp"
#include "mpm/shape/kind.hpp"
#include "mpm/shape/qcpdi.hpp"
#include "mpm/shape/ugimp.hpp"
#include "mpm/shape/ugimp_stretch.hpp"

namespace mpm::test {

/// The grid as shape functions see it.
struct ReferenceGrid {
  std::array<double, 3> origin{}, cell{1.0, 1.0, 1.0};  ///< [m]
  std::array<double, 3> low_wall{-mpm_kernel::kNoWall, -mpm_kernel::kNoWall, -mpm_kernel::kNoWall};
  std::array<double, 3> high_wall{mpm_kernel::kNoWall, mpm_kernel::kNoWall, mpm_kernel::kNoWall};  ///< node numbers

  double in_cells(int k, double x) const { return (x - origin[k]) / cell[k]; }
  /// Position of a node [m].
  double position(int k, int node) const { return origin[k] + node * cell[k]; }
};

/// What a particle's weights depend on.
struct ReferencePlace {
  std::array<double, 3> x{};     ///< [m]
  std::array<double, 3> half{};  ///< of its box [cells]
  double f[3][3] = {};           ///< deformation gradient in the grid's axes as the step began
};

struct NodeWeight {
  std::array<int, 3> at{};
  double s = 0.0;
  double g[3] = {};  ///< [1/m]
};

/// How far from its particle a point of a domain may be along an axis [cells]; kernel/domain.hpp.
constexpr double kReferenceReach = 1.5 - 1e-4;

/// Half vectors of a particle's domain [m], made shorter as a whole where it reaches too far.
template <int Dim>
void reference_domain(const ReferenceGrid& grid, const ReferencePlace& place, double (&d)[Dim][Dim]) {
  double reach = 0.0;
  for (int c = 0; c < Dim; ++c) {
    double along = 0.0;
    for (int k = 0; k < Dim; ++k) {
      d[k][c] = place.f[c][k] * place.half[k] * grid.cell[k];
      along += std::abs(d[k][c]) / grid.cell[c];
    }
    reach = std::max(reach, along);
  }
  for (auto& vector : d) {
    for (double& component : vector) component *= std::min(1.0, kReferenceReach / reach);
  }
}

template <int Dim>
class ReferenceStencil {
 public:
  ReferenceStencil(ShapeKind shape, const ReferenceGrid& grid, const ReferencePlace& place) {
    switch (shape) {
      case ShapeKind::dirac:
        add_product<Dirac<double>>(grid, place);
        break;
      case ShapeKind::ugimp:
        add_product<Ugimp<double>>(grid, place);
        break;
      case ShapeKind::ugimp_stretch:
        add_product<UgimpStretch<double>>(grid, place);
        break;
      case ShapeKind::cpdi:
        add_points<Cpdi<Dim>>(grid, place);
        break;
      case ShapeKind::qcpdi:
        if constexpr (Dim == 2) add_points<Qcpdi<Dim>>(grid, place);
        break;
      case ShapeKind::bspline2:
        add_product<QuadraticSpline<double>>(grid, place);
        break;
      case ShapeKind::bspline3:
        add_product<CubicSpline<double>>(grid, place);
        break;
    }
  }
  const std::vector<NodeWeight>& nodes() const { return nodes_; }

 private:
  template <class Shape>
  static Shape along_axis(int k, int nearest, const ReferenceGrid& grid, const ReferencePlace& place) {
    const double offset = grid.in_cells(k, place.x[k]) - nearest;
    const typename Shape::Axis axis(place.half[k], 1.0 / grid.cell[k]);
    if constexpr (Shape::kStretches) {
      return Shape(offset, Shape::half(place.f[k][k], axis), axis);
    } else {
      Shape shape(offset, axis);
      if constexpr (Shape::kFoldsAtWalls) shape.fold(nearest - grid.low_wall[k], grid.high_wall[k] - nearest);
      return shape;
    }
  }

  template <class Shape>
  void add_product(const ReferenceGrid& grid, const ReferencePlace& place) {
    constexpr int kNodes = Shape::kNodes;
    double s[3][kNodes], g[3][kNodes];
    int nearest[3] = {}, count = 1;
    for (int k = 0; k < Dim; ++k) {
      nearest[k] = static_cast<int>(std::floor(grid.in_cells(k, place.x[k]) + 0.5));
      const Shape shape = along_axis<Shape>(k, nearest[k], grid, place);
      std::copy(shape.s, shape.s + kNodes, s[k]);
      std::copy(shape.g, shape.g + kNodes, g[k]);
      count *= kNodes;
    }
    for (int m = 0; m < count; ++m) {
      const int of[3] = {m % kNodes, m / kNodes % kNodes, m / kNodes / kNodes};
      NodeWeight node;
      node.s = 1.0;
      std::fill(node.g, node.g + Dim, 1.0);
      for (int k = 0; k < Dim; ++k) {
        node.at[k] = nearest[k] + of[k] - kNodes / 2;
        node.s *= s[k][of[k]];
        for (int j = 0; j < Dim; ++j) node.g[j] *= j == k ? g[k][of[k]] : s[k][of[k]];
      }
      nodes_.push_back(node);
    }
  }

  template <class Points>
  void add_points(const ReferenceGrid& grid, const ReferencePlace& place) {
    double d[Dim][Dim], offset[Points::kPoints][Dim], gradient[Points::kPoints][Dim];
    reference_domain(grid, place, d);
    Points::offsets(d, offset);
    Points::gradients(d, gradient);
    for (int a = 0; a < Points::kPoints; ++a) {
      int low[3] = {};
      double beyond[3] = {};
      for (int k = 0; k < Dim; ++k) {
        const double cells = grid.in_cells(k, place.x[k] + offset[a][k]);
        low[k] = static_cast<int>(std::floor(cells));
        beyond[k] = cells - low[k];
      }
      for (int corner = 0; corner < 1 << Dim; ++corner) {
        NodeWeight node;
        double hat = 1.0;
        for (int k = 0; k < Dim; ++k) {
          const int upper = corner >> k & 1;
          node.at[k] = low[k] + upper;
          hat *= upper != 0 ? beyond[k] : 1.0 - beyond[k];
        }
        node.s = Points::weight(a) * hat;
        for (int k = 0; k < Dim; ++k) node.g[k] = gradient[a][k] * hat;
        nodes_.push_back(node);
      }
    }
  }

  std::vector<NodeWeight> nodes_;
};

template <int Dim>
std::vector<NodeWeight> reference_stencil(ShapeKind shape, const ReferenceGrid& grid, const ReferencePlace& place) {
  return ReferenceStencil<Dim>(shape, grid, place).nodes();
}

}  // namespace mpm::test
