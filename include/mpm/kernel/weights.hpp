// The weights of a chunk of particles: where they are in their block's tile, the nearest node, and the shape function
// and its gradient at the nodes around it along each axis. Made anew for every pass (to store them between passes costs
// more than they do), a chunk at a time into a buffer in cache: the passes then know where to look before they get
// there.
//
// A shape function is a class with kNodes, 3 or 5, values s[kNodes], which sum to 1, and g[kNodes], which sum to 0
// (gathers and scatters count on it), made from the offset from the nearest node and an Axis, its constants for a body
// (shape/ugimp.hpp). What is done with weights depends on the number of values alone, so passes reach a shape function
// through mpm_kernel::ShapeKernels, a call a chunk, and are shared by all of one number. With kStretches its box is the
// particle's own; with kFoldsAtWalls it keeps to the nodes inside walls; with kAxisymmetric it has a radial() for the
// first axis, which has a hoop function besides (shape/axisymmetric.hpp).
#pragma once

#include <type_traits>

#include "mpm/kernel/tile.hpp"
#include "mpm/kernel/wide_math.hpp"
#include "mpm/shape/axis_rules.hpp"

namespace mpm {

using mpm_kernel::Beside;
using mpm_kernel::GridView;
using mpm_kernel::kBuffer;
using mpm_kernel::kChunk;
using mpm_kernel::SetView;

/// Lanes that share a row of nodes along the last axis are gathered together; else those that share their nearest node.
template <class T>
constexpr bool kByColumn = Wide<T>::kLanes >= kTileEdge;

/// Frame of the weights of a body's particles: all that they depend on beside places.
template <class T, int Dim, template <class> class Shape>
class WeightFrame {
  using W = Wide<T>;
  static constexpr int kNodes = Shape<W>::kNodes;

 public:
  using Axis = typename Shape<W>::Axis;
  WeightFrame(const GridView& grid, const BlockView& block, const SetView<T>& set)
      : lowest_(lowest_nearest<kNodes>(block.loose)), highest_(highest_nearest<kNodes>(block.loose)) {
    for (int k = 0; k < Dim; ++k) {
      x_[k] = set.x[k];
      origin_[k] = grid.origin[k];
      inverse_cell_[k] = grid.inverse_cell[k];
      corner_[k] = block.corner[k];
      half_[k] = set.half[k];
      if constexpr (Shape<W>::kStretches) stretch_[k] = set.domain[k];
      if constexpr (Shape<W>::kFoldsAtWalls) {
        low_wall_[k] = grid.low_wall[k] - corner_[k];
        high_wall_[k] = grid.high_wall[k] - corner_[k];
      }
    }
    if constexpr (Shape<W>::kAxisymmetric) {
      first_radius_ = corner_[0] + origin_[0] * inverse_cell_[0];
      if (set.whole_domains) rules_.domains = AxisDomains::whole;
      if (set.planar_functions) rules_.functions = AxisFunctions::planar;
    }
  }
  Axis axis(int k) const { return Axis(half_[k], inverse_cell_[k]); }
  double cell(int k) const { return 1.0 / inverse_cell_[k]; }
  /// Places of particles [p, p + count) along axis k, in the tile: its node i lies at i.
  W cells(int k, int p, int count) const {
    return W(W::B::place(x_[k] + p, count, origin_[k], inverse_cell_[k], corner_[k]));
  }
  /// Half way between two nodes the upper one, as the sorter has it; and none that the tile does not hold.
  W nearest(W cells) const { return max(min(round(cells + W(kTie)), highest_), lowest_); }
  /// Shape functions of particles [p, p + count) along axis k, around their nearest nodes. Inline always: a call would
  /// take its registers through memory.
  [[gnu::always_inline]] Shape<W> shape(int k, int p, int count, W cells, W nearest, const Axis& axis) const {
    if constexpr (Shape<W>::kStretches) {
      return Shape<W>(cells - nearest, Shape<W>::half(W::load_first(stretch_[k] + p, count), axis), axis);
    } else {
      Shape<W> shape(cells - nearest, axis);
      if constexpr (Shape<W>::kFoldsAtWalls) shape.fold(nearest - W(low_wall_[k]), W(high_wall_[k]) - nearest);
      return shape;
    }
  }
  /// Along the radius.
  auto radial(int p, int count, W cells, W nearest) const {
    W half(half_[0]);
    if constexpr (Shape<W>::kStretches) half = Shape<W>::half(W::load_first(stretch_[0] + p, count), axis(0));
    return Shape<W>::radial(cells - nearest, nearest + W(first_radius_), half, W(inverse_cell_[0]), rules_);
  }

