// The points of the deformed domains of a chunk of particles (shape/cpdi.hpp): where they are in the tile, and their
// part in the gradient. Made anew for every pass, as weights.hpp makes those of other shape functions.
//
// A domain that leans too far is set up (shape/domain_shear.hpp).
//
// A point farther than 1.5 cells from its particle could lie outside the tile: such a domain is shrunk as a whole,
// which keeps all sums that a shape function must have (Homel, Brannon & Guilkey (2016) scale CPDI domains for the same
// end).
#pragma once

#include <type_traits>

#include "mpm/kernel/point_tile.hpp"
#include "mpm/kernel/wide_math.hpp"
#include "mpm/shape/domain_shear.hpp"
#include "mpm/shape/particle_domain.hpp"

namespace mpm {

constexpr int kDomainChunk = 16;  ///< particles at a time

template <class T, int Dim, template <int> class Points>
class Domains {
  using W = Wide<T>;
  using Set = mpm_kernel::SetView<T>;
  static constexpr int kPoints = Points<Dim>::kPoints;
  static constexpr int kRoom = kDomainChunk + 16;  // and what the last register writes beyond it
  static constexpr bool kRings = Points<Dim>::kAxisymmetric;

 public:
  Domains(const mpm_kernel::GridView& grid, const BlockView& block, const Set& set) : set_(set) {
    for (int k = 0; k < Dim; ++k) {
      origin_[k] = grid.origin[k];
      inverse_cell_[k] = grid.inverse_cell[k];
      corner_[k] = block.corner[k];
      half_[k] = W(set.half[k] / grid.inverse_cell[k]);
    }
    if constexpr (kRings) {
      first_radius_ = corner_[0] + origin_[0] * inverse_cell_[0];
      planar_ = set.planar_functions;
      fitted_ = !set.whole_domains && !planar_;
    }
  }

  /// Fills the domains of particles [first, first + count).
  void fill(int first, int count) {
    for (int q = 0; q < count; q += W::kLanes) {
      W d[Dim][Dim], offset[kPoints][Dim], gradient[kPoints][Dim];
      vectors(first + q, count - q, d);
      Points<Dim>::offsets(d, offset);
      for (int c = 0; c < Dim; ++c) place(c, first + q, count - q).store(place_[c] + q);
      if constexpr (kRings) {
        weigh_rings(q, d, offset, gradient);
      } else {
        Points<Dim>::gradients(d, gradient);
      }
      for (int a = 0; a < kPoints; ++a) {
        W number(0.0);
        for (int c = 0; c < Dim; ++c) {
          const W at = W::load(place_[c] + q) + offset[a][c] * W(inverse_cell_[c]);
          const W cell = max(min(round(at - W(0.5)), W(kTileEdge - 2.0)), W(0.0));
          (at - cell).store(along_[a][c] + q);
          gradient[a][c].store(gradient_[a][c] + q);
          number = number * W(kTileEdge) + cell;
        }
        typedef int Numbers __attribute__((vector_size(4 * W::kLanes)));
        const Numbers numbers = __builtin_convertvector(number.v, Numbers);
        __builtin_memcpy(node_[a] + q, &numbers, sizeof(numbers));
      }
    }
  }

  /// Point a of the particle at place q of the chunk.
  CellPoint<T, Dim> point(int a, int q) const {
    CellPoint<T, Dim> at;
    at.node = node_[a][q];
    for (int c = 0; c < Dim; ++c) at.along[c] = along_[a][c][q];
    return at;
  }
  W cells(int c, int q) const { return W::load(place_[c] + q); }  ///< place of particles in the tile
  /// The cell of the particle itself.
  CellPoint<T, Dim> centre(int q) const {
    CellPoint<T, Dim> at{0, {}};
    for (int c = 0; c < Dim; ++c) {
      const int cell = static_cast<int>(place_[c][q]);
      at.along[c] = place_[c][q] - static_cast<T>(cell);
      at.node = at.node * kTileEdge + cell;
    }
    return at;
  }
  T weight(int a, int q) const {
    if constexpr (kRings) return ring_.weight[a][q];
    return static_cast<T>(Points<Dim>::weight(a));
  }
  /// Factor that makes v_r / r of the points' v_r, for rings [1/m].
  T hoop(int a, int q) const { return static_cast<T>(Points<Dim>::weight(a)) * ring_.per_radius[q]; }
  T gradient(int a, int c, int q) const { return gradient_[a][c][q]; }  ///< [1/m]
  T cell(int c) const { return static_cast<T>(1.0 / inverse_cell_[c]); }
  /// From the particle (of rings from the mean place of its values) to the lower corner of the cell of point a along
  /// axis c [m].
  T arm(int a, int c, int q) const {
    const int node = node_[a][q] / kStride[Dim - 1 - c] % kTileEdge;
    const T arm = (static_cast<T>(node) - place_[c][q]) * cell(c);
    if constexpr (kRings) return arm - ring_.mean[c][q];
    return arm;
  }

