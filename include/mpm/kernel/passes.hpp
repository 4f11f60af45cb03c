// The passes over one block, as the table of kernels.hpp wants them, for shape functions that are products along the
// axes. Particles pass through buffers in cache, a chunk of whole groups at a time. What a pass is told of a body it
// copies first: numbers that nothing points to stay in registers.
#pragma once

#include "mpm/kernel/advance.hpp"
#include "mpm/kernel/chunks.hpp"
#include "mpm/kernel/gather.hpp"
#include "mpm/kernel/mean.hpp"
#include "mpm/kernel/nodes.hpp"
#include "mpm/kernel/scatter.hpp"

namespace mpm {

template <int Dim, template <class> class Shape, class T>
class Passes {
  static constexpr int kDim = Dim;
  static constexpr int kNodes = Shape<Wide<T>>::kNodes;
  static constexpr bool kRings = Shape<Wide<T>>::kAxisymmetric;
  static_assert(!kRings || Dim == 2);
  using W = Wide<T>;
  using AllWeights = Weights<T, kDim, Shape>;
  using Frame = WeightFrame<T, kDim, Shape>;
  using Gathers = Gather<T, kDim, Shape>;
  using Scatters = Scatter<T, kDim, Shape>;
  using Values = typename Scatters::Values;
  using Set = SetView<T>;
  using Means = Mean<T, Dim, kRings>;

 public:
  static constexpr mpm_kernel::KernelTable<T> table() {
    return {W::kLanes,
            kByColumn<T>,
            nullptr,
            {&scatter_momentum<false>, &scatter_momentum<true>},
            &strain,
            &force,
            {&spread_mean<false>, &spread_mean<true>},
            {{&move<mpm_kernel::kIncrement, false>, &move<mpm_kernel::kIncrement, true>},
             {&move<mpm_kernel::kAdopt, false>, &move<mpm_kernel::kAdopt, true>},
             {&move<mpm_kernel::kAffine, false>, &move<mpm_kernel::kAffine, true>}},
            &scatter_load,
            &project,
            nullptr,
            &nodal_velocity<kDim>,
            &nodal_update<kDim>};
  }

 private:
  // A stencil of five reaches all of the tile from anywhere in the block.
  static BlockView whole(BlockView block) {
    block.loose = block.loose || kNodes > 3;
    return block;
  }

  template <bool Affine>
  static void scatter_momentum(const GridView& grid, const BlockView& given, const Set* sets, int count) {
    const BlockView block = whole(given);
    ScatterTile<T, kDim> tile;
    tile.clear(block);
    for (int s = 0; s < count; ++s) {
      if (absent(sets[s], block)) continue;
      const Set set = sets[s];
      if constexpr (Shape<W>::kStretches) note_stretch(set, block.owner);
      scatter_values(grid, block, set, tile,
                     [&](Values& values, int q, int p, int lanes) { put_momentum(set, values, q, p, lanes); });
      if constexpr (Affine) scatter_affine(grid, block, set, tile);
    }
    tile.template add_to<kDim>(grid.momentum, block, 0);
    tile.template add_to<1>(grid.mass, block, kDim);
  }

  static void scatter_load(const GridView& grid, const BlockView& given, const Set* sets, int count, double* field) {
    const BlockView block = whole(given);
    ScatterTile<T, kDim> tile;
    tile.clear(block);
    for (int s = 0; s < count; ++s) {
      if (absent(sets[s], block) || sets[s].load[0] == nullptr) continue;
      const Set set = sets[s];
      scatter_values(grid, block, set, tile, [&](Values& values, int q, int p, int lanes) {
        W force[3] = {W(0.0), W(0.0), W(0.0)};
        const double mass = kRings ? 1.0 : set.mass;
        for (int c = 0; c < kDim; ++c) {
          force[c] = W(W::B::place(set.load[c] + p, lanes, 0.0, mass, 0.0));
          if constexpr (kRings) force[c] *= mass_of<true>(set, p, lanes);
        }
        values.set(q, force[0], force[1], force[2], W(0.0));
      });
    }
    tile.template add_to<kDim>(field, block, 0);
  }

