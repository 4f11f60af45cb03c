// The interpolator of shape functions that are products along the axes: the weights of a chunk of particles, and what
// goes with them between particles and the tiles of a block. interpolator.hpp says what it has.
//
// Each transfer is a function of its own, called once a chunk: passes share them, and a compiler takes each of them
// once.
#pragma once

#include "mpm/kernel/gather.hpp"
#include "mpm/kernel/scatter.hpp"

namespace mpm {

/// `Nodes`: along an axis, 3 or 5. `Rings`: about an axis of symmetry.
template <class T, int Dim, int Nodes, bool Rings>
class ProductInterpolator {
  static_assert(!Rings || (Dim == 2 && Nodes == 3));
  using W = Wide<T>;
  using Set = SetView<T>;
  using Gathers = Gather<T, Dim, Nodes, Rings>;
  using Scatters = Scatter<T, Dim, Nodes, Rings>;

 public:
  using Number = T;
  static constexpr int kDim = Dim;
  static constexpr int kNodes = Nodes;
  static constexpr bool kRings = Rings;
  static constexpr bool kOutgrows = false;
  template <int Fields>
  using Source = GatherTile<T, Dim, Fields>;
  using Sink = ScatterTile<T, Dim>;

  ProductInterpolator(const GridView& grid, const BlockView& block, const Set& set)
      : grid_(grid), block_(block), set_(set) {}

  // A stencil of five reaches all of the tile from anywhere in the block.
  static BlockView reach(BlockView block) {
    block.loose = block.loose || Nodes > 3;
    return block;
  }

  static void note_domains(const Set& set, int owner) {
    if (!set.shape->stretches) return;
    for (int k = 0; k < Dim; ++k) note_domain(set, owner, set.f[k * Dim + k], set.domain[k]);
  }

  template <class Visit>
  void each_chunk(Visit&& visit) {
    each_chunk_of_groups(set_, block_.owner, [&](const ParticleChunk& chunk) {
      chunk_ = chunk;
      visit(chunk);
    });
  }
  void fill(Beside what) {
    set_.shape->fill[static_cast<int>(what)](grid_, block_, set_, chunk_.first, chunk_.count, &weights_);
  }
  W cells(int k, int q) const { return W::load(weights_.cells[k] + q); }

  template <int Fields>
  [[gnu::noinline]] int gather(const Source<Fields>& from, T (*to)[kBuffer]) const {
    int parts = 0;
    each_group(set_, chunk_, [&](int q, int lanes) {
      W sum[Fields];
      for (W& component : sum) component = W(0.0);
      parts += Gathers::each_part(weights_, q, lanes, [&](const auto& reader, int row, const auto& weights) {
        Gathers::values(from, reader, row, weights, sum);
      });
      for (int c = 0; c < Fields; ++c) sum[c].store(to[c] + q);
    });
    return parts;
  }

  template <int Fields>
  void gradient(const Source<Fields>& from, mpm_kernel::ChunkGradients<T>& to) const {
    by_gradient(from, to);
    if constexpr (Rings) by_hoop(from, 0, to.l[mpm_kernel::kHoopGradient]);
  }

  // With moments in place of the gradient that is B.
  void gather_affine(const Source<Dim>& velocity) const {
    mpm_kernel::ChunkGradients<T> b;
    by_gradient(velocity, b);
    for (int c = 0; c < Dim * Dim; ++c) std::memcpy(set_.affine[c] + chunk_.first, b.l[c], chunk_.count * sizeof(T));
  }

  // Hat functions stand in place of the hoop function if no gradient was asked for.
  template <int Fields>
  void gather_at_place(const Source<Fields>& from, int c, T* to) const {
    by_hoop(from, c, to);
  }

  [[gnu::noinline]] void spread(const ChunkValues<T>& from, Sink& to) const {
    Scatters::values(weights_, from, chunk_.count, to.data());
  }
  template <bool Hoop = Rings>
  [[gnu::noinline]] void spread_gradient(const mpm_kernel::ChunkStresses<T>& from, Sink& to) const {
    Scatters::template columns<Hoop>(weights_, from, chunk_.count, to.data());
  }

  // As a force's columns go by G, the columns of m B go by D^-1 (x_i - x_p) S, D as it is in the particle's present
  // place.
  void spread_affine(const ChunkValues<T>& from, Sink& to) {
    fill(Beside::affine);
    spread(from, to);
    mpm_kernel::ChunkStresses<T> columns;
    for (int q = 0; q < chunk_.count; q += W::kLanes) {
      const int p = chunk_.first + q, lanes = chunk_.count - q;
      const W mass = mass_of<Rings>(set_, p, lanes);
      for (int k = 0; k < Dim; ++k) {
        W four[4] = {W(0.0), W(0.0), W(0.0), W(0.0)};
        for (int c = 0; c < Dim; ++c) four[c] = mass * W::load_first(set_.affine[c * Dim + k] + p, lanes);
        interleave(columns.column[k] + 4 * q, four[0], four[1], four[2], four[3]);
      }
    }
    spread_gradient<false>(columns, to);
  }

 private:
  // By what stands beside the values.
  template <int Fields>
  [[gnu::noinline]] void by_gradient(const Source<Fields>& from, mpm_kernel::ChunkGradients<T>& to) const {
    each_group(set_, chunk_, [&](int q, int lanes) {
      W l[Fields][Dim];
      for (auto& row : l) {
        for (W& component : row) component = W(0.0);
      }
      Gathers::each_part(weights_, q, lanes, [&](const auto& reader, int row, const auto& weights) {
        Gathers::gradient(from, reader, row, weights, l);
      });
      for (int c = 0; c < Fields; ++c) {
        for (int k = 0; k < Dim; ++k) l[c][k].store(to.l[c * Dim + k] + q);
      }
    });
  }
  // Component `c` by what stands in HoopWeights.
  template <int Fields>
  [[gnu::noinline]] void by_hoop(const Source<Fields>& from, int c, T* to) const {
    each_group(set_, chunk_, [&](int q, int lanes) {
      W sum(0.0);
      Gathers::each_part(weights_, q, lanes, [&](const auto& reader, int row, const auto& weights) {
        Gathers::by_hoop(from, c, reader, row, weights, sum);
      });
      sum.store(to + q);
    });
  }

  const GridView& grid_;
  const BlockView& block_;
  const Set& set_;
  ParticleChunk chunk_{};
  Weights<T, Dim, Nodes, Rings> weights_;
};

}  // namespace mpm
