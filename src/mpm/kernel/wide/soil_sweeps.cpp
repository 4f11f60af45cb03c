// The sweeps of the implicit step, eight cells at once.
#include "mpm/kernel/soil_relax.hpp"

namespace mpm {

// soil_particles.cpp
template <class T>
mpm_kernel::SoilPasses<T> soil_passes(mpm_kernel::CellKind kind);
// soil_contacts.cpp
template <class T>
void meet_contacts(const mpm_kernel::SoilBlock<T>& block, mpm_kernel::SoilNode<T>* nodes);
template <class T>
void touch_contact(mpm_kernel::ContactRow<T>& row, mpm_kernel::SoilNode<T>* nodes);

namespace {

using mpm_kernel::CellKind;
using mpm_kernel::kGroupCells;
using mpm_kernel::SoilBlock;
using mpm_kernel::SoilGroup;
using mpm_kernel::SoilNode;

template <class T, CellKind Kind>
void push(const SoilBlock<T>& block, SoilNode<T>* nodes) {
  for (int i = 0; i < block.group_count; ++i) {
    const SoilGroup<T>& group = block.groups[i];
    soil::GroupNodes<T, Kind> corners(group, nodes);
    soil::Register<T> r[6];
    for (int k = 0; k < 6; ++k) r[k] = soil::load(group.stress[k]);
    soil::spread(group, block.masks, r, corners);
    for (int e = 0; e < corners.kCount; ++e) soil::store(nodes, group.node[e], corners.of[e]);
  }
}

template <class T, CellKind Kind>
mpm_kernel::SweepChange sweep(const SoilBlock<T>& block, SoilNode<T>* nodes, bool backwards) {
  soil::Register<T> size{}, change{};
  for (int i = 0; i < block.group_count; ++i) {
    SoilGroup<T>& group = block.groups[backwards ? block.group_count - 1 - i : i];
    soil::relax<T, Kind>(group, block.masks, nodes, size, change);
  }
  mpm_kernel::SweepChange sum{0.0, 0.0};
  for (int l = 0; l < kGroupCells; ++l) {
    sum.size += static_cast<double>(size[l]);
    sum.change += static_cast<double>(change[l]);
  }
  return sum;
}

/// `now` goes on by `factor` times its change, and `before` becomes what it was: so many numbers, a multiple of Of.
template <class Of, class T>
inline __attribute__((always_inline)) void go_on(T* now, T* before, int count, T factor) {
  constexpr int kWidth = sizeof(Of) / sizeof(T);
  for (int i = 0; i < count; i += kWidth) {
    Of& value = *reinterpret_cast<Of*>(now + i);
    Of& last = *reinterpret_cast<Of*>(before + i);
    const Of was = value;
    if (factor != T(0)) value += factor * (was - last);
    last = was;
  }
}

template <class T>
void extrapolate(const SoilBlock<T>& block, SoilNode<T>* nodes, SoilNode<T>* before, int count, T factor) {
  for (int i = 0; i < block.group_count; ++i) {
    SoilGroup<T>& group = block.groups[i];
    go_on<soil::Register<T>>(group.stress[0], group.before[0], 6 * kGroupCells, factor);
  }
  // With the inverse masses, which do not change. A block has a multiple of two nodes.
  go_on<soil::Register<T>>(nodes->v, before->v, 4 * count, factor);
  for (int i = 0; i < block.row_count; ++i) go_on<T>(block.rows[i].impulse, block.rows[i].before, 3, factor);
  for (int i = 0; i < block.wall_count; ++i) go_on<T>(block.walls[i].impulse, block.walls[i].before, 3, factor);
}

template <class T, CellKind Kind>
mpm_kernel::SweepTable<T> table() {
  return {&soil::prepare<T, Kind>, &soil::project<T>, &push<T, Kind>,       &sweep<T, Kind>,     &extrapolate<T>,
          &meet_contacts<T>,       &touch_contact<T>, &soil::flow<T, Kind>, soil_passes<T>(Kind)};
}

}  // namespace

const mpm_kernel::SweepFamily& soil_sweeps() {
  static const mpm_kernel::SweepFamily kFamily{
      {table<double, CellKind::space>(), table<double, CellKind::plane>(), table<double, CellKind::rings>()},
      {table<float, CellKind::space>(), table<float, CellKind::plane>(), table<float, CellKind::rings>()}};
  return kFamily;
}

}  // namespace mpm
