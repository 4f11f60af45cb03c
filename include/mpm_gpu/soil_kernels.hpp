// The kernels of implicit steps: a cell, a node, a particle or a row of contact an index, by the solver's own functions
// of one cell (kernel/soil_relax.hpp), one row (kernel/soil_contact.hpp) and one particle (kernel/soil_exchange.hpp).
// For code of one lane alone. Sums of a cell are those of the particles that are nearest to its nodes, set by set, node
// by node, in their sorted order.
#pragma once

#include "mpm/kernel/soil_cell.hpp"
#include "mpm/kernel/soil_contact.hpp"
#include "mpm/kernel/soil_exchange.hpp"
#include "mpm/kernel/soil_nodes.hpp"
#include "mpm/kernel/soil_relax.hpp"
#include "mpm_gpu/soil_passes.hpp"
#include "mpm_gpu/stencil.hpp"

namespace mpm_gpu {

template <int Dim>
constexpr mpm_kernel::CellKind kKindOf = Dim == 3 ? mpm_kernel::CellKind::space : mpm_kernel::CellKind::plane;
template <int Dim>
constexpr int kMembers = 1 << Dim;  ///< cells of a turn, and turns of a block
template <int Dim>
constexpr int world_axis(int k) {
  return Dim == 3 ? k : 2 * k;
}

/// Number of a cell of a soil, by the block and the place in it of the node at its lower corner.
template <int Dim>
long cell_number(const NodeView& nodes, int soil, long block, int place) {
  return soil * nodes.nodes + block * nodes_of_block(Dim) + place;
}

template <class T, class Geometry>
struct SoilNumbersKernel {
  mpm_kernel::SoilParticles<T> particles;
  SoilView<T> soil;
  std::uint32_t first;

  void operator()(long i) const {
    const int p = static_cast<int>(first + i);
    mpm::Wide<T> numbers[kSoilNumbers];
    mpm::soil::numbers_of<Geometry>(particles, p, 1, numbers);
    for (int n = 0; n < kSoilNumbers; ++n) numbers[n].store(soil.number[n] + p);
  }
};

template <class T, int Dim>
struct SoilLoadKernel {
  StepView<T> step;
  SoilView<T> soil;

  void operator()(long n) const {
    const NodeView& from = step.nodes;
    mpm_kernel::SoilNode<T> node{};
    const double mass = from.mass[n];
    if (mass > step.grid.least_mass) {
      node.inverse_mass = static_cast<T>(1.0 / (mass + soil.lightest));
      for (int k = 0; k < Dim; ++k) {
        const int axis = world_axis<Dim>(k);
        if (soil.holder[3 * n + axis] != kFreeComponent) continue;
        const long at = k * from.nodes + n;
        node.v[axis] = static_cast<T>(
            mpm_kernel::start_of_solve(mass, from.momentum[at] / mass, from.velocity[at], soil.lightest, soil.loads));
      }
    }
    soil.node[n] = node;
  }
};

/// The cuts of a particle's box, whose nearest node is number 0 along each axis.
template <class T, int Dim>
struct SoilBox {
  mpm::soil::Cut<T> along[Dim];

  SoilBox(const StepView<T>& step, const double* half, long p) {
    for (int k = 0; k < Dim; ++k) {
      const double cells = in_cells(step.grid, k, step.particles.x[k][p]), at = cells - nearest_node(cells);
      along[k] = mpm::soil::Cut<T>(at, at - half[k], at + half[k], 1.0 / (2.0 * half[k]));
    }
  }
};

template <class T, class Geometry>
struct SoilCellKernel {
  static constexpr int kDim = Geometry::kDim;
  StepView<T> step;
  SoilView<T> soil;
  mpm_kernel::SoilConstants constants;
  double dt;
  int number;