 private:
  static constexpr double kTie = sizeof(T) == 8 ? 1e-12 : 2e-6;  // beyond the round-off of a place in the tile
  const double* x_[Dim];
  const T* stretch_[Shape<W>::kStretches ? Dim : 1];
  double origin_[Dim], inverse_cell_[Dim], corner_[Dim], half_[Dim];
  double low_wall_[Shape<W>::kFoldsAtWalls ? Dim : 1], high_wall_[Shape<W>::kFoldsAtWalls ? Dim : 1];
  W lowest_, highest_;
  double first_radius_ = 0.0;  ///< radius of the tile's first nodes [cells]
  AxisRules rules_;
};

/// Beside the radial values of an axisymmetric shape function: the hoop function [1/m]; where no gradient is asked for,
/// the hat functions at the particle, which move it (AxisMotion::point).
template <class T, int Nodes, bool Axisymmetric>
struct HoopWeights {
  alignas(64) T t[Nodes][kBuffer];
};
template <class T, int Nodes>
struct HoopWeights<T, Nodes, false> {};

/// Weights of a chunk of particles, for a shape function of `Nodes` values along an axis; what follows the chunk in the
/// buffers has no meaning.
template <class T, int Dim, int Nodes, bool Rings>
struct Weights : HoopWeights<T, Nodes, Rings> {
  alignas(64) T s[Dim][Nodes][kBuffer];  ///< shape function along each axis
  alignas(64) T g[Dim][Nodes][kBuffer];  ///< its gradient [1/m], or what stands beside the values
  alignas(64) T cells[Dim][kBuffer];     ///< place in the tile
  alignas(64) T last[kBuffer];           ///< nearest node along the last axis
  alignas(64) T place[kBuffer];   ///< number of a column or a node, which lanes must share to be gathered together
  alignas(64) int node[kBuffer];  ///< number in the tile of the nearest node
};

/// Makes the weights of one shape function.
template <class T, int Dim, template <class> class Shape>
class WeightMaker {
  using W = Wide<T>;
  static constexpr int kLast = Dim - 1;
  static constexpr int kNodes = Shape<W>::kNodes;

 public:
  using Made = Weights<T, Dim, kNodes, Shape<W>::kAxisymmetric>;

  template <Beside What>
  static void fill(const GridView& grid, const BlockView& block, const SetView<T>& set, int first, int count,
                   void* weights) {
    const WeightFrame<T, Dim, Shape> frame(grid, block, set);
    Made& to = *static_cast<Made*>(weights);
    for (int k = 0; k < Dim; ++k) {
      const typename Shape<W>::Axis axis = frame.axis(k);
      for (int q = 0; q < count; q += W::kLanes) {
        const W x = frame.cells(k, first + q, count - q);
        const W nearest = frame.nearest(x);
        if constexpr (Shape<W>::kAxisymmetric) {
          if (k == 0) {
            auto radial = frame.radial(first + q, count - q, x, nearest);
            keep_hoop<What>(radial, x - nearest, q, to);
            keep<What>(radial, x - nearest, frame.cell(k), k, q, to);
          } else {
            Shape<W> shape = frame.shape(k, first + q, count - q, x, nearest, axis);
            keep<What>(shape, x - nearest, frame.cell(k), k, q, to);
          }
        } else {
          Shape<W> shape = frame.shape(k, first + q, count - q, x, nearest, axis);
          keep<What>(shape, x - nearest, frame.cell(k), k, q, to);
        }
        x.store(to.cells[k] + q);
        const W number = k == 0 ? nearest : W::load(to.place + q) * W(kTileEdge) + nearest;
        if (k < kLast || !kByColumn<T>) number.store(to.place + q);
        if (Dim == 1 && kByColumn<T>) W(0.0).store(to.place + q);  // a line is one column
        if (k == kLast) {
          nearest.store(to.last + q);
          typedef int Numbers __attribute__((vector_size(4 * W::kLanes)));
          const Numbers numbers = __builtin_convertvector(number.v, Numbers);
          __builtin_memcpy(to.node + q, &numbers, sizeof(numbers));
        }
      }
    }
  }

