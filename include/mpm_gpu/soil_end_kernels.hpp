// The kernels of the end of an implicit step: what held components take of stresses, what particles take of cells, and
// the velocities that the grid is given; and copies of nodes and rows to the host and back. For code of one lane alone.
#pragma once

#include "mpm_gpu/soil_kernels.hpp"

namespace mpm_gpu {

/// Impulses that the stress of a cell gives to components that walls hold, as a part of the sum over cells.
template <class T, int Dim>
struct HeldOfCell {
  const SoilView<T>* soil;
  long cell;

  friend constexpr HeldSums& operator+=(HeldSums& sums, const HeldOfCell& one) {
    const mpm_kernel::SoilGroup<T, 1>& group = one.soil->cell[one.cell];
    if (group.place[0] < 0 || group.mask < 0) return sums;
    const mpm_kernel::Tension tension = mpm_kernel::tension_in(group, 0);
    for (int e = 0; e < kMembers<Dim>; ++e) {
      double force[3] = {};
      mpm_kernel::pull_on(group, 0, tension, e, force);
      for (int a = 0; a < 3; ++a) {
        if (one.soil->mask[one.cell].free[a][e][0] != T(0)) continue;
        const std::uint8_t holder = one.soil->holder[3L * group.node[e][0] + a];
        if (holder != kAtRestComponent) sums.of[holder][a] -= static_cast<double>(group.push[0]) * force[a];
      }
    }
    return sums;
  }
};

template <class T, int Dim>
struct HeldOfCells {
  SoilView<T> soil;
  HeldOfCell<T, Dim> operator()(long cell) const { return {&soil, cell}; }
};

template <class T, int Dim>
struct HeldAtRestKernel {
  SoilView<T> soil;
  NodeView nodes;
  const std::int32_t* numbers;
  double* to;

  void operator()(long i) const {
    const long node = numbers[i], block = node / nodes_of_block(Dim);
    const Local<Dim> local = local_of<Dim>(node);
    double sum[3] = {};
    for (int e = 0; e < kMembers<Dim>; ++e) {
      Local<Dim> below = local;
      for (int k = 0; k < Dim; ++k) below.at[k] -= e >> k & 1;
      const long lower = number_of<Dim>(nodes, block, below);
      if (lower < 0) continue;
      const int place = place_of_cell<Dim>(local_of<Dim>(lower).at);
      for (int s = 0; s < soil.soils; ++s) {
        const auto& group = soil.cell[cell_number<Dim>(nodes, s, lower / nodes_of_block(Dim), place)];
        if (group.place[0] < 0) continue;
        double force[3] = {};
        mpm_kernel::pull_on(group, 0, mpm_kernel::tension_in(group, 0), e, force);
        for (int a = 0; a < 3; ++a) {
          if (soil.holder[3 * node + a] == kAtRestComponent) sum[a] -= static_cast<double>(group.push[0]) * force[a];
        }
      }
    }
    for (int a = 0; a < 3; ++a) to[3 * i + a] = sum[a];
  }
};

template <class T, int Dim>
struct SoilMotionKernel {
  SoilView<T> soil;

  void operator()(long cell) const {
    const mpm_kernel::SoilGroup<T, 1>& group = soil.cell[cell];
    if (group.place[0] < 0) return;
    mpm_kernel::SoilFlow<T, 1> flow;
    mpm::soil::flow<T, kKindOf<Dim>>(group, soil.node, flow);
    mpm_kernel::find_motion(group, flow, 0, soil.motion[cell]);
  }
};

template <class T, class Geometry>
struct SoilTakeKernel {
  static constexpr int kDim = Geometry::kDim;
  StepView<T> step;
  SoilView<T> soil;
  mpm_kernel::SoilParticles<T> particles;
  SetView set;
  double dt;
  int number;

  void operator()(long i) const {
    const long p = set.first + i, node = step.particles.node[p], block = node / nodes_of_block(kDim);
    const SoilBox<T, kDim> box(step, set.half, p);
    const Local<kDim> local = local_of<kDim>(node);
    T sums[mpm::soil::kMotionNumbers] = {};
    for (int piece = 0; piece < kMembers<kDim>; ++piece) {
      Local<kDim> there = local;
      T part = T(1);
      for (int k = 0; k < kDim; ++k) {
        const int upper = piece >> (kDim - 1 - k) & 1;
        there.at[k] += box.along[k].cell + upper;
        part *= box.along[k].part[upper];
      }
      if (!(part > T(0))) continue;
      const long lower = number_of<kDim>(step.nodes, block, there);
      if (lower < 0) continue;
      const Local<kDim> at = local_of<kDim>(lower);
      const long cell = cell_number<kDim>(step.nodes, number, lower / nodes_of_block(kDim), place_of_cell<kDim>(at.at));
      mpm::soil::add_motion(sums, part, soil.motion[cell]);
    }
    mpm::Wide<T> of[mpm::soil::kMotionNumbers];
    for (int n = 0; n < mpm::soil::kMotionNumbers; ++n) of[n] = mpm::Wide<T>::load(sums + n);
    mpm::soil::take_motion<Geometry>(particles, static_cast<int>(p), 1, of, dt);
  }
};

/// A node after the sweeps, as a part of the sums over nodes.
template <class T, int Dim>
struct SolvedNode {
  const SoilView<T>* soil;
  const StepView<T>* step;
  long n;

