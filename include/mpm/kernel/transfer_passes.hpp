// Passes that move any numbers between the particles of a block and its nodes, over an interpolator (interpolator.hpp):
// gather, gradient, slopes, slope_lead, spread, spread_gradient and diffuse of kernels.hpp. They know neither mass,
// unless asked, nor law of a body.
#pragma once

#include "mpm/kernel/interpolator.hpp"
#include "mpm/kernel/weights.hpp"

namespace mpm {

template <class Interpolator>
class TransferPasses {
  using T = typename Interpolator::Number;
  static constexpr int kDim = Interpolator::kDim;
  static constexpr bool kRings = Interpolator::kRings;
  template <int Fields>
  using Source = typename Interpolator::template Source<Fields>;
  using Sink = typename Interpolator::Sink;
  using W = Wide<T>;
  using Set = SetView<T>;
  using Arrays = mpm_kernel::ParticleArrays;

 public:
  static void gather(const GridView& grid, const BlockView& given, const Set* sets, const Arrays* arrays, int count,
                     int components, const double* field) {
    if (components == 1) {
      gather_components<1>(grid, given, sets, arrays, count, field);
    } else {
      gather_components<kDim>(grid, given, sets, arrays, count, field);
    }
  }

  static void gradient(const GridView& grid, const BlockView& given, const Set* sets, const Arrays* arrays, int count,
                       const double* field) {
    const BlockView block = Interpolator::reach(given);
    Source<1> source;
    source.template load<1>(field, block, 0);
    mpm_kernel::ChunkGradients<T> gradients;
    each_set<Interpolator>(grid, block, sets, count, [&](Interpolator& in, const Set&, int number) {
      const Arrays& of = arrays[number];
      if (of.to[0] == nullptr) return;
      in.each_chunk([&](const ParticleChunk& chunk) {
        in.fill(Beside::gradient);
        in.gradient(source, gradients);
        for (int k = 0; k < kDim; ++k) take(gradients.l[k], chunk, of.to[k]);
        if (kRings && of.to[2] != nullptr) take(gradients.l[mpm_kernel::kHoopGradient], chunk, of.to[2]);
      });
    });
  }

  static void slopes(const GridView& grid, const BlockView& given, const Set* sets, const Arrays* arrays, int count,
                     const double* field) {
    Source<kDim> source;
    source.template load<kDim>(field, Interpolator::reach(given), 0);
    take_slopes(grid, given, sets, arrays, count, source, [](const Interpolator&, int, int, W slope) { return slope; });
  }

  static void slope_lead(const GridView& grid, const BlockView& given, const Set* sets, const Arrays* arrays,
                         int count) {
    static constexpr Parabolas kParabolas;
    BlockView block = Interpolator::reach(given);
    block.neighbours = kParabolas.blocks;
    Source<kDim> source;
    source.template load<kDim>(kParabolas.values, block, 0);
    take_slopes(grid, given, sets, arrays, count, source, [&](const Interpolator& in, int k, int q, W slope) {
      const W cell(1.0 / grid.inverse_cell[k]);
      return (slope * cell - in.cells(k, q) + W(kMiddle)) * cell;
    });
  }

  static void spread(const GridView& grid, const BlockView& given, const Set* sets, const Arrays* arrays, int count,
                     int components, bool by_mass, double* field) {
    const BlockView block = Interpolator::reach(given);
    Sink tile;
    tile.clear(block);
    ChunkValues<T> values;
    each_set<Interpolator>(grid, block, sets, count, [&](Interpolator& in, const Set& set, int number) {
      const Arrays& of = arrays[number];
      if (of.from[0] == nullptr) return;
      in.each_chunk([&](const ParticleChunk& chunk) {
        in.fill(Beside::nothing);
        for (int q = 0; q < chunk.count; q += W::kLanes) {
          W number_of[3] = {W(0.0), W(0.0), W(0.0)};
          for (int c = 0; c < components; ++c) number_of[c] = give(set, of.from[c], chunk, q, by_mass);
          values.set(q, number_of[0], number_of[1], number_of[2], W(0.0));
        }
        in.spread(values, tile);
      });
    });
    add_components(tile, block, components, field);
  }

  static void spread_gradient(const GridView& grid, const BlockView& given, const Set* sets, const Arrays* arrays,
                              int count, int components, bool by_mass, double* field) {
    const BlockView block = Interpolator::reach(given);
    Sink tile;
    tile.clear(block);
    mpm_kernel::ChunkStresses<T> columns;
    const bool isotropic = components > 1;  // on a line both are the same
    each_set<Interpolator>(grid, block, sets, count, [&](Interpolator& in, const Set& set, int number) {
      const Arrays& of = arrays[number];
      if (of.from[0] == nullptr) return;
      const bool hoop = kRings && !isotropic && of.from[2] != nullptr;
      in.each_chunk([&](const ParticleChunk& chunk) {
        in.fill(Beside::gradient);
        for (int q = 0; q < chunk.count; q += W::kLanes) {
          for (int k = 0; k < kDim; ++k) {
            W four[4] = {W(0.0), W(0.0), W(0.0), W(0.0)};
            four[isotropic ? k : 0] = give(set, of.from[isotropic ? 0 : k], chunk, q, by_mass);
            interleave(columns.column[k] + 4 * q, four[0], four[1], four[2], four[3]);
          }
          if (hoop) {
            const W along = give(set, of.from[2], chunk, q, by_mass);
            interleave(columns.column[mpm_kernel::kHoopColumn] + 4 * q, along, W(0.0), W(0.0), W(0.0));
          }
        }
        if (hoop) {
          in.spread_gradient(columns, tile);
        } else {
          in.template spread_gradient<false>(columns, tile);
        }
      });
    });
    add_components(tile, block, components, field);
  }