  void operator()(long i) const {
    constexpr int kPerBlock = nodes_of_block(kDim);
    const long block = i / kPerBlock;
    const int place = static_cast<int>(i % kPerBlock);
    Local<kDim> local{};
    cell_at<kDim>(place / kMembers<kDim>, place % kMembers<kDim>, local.at);
    long corner[kMembers<kDim>];
    for (int e = 0; e < kMembers<kDim>; ++e) {
      Local<kDim> there = local;
      for (int k = 0; k < kDim; ++k) there.at[k] += e >> k & 1;
      corner[e] = number_of<kDim>(step.nodes, block, there);
    }
    const mpm_kernel::SoilSums<T> sums = sums_of(corner);
    const long cell = cell_number<kDim>(step.nodes, number, block, place);
    mpm_kernel::SoilGroup<T, 1>& group = soil.cell[cell];
    group.place[0] = -1;
    if (!(sums.volume > T(0))) return;
    group.place[0] = static_cast<int>(cell);
    mpm_kernel::begin_group(group, constants);
    find_nodes(corner, cell, group);
    mpm_kernel::SoilPlaces<T, 1> places{};
    for (int k = 0; k < kDim; ++k) places.inverse_cell[world_axis<kDim>(k)] = static_cast<T>(step.grid.inverse_cell[k]);
    mpm_kernel::make_cell(sums, constants, dt, false, 0, group, places);
    mpm::soil::prepare<T, kKindOf<kDim>>(group, places, soil.node, group.mask >= 0 ? soil.mask + cell : nullptr);
    mpm::soil::project<T>(group);
  }

 private:
  mpm_kernel::SoilSums<T> sums_of(const long* corner) const {
    mpm_kernel::SoilSums<T> sums{};
    for (int s = 0; s < step.set_count; ++s) {
      if (soil.soil_of_set[s] != number) continue;
      const SetView set = step.sets_there[s];
      for (int e = 0; e < kMembers<kDim>; ++e) {
        if (corner[e] < 0) continue;
        const long row = s * step.nodes.nodes + corner[e];
        for (std::uint32_t p = step.nodes.begin[row]; p < step.nodes.end[row]; ++p) add(sums, set, p, e);
      }
    }
    return sums;
  }
  /// Adds the piece in this cell of a particle that is nearest to corner `e`.
  void add(mpm_kernel::SoilSums<T>& sums, const SetView& set, std::uint32_t p, int e) const {
    const SoilBox<T, kDim> box(step, set.half, p);
    T part[kDim], middle[kDim];
    for (int k = 0; k < kDim; ++k) {
      const int piece = -(e >> k & 1) - box.along[k].cell;
      if (piece < 0 || piece > 1) return;
      part[k] = box.along[k].part[piece];
      middle[k] = box.along[k].middle[piece];
      if (!(part[k] > T(0))) return;
    }
    T numbers[kSoilNumbers];
    for (int n = 0; n < kSoilNumbers; ++n) numbers[n] = soil.number[n][p];
    mpm::soil::add_piece<Geometry>(sums, numbers, part, middle);
  }
  /// The nodes of the cell, and which of their components are held.
  void find_nodes(const long* corner, long cell, mpm_kernel::SoilGroup<T, 1>& group) const {
    for (int e = 0; e < mpm_kernel::kCellNodes; ++e) {
      const long node = e < kMembers<kDim> && corner[e] >= 0 ? corner[e] : step.nodes.nodes;
      group.node[e][0] = static_cast<int>(node);
      if (node == step.nodes.nodes) continue;
      for (int a = 0; a < 3; ++a) {
        if (soil.holder[3 * node + a] != kFreeComponent) group.mask = static_cast<int>(cell);
      }
    }
    if (group.mask < 0) return;
    for (int e = 0; e < mpm_kernel::kCellNodes; ++e) {
      const int node = group.node[e][0];
      for (int a = 0; a < 3; ++a) {
        const bool free = node == step.nodes.nodes || soil.holder[3L * node + a] == kFreeComponent;
        soil.mask[cell].free[a][e][0] = free ? T(1) : T(0);
      }
    }
  }
};

template <class T, int Dim>
struct SoilPushKernel {
  SoilView<T> soil;
  NodeView nodes;
  const std::int32_t* blocks;