  static mpm_kernel::Failure strain(const GridView& grid, const BlockView& given, const Set* sets, int count,
                                    const mpm_kernel::StrainSettings& settings) {
    const BlockView block = whole(given);
    GatherTile<T, kDim, kDim> velocity;
    velocity.template load<kDim>(grid.velocity, block, 0);
    GatherTile<T, kDim, 1> dilatation;
    if (settings.dilatation != nullptr) dilatation.template load<1>(settings.dilatation, block, 0);
    ScatterTile<T, kDim> force;
    if (settings.and_force) force.clear(block);
    AllWeights w;
    mpm_kernel::ChunkGradients<T> gradients;
    mpm_kernel::ChunkStresses<T> stresses;
    mpm_kernel::Failure failure{-1, 0};
    for (int s = 0; s < count; ++s) {
      if (absent(sets[s], block)) continue;
      const Set set = sets[s];
      const Frame frame(grid, block, set);
      each_chunk(set, block.owner, [&](int first, int g, int g_end) {
        const int particles = static_cast<int>(set.group[g_end]) - first;
        w.template fill<Beside::gradient>(frame, first, particles);
        gather_gradients(velocity, w, set, first, g, g_end, gradients);
        if (settings.dilatation != nullptr) {
          alignas(64) T mean[kBuffer];
          gather_scalar(dilatation, w, set, first, g, g_end, mean);
          for (int q = 0; q < particles; q += W::kLanes) {
            Means::set_dilatation(gradients, q, W::load(mean + q));
          }
        }
        const int bad = set.law_kernels->update(sets[s], first, particles, gradients, settings,
                                                settings.and_force ? &stresses : nullptr);
        if (bad < particles && failure.set < 0) failure = {s, first + bad};
        if (settings.and_force) Scatters::scatter(w, stresses, particles, force.data());
      });
    }
    if (settings.and_force) force.template add_to<kDim>(grid.force, block, 0);
    return failure;
  }

  static void force(const GridView& grid, const BlockView& given, const Set* sets, int count, const double* pressure) {
    const BlockView block = whole(given);
    GatherTile<T, kDim, 1> means;
    if (pressure != nullptr) means.template load<1>(pressure, block, 0);
    ScatterTile<T, kDim> tile;
    tile.clear(block);
    AllWeights w;
    mpm_kernel::ChunkStresses<T> stresses;
    for (int s = 0; s < count; ++s) {
      if (absent(sets[s], block)) continue;
      const Set set = sets[s];
      const Frame frame(grid, block, set);
      each_chunk(set, block.owner, [&](int first, int g, int g_end) {
        const int particles = static_cast<int>(set.group[g_end]) - first;
        w.template fill<Beside::gradient>(frame, first, particles);
        set.law_kernels->columns(sets[s], first, particles, stresses);
        if (pressure != nullptr) {
          alignas(64) T mean[kBuffer];
          gather_scalar(means, w, set, first, g, g_end, mean);
          for (int q = 0; q < particles; ++q) {
            const T mass = kRings ? set.masses[first + q] : static_cast<T>(set.mass);
            Means::set_mean(stresses, q, -mass * mean[q]);
          }
        }
        Scatters::scatter(w, stresses, particles, tile.data());
      });
    }
    tile.template add_to<kDim>(grid.force, block, 0);
  }