  /// True if points of particles [first, first + count) lie outside the tile, where particles are and with the domains
  /// that they have now.
  bool outgrown(int first, int count) const {
    WideMask<T> inside = WideMask<T>::first(W::kLanes);
    for (int q = 0; q < count; q += W::kLanes) {
      W d[Dim][Dim];
      vectors(first + q, count - q, d);
      const WideMask<T> beyond = !WideMask<T>::first(count - q);
      for (int c = 0; c < Dim; ++c) {
        W reach(0.0);
        for (int k = 0; k < Dim; ++k) reach += abs(d[k][c]) * W(inverse_cell_[c]);
        const W at = place(c, first + q, count - q);
        inside = inside & (((at - reach >= W(0.0)) & (at + reach <= W(kTileEdge - 1.0))) | beyond);
      }
    }
    return !all(inside);
  }

 private:
  W place(int c, int p, int count) const {
    return W(W::B::place(set_.x[c] + p, count, origin_[c], inverse_cell_[c], corner_[c]));
  }
  // Half vectors of the domains [m], columns of F times half the box; those that lean too far set up, and those beyond
  // the reach made shorter.
  void vectors(int p, int count, W (&d)[Dim][Dim]) const {
    for (int c = 0; c < Dim; ++c) {
      for (int k = 0; k < Dim; ++k) {
        const W one = select(WideMask<T>::first(count), W::load_first(set_.domain[c * Dim + k] + p, count),
                             W(c == k ? 1.0 : 0.0));
        d[k][c] = one * half_[k];
      }
    }
    if constexpr (Dim > 1) limit_shear(d);
    W reach(0.0);
    for (int c = 0; c < Dim; ++c) {
      W along(0.0);
      for (int k = 0; k < Dim; ++k) along += abs(d[k][c]) * W(inverse_cell_[c]);
      reach = max(reach, along);
    }
    W scale = W(kDomainReach) / max(reach, W(kDomainReach));
    if constexpr (kRings) {
      if (fitted_) {
        const W radius = max(place(0, p, count) + W(first_radius_), W(kLeastRadius)) * W(1.0 / inverse_cell_[0]);
        scale = min(scale, radius / (abs(d[0][0]) + abs(d[1][0])));
      }
    }
    for (auto& vector : d) {
      for (W& component : vector) component *= scale;
    }
  }
  // In cells, the unit in which the limit is stated and in which no square of an edge is too small for T.
  void limit_shear(W (&d)[Dim][Dim]) const {
    W cells[Dim][Dim];
    for (int k = 0; k < Dim; ++k) {
      for (int c = 0; c < Dim; ++c) cells[k][c] = d[k][c] * W(inverse_cell_[c]);
    }
    const WideMask<T> leans = leans_too_far(cells);
    if (__builtin_expect(any(leans), 0)) set_up_lanes(leans.bits(), cells, d);
  }
  [[gnu::cold, gnu::noinline]] void set_up_lanes(unsigned lanes, const W (&cells)[Dim][Dim], W (&d)[Dim][Dim]) const {
    for (; lanes != 0; lanes &= lanes - 1) {
      const int l = __builtin_ctz(lanes);
      double one[Dim][Dim];
      for (int k = 0; k < Dim; ++k) {
        for (int c = 0; c < Dim; ++c) one[k][c] = static_cast<double>(lane(cells[k][c], l));
      }
      set_up(one);
      for (int k = 0; k < Dim; ++k) {
        for (int c = 0; c < Dim; ++c) set_lane(d[k][c], l, static_cast<T>(one[k][c] / inverse_cell_[c]));
      }
    }
  }
  // Weights, gradients and the rest of rings at places q to q + kLanes of the chunk.
  void weigh_rings(int q, const W (&d)[Dim][Dim], const W (&offset)[kPoints][Dim], W (&gradient)[kPoints][Dim]) {
    const W radius = max(W::load(place_[0] + q) + W(first_radius_), W(kLeastRadius)) * W(1.0 / inverse_cell_[0]);
    W weight[kPoints];
    if (planar_) {
      Points<Dim>::gradients(d, gradient);
      for (int a = 0; a < kPoints; ++a) weight[a] = W(Points<Dim>::weight(a));
    } else {
      Points<Dim>::radial(d, radius, weight, gradient);
    }
    (W(1.0) / radius).store(ring_.per_radius + q);
    for (int a = 0; a < kPoints; ++a) weight[a].store(ring_.weight[a] + q);
    for (int c = 0; c < Dim; ++c) {
      W mean(0.0);
      for (int a = 0; a < kPoints; ++a) mean += weight[a] * offset[a][c];
      mean.store(ring_.mean[c] + q);
    }
  }

  static constexpr double kLeastRadius = 1e-4;  ///< radius of a particle that all but lies on the axis [cells]
  struct Ring {
    alignas(64) T weight[kPoints][kRoom];
    alignas(64) T per_radius[kRoom];  ///< [1/m]
    alignas(64) T mean[Dim][kRoom];   ///< place of the values from the particle [m]
  };
  struct Nothing {};

  static constexpr int kStride[3] = {1, kTileEdge, kTileEdge* kTileEdge};
  const Set& set_;
  double origin_[Dim], inverse_cell_[Dim], corner_[Dim];
  W half_[Dim];
  alignas(64) T place_[Dim][kRoom];  ///< place of the particles in the tile
  alignas(64) T along_[kPoints][Dim][kRoom];
  alignas(64) T gradient_[kPoints][Dim][kRoom];
  alignas(64) int node_[kPoints][kRoom];
  std::conditional_t<kRings, Ring, Nothing> ring_;
  double first_radius_ = 0.0;  ///< radius of the tile's first nodes [cells]
  bool fitted_ = false, planar_ = false;
};

}  // namespace mpm
