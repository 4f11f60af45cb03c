// The passes of a step over one block, as the table of kernels.hpp wants them, written once for all shape functions:
// over an interpolator (interpolator.hpp). Particles pass through buffers in cache, a chunk at a time.
#pragma once

#include "mpm/kernel/advance.hpp"
#include "mpm/kernel/mean.hpp"
#include "mpm/kernel/nodes.hpp"
#include "mpm/kernel/transfer_passes.hpp"

namespace mpm {

template <class Interpolator>
class Passes {
  using T = typename Interpolator::Number;
  static constexpr int kDim = Interpolator::kDim;
  static constexpr bool kRings = Interpolator::kRings;
  template <int Fields>
  using Source = typename Interpolator::template Source<Fields>;
  using Sink = typename Interpolator::Sink;
  using W = Wide<T>;
  using Set = SetView<T>;
  using Values = ChunkValues<T>;
  using Gradients = mpm_kernel::ChunkGradients<T>;
  using Columns = mpm_kernel::ChunkStresses<T>;
  using Transfers = TransferPasses<Interpolator>;
  using Means = Mean<T, kDim, kRings>;

 public:
  static constexpr mpm_kernel::KernelTable<T> table() {
    bool (*grown)(const GridView&, const BlockView&, const Set*, int) = nullptr;
    if constexpr (Interpolator::kOutgrows) grown = &outgrown;
    return {W::kLanes,
            kByColumn<T>,
            nullptr,
            nullptr,
            {&scatter_momentum<false>, &scatter_momentum<true>},
            &strain,
            &force,
            {&spread_mean<false>, &spread_mean<true>},
            {&move<mpm_kernel::kIncrement>, &move<mpm_kernel::kAdopt>, &move<mpm_kernel::kAffine>},
            &project,
            grown,
            &Transfers::gather,
            &Transfers::gradient,
            &Transfers::slopes,
            &Transfers::slope_lead,
            &Transfers::spread,
            &Transfers::spread_gradient,
            &Transfers::diffuse,
            &nodal_velocity<kDim>,
            &nodal_update<kDim>};
  }

 private:
  template <bool Affine>
  static void scatter_momentum(const GridView& grid, const BlockView& given, const Set* sets, int count) {
    const BlockView block = Interpolator::reach(given);
    Sink tile;
    tile.clear(block);
    Values values;
    each_set<Interpolator>(grid, block, sets, count, [&](Interpolator& in, const Set& set, int) {
      Interpolator::note_domains(set, block.owner);
      in.each_chunk([&](const ParticleChunk& chunk) {
        in.fill(Beside::nothing);
        put_momentum<Affine>(in, set, chunk, values, tile);
      });
    });
    tile.template add_to<kDim>(grid.momentum, block, 0);
    tile.template add_to<1>(grid.mass, block, kDim);
  }

  static mpm_kernel::Failure strain(const GridView& grid, const BlockView& given, const Set* sets, int count,
                                    const mpm_kernel::StrainSettings& settings) {
    const BlockView block = Interpolator::reach(given);
    Source<kDim> velocity;
    velocity.template load<kDim>(grid.velocity, block, 0);
    Source<1> dilatation;
    if (settings.dilatation != nullptr) dilatation.template load<1>(settings.dilatation, block, 0);
    Sink force;
    if (settings.and_force) force.clear(block);
    Gradients gradients;
    Columns stresses;
    mpm_kernel::Failure failure{-1, 0};
    each_set<Interpolator>(grid, block, sets, count, [&](Interpolator& in, const Set& set, int number) {
      in.each_chunk([&](const ParticleChunk& chunk) {
        in.fill(Beside::gradient);
        in.gradient(velocity, gradients);
        if (set.free_slope[0] != nullptr) enhance(set, chunk, settings.dt, gradients);
        if (settings.dilatation != nullptr) {
          alignas(64) T mean[1][kBuffer];
          in.gather(dilatation, mean);
          for (int q = 0; q < chunk.count; q += W::kLanes) Means::set_dilatation(gradients, q, W::load(mean[0] + q));
        }
        const int bad = set.law_kernels->update(set, chunk.first, chunk.count, gradients, settings,
                                                settings.and_force ? &stresses : nullptr);
        if (set.free_strain != nullptr) note_free_strain(set, chunk);
        if (bad < chunk.count && failure.set < 0) failure = {number, chunk.first + bad};
        if (settings.and_force) in.spread_gradient(stresses, force);
      });
    });
    if (settings.and_force) force.template add_to<kDim>(grid.force, block, 0);
    return failure;
  }

