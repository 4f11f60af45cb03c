// The nodes of one particle with the value and the gradient of its shape function there, from the classes of shape/
// alone: products along the axes of three or five values, or sums over the points of a deformed domain, each point with
// the hat functions of its cell. A node of two points is listed twice. Always in double precision. It is slow, since
// the list is made anew for each particle. Source: method reference 2.1 to 2.7, 3; the bounds on a domain's size are
// those of kernel/domain.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <vector>

#include "mpm/kernel/kernels.hpp"
#include "mpm/shape/axisymmetric.hpp"
#include "mpm/shape/axisymmetric_points.hpp"
#include "mpm/shape/bspline.hpp"
#include "mpm/shape/cpdi.hpp"
#include "mpm/shape/dirac.hpp"
#include "mpm/shape/domain_shear.hpp"
#include "mpm/shape/kind.hpp"
#include "mpm/shape/qcpdi.hpp"
#include "mpm/shape/ugimp.hpp"
#include "mpm/shape/ugimp_stretch.hpp"

namespace mpm::test {

/// The properties of the grid on which shape functions depend.
struct ReferenceGrid {
  std::array<double, 3> origin{}, cell{1.0, 1.0, 1.0};  ///< [m]
  std::array<double, 3> low_wall{-mpm_kernel::kNoWall, -mpm_kernel::kNoWall, -mpm_kernel::kNoWall};
  std::array<double, 3> high_wall{mpm_kernel::kNoWall, mpm_kernel::kNoWall, mpm_kernel::kNoWall};  ///< node numbers

  bool rings = false;  ///< axisymmetric about x = 0, with the rules of `axis`
  AxisRules axis;

