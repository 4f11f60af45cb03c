// The passes over one block, as the table of kernels.hpp wants them. Particles pass through buffers in cache, a chunk of
// whole groups at a time. What a pass is told it copies first: numbers that nothing points to stay in registers.
#pragma once

#include "mpm/kernel/gather.hpp"
#include "mpm/kernel/nodes.hpp"
#include "mpm/kernel/stress.hpp"

namespace mpm {

template <class Geometry, template <class> class Shape, class T>
class Passes {
  static constexpr int kDim = Geometry::kDim;
  using W = Wide<T>;
  using AllWeights = Weights<T, kDim, Shape>;
  using Gathers = Gather<T, kDim, Shape>;
  using Scatters = Scatter<T, kDim, Shape>;
  using Stresses = Stress<Geometry, Shape, T>;
  using Set = SetView<T>;

 public:
  static constexpr mpm_kernel::KernelTable<T> table() {
    return {W::kLanes,     kByColumn<T>,   &scatter_momentum, &strain, &move,
            &scatter_load, &nodal_velocity<kDim>, &nodal_update<kDim>};
  }

 private:
  static void scatter_momentum(const GridView& grid_view, const BlockView& block_view, const Set* sets, int count) {
    const GridView grid = grid_view;
    const BlockView block = block_view;
    ScatterTile<T, kDim> tile;
    tile.clear(block);
    for (int s = 0; s < count; ++s) {
      const Set set = sets[s];
      const W mass(set.mass);
      scatter_values(grid, block, set, tile, [&](typename Scatters::Values& values, const AllWeights& w, int q, int p,
                                                  int lanes) {
        W momentum[3] = {mass, mass, mass};
        for (int c = 0; c < kDim; ++c) momentum[c] = mass * W::load_first(set.v[c] + p, lanes);
        // In a plane the mass is the third component.
        values.set(w, q, momentum[0], momentum[1], momentum[2], mass);
      });
    }
    tile.template add_to<kDim>(grid.momentum, block, 0);
    tile.template add_to<1>(grid.mass, block, kDim);
  }

  static void scatter_load(const GridView& grid_view, const BlockView& block_view, const Set* sets, int count, double* field) {
    const GridView grid = grid_view;
    const BlockView block = block_view;
    ScatterTile<T, kDim> tile;
    tile.clear(block);
    for (int s = 0; s < count; ++s) {
      const Set set = sets[s];
      if (set.load[0] == nullptr) continue;
      scatter_values(grid, block, set, tile, [&](typename Scatters::Values& values, const AllWeights& w, int q, int p,
                                                  int lanes) {
        W force[3] = {W(0.0), W(0.0), W(0.0)};
        for (int c = 0; c < kDim; ++c) {
          force[c] = W(W::B::place(set.load[c] + p, lanes, 0.0, set.mass, 0.0));
        }
        values.set(w, q, force[0], force[1], force[2], W(0.0));
      });
    }
    tile.template add_to<kDim>(field, block, 0);
  }

  static mpm_kernel::Failure strain(const GridView& grid_view, const BlockView& block_view, const Set* sets, int count,
                                    const mpm_kernel::StrainSettings& settings) {
    const GridView grid = grid_view;
    const BlockView block = block_view;
    GatherTile<T, kDim, kDim> velocity;
    velocity.template load<kDim>(grid.velocity, block, 0);
    ScatterTile<T, kDim> force;
    if (settings.and_force) force.clear(block);
    typename Stresses::Gradients gradients;
    typename Stresses::Stresses stresses;
    mpm_kernel::Failure failure{-1, 0};
    for (int s = 0; s < count; ++s) {
      const Set set = sets[s];
      const typename Stresses::Update update = Stresses::of_law(set.law_kind);
      each_chunk(set, block.owner, [&](int first, int g, int g_end) {
        int q = 0;
        for (; g < g_end; ++g) {
          const int p = set.group[g], lanes = set.group[g + 1] - set.group[g];
          const AllWeights w(grid, block, set, p, lanes);
          W l[kDim][kDim];
          for (auto& row : l) {
            for (W& component : row) component = W(0.0);
          }
          Gathers::each_part(w, lanes, [&](const auto& reader, int row, const AllWeights& part) {
            Gathers::gradient(velocity, reader, row, part, l);
          });
          for (int c = 0; c < kDim; ++c) {
            for (int k = 0; k < kDim; ++k) l[c][k].store(gradients.l[c][k] + q);
          }
          if (settings.and_force) stresses.set(w, q);
          q += lanes;
        }
        const int bad = update(sets[s], first, q, gradients, settings, settings.and_force ? &stresses : nullptr);
        if (bad < q && failure.set < 0) failure = {s, first + bad};
        if (settings.and_force) Scatters::scatter(stresses, q, force.data);
      });
    }
    if (settings.and_force) force.template add_to<kDim>(grid.force, block, 0);
    return failure;
  }

