// The passes over one block for shape functions that are sums over points of a deformed domain (CPDI): points and their
// gradients are made with particles in the lanes, nodes are read and written a particle at a time, as vectors of two
// nodes' components. The law's pass, the schedule and the grid are those of all other shape functions.
//
// Weak: about half the speed of uGIMP in a solid. A domain is that of the step's start through the whole step: gathered
// with another one than it was scattered with, momentum would be lost.
// Source: Sadeghirad, Brannon & Burghardt (2011); method reference 2.5 to 2.7.
#pragma once

#include "mpm/kernel/advance.hpp"
#include "mpm/kernel/affine.hpp"
#include "mpm/kernel/chunks.hpp"
#include "mpm/kernel/domain.hpp"
#include "mpm/kernel/interleave.hpp"
#include "mpm/kernel/mean.hpp"
#include "mpm/kernel/nodes.hpp"

namespace mpm {

template <int Dim, template <int> class Points, class T>
class PointPasses {
  static constexpr int kPoints = Points<Dim>::kPoints;
  static constexpr int kRoom = kDomainChunk + 16;
  static constexpr bool kRings = Points<Dim>::kAxisymmetric;
  using W = Wide<T>;
  using Set = SetView<T>;
  using Vectors = PointVectors<T>;
  using Four = typename Vectors::Four;
  using Frame = Domains<T, Dim, Points>;
  using Tile = ScatterTile<T, Dim>;
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
            &outgrown,
            &nodal_velocity<Dim>,
            &nodal_update<Dim>};
  }

 private:
  // Points reach all of the tile.
  static BlockView whole(BlockView block) {
    block.loose = true;
    return block;
  }

  // visit(set, its number, frame, first particle, count) for chunks of the block's particles.
  template <class Visit>
  static void each(const GridView& grid, const BlockView& block, const Set* sets, int count, Visit&& visit) {
    for (int s = 0; s < count; ++s) {
      if (absent(sets[s], block)) continue;
      Frame frame(grid, block, sets[s]);
      const int end = static_cast<int>(sets[s].group[sets[s].group_begin[block.owner + 1]]);
      for (int p = static_cast<int>(sets[s].group[sets[s].group_begin[block.owner]]); p < end; p += kDomainChunk) {
        visit(sets[s], s, frame, p, end - p < kDomainChunk ? end - p : kDomainChunk);
      }
    }
  }

  static T mass_at(const Set& set, int p) { return kRings ? set.masses[p] : static_cast<T>(set.mass); }
  // m v, and m as the component after them.
  static Four momentum_of(const Set& set, int p) {
    const T mass = mass_at(set, p);
    Four value{};
    for (int c = 0; c < Dim; ++c) value[c] = mass * set.v[c][p];
    value[Dim] = mass;
    return value;
  }

  static void spread_all(const Frame& frame, int q, Four value, Tile& tile) {
    for (int a = 0; a < kPoints; ++a) spread(frame.point(a, q), frame.weight(a, q) * value, tile.data());
  }

  static void put_momentum(const Frame& frame, const Set& set, int p, int q, bool affine, Tile& tile) {
    const Four value = momentum_of(set, p);
    if (affine) {
      spread_affine<Dim, kPoints>(frame, q, value, set, p, tile.data());
    } else {
      spread_all(frame, q, value, tile);
    }
  }

  template <bool Affine>
  static void scatter_momentum(const GridView& grid, const BlockView& given, const Set* sets, int count) {
    const BlockView block = whole(given);
    Tile tile;
    tile.clear(block);
    for (int s = 0; s < count; ++s) {
      if (absent(sets[s], block)) continue;
      for (int c = 0; c < Dim * Dim; ++c) note_domain(sets[s], block.owner, sets[s].f[c], sets[s].domain[c]);
    }
    each(grid, block, sets, count, [&](const Set& set, int, Frame& frame, int first, int particles) {
      frame.fill(first, particles);
      for (int q = 0; q < particles; ++q) put_momentum(frame, set, first + q, q, Affine, tile);
    });
    tile.template add_to<Dim>(grid.momentum, block, 0);
    tile.template add_to<1>(grid.mass, block, Dim);
  }

  static void scatter_load(const GridView& grid, const BlockView& given, const Set* sets, int count, double* field) {
    const BlockView block = whole(given);
    Tile tile;
    tile.clear(block);
    each(grid, block, sets, count, [&](const Set& set, int, Frame& frame, int first, int particles) {
      if (set.load[0] == nullptr) return;
      frame.fill(first, particles);
      for (int q = 0; q < particles; ++q) {
        Four force{};
        const double mass = kRings ? static_cast<double>(set.masses[first + q]) : set.mass;
        for (int c = 0; c < Dim; ++c) force[c] = static_cast<T>(mass * set.load[c][first + q]);
        spread_all(frame, q, force, tile);
      }
    });
    tile.template add_to<Dim>(field, block, 0);
  }

  static mpm_kernel::Failure strain(const GridView& grid, const BlockView& given, const Set* sets, int count,
                                    const mpm_kernel::StrainSettings& settings) {
    const BlockView block = whole(given);
    PointTile<T, Dim> velocity;
    velocity.template load<Dim>(grid.velocity, block);
    PointTile<T, Dim> dilatation;
    if (settings.dilatation != nullptr) dilatation.template load<1>(settings.dilatation, block);
    Tile tile;
    if (settings.and_force) tile.clear(block);
    mpm_kernel::ChunkGradients<T> gradients;
    mpm_kernel::ChunkStresses<T> stresses;
    mpm_kernel::Failure failure{-1, 0};
    each(grid, block, sets, count, [&](const Set& set, int number, Frame& frame, int first, int particles) {
      frame.fill(first, particles);
      gather_gradients(frame, velocity, particles, gradients);
      if (settings.dilatation != nullptr) {
        alignas(64) T mean[kRoom] = {};
        for (int q = 0; q < particles; ++q) mean[q] = gather(frame, dilatation, q)[0];
        for (int q = 0; q < particles; q += W::kLanes) Means::set_dilatation(gradients, q, W::load(mean + q));
      }
      const int bad =
          set.law_kernels->update(set, first, particles, gradients, settings, settings.and_force ? &stresses : nullptr);
      if (bad < particles && failure.set < 0) failure = {number, first + bad};
      if (settings.and_force) spread_stresses(frame, stresses, particles, tile);
    });
    if (settings.and_force) tile.template add_to<Dim>(grid.force, block, 0);
    return failure;
  }

  static void gather_gradients(const Frame& frame, const PointTile<T, Dim>& velocity, int particles,
                               mpm_kernel::ChunkGradients<T>& gradients) {
    for (int q = 0; q < particles; ++q) {
      Four by_axis[Dim] = {};  // d v / d x_k
      T hoop = 0;
      for (int a = 0; a < kPoints; ++a) {
        const Four v = velocity.at(frame.point(a, q));
        for (int k = 0; k < Dim; ++k) by_axis[k] += frame.gradient(a, k, q) * v;
        if constexpr (kRings) hoop += frame.hoop(a, q) * v[0];
      }
      if constexpr (kRings) gradients.l[mpm_kernel::kHoopGradient][q] = hoop;
      for (int c = 0; c < Dim; ++c) {
        for (int k = 0; k < Dim; ++k) gradients.l[c * Dim + k][q] = by_axis[k][c];
      }
    }
  }
  static Four gather(const Frame& frame, const PointTile<T, Dim>& tile, int q) {
    Four sum{};
    for (int a = 0; a < kPoints; ++a) sum += frame.weight(a, q) * tile.at(frame.point(a, q));
    return sum;
  }

  static void force(const GridView& grid, const BlockView& given, const Set* sets, int count, const double* pressure) {
    const BlockView block = whole(given);
    PointTile<T, Dim> means;
    if (pressure != nullptr) means.template load<1>(pressure, block);
    Tile tile;
    tile.clear(block);
    mpm_kernel::ChunkStresses<T> stresses;
    each(grid, block, sets, count, [&](const Set& set, int, Frame& frame, int first, int particles) {
      frame.fill(first, particles);
      set.law_kernels->columns(set, first, particles, stresses);
      for (int q = 0; pressure != nullptr && q < particles; ++q) {
        Means::set_mean(stresses, q, -mass_at(set, first + q) * gather(frame, means, q)[0]);
      }
      spread_stresses(frame, stresses, particles, tile);
    });
    tile.template add_to<Dim>(grid.force, block, 0);
  }

  template <bool OfStress>
  static void spread_mean(const GridView& grid, const BlockView& given, const Set* sets, int count, double* to) {
    const BlockView block = whole(given);
    PointTile<T, Dim> velocity;
    if constexpr (!OfStress) velocity.template load<Dim>(grid.velocity, block);
    Tile tile;
    tile.clear(block);
    mpm_kernel::ChunkGradients<T> gradients;
    mpm_kernel::ChunkStresses<T> stresses;
    each(grid, block, sets, count, [&](const Set& set, int, Frame& frame, int first, int particles) {
      frame.fill(first, particles);
      if constexpr (OfStress) {
        set.law_kernels->columns(set, first, particles, stresses);
      } else {
        gather_gradients(frame, velocity, particles, gradients);
      }
      for (int q = 0; q < particles; ++q) {
        Four value{};
        if constexpr (OfStress) {
          value[0] = -Means::mean(stresses, q);
        } else {
          T trace = 0;
          for (int k = 0; k < Dim; ++k) trace += gradients.l[k * (Dim + 1)][q];
          if constexpr (kRings) trace += gradients.l[mpm_kernel::kHoopGradient][q];
          value[0] = mass_at(set, first + q) * trace;
        }
        spread_all(frame, q, value, tile);
      }
    });
    tile.template add_to<1>(to, block, 0);
  }

  static void spread_stresses(const Frame& frame, const mpm_kernel::ChunkStresses<T>& stresses, int particles,
                              Tile& tile) {
    for (int q = 0; q < particles; ++q) {
      Four column[Dim];
      for (int k = 0; k < Dim; ++k) __builtin_memcpy(&column[k], stresses.column[k] + 4 * q, sizeof(Four));
      for (int a = 0; a < kPoints; ++a) {
        Four f{};
        for (int k = 0; k < Dim; ++k) f += frame.gradient(a, k, q) * column[k];
        if constexpr (kRings) f[0] += frame.hoop(a, q) * stresses.column[mpm_kernel::kHoopColumn][4 * q];
        spread(frame.point(a, q), f, tile.data());
      }
    }
  }

  template <mpm_kernel::Motion Kind, bool Damped>
  static mpm_kernel::Moved move(const GridView& grid, const BlockView& given, const Set* sets, int count,
                                const mpm_kernel::MoveSettings& settings_view) {
    constexpr bool kAffine = Kind == mpm_kernel::kAffine;
    constexpr bool kAccelerates = Kind == mpm_kernel::kIncrement;
    const BlockView block = whole(given);
    const mpm_kernel::MoveSettings settings = settings_view;
    PointTile<T, Dim> velocity, acceleration;
    velocity.template load<Dim>(grid.velocity, block);
    if constexpr (kAccelerates) acceleration.template load<Dim>(grid.force, block);
    Tile momentum;
    if (settings.regather) momentum.clear(block);
    alignas(64) T gathered[2 * Dim][kRoom] = {};
    alignas(64) T to_point[kRings ? 2 : 1][kRoom] = {};  // of rings, radial velocity and acceleration
    mpm_kernel::Moved moved{false, false, 0, 0};
    each(grid, block, sets, count, [&](const Set& set, int, Frame& frame, int first, int particles) {
      const Reach<T, Dim, 3> reach(grid, given, set);
      Advance<T, Dim, Kind, Damped, kRings> advance(set, settings);
      WideMask<T> inside = reach.everywhere(), tight = inside;
      frame.fill(first, particles);
      for (int q = 0; q < particles; ++q) {
        Four v{}, a_sum{};
        for (int a = 0; a < kPoints; ++a) {
          const CellPoint<T, Dim> at = frame.point(a, q);
          v += frame.weight(a, q) * velocity.at(at);
          if constexpr (kAccelerates) a_sum += frame.weight(a, q) * acceleration.at(at);
        }
        for (int c = 0; c < Dim; ++c) {
          gathered[c][q] = v[c];
          if constexpr (kAccelerates) gathered[Dim + c][q] = a_sum[c];
        }
        if constexpr (kAffine) gather_affine<Dim, kPoints>(frame, q, velocity, set, first + q);
        if constexpr (kRings) {
          if (settings.by_point) {
            const CellPoint<T, Dim> at = frame.centre(q);
            to_point[0][q] = velocity.at(at)[0] - v[0];
            if constexpr (kAccelerates) to_point[1][q] = acceleration.at(at)[0] - a_sum[0];
          }
        }
      }
      for (int q = 0; q < particles; q += W::kLanes) {
        for (int c = 0; c < Dim; ++c) {
          const W cells = frame.cells(c, q);
          W beside(0.0);
          if constexpr (kRings) {
            if (c == 0) beside = advance.to_point(W::load(to_point[0] + q), W::load(to_point[1] + q));
          }
          const W displacement = advance.particles(c, first + q, particles - q, W::load(gathered[c] + q),
                                                   W::load(gathered[Dim + c] + q), beside);
          reach.check(c, cells, displacement, particles - q, inside, tight);
        }
      }
      if (settings.regather) {
        for (int q = 0; q < particles; ++q) put_momentum(frame, set, first + q, q, kAffine, momentum);
      }
      advance.add_to(moved);
      moved.gone = moved.gone || !all(inside);
      moved.loose = moved.loose || !all(tight);
    });
    if (settings.regather) momentum.template add_to<Dim>(grid.momentum, block, 0);
    return moved;
  }

  static void project(const GridView& grid, const BlockView& given, const Set* sets, int count, const double* from,
                      double* to) {
    const BlockView block = whole(given);
    PointTile<T, Dim> field;
    field.template load<Dim>(from, block);
    Tile tile;
    tile.clear(block);
    each(grid, block, sets, count, [&](const Set& set, int, Frame& frame, int first, int particles) {
      frame.fill(first, particles);
      for (int q = 0; q < particles; ++q) {
        spread_all(frame, q, mass_at(set, first + q) * gather(frame, field, q), tile);
      }
    });
    tile.template add_to<Dim>(to, block, 0);
  }

  // As the next step will have them: with the deformation of now.
  static bool outgrown(const GridView& grid, const BlockView& block, const Set* sets, int count) {
    for (int s = 0; s < count; ++s) {
      if (absent(sets[s], block)) continue;
      Set set = sets[s];
      for (int c = 0; c < Dim * Dim; ++c) set.domain[c] = set.f[c];
      const int first = static_cast<int>(set.group[set.group_begin[block.owner]]);
      const int end = static_cast<int>(set.group[set.group_begin[block.owner + 1]]);
      if (Frame(grid, block, set).outgrown(first, end - first)) return true;
    }
    return false;
  }
};

/// Of points about an axis, in the place of two axes.
template <template <int> class Points>
constexpr mpm_kernel::PassFamily axisymmetric_passes_of() {
  return {{{}, PointPasses<2, Points, double>::table(), {}}, {{}, PointPasses<2, Points, float>::table(), {}}};
}

/// Of a set of points, for each number of axes and either precision.
template <template <int> class Points>
constexpr mpm_kernel::PassFamily passes_of() {
  return {{PointPasses<1, Points, double>::table(), PointPasses<2, Points, double>::table(),
           PointPasses<3, Points, double>::table()},
          {PointPasses<1, Points, float>::table(), PointPasses<2, Points, float>::table(),
           PointPasses<3, Points, float>::table()}};
}

}  // namespace mpm