  template <bool OfStress>
  static void spread_mean(const GridView& grid, const BlockView& given, const Set* sets, int count, double* to) {
    const BlockView block = whole(given);
    GatherTile<T, kDim, kDim> velocity;
    if constexpr (!OfStress) velocity.template load<kDim>(grid.velocity, block, 0);
    ScatterTile<T, kDim> tile;
    tile.clear(block);
    AllWeights w;
    Values values;
    mpm_kernel::ChunkGradients<T> gradients;
    mpm_kernel::ChunkStresses<T> stresses;
    for (int s = 0; s < count; ++s) {
      if (absent(sets[s], block)) continue;
      const Set set = sets[s];
      const Frame frame(grid, block, set);
      each_chunk(set, block.owner, [&](int first, int g, int g_end) {
        const int particles = static_cast<int>(set.group[g_end]) - first;
        w.template fill<OfStress ? Beside::nothing : Beside::gradient>(frame, first, particles);
        alignas(64) T mean[kBuffer] = {};
        if constexpr (OfStress) {
          set.law_kernels->columns(sets[s], first, particles, stresses);
          for (int q = 0; q < particles; ++q) mean[q] = -Means::mean(stresses, q);
        } else {
          gather_gradients(velocity, w, set, first, g, g_end, gradients);
          for (int q = 0; q < particles; q += W::kLanes) {
            (mass_of<kRings>(set, first + q, particles - q) * Means::dilatation(gradients, q)).store(mean + q);
          }
        }
        for (int q = 0; q < particles; q += W::kLanes) {
          values.set(q, W::load(mean + q), W(0.0), W(0.0), W(0.0));
        }
        values.set_weights(w, particles);
        Scatters::scatter(w, values, particles, tile.data());
      });
    }
    tile.template add_to<1>(to, block, 0);
  }

  template <mpm_kernel::Motion Kind, bool Damped>
  static mpm_kernel::Moved move(const GridView& grid, const BlockView& given, const Set* sets, int count,
                                const mpm_kernel::MoveSettings& settings_view) {
    constexpr int kFields = Kind == mpm_kernel::kIncrement ? 2 * kDim : kDim;  // velocity, acceleration
    const BlockView block = whole(given);
    const mpm_kernel::MoveSettings settings = settings_view;
    GatherTile<T, kDim, kFields> motion;
    motion.template load<kDim>(grid.velocity, block, 0);
    if constexpr (kFields > kDim) motion.template load<kDim>(grid.force, block, kDim);
    ScatterTile<T, kDim> momentum;
    if (settings.regather) momentum.clear(block);
    AllWeights w;
    Values values;
    alignas(64) T gathered[kFields][kBuffer];
    alignas(64) T beside[kRings ? kBuffer : 1];
    mpm_kernel::Moved moved{false, false, 0, 0};
    for (int s = 0; s < count; ++s) {
      if (absent(sets[s], block)) continue;
      const Set set = sets[s];
      const Frame frame(grid, block, set);
      const Reach<T, kDim, kNodes> reach(grid, block, set);
      Advance<T, kDim, Kind, Damped, kRings> advance(set, settings);
      WideMask<T> inside = reach.everywhere(), tight = inside;
      each_chunk(set, block.owner, [&](int first, int g, int g_end) {
        const int particles = static_cast<int>(set.group[g_end]) - first;
        w.template fill<Kind == mpm_kernel::kAffine ? Beside::moment : Beside::nothing>(frame, first, particles);
        moved.groups += g_end - g;
        each_group(set, first, g, g_end, [&](int q, int lanes) {
          W sum[kFields];
          for (W& component : sum) component = W(0.0);
          moved.parts += Gathers::each_part(w, q, lanes, [&](const auto& reader, int row, const auto& weights) {
            Gathers::values(motion, reader, row, weights, sum);
          });
          for (int c = 0; c < kFields; ++c) sum[c].store(gathered[c] + q);
          if constexpr (kRings) {
            W of_point(0.0);
            if (settings.by_point) {
              const W velocity = by_hoop(motion, w, 0, q, lanes) - sum[0];
              const W acceleration =
                  kFields > kDim ? by_hoop(motion, w, kFields - kDim, q, lanes) - sum[kFields - kDim] : W(0.0);
              of_point = advance.to_point(velocity, acceleration);
            }
            of_point.store(beside + q);
          }
          if constexpr (Kind == mpm_kernel::kAffine) {
            W b[kDim][kDim];
            gather_gradient(motion, w, q, lanes, b);
            for (int c = 0; c < kDim; ++c) {
              for (int k = 0; k < kDim; ++k) b[c][k].store_first(set.affine[c * kDim + k] + first + q, lanes);
            }
          }
        });
        for (int q = 0; q < particles; q += W::kLanes) {
          const int p = first + q, lanes = particles - q;
          for (int c = 0; c < kDim; ++c) {
            const W velocity = W::load(gathered[c] + q);
            const W acceleration = kFields > kDim ? W::load(gathered[(kFields - kDim) + c] + q) : W(0.0);
            W displacement;
            if constexpr (kRings) {
              const W of_point = c == 0 ? W::load(beside + q) : W(0.0);
              displacement = advance.particles(c, p, lanes, velocity, acceleration, of_point);
            } else {
              displacement = advance.particles(c, p, lanes, velocity, acceleration);
            }
            reach.check(c, W::load(w.cells[c] + q), displacement, lanes, inside, tight);
          }
          if (settings.regather) put_momentum(set, values, q, p, lanes);
        }
        if (settings.regather) {
          values.set_weights(w, particles);
          Scatters::scatter(w, values, particles, momentum.data());
        }
      });
      if (Kind == mpm_kernel::kAffine && settings.regather) scatter_affine(grid, block, set, momentum);
      advance.add_to(moved);
      moved.gone = moved.gone || !all(inside);
      moved.loose = moved.loose || !all(tight);
    }
    if (settings.regather) momentum.template add_to<kDim>(grid.momentum, block, 0);
    return moved;
  }