  static mpm_kernel::Moved move(const GridView& grid_view, const BlockView& block_view, const Set* sets, int count,
                                const mpm_kernel::MoveSettings& settings) {
    const GridView grid = grid_view;
    const BlockView block = block_view;
    GatherTile<T, kDim, 2 * kDim> motion;  // velocity, acceleration
    motion.template load<kDim>(grid.velocity, block, 0);
    motion.template load<kDim>(grid.force, block, kDim);
    ScatterTile<T, kDim> momentum;
    if (settings.regather) momentum.clear(block);
    typename Scatters::Values values;
    mpm_kernel::Moved moved{false, false, 0, 0};
    for (int s = 0; s < count; ++s) {
      const Set set = sets[s];
      const Reach reach(block, set);
      WideMask<T> inside = reach.everywhere(), tight = inside;
      each_chunk(set, block.owner, [&](int, int g, int g_end) {
        int q = 0;
        for (; g < g_end; ++g) {
          const int p = set.group[g], lanes = set.group[g + 1] - set.group[g];
          const AllWeights w(grid, block, set, p, lanes);
          W sum[2 * kDim];
          for (W& component : sum) component = W(0.0);
          moved.parts += Gathers::each_part(w, lanes, [&](const auto& reader, int row, const AllWeights& part) {
            Gathers::values(motion, reader, row, part, sum);
          });
          ++moved.groups;
          W velocity[3] = {W(0.0), W(0.0), W(0.0)};
          for (int c = 0; c < kDim; ++c) {
            velocity[c] = W::load_first(set.v[c] + p, lanes);
            const W displacement = advance(sum[c], sum[kDim + c], settings, velocity[c]);
            velocity[c].store_first(set.v[c] + p, lanes);
            W::B::displace(set.next_x[c] + p, set.x[c] + p, displacement.v, lanes);
            reach.check(c, w.cells[c] + displacement * W(grid.inverse_cell[c]), lanes, inside, tight);
          }
          if (settings.regather) {
            const W mass(set.mass);
            values.set(w, q, mass * velocity[0], mass * velocity[1], mass * velocity[2], W(0.0));
          }
          q += lanes;
        }
        if (settings.regather) Scatters::scatter(values, q, momentum.data);
      });
      moved.gone = moved.gone || !all(inside);
      moved.loose = moved.loose || !all(tight);
    }
    if (settings.regather) momentum.template add_to<kDim>(grid.momentum, block, 0);
    return moved;
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
    Reach(const BlockView& block, const Set& set) {
      for (int k = 0; k < kDim; ++k) {
        // The nearest node must keep a neighbour on each side in the tile, or in its six nodes.
        const double lowest = set.lowest[k] - block.corner[k], highest = set.highest[k] - block.corner[k];
        const double first = 0.5 + mpm_kernel::kSlack, last = kTileEdge - 1.5 - mpm_kernel::kSlack;
        lowest_[k] = W(lowest > first ? lowest : first);
        highest_[k] = W(highest < last ? highest : last);
      }
    }
    static WideMask<T> everywhere() { return WideMask<T>::first(W::kLanes); }
    void check(int k, W cells, int lanes, WideMask<T>& inside, WideMask<T>& tight) const {
      const WideMask<T> beyond = !WideMask<T>::first(lanes);
      inside = inside & (((cells >= lowest_[k]) & (cells <= highest_[k])) | beyond);
      tight = tight & (((cells >= W(1.5 + mpm_kernel::kSlack)) & (cells <= W(5.5 - mpm_kernel::kSlack))) | beyond);
    }

   private:
    W lowest_[kDim], highest_[kDim];
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

  // fill(buffer, weights, place in the buffer, first particle, lanes) for every group; then they go to the tile.
  template <class Fill>
  static void scatter_values(const GridView& grid, const BlockView& block, const Set& set, ScatterTile<T, kDim>& tile,
                             Fill&& fill) {
    typename Scatters::Values values;
    each_chunk(set, block.owner, [&](int, int g, int g_end) {
      int q = 0;
      for (; g < g_end; ++g) {
        const int p = set.group[g], lanes = set.group[g + 1] - set.group[g];
        fill(values, AllWeights(grid, block, set, p, lanes), q, p, lanes);
        q += lanes;
      }
      Scatters::scatter(values, q, tile.data);
    });
  }
};

}  // namespace mpm