  double in_cells(int k, double x) const { return (x - origin[k]) / cell[k]; }
  /// Position of a node [m].
  double position(int k, int node) const { return origin[k] + node * cell[k]; }
};

/// The properties of a particle on which its weights depend.
struct ReferencePlace {
  std::array<double, 3> x{};     ///< [m]
  std::array<double, 3> half{};  ///< half edges of its box [cells]
  double f[3][3] = {};           ///< deformation gradient in the grid's axes as the step began
};

struct NodeWeight {
  std::array<int, 3> at{};
  double s = 0.0;
  double g[3] = {};    ///< [1/m]
  double t = 0.0;      ///< for rings, the weight of v_r in v_r / r [1/m]
  double point = 0.0;  ///< for rings, the weight of v_r in their motion with AxisMotion::point
};

/// Largest distance of a domain's point from its particle along an axis [cells]; kernel/domain.hpp.
constexpr double kReferenceReach = 1.5 - 1e-4;

/// Half vectors of a particle's domain [m], scaled down together if the domain reaches too far, or across an axis to
/// which it is fitted.
template <int Dim>
void reference_domain(const ReferenceGrid& grid, const ReferencePlace& place, double (&d)[Dim][Dim]) {
  for (int k = 0; k < Dim; ++k) {
    for (int c = 0; c < Dim; ++c) d[k][c] = place.f[c][k] * place.half[k] * grid.cell[k] / grid.cell[c];  // [cells]
  }
  if constexpr (Dim > 1) {
    if (leans_too_far(d)) set_up(d);  // stability.domain_shear has what these two do
  }
  double reach = 0.0;
  for (int c = 0; c < Dim; ++c) {
    double along = 0.0;
    for (int k = 0; k < Dim; ++k) {
      along += std::abs(d[k][c]);
      d[k][c] *= grid.cell[c];
    }
    reach = std::max(reach, along);
  }
  double scale = std::min(1.0, kReferenceReach / reach);
  if constexpr (Dim == 2) {
    if (grid.rings && grid.axis.domains == AxisDomains::fitted && grid.axis.functions == AxisFunctions::weighted) {
      scale = std::min(scale, place.x[0] / (std::abs(d[0][0]) + std::abs(d[1][0])));
    }
  }
  for (auto& vector : d) {
    for (double& component : vector) component *= scale;
  }
}

template <int Dim>
class ReferenceStencil {
 public:
  ReferenceStencil(ShapeKind shape, const ReferenceGrid& grid, const ReferencePlace& place) {
    if constexpr (Dim == 2) {
      if (grid.rings) {
        add_rings(shape, grid, place);
        return;
      }
    }
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
  void add_rings(ShapeKind shape, const ReferenceGrid& grid, const ReferencePlace& place) {
    switch (shape) {
      case ShapeKind::dirac:
        return add_product<AxisymmetricDirac<double>>(grid, place);
      case ShapeKind::ugimp:
        return add_product<AxisymmetricUgimp<double>>(grid, place);
      case ShapeKind::ugimp_stretch:
        return add_product<AxisymmetricUgimpStretch<double>>(grid, place);
      case ShapeKind::cpdi:
        return add_points<AxisymmetricCpdi<Dim>>(grid, place);
      case ShapeKind::qcpdi:
        return add_points<AxisymmetricQcpdi<Dim>>(grid, place);
      case ShapeKind::bspline2:
      case ShapeKind::bspline3:
        break;
    }
  }

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
  static auto along_radius(int nearest, const ReferenceGrid& grid, const ReferencePlace& place) {
    double half = place.half[0];
    if constexpr (Shape::kStretches) {
      half = Shape::half(place.f[0][0], typename Shape::Axis(half, 1.0 / grid.cell[0]));
    }
    return Shape::radial(grid.in_cells(0, place.x[0]) - nearest, static_cast<double>(nearest), half, 1.0 / grid.cell[0],
                         grid.axis);
  }

  template <class Shape>
  void add_product(const ReferenceGrid& grid, const ReferencePlace& place) {
    constexpr int kNodes = Shape::kNodes;
    double s[3][kNodes], g[3][kNodes], t[kNodes] = {};
    int nearest[3] = {}, count = 1;
    for (int k = 0; k < Dim; ++k) {
      nearest[k] = static_cast<int>(std::floor(grid.in_cells(k, place.x[k]) + 0.5));
      count *= kNodes;
      if constexpr (Shape::kAxisymmetric) {
        if (k == 0) {
          const auto radial = along_radius<Shape>(nearest[0], grid, place);
          std::copy(radial.s, radial.s + kNodes, s[0]);
          std::copy(radial.g, radial.g + kNodes, g[0]);
          std::copy(radial.t, radial.t + kNodes, t);
          continue;
        }
      }
      const Shape shape = along_axis<Shape>(k, nearest[k], grid, place);
      std::copy(shape.s, shape.s + kNodes, s[k]);
      std::copy(shape.g, shape.g + kNodes, g[k]);
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
      if constexpr (Shape::kAxisymmetric) {
        node.t = t[of[0]] * s[1][of[1]];
        node.point = hat(grid.in_cells(0, place.x[0]) - node.at[0]) * s[1][of[1]];
      }
      nodes_.push_back(node);
    }
  }

  template <class Points>
  void add_points(const ReferenceGrid& grid, const ReferencePlace& place) {
    double d[Dim][Dim], offset[Points::kPoints][Dim], gradient[Points::kPoints][Dim], weight[Points::kPoints];
    reference_domain(grid, place, d);
    Points::offsets(d, offset);
    Points::gradients(d, gradient);
    for (int a = 0; a < Points::kPoints; ++a) weight[a] = Points::weight(a);
    if constexpr (Points::kAxisymmetric) {
      if (grid.axis.functions == AxisFunctions::weighted) Points::radial(d, place.x[0], weight, gradient);
    }
    for (int a = 0; a < Points::kPoints; ++a) {
      add_cell(grid, place, offset[a], [&](NodeWeight& node, double hat) {
        node.s = weight[a] * hat;
        if constexpr (Points::kAxisymmetric) node.t = Points::weight(a) / place.x[0] * hat;
        for (int k = 0; k < Dim; ++k) node.g[k] = gradient[a][k] * hat;
      });
    }
    if constexpr (Points::kAxisymmetric) {
      const double centre[Dim] = {};
      add_cell(grid, place, centre, [](NodeWeight& node, double hat) { node.point = hat; });
    }
  }

  static double hat(double cells) { return std::max(0.0, 1.0 - std::abs(cells)); }
  // Visits the nodes of the cell that holds the point at `offset` [m] from the particle: weigh(node, hat function).
  template <class Weigh>
  void add_cell(const ReferenceGrid& grid, const ReferencePlace& place, const double (&offset)[Dim], Weigh&& weigh) {
    double cells[Dim];
    for (int k = 0; k < Dim; ++k) cells[k] = grid.in_cells(k, place.x[k] + offset[k]);
    for (int corner = 0; corner < 1 << Dim; ++corner) {
      NodeWeight node;
      double product = 1.0;
      for (int k = 0; k < Dim; ++k) {
        node.at[k] = static_cast<int>(std::floor(cells[k])) + (corner >> k & 1);
        product *= hat(cells[k] - node.at[k]);
      }
      weigh(node, product);
      nodes_.push_back(node);
    }
  }

  std::vector<NodeWeight> nodes_;
};

template <int Dim>
std::vector<NodeWeight> reference_stencil(ShapeKind shape, const ReferenceGrid& grid, const ReferencePlace& place) {
  return ReferenceStencil<Dim>(shape, grid, place).nodes();
}

}  // namespace mpm::test