  // Gradients of what a free strain e brings: d u_i / d x_j is off by d e / d x_i times the distance to the slope along
  // j, one way along the axis itself and the other way across it.
  [[gnu::noinline]] static void enhance(const Set& set, const ParticleChunk& chunk, double dt, Gradients& gradients) {
    const W per_time(1.0 / dt);
    for (int q = 0; q < chunk.count; q += W::kLanes) {
      const int p = chunk.first + q, lanes = chunk.count - q;
      for (int i = 0; i < kDim; ++i) {
        const W slope = W(W::B::place(set.free_slope[i] + p, lanes, 0.0, 1.0, 0.0)) * per_time;
        for (int j = 0; j < kDim; ++j) {
          const W off = slope * W(W::B::place(set.slope_lead[j] + p, lanes, 0.0, 1.0, 0.0));
          T* rate = gradients.l[i * kDim + j] + q;
          (i == j ? W::load(rate) - off : W::load(rate) + off).store(rate);
        }
      }
    }
  }
  static void note_free_strain(const Set& set, const ParticleChunk& chunk) {
    for (int p = chunk.first; p < chunk.first + chunk.count; ++p) set.strained_free[p] = set.free_strain[p];
    for (int k = 0; k < kDim && set.free_slope[0] != nullptr; ++k) {
      for (int p = chunk.first; p < chunk.first + chunk.count; ++p) set.free_slope[k][p] = 0.0;
    }
  }

  static void force(const GridView& grid, const BlockView& given, const Set* sets, int count, const double* pressure) {
    const BlockView block = Interpolator::reach(given);
    Source<1> means;
    if (pressure != nullptr) means.template load<1>(pressure, block, 0);
    Sink tile;
    tile.clear(block);
    Columns stresses;
    each_set<Interpolator>(grid, block, sets, count, [&](Interpolator& in, const Set& set, int) {
      in.each_chunk([&](const ParticleChunk& chunk) {
        in.fill(Beside::gradient);
        set.law_kernels->columns(set, chunk.first, chunk.count, stresses);
        if (pressure != nullptr) {
          alignas(64) T mean[1][kBuffer];
          in.gather(means, mean);
          for (int q = 0; q < chunk.count; ++q) {
            const T mass = weighs_each<kRings>(set) ? set.masses[chunk.first + q] : static_cast<T>(set.mass);
            Means::set_mean(stresses, q, -mass * mean[0][q]);
          }
        }
        in.spread_gradient(stresses, tile);
      });
    });
    tile.template add_to<kDim>(grid.force, block, 0);
  }

  template <bool OfStress>
  static void spread_mean(const GridView& grid, const BlockView& given, const Set* sets, int count, double* to) {
    const BlockView block = Interpolator::reach(given);
    Source<kDim> velocity;
    if constexpr (!OfStress) velocity.template load<kDim>(grid.velocity, block, 0);
    Sink tile;
    tile.clear(block);
    Values values;
    Gradients gradients;
    Columns stresses;
    each_set<Interpolator>(grid, block, sets, count, [&](Interpolator& in, const Set& set, int) {
      in.each_chunk([&](const ParticleChunk& chunk) {
        in.fill(OfStress ? Beside::nothing : Beside::gradient);
        alignas(64) T mean[kBuffer] = {};
        if constexpr (OfStress) {
          set.law_kernels->columns(set, chunk.first, chunk.count, stresses);
          for (int q = 0; q < chunk.count; ++q) mean[q] = -Means::mean(stresses, q);
        } else {
          in.gradient(velocity, gradients);
          for (int q = 0; q < chunk.count; q += W::kLanes) {
            const W mass = mass_of<kRings>(set, chunk.first + q, chunk.count - q);
            (mass * Means::dilatation(gradients, q)).store(mean + q);
          }
        }
        for (int q = 0; q < chunk.count; q += W::kLanes) {
          values.set(q, W::load(mean + q), W(0.0), W(0.0), W(0.0));
        }
        in.spread(values, tile);
      });
    });
    tile.template add_to<1>(to, block, 0);
  }

