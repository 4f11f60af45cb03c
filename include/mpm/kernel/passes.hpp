// The passes over one block, as the table of kernels.hpp wants them. Particles pass through buffers in cache, a chunk
// of whole groups at a time. What a pass is told of a body it copies first: numbers that nothing points to stay in
// registers.
#pragma once

#include "mpm/kernel/gather.hpp"
#include "mpm/kernel/nodes.hpp"
#include "mpm/kernel/stress.hpp"
#include "mpm/kernel/survey.hpp"

namespace mpm {

template <class Geometry, template <class> class Shape, class T>
class Passes {
  static constexpr int kDim = Geometry::kDim;
  using W = Wide<T>;
  using AllWeights = Weights<T, kDim, Shape>;
  using Frame = WeightFrame<T, kDim, Shape>;
  using Gathers = Gather<T, kDim, Shape>;
  using Scatters = Scatter<T, kDim, Shape>;
  using Values = typename Scatters::Values;
  using Stresses = Stress<Geometry, Shape, T>;
  using Set = SetView<T>;

 public:
  static constexpr mpm_kernel::KernelTable<T> table() {
    return {W::kLanes,
            kByColumn<T>,
            &scatter_momentum,
            &strain,
            &move,
            &scatter_load,
            &Survey<Geometry, T>::fastest,
            &nodal_velocity<kDim>,
            &nodal_update<kDim>};
  }

 private:
  static void scatter_momentum(const GridView& grid, const BlockView& block, const Set* sets, int count) {
    ScatterTile<T, kDim> tile;
    tile.clear(block);
    for (int s = 0; s < count; ++s) {
      if (absent(sets[s], block)) continue;
      const Set set = sets[s];
      const W mass(set.mass);
      scatter_values(grid, block, set, tile, [&](Values& values, int q, int p, int lanes) {
        W momentum[3] = {mass, mass, mass};  // in a plane the mass is the third component
        for (int c = 0; c < kDim; ++c) momentum[c] = mass * W::load_first(set.v[c] + p, lanes);
        values.set(q, momentum[0], momentum[1], momentum[2], mass);
      });
    }
    tile.template add_to<kDim>(grid.momentum, block, 0);
    tile.template add_to<1>(grid.mass, block, kDim);
  }

  static void scatter_load(const GridView& grid, const BlockView& block, const Set* sets, int count, double* field) {
    ScatterTile<T, kDim> tile;
    tile.clear(block);
    for (int s = 0; s < count; ++s) {
      if (absent(sets[s], block) || sets[s].load[0] == nullptr) continue;
      const Set set = sets[s];
      scatter_values(grid, block, set, tile, [&](Values& values, int q, int p, int lanes) {
        W force[3] = {W(0.0), W(0.0), W(0.0)};
        for (int c = 0; c < kDim; ++c) force[c] = W(W::B::place(set.load[c] + p, lanes, 0.0, set.mass, 0.0));
        values.set(q, force[0], force[1], force[2], W(0.0));
      });
    }
    tile.template add_to<kDim>(field, block, 0);
  }

  static mpm_kernel::Failure strain(const GridView& grid, const BlockView& block, const Set* sets, int count,
                                    const mpm_kernel::StrainSettings& settings) {
    GatherTile<T, kDim, kDim> velocity;
    velocity.template load<kDim>(grid.velocity, block, 0);
    ScatterTile<T, kDim> force;
    if (settings.and_force) force.clear(block);
    AllWeights w;
    typename Stresses::Gradients gradients;
    typename Stresses::Stresses stresses;
    mpm_kernel::Failure failure{-1, 0};
    for (int s = 0; s < count; ++s) {
      if (absent(sets[s], block)) continue;
      const Set set = sets[s];
      const Frame frame(grid, block, set);
      const typename Stresses::Update update = Stresses::of_law(set.law_kind);
      each_chunk(set, block.owner, [&](int first, int g, int g_end) {
        const int particles = static_cast<int>(set.group[g_end]) - first;
        w.template fill<true>(frame, first, particles);
        each_group(set, first, g, g_end, [&](int q, int lanes) {
          W l[kDim][kDim];
          for (auto& row : l) {
            for (W& component : row) component = W(0.0);
          }
          Gathers::each_part(w, q, lanes, [&](const auto& reader, int row, const auto& weights) {
            Gathers::gradient(velocity, reader, row, weights, l);
          });
          for (int c = 0; c < kDim; ++c) {
            for (int k = 0; k < kDim; ++k) l[c][k].store(gradients.l[c][k] + q);
          }
        });
        const int bad =
            update(sets[s], first, particles, gradients, settings, settings.and_force ? &stresses : nullptr);
        if (bad < particles && failure.set < 0) failure = {s, first + bad};
        if (settings.and_force) {
          Scatters::scatter(w, stresses, particles, force.data());
        }
      });
    }
    if (settings.and_force) force.template add_to<kDim>(grid.force, block, 0);
    return failure;
  }