  static constexpr mpm_kernel::ShapeKernels<T> kernels() {
    return {{&fill<Beside::nothing>, &fill<Beside::gradient>, &fill<Beside::moment>, &fill<Beside::affine>},
            Shape<W>::kStretches};
  }

 private:
  static constexpr double kLeastMoment = 1e-10;  ///< [cells^2]
  template <Beside What, class Along>
  [[gnu::always_inline]] static void keep(Along& shape, W offset, double cell, int k, int q, Made& to) {
    if constexpr (What == Beside::moment || What == Beside::affine) {
      put_moments(shape, offset, cell, What == Beside::affine);
    }
    for (int n = 0; n < kNodes; ++n) {
      shape.s[n].store(to.s[k][n] + q);
      if constexpr (What != Beside::nothing) shape.g[n].store(to.g[k][n] + q);
    }
  }
  template <Beside What, class Along>
  static void keep_hoop(const Along& radial, W offset, int q, Made& to) {
    const W hat[3] = {max(-offset, W(0.0)), W(1.0) - abs(offset), max(offset, W(0.0))};
    for (int n = 0; n < kNodes; ++n) (What == Beside::gradient ? radial.t[n] : hat[n]).store(to.t[n] + q);
  }

  // A product of values that each reproduce a linear field has a diagonal second moment, sum of S (x_i - x_p)^2. With
  // the weight r values do not: moments are then about their mean place.
  template <class Along>
  static void put_moments(Along& shape, W offset, double cell, bool over_second) {
    W second(0.0), mean(0.0);
    if constexpr (!std::is_same_v<Along, Shape<W>>) {
      for (int n = 0; n < kNodes; ++n) mean += shape.s[n] * W(n - kNodes / 2);
      mean -= offset;
    }
    for (int n = 0; n < kNodes; ++n) {
      W arm = (W(n - kNodes / 2) - offset) * W(cell);
      if constexpr (!std::is_same_v<Along, Shape<W>>) arm -= mean * W(cell);
      shape.g[n] = shape.s[n] * arm;
      second += shape.g[n] * arm;
    }
    if (!over_second) return;
    // A spline folded at a wall has no second moment on the wall, where all weight is the wall node's and moments are
    // zero, and a negative one beyond it.
    const W least(kLeastMoment * cell * cell);
    second = select(second < W(0.0), min(second, -least), max(second, least));
    for (int n = 0; n < kNodes; ++n) shape.g[n] /= second;
  }
};

/// Family of an axisymmetric shape function, in the place of two axes.
template <template <class> class Shape>
constexpr mpm_kernel::ShapeFamily axisymmetric_shape_of() {
  return {{{}, WeightMaker<double, 2, Shape>::kernels(), {}}, {{}, WeightMaker<float, 2, Shape>::kernels(), {}}};
}

/// Family of a shape function, for each number of axes and either precision.
template <template <class> class Shape>
constexpr mpm_kernel::ShapeFamily shape_of() {
  return {{WeightMaker<double, 1, Shape>::kernels(), WeightMaker<double, 2, Shape>::kernels(),
           WeightMaker<double, 3, Shape>::kernels()},
          {WeightMaker<float, 1, Shape>::kernels(), WeightMaker<float, 2, Shape>::kernels(),
           WeightMaker<float, 3, Shape>::kernels()}};
}

}  // namespace mpm