  // Two functions, so that the loop of particles that weigh alike has no part of the other, which would change its
  // rounding.
  template <mpm_kernel::Motion Kind>
  static mpm_kernel::Moved move(const GridView& grid, const BlockView& given, const Set* sets, int count,
                                const mpm_kernel::MoveSettings& settings) {
    for (int s = 0; s < count; ++s) {
      if (weighs_each<kRings>(sets[s])) return move_sets<Kind, true>(grid, given, sets, count, settings);
    }
    return move_sets<Kind, kRings>(grid, given, sets, count, settings);
  }

  template <mpm_kernel::Motion Kind, bool Weighed>
  static mpm_kernel::Moved move_sets(const GridView& grid, const BlockView& given, const Set* sets, int count,
                                     const mpm_kernel::MoveSettings& settings_view) {
    constexpr bool kAffine = Kind == mpm_kernel::kAffine;
    constexpr int kFields = Kind == mpm_kernel::kIncrement ? 2 * kDim : kDim;  // velocity, acceleration
    constexpr int kAcceleration = kFields - kDim;                              // the first of it, if it is there
    const BlockView block = Interpolator::reach(given);
    const mpm_kernel::MoveSettings settings = settings_view;
    Source<kFields> motion;
    motion.template load<kDim>(grid.velocity, block, 0);
    if constexpr (kFields > kDim) motion.template load<kDim>(grid.force, block, kDim);
    Sink momentum;
    if (settings.regather) momentum.clear(block);
    Values values;
    alignas(64) T gathered[kFields][kBuffer];
    alignas(64) T at_place[2][kRings ? kBuffer : 1];  // radial velocity and acceleration of rings
    mpm_kernel::Moved moved{false, false, 0, 0};
    each_set<Interpolator>(grid, block, sets, count, [&](Interpolator& in, const Set& set, int) {
      const Reach<T, kDim, Interpolator::kNodes> reach(grid, block, set);
      Advance<T, kDim, Kind, kRings, Weighed> advance(set, settings);
      WideMask<T> inside = reach.everywhere(), tight = inside;
      const auto advance_all = [&](auto counted, auto damped, const ParticleChunk& chunk) {
        WideMask<T> still_inside = inside, still_tight = tight;
        for (int q = 0; q < chunk.count; q += W::kLanes) {
          const int lanes = chunk.count - q;
          for (int c = 0; c < kDim; ++c) {
            const W velocity = W::load(gathered[c] + q);
            const W acceleration = kFields > kDim ? W::load(gathered[kAcceleration + c] + q) : W(0.0);
            W beside(0.0);
            if constexpr (kRings) {
              if (c == 0 && settings.by_point) {
                const W change = kFields > kDim ? W::load(at_place[1] + q) - acceleration : W(0.0);
                beside = advance.to_point(W::load(at_place[0] + q) - velocity, change);
              }
            }
            const W displacement = advance.template particles<decltype(counted)::value, decltype(damped)::value>(
                c, chunk.first + q, lanes, velocity, acceleration, beside);
            reach.check(c, in.cells(c, q), displacement, lanes, still_inside, still_tight);
          }
        }
        inside = still_inside;
        tight = still_tight;
      };
      in.each_chunk([&](const ParticleChunk& chunk) {
        in.fill(kAffine ? Beside::moment : Beside::nothing);
        moved.groups += chunk.groups();
        moved.parts += in.gather(motion, gathered);
        if constexpr (kRings) {
          for (int i = 0; settings.by_point && i < kFields / kDim; ++i)
            in.gather_at_place(motion, i * kDim, at_place[i]);
        }
        if constexpr (kAffine) in.gather_affine(motion);
        if (settings.damped) {
          advance_all(std::true_type(), std::true_type(), chunk);
        } else if (settings.counted) {
          advance_all(std::true_type(), std::false_type(), chunk);
        } else {
          advance_all(std::false_type(), std::false_type(), chunk);
        }
        if (settings.regather) put_momentum<kAffine>(in, set, chunk, values, momentum);
      });
      if (settings.counted || settings.damped) advance.add_to(moved);
      moved.gone = moved.gone || !all(inside);
      moved.loose = moved.loose || !all(tight);
    });
    if (settings.regather) momentum.template add_to<kDim>(grid.momentum, block, 0);
    return moved;
  }