  /// visit(grid axis, world axis, holder, solved) for each component, if the node carries material.
  template <class Visit>
  constexpr void each(Visit&& visit) const {
    const NodeView& nodes = step->nodes;
    const double mass = nodes.mass[n];
    if (!(mass > step->grid.least_mass)) return;
    for (int k = 0; k < Dim; ++k) {
      const int axis = world_axis<Dim>(k);
      const std::uint8_t holder = soil->holder[3 * n + axis];
      if (holder == kAtRestComponent) continue;
      const bool held = holder != kFreeComponent;
      const long at = k * nodes.nodes + n;
      const double found = held ? 0.0 : static_cast<double>(soil->node[n].v[axis]);
      visit(k, axis, holder,
            mpm_kernel::end_of_solve(mass, nodes.momentum[at] / mass, nodes.velocity[at], found, held, soil->lightest,
                                     soil->loads, step->settings.dt));
    }
  }
  friend constexpr DeedSums& operator+=(DeedSums& sums, const SolvedNode& one) {
    one.each([&](int, int axis, std::uint8_t holder, const mpm_kernel::SolvedComponent& solved) {
      if (holder != kFreeComponent) {
        sums.held.of[holder][axis] += solved.held;
      } else {
        sums.light[axis] += solved.light;
      }
      sums.taken += solved.taken;
    });
    return sums;
  }
};

template <class T, int Dim>
struct SolvedNodes {
  SoilView<T> soil;
  StepView<T> step;
  SolvedNode<T, Dim> operator()(long n) const { return {&soil, &step, n}; }
};

template <class T, int Dim>
struct SoilStoreKernel {
  SoilView<T> soil;
  StepView<T> step;

  void operator()(long n) const {
    SolvedNode<T, Dim>{&soil, &step, n}.each([&](int k, int, std::uint8_t, const mpm_kernel::SolvedComponent& solved) {
      step.nodes.velocity[k * step.nodes.nodes + n] = solved.velocity;
      step.nodes.acceleration[k * step.nodes.nodes + n] = solved.acceleration;
    });
  }
};

template <class T, int Dim>
struct StoreAtRestKernel {
  SoilView<T> soil;
  StepView<T> step;
  const std::int32_t* numbers;
  const double* impulses;

  void operator()(long i) const {
    const NodeView& nodes = step.nodes;
    const long node = numbers[i];
    const double mass = nodes.mass[node];
    if (!(mass > step.grid.least_mass)) return;
    for (int k = 0; k < Dim; ++k) {
      const int axis = world_axis<Dim>(k);
      if (soil.holder[3 * node + axis] != kAtRestComponent) continue;
      const long at = k * nodes.nodes + node;
      const double velocity = nodes.velocity[at] + impulses[3 * i + axis] / mass;
      nodes.velocity[at] = velocity;
      nodes.acceleration[at] = (velocity - nodes.momentum[at] / mass) / step.settings.dt;
    }
  }
};

template <class T>
struct PackKernel {
  const mpm_kernel::SoilNode<T>* node;
  const std::int32_t* numbers;
  mpm_kernel::SoilNode<T>* to;
  void operator()(long i) const { to[i] = node[numbers[i]]; }
};
template <class T>
struct UnpackKernel {
  mpm_kernel::SoilNode<T>* node;
  const std::int32_t* numbers;
  const mpm_kernel::SoilNode<T>* from;
  void operator()(long i) const { node[numbers[i]] = from[i]; }
};

template <class T>
struct ImpulsesKernel {
  RowsView<T> rows;
  long tools;
  T* to;

  void operator()(long i) const {
    const T* impulse = i < tools ? rows.row[i].impulse : rows.wall[i - tools].impulse;
    for (int a = 0; a < 3; ++a) to[3 * i + a] = impulse[a];
  }
};

template <class T>
struct OwnersKernel {
  StepView<T> step;
  int per_block;
  std::uint8_t* to;

  void operator()(long block) const {
    std::uint8_t holds = 0;
    for (int s = 0; s < step.set_count; ++s) {
      for (long row = s * step.nodes.nodes + block * per_block, end = row + per_block; row < end; ++row) {
        if (step.nodes.begin[row] < step.nodes.end[row]) holds = 1;
      }
    }
    to[block] = holds;
  }
};

}  // namespace mpm_gpu