  void operator()(long team, int turn, int member) const {
    const int place = turn % kMembers<Dim> * kMembers<Dim> + member;
    const mpm_kernel::SoilGroup<T, 1>& group =
        soil.cell[cell_number<Dim>(nodes, turn / kMembers<Dim>, blocks[team], place)];
    if (group.place[0] < 0) return;
    mpm::soil::GroupNodes<T, kKindOf<Dim>> corners(group, soil.node);
    T stress[6];
    for (int s = 0; s < 6; ++s) stress[s] = group.stress[s][0];
    mpm::soil::spread(group, soil.mask, stress, corners);
    for (int e = 0; e < corners.kCount; ++e) mpm::soil::store(soil.node, group.node[e], corners.of[e]);
  }
};

template <class T, int Dim>
struct SoilSweepKernel {
  SoilView<T> soil;
  NodeView nodes;
  const std::int32_t* blocks;
  const std::uint8_t* marked;
  bool backwards;

  void operator()(long team, int turn, int member) const {
    const long block = blocks[team];
    if (marked[block] == 0) return;
    mpm_kernel::SweepChange& change = soil.change[block * kMembers<Dim> + member];
    if (turn == 0) change = {0.0, 0.0};
    const int turns = soil.soils * kMembers<Dim>, at = backwards ? turns - 1 - turn : turn;
    const int place = at % kMembers<Dim> * kMembers<Dim> + member;
    mpm_kernel::SoilGroup<T, 1>& group = soil.cell[cell_number<Dim>(nodes, at / kMembers<Dim>, block, place)];
    if (group.place[0] < 0) return;
    T size = T(0), moved = T(0);
    mpm::soil::relax<T, kKindOf<Dim>>(group, soil.mask, soil.node, size, moved);
    change.size += static_cast<double>(size);
    change.change += static_cast<double>(moved);
  }
};

template <class T, int Dim>
struct SoilChangesKernel {
  const mpm_kernel::SweepChange* change;
  mpm_kernel::SweepChange* to;

  void operator()(long block) const {
    mpm_kernel::SweepChange sum{0.0, 0.0};
    for (int m = 0; m < kMembers<Dim>; ++m) {
      sum.size += change[block * kMembers<Dim> + m].size;
      sum.change += change[block * kMembers<Dim> + m].change;
    }
    to[block] = sum;
  }
};

/// `now` goes on by `factor` times its change, and `before` becomes what it was.
template <class T>
void go_on_by(T factor, T& now, T& before) {
  const T was = now;
  if (factor != T(0)) now += factor * (was - before);
  before = was;
}

template <class T>
struct SoilGoOnKernel {
  SoilView<T> soil;
  long nodes, cells;
  T factor;

  void operator()(long i) const {
    if (i < nodes) {
      for (int a = 0; a < 3; ++a) go_on_by(factor, soil.node[i].v[a], soil.before[i].v[a]);
    }
    if (i >= cells || soil.cell[i].place[0] < 0) return;
    for (int s = 0; s < 6; ++s) go_on_by(factor, soil.cell[i].stress[s][0], soil.cell[i].before[s][0]);
  }
};

template <class T>
struct RowsGoOnKernel {
  RowsView<T> rows;
  long tools;
  T factor;

  void operator()(long i) const {
    for (int a = 0; a < 3; ++a) {
      if (i < tools) {
        go_on_by(factor, rows.row[i].impulse[a], rows.row[i].before[a]);
      } else {
        go_on_by(factor, rows.wall[i - tools].impulse[a], rows.wall[i - tools].before[a]);
      }
    }
  }
};

template <class T>
struct SoilMeetKernel {
  SoilView<T> soil;
  RowsView<T> rows;

  void operator()(long i) const {
    const std::int32_t* range = rows.range + 4 * i;
    for (std::int32_t w = range[2]; w < range[3]; ++w) mpm::soil::touch_wall(rows.wall[w], soil.node);
    for (int pass = 0; pass < mpm::soil::kContactPasses; ++pass) {
      for (std::int32_t r = range[0]; r < range[1]; ++r) mpm::soil::touch_row(rows.row[r], soil.node);
    }
  }
};

}  // namespace mpm_gpu
