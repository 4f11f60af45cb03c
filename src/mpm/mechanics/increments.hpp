// The increments of XPIC and FMPM, on the nodes. Private to this folder.
//
// The velocity v(m) that particles adopt is a sum of increments, the first of them the velocity itself, each the part
// of the one before it that particles and grid, passing it to and fro, lose: dv(j+1) = dv(j) - S+ S dv(j). XPIC begins
// with the velocity of the step's start, FMPM with that of its end, in which conditions hold. Where XPIC is mixed with
// FLIP, particles gain its part of the increments as they gain an acceleration. Source: method reference 6.6;
// Hammerquist & Nairn (2017), Nairn & Hammerquist (2021).
#pragma once

#include <cstddef>
#include <utility>

#include "field_passes.hpp"
#include "mpm/loop/chunk_sums.hpp"
#include "mpm/step/transfer.hpp"

namespace mpm {

/// T is the precision of the particles.
template <class T>
class Increments {
  using Field = FieldAtWork<T>;

 public:
  explicit Increments(int threads) : threads_(threads) {}

  /// Makes room for what a later step needs, so that it does not allocate.
  void make_room(FieldPasses<T>& passes) {
    for (Field& field : passes.fields()) {
      field.grid.increment.resize(field.grid.blocks.size());
      field.taken.resize(field.grid.blocks.owners());
      works_.reserve(field.grid.blocks.size());
    }
  }

  /// Sets Grid::increment to the velocity from which the others are found [m/s].
  void begin(FieldPasses<T>& passes, const Transfer& transfer) {
    const bool from_start = transfer.kind != TransferKind::fmpm;
    part_ = transfer.mixes() ? 1.0 - transfer.flip : 1.0;
    for (Field& field : passes.fields()) {
      Grid& grid = field.grid;
      grid.increment.resize(grid.blocks.size());
      const NodalField& velocity = grid.velocity;
      passes.each_carrying("grid: increments", grid, [&](int b, int n, double inverse_mass) {
        for (int k = 0; k < grid.layout.dim(); ++k) {
          const double start = grid.momentum.at(b, k, n) * inverse_mass;
          grid.increment.at(b, k, n) = from_start ? start : velocity.at(b, k, n);
        }
      });
    }
  }

  /// Sets Grid::increment to the next one. Grid::momentum is lost.
  void find(FieldPasses<T>& passes, const mpm_kernel::KernelTable<T>& kernels) {
    if (auto& patches = passes.patches()) patches->grid.increment.resize(patches->grid.blocks.size());
    passes.take(&Grid::increment);
    passes.spread(
        "particles: increments to the grid", {&Grid::momentum}, [&](Field& field, const mpm_kernel::BlockView& block) {
          Grid& grid = field.grid;
          kernels.project(field.view, block, field.sets(), field.count(), grid.increment.data(), grid.momentum.data());
        });
    const double part = std::exchange(part_, 1.0);  // the next one is found from this part
    for (Field& field : passes.fields()) {
      Grid& grid = field.grid;
      passes.each_carrying("grid: increments", grid, [&](int b, int n, double inverse_mass) {
        for (int k = 0; k < grid.layout.dim(); ++k) {
          double& increment = grid.increment.at(b, k, n);
          increment = part * (increment - grid.momentum.at(b, k, n) * inverse_mass);
        }
      });
    }
  }

  /// Adds it to the velocity; or, as gained in a time of `over` [s], to the acceleration.
  void add(FieldPasses<T>& passes, NodalField Grid::*to, double over = 1.0) {
    for (Field& field : passes.fields()) {
      Grid& grid = field.grid;
      const std::ptrdiff_t count = grid.layout.dim() * grid.layout.nodes_per_block();
      passes.each_node_range("grid: increments", grid, [&](int first, int last) {
        const double* from = grid.increment.block(first);
        double* sum = (grid.*to).block(first);
        for (std::ptrdiff_t i = 0; i < (last - first) * count; ++i) sum[i] += from[i] / over;
      });
    }
  }

  /// Work that the first of them does, before conditions take from it what they hold and count what that gives, on this
  /// rank [J]: at the mean of the particles' velocities before and after the step. Of that mean at the nodes PIC takes
  /// half of the increment, and order 2 gives it back, but for what S+ S smooths of it: 2 % of the account for waves of
  /// 8 cells, 7 % for those of 4, of a part of 0.4.
  double work(const FieldPasses<T>& passes, double dt) {
    double all = 0.0;
    for (const Field& field : passes.fields()) {
      const Grid& grid = field.grid;
      const int nodes = grid.layout.nodes_per_block(), numbers = grid.layout.dim() * nodes;
      all += works_.over("grid: increments", grid.blocks.size(), threads_, [&](std::size_t block, double& work) {
        const int b = static_cast<int>(block);
        if (!grid.counts(b)) return;
        const double *mass = grid.mass.block(b), *increment = grid.increment.block(b);
        const double *velocity = grid.velocity.block(b), *acceleration = grid.force.block(b);
        for (int i = 0; i < numbers; ++i) {
          work += mass[i % nodes] * increment[i] * (velocity[i] - 0.5 * dt * acceleration[i]);
        }
      });
    }
    return all;
  }

 private:
  int threads_;
  double part_ = 1.0;  ///< part of the next increment that particles take over
  ChunkSums<double> works_;
};

}  // namespace mpm