  static void project(const GridView& grid, const BlockView& given, const Set* sets, int count, const double* from,
                      double* to) {
    const BlockView block = whole(given);
    GatherTile<T, kDim, kDim> field;
    field.template load<kDim>(from, block, 0);
    ScatterTile<T, kDim> tile;
    tile.clear(block);
    AllWeights w;
    Values values;
    alignas(64) T gathered[3][kBuffer] = {};
    for (int s = 0; s < count; ++s) {
      if (absent(sets[s], block)) continue;
      const Set set = sets[s];
      const Frame frame(grid, block, set);
      each_chunk(set, block.owner, [&](int first, int g, int g_end) {
        const int particles = static_cast<int>(set.group[g_end]) - first;
        w.template fill<Beside::nothing>(frame, first, particles);
        each_group(set, first, g, g_end, [&](int q, int lanes) {
          W sum[kDim];
          for (W& component : sum) component = W(0.0);
          Gathers::each_part(w, q, lanes, [&](const auto& reader, int row, const auto& weights) {
            Gathers::values(field, reader, row, weights, sum);
          });
          for (int c = 0; c < kDim; ++c) sum[c].store(gathered[c] + q);
        });
        for (int q = 0; q < particles; q += W::kLanes) {
          const W mass = mass_of<kRings>(set, first + q, particles - q);
          values.set(q, mass * W::load(gathered[0] + q), mass * W::load(gathered[1] + q),
                     mass * W::load(gathered[2] + q), W(0.0));
        }
        values.set_weights(w, particles);
        Scatters::scatter(w, values, particles, tile.data());
      });
    }
    tile.template add_to<kDim>(to, block, 0);
  }

  // The stretch of the boxes, F_kk, as the step begins.
  static void note_stretch(const Set& set, int owner) {
    for (int k = 0; k < kDim; ++k) note_domain(set, owner, set.f[k * kDim + k], set.domain[k]);
  }

  // l[c][k] = d v_c / d x_k of one group, by the weights that stand beside the values.
  template <class Tile>
  static void gather_gradient(const Tile& tile, const AllWeights& w, int q, int lanes, W (&l)[kDim][kDim]) {
    for (auto& row : l) {
      for (W& component : row) component = W(0.0);
    }
    Gathers::each_part(w, q, lanes, [&](const auto& reader, int row, const auto& weights) {
      Gathers::gradient(tile, reader, row, weights, l);
    });
  }