  // m v, and m as the component after them; with APIC's affine field. Weights are there.
  template <bool Affine>
  static void put_momentum(Interpolator& in, const Set& set, const ParticleChunk& chunk, Values& values, Sink& tile) {
    for (int q = 0; q < chunk.count; q += W::kLanes) {
      const int p = chunk.first + q, lanes = chunk.count - q;
      const W mass = mass_of<kRings>(set, p, lanes);
      W momentum[3] = {mass, mass, mass};
      for (int c = 0; c < kDim; ++c) momentum[c] = mass * W::load_first(set.v[c] + p, lanes);
      values.set(q, momentum[0], momentum[1], momentum[2], mass);
    }
    if constexpr (Affine) {
      in.spread_affine(values, tile);
    } else {
      in.spread(values, tile);
    }
  }

  static void project(const GridView& grid, const BlockView& given, const Set* sets, int count, const double* from,
                      double* to) {
    const BlockView block = Interpolator::reach(given);
    Source<kDim> field;
    field.template load<kDim>(from, block, 0);
    Sink tile;
    tile.clear(block);
    Values values;
    alignas(64) T gathered[kDim][kBuffer];
    each_set<Interpolator>(grid, block, sets, count, [&](Interpolator& in, const Set& set, int) {
      in.each_chunk([&](const ParticleChunk& chunk) {
        in.fill(Beside::nothing);
        in.gather(field, gathered);
        for (int q = 0; q < chunk.count; q += W::kLanes) {
          const W mass = mass_of<kRings>(set, chunk.first + q, chunk.count - q);
          W momentum[3] = {W(0.0), W(0.0), W(0.0)};
          for (int c = 0; c < kDim; ++c) momentum[c] = mass * W::load(gathered[c] + q);
          values.set(q, momentum[0], momentum[1], momentum[2], W(0.0));
        }
        in.spread(values, tile);
      });
    });
    tile.template add_to<kDim>(to, block, 0);
  }

  static bool outgrown(const GridView& grid, const BlockView& block, const Set* sets, int count) {
    for (int s = 0; s < count; ++s) {
      if (!absent(sets[s], block) && Interpolator::outgrown(grid, block, sets[s])) return true;
    }
    return false;
  }
};

/// Passes of an interpolator for each number of axes, in either precision.
template <template <class T, int Dim> class Interpolator>
constexpr mpm_kernel::PassFamily passes_of() {
  return {{Passes<Interpolator<double, 1>>::table(), Passes<Interpolator<double, 2>>::table(),
           Passes<Interpolator<double, 3>>::table()},
          {Passes<Interpolator<float, 1>>::table(), Passes<Interpolator<float, 2>>::table(),
           Passes<Interpolator<float, 3>>::table()}};
}

/// Passes of an interpolator that exists for two axes alone.
template <template <class T, int Dim> class Interpolator>
constexpr mpm_kernel::PassFamily planar_passes_of() {
  return {{{}, Passes<Interpolator<double, 2>>::table(), {}}, {{}, Passes<Interpolator<float, 2>>::table(), {}}};
}

}  // namespace mpm