  static void diffuse(const GridView& grid, const BlockView& given, const Set* sets, const Arrays* arrays, int count,
                      const double* field, double* to) {
    const BlockView block = Interpolator::reach(given);
    Source<1> source;
    source.template load<1>(field, block, 0);
    Sink tile;
    tile.clear(block);
    mpm_kernel::ChunkGradients<T> gradients;
    mpm_kernel::ChunkStresses<T> columns;
    each_set<Interpolator>(grid, block, sets, count, [&](Interpolator& in, const Set& set, int number) {
      const Arrays& of = arrays[number];
      if (of.from[0] == nullptr) return;
      in.each_chunk([&](const ParticleChunk& chunk) {
        in.fill(Beside::gradient);
        in.gradient(source, gradients);
        for (int q = 0; q < chunk.count; q += W::kLanes) {
          const W conducts = -give(set, of.from[0], chunk, q, true);
          for (int k = 0; k < kDim; ++k) {
            interleave(columns.column[k] + 4 * q, conducts * W::load(gradients.l[k] + q), W(0.0), W(0.0), W(0.0));
          }
        }
        in.template spread_gradient<false>(columns, tile);
      });
    });
    add_components(tile, block, 1, to);
  }

 private:
  static constexpr double kMiddle = 0.5 * (kTileEdge - 1);

  /// to(interpolator, axis k, place in the chunk, d source_k / d x_k) for what is kept.
  template <class To>
  static void take_slopes(const GridView& grid, const BlockView& given, const Set* sets, const Arrays* arrays,
                          int count, const Source<kDim>& source, To&& to) {
    mpm_kernel::ChunkGradients<T> gradients;
    each_set<Interpolator>(grid, Interpolator::reach(given), sets, count,
                           [&](Interpolator& in, const Set&, int number) {
                             const Arrays& of = arrays[number];
                             if (of.to[0] == nullptr) return;
                             in.each_chunk([&](const ParticleChunk& chunk) {
                               in.fill(Beside::gradient);
                               in.gradient(source, gradients);
                               for (int k = 0; k < kDim; ++k) {
                                 T* slope = gradients.l[k * kDim + k];
                                 for (int q = 0; q < chunk.count; q += W::kLanes)
                                   to(in, k, q, W::load(slope + q)).store(slope + q);
                                 take(slope, chunk, of.to[k]);
                               }
                             });
                           });
  }
  /// Parabolas along each axis about the tile's middle [cells^2], on the blocks that a tile is copied from.
  struct Parabolas {
    static constexpr int kBlocks = kDim == 3 ? 27 : kDim == 2 ? 9 : 3, kNodes = TileShape<kDim>::kBlockNodes;
    double values[kBlocks * kDim * kNodes] = {};
    int blocks[kBlocks] = {};

    constexpr Parabolas() {
      for (int b = 0; b < kBlocks; ++b) {
        blocks[b] = b;
        for (int n = 0; n < kNodes; ++n) {
          for (int k = kDim - 1, block = b, node = n; k >= 0; --k, block /= 3, node /= 4) {
            const double arm = 4 * (block % 3) + node % 4 - mpm_kernel::kTileMargin - kMiddle;
            values[(b * kDim + k) * kNodes + n] = 0.5 * arm * arm;
          }
        }
      }
    }
  };

  template <int Components>
  static void gather_components(const GridView& grid, const BlockView& given, const Set* sets, const Arrays* arrays,
                                int count, const double* field) {
    const BlockView block = Interpolator::reach(given);
    Source<Components> source;
    source.template load<Components>(field, block, 0);
    alignas(64) T gathered[Components][kBuffer];
    each_set<Interpolator>(grid, block, sets, count, [&](Interpolator& in, const Set&, int number) {
      if (arrays[number].to[0] == nullptr) return;
      in.each_chunk([&](const ParticleChunk& chunk) {
        in.fill(Beside::nothing);
        in.gather(source, gathered);
        for (int c = 0; c < Components; ++c) take(gathered[c], chunk, arrays[number].to[c]);
      });
    });
  }

  // Numbers of a register of the chunk's particles, rounded to what particles carry.
  static W give(const Set& set, const double* from, const ParticleChunk& chunk, int q, bool by_mass) {
    const int p = chunk.first + q, lanes = chunk.count - q;
    const bool each = weighs_each<kRings>(set);
    const W number(W::B::place(from + p, lanes, 0.0, by_mass && !each ? set.mass : 1.0, 0.0));
    return by_mass && each ? number * mass_of<true>(set, p, lanes) : number;
  }
  static void take(const T* from, const ParticleChunk& chunk, double* to) {
    for (int q = 0; q < chunk.count; ++q) to[chunk.first + q] = static_cast<double>(from[q]);
  }
  static void add_components(const Sink& tile, const BlockView& block, int components, double* field) {
    if (components == 1) {
      tile.template add_to<1>(field, block, 0);
    } else {
      tile.template add_to<kDim>(field, block, 0);
    }
  }
};

}  // namespace mpm