  // Gradients of a chunk's groups.
  template <class Tile>
  static void gather_gradients(const Tile& tile, const AllWeights& w, const Set& set, int first, int g, int g_end,
                               mpm_kernel::ChunkGradients<T>& gradients) {
    each_group(set, first, g, g_end, [&](int q, int lanes) {
      W l[kDim][kDim];
      gather_gradient(tile, w, q, lanes, l);
      for (int c = 0; c < kDim; ++c) {
        for (int k = 0; k < kDim; ++k) l[c][k].store(gradients.l[c * kDim + k] + q);
      }
      if constexpr (kRings) by_hoop(tile, w, 0, q, lanes).store(gradients.l[mpm_kernel::kHoopGradient] + q);
    });
  }
  // Component `c` of the tile by what stands in HoopWeights.
  template <class Tile>
  static W by_hoop(const Tile& tile, const AllWeights& w, int c, int q, int lanes) {
    W sum(0.0);
    Gathers::each_part(w, q, lanes, [&](const auto& reader, int row, const auto& weights) {
      Gathers::by_hoop(tile, c, reader, row, weights, sum);
    });
    return sum;
  }
  // A scalar field at a chunk's particles.
  static void gather_scalar(const GatherTile<T, kDim, 1>& tile, const AllWeights& w, const Set& set, int first, int g,
                            int g_end, T* to) {
    each_group(set, first, g, g_end, [&](int q, int lanes) {
      W sum[1] = {W(0.0)};
      Gathers::each_part(w, q, lanes, [&](const auto& reader, int row, const auto& weights) {
        Gathers::values(tile, reader, row, weights, sum);
      });
      sum[0].store(to + q);
    });
  }

  // m v, and m as the component after them.
  static void put_momentum(const Set& set, Values& values, int q, int p, int lanes) {
    const W mass = mass_of<kRings>(set, p, lanes);
    W momentum[3] = {mass, mass, mass};
    for (int c = 0; c < kDim; ++c) momentum[c] = mass * W::load_first(set.v[c] + p, lanes);
    values.set(q, momentum[0], momentum[1], momentum[2], mass);
  }

  // m B D^-1 (x_i - x_p) S of every particle, D as it is in its present place: as a force's columns go by G, the
  // columns of m B go by D^-1 (x_i - x_p) S.
  static void scatter_affine(const GridView& grid, const BlockView& block, const Set& set, ScatterTile<T, kDim>& tile) {
    const Frame frame(grid, block, set);
    AllWeights w;
    mpm_kernel::ChunkStresses<T> columns;
    each_chunk(set, block.owner, [&](int first, int, int g_end) {
      const int particles = static_cast<int>(set.group[g_end]) - first;
      w.template fill<Beside::affine>(frame, first, particles);
      for (int q = 0; q < particles; q += W::kLanes) {
        const W mass = mass_of<kRings>(set, first + q, particles - q);
        for (int k = 0; k < kDim; ++k) {
          W four[4] = {W(0.0), W(0.0), W(0.0), W(0.0)};
          for (int c = 0; c < kDim; ++c) {
            four[c] = mass * W::load_first(set.affine[c * kDim + k] + first + q, particles - q);
          }
          interleave(columns.column[k] + 4 * q, four[0], four[1], four[2], four[3]);
        }
      }
      Scatters::template scatter<false>(w, columns, particles, tile.data());
    });
  }

  // fill(values, place in the chunk, first particle, lanes) for all particles; then they go to the tile.
  template <class Fill>
  static void scatter_values(const GridView& grid, const BlockView& block, const Set& set, ScatterTile<T, kDim>& tile,
                             Fill&& fill) {
    const Frame frame(grid, block, set);
    AllWeights w;
    Values values;
    each_chunk(set, block.owner, [&](int first, int, int g_end) {
      const int particles = static_cast<int>(set.group[g_end]) - first;
      w.template fill<Beside::nothing>(frame, first, particles);
      values.set_weights(w, particles);
      for (int q = 0; q < particles; q += W::kLanes) fill(values, q, first + q, particles - q);
      Scatters::scatter(w, values, particles, tile.data());
    });
  }
};

/// Of an axisymmetric shape function, in the place of two axes.
template <template <class> class Shape>
constexpr mpm_kernel::PassFamily axisymmetric_passes_of() {
  return {{{}, Passes<2, Shape, double>::table(), {}}, {{}, Passes<2, Shape, float>::table(), {}}};
}

/// Of a shape function, for each number of axes and either precision.
template <template <class> class Shape>
constexpr mpm_kernel::PassFamily passes_of() {
  return {{Passes<1, Shape, double>::table(), Passes<2, Shape, double>::table(), Passes<3, Shape, double>::table()},
          {Passes<1, Shape, float>::table(), Passes<2, Shape, float>::table(), Passes<3, Shape, float>::table()}};
}

}  // namespace mpm