  static mpm_kernel::Moved move(const GridView& grid, const BlockView& block, const Set* sets, int count,
                                const mpm_kernel::MoveSettings& settings_view) {
    const mpm_kernel::MoveSettings settings = settings_view;
    GatherTile<T, kDim, 2 * kDim> motion;  // velocity, acceleration
    motion.template load<kDim>(grid.velocity, block, 0);
    motion.template load<kDim>(grid.force, block, kDim);
    ScatterTile<T, kDim> momentum;
    if (settings.regather) momentum.clear(block);
    AllWeights w;
    Values values;
    alignas(64) T gathered[2 * kDim][kBuffer];
    mpm_kernel::Moved moved{false, false, 0, 0};
    for (int s = 0; s < count; ++s) {
      if (absent(sets[s], block)) continue;
      const Set set = sets[s];
      const Frame frame(grid, block, set);
      const Reach reach(grid, block, set);
      WideMask<T> inside = reach.everywhere(), tight = inside;
      each_chunk(set, block.owner, [&](int first, int g, int g_end) {
        const int particles = static_cast<int>(set.group[g_end]) - first;
        w.template fill<false>(frame, first, particles);
        moved.groups += g_end - g;
        each_group(set, first, g, g_end, [&](int q, int lanes) {
          W sum[2 * kDim];
          for (W& component : sum) component = W(0.0);
          moved.parts += Gathers::each_part(w, q, lanes, [&](const auto& reader, int row, const auto& weights) {
            Gathers::values(motion, reader, row, weights, sum);
          });
          for (int c = 0; c < 2 * kDim; ++c) sum[c].store(gathered[c] + q);
        });
        for (int q = 0; q < particles; q += W::kLanes) {
          const int p = first + q, lanes = particles - q;
          W velocity[3] = {W(0.0), W(0.0), W(0.0)};
          for (int c = 0; c < kDim; ++c) {
            velocity[c] = W::load_first(set.v[c] + p, lanes);
            const W displacement =
                advance(W::load(gathered[c] + q), W::load(gathered[kDim + c] + q), settings, velocity[c]);
            velocity[c].store_first(set.v[c] + p, lanes);
            W::B::displace(set.next_x[c] + p, set.x[c] + p, displacement.v, lanes);
            reach.check(c, W::load(w.cells[c] + q), displacement, lanes, inside, tight);
          }
          if (settings.regather) {
            const W mass(set.mass);
            values.set(q, mass * velocity[0], mass * velocity[1], mass * velocity[2], W(0.0));
          }
        }
        if (settings.regather) {
          values.set_weights(w, particles);
          Scatters::scatter(w, values, particles, momentum.data());
        }
      });
      moved.gone = moved.gone || !all(inside);
      moved.loose = moved.loose || !all(tight);
    }
    if (settings.regather) momentum.template add_to<kDim>(grid.momentum, block, 0);
    return moved;
  }

  static bool absent(const Set& set, const BlockView& block) {
    return set.group_begin[block.owner] == set.group_begin[block.owner + 1];
  }

  /// The particle's velocity gains what the grid's did, less the slip that the PIC fraction takes away. Returns the
  /// displacement. GIMP notes (2.15), (2.16); method reference 6.2.
  static W advance(W grid_velocity, W acceleration, const mpm_kernel::MoveSettings& settings, W& velocity) {
    const W dt(settings.dt), half_dt(0.5 * settings.dt);
    const W slip = W(1.0 - settings.flip) * (velocity - (grid_velocity - acceleration * dt));
    velocity += acceleration * dt - slip;
    return dt * (grid_velocity - W(0.5) * slip - half_dt * acceleration);
  }

  /// How far particles of a set may go before they have to be sorted.
  class Reach {
   public:
    Reach(const GridView& grid, const BlockView& block, const Set& set) {
      for (int k = 0; k < kDim; ++k) {
        inverse_cell_[k] = W(grid.inverse_cell[k]);
        // The nearest node must keep a neighbour on each side in the tile, or in its six nodes.
        const double lowest = set.lowest[k] - block.corner[k], highest = set.highest[k] - block.corner[k];
        const double first = lowest_nearest(true) - kBeside, last = highest_nearest(true) + kBeside;
        lowest_[k] = W(lowest > first ? lowest : first);
        highest_[k] = W(highest < last ? highest : last);
      }
    }
    static WideMask<T> everywhere() { return WideMask<T>::first(W::kLanes); }
    /// `cells`: where they were in the tile; `displacement` [m].
    void check(int k, W cells, W displacement, int lanes, WideMask<T>& inside, WideMask<T>& tight) const {
      const WideMask<T> beyond = !WideMask<T>::first(lanes);
      cells += displacement * inverse_cell_[k];
      inside = inside & (((cells >= lowest_[k]) & (cells <= highest_[k])) | beyond);
      tight =
          tight &
          (((cells >= W(lowest_nearest(false) - kBeside)) & (cells <= W(highest_nearest(false) + kBeside))) | beyond);
    }

   private:
    static constexpr double kBeside = 0.5 - mpm_kernel::kSlack;  ///< how far from its nearest node a particle may be
    W lowest_[kDim], highest_[kDim], inverse_cell_[kDim];
  };

  // visit(first particle, groups) for the set's particles of one block, at most kChunk at a time.
  template <class Visit>
  static void each_chunk(const Set& set, int owner, Visit&& visit) {
    const int end = static_cast<int>(set.group_begin[owner + 1]);
    for (int g = static_cast<int>(set.group_begin[owner]); g < end;) {
      const int first = static_cast<int>(set.group[g]);
      int g_end = g + 1;
      while (g_end < end && static_cast<int>(set.group[g_end + 1]) - first <= kChunk) ++g_end;
      visit(first, g, g_end);
      g = g_end;
    }
  }

  // visit(place in the chunk, lanes) for each of its groups.
  template <class Visit>
  static void each_group(const Set& set, int first, int g, int g_end, Visit&& visit) {
    for (; g < g_end; ++g) {
      const int p = static_cast<int>(set.group[g]);
      visit(p - first, static_cast<int>(set.group[g + 1]) - p);
    }
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
      w.template fill<false>(frame, first, particles);
      values.set_weights(w, particles);
      for (int q = 0; q < particles; q += W::kLanes) fill(values, q, first + q, particles - q);
      Scatters::scatter(w, values, particles, tile.data());
    });
  }
};

}  // namespace mpm
