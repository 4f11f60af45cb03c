#include "mpm/mechanics/kernel_views.hpp"

#include <algorithm>
#include <type_traits>

namespace mpm {

mpm_kernel::GridView view_of(Grid& grid) {
  mpm_kernel::GridView view{};
  for (int k = 0; k < grid.layout.dim(); ++k) {
    view.origin[k] = grid.layout.origin(k);
    view.inverse_cell[k] = grid.layout.inverse_cell(k);
    view.low_wall[k] = grid.has_wall[2 * k] ? 0.0 : -mpm_kernel::kNoWall;
    view.high_wall[k] = grid.has_wall[2 * k + 1] ? grid.layout.last_node(k) : mpm_kernel::kNoWall;
  }
  view.least_mass = grid.least_mass;
  view.mass = grid.mass.data();
  view.momentum = grid.momentum.data();
  view.velocity = grid.velocity.data();
  view.force = grid.force.data();
  return view;
}

template <class T>
mpm_kernel::SetView<T> view_of(ParticleSet& set, const mpm_kernel::KernelTable<T>& kernels, int first_owner) {
  mpm_kernel::SetView<T> view{};
  view.group = set.group.data();
  view.group_begin = set.group_begin.data() + first_owner;
  view.mass = set.mass;
  view.weighed = !set.masses.empty();
  view.masses = set.masses.empty() ? nullptr : set.masses[0].template data<T>();
  view.whole_domains = set.whole_domains;
  view.planar_functions = set.planar_functions;
  for (std::size_t k = 0; k < set.x.size(); ++k) {
    view.half[k] = set.half[k];
    view.lowest[k] = set.lowest[k];
    view.highest[k] = set.highest[k];
    view.x[k] = set.x[k].data();
    view.next_x[k] = (set.next_x.empty() ? set.x : set.next_x)[k].data();
    view.v[k] = set.v[k].template data<T>();
  }
  for (std::size_t c = 0; c < set.f.size(); ++c) view.f[c] = set.f[c].template data<T>();
  for (std::size_t c = 0; c < set.tau.size(); ++c) view.tau[c] = set.tau[c].template data<T>();
  for (std::size_t c = 0; c < set.history.size(); ++c) view.history[c] = set.history[c].template data<T>();
  for (std::size_t c = 0; c < set.affine.size(); ++c) view.affine[c] = set.affine[c].template data<T>();
  for (std::size_t c = 0; c < set.domain.size(); ++c) view.domain[c] = set.domain[c].template data<T>();
  if (set.free_strain >= 0) {
    view.free_strain = set.brought[set.free_strain].values.data();
    view.strained_free = set.brought[set.free_strain + 1].values.data();
  }
  for (std::size_t k = 0; k < set.x.size() && set.enhanced_strain >= 0; ++k) {
    view.free_slope[k] = set.brought[set.enhanced_strain + k].values.data();
    view.slope_lead[k] = set.brought[set.enhanced_strain + set.x.size() + k].values.data();
  }
  view.shape = kernels.shape;
  return view;
}

template <class T>
mpm_kernel::SetView<T> view_of(ParticleSet& set, const Law& law, const mpm_kernel::KernelTable<T>& kernels,
                               int first_owner) {
  mpm_kernel::SetView<T> view = view_of(set, kernels, first_owner);
  std::visit(
      [&](const auto& kind) {
        static_assert(std::decay_t<decltype(kind)>::kHistory <= mpm_kernel::kMostHistory);
        view.law = &kind;
      },
      law);
  view.law_kernels = kernels.laws + law.index();
  return view;
}

void find_givers(const Grid& grid, const std::vector<std::uint8_t>& marked, std::vector<std::uint8_t>& owners) {
  const BlockTable& blocks = grid.blocks;
  const int span = neighbours_of(grid.layout.dim());
  owners.resize(blocks.owners());
  for (int o = 0; o < blocks.owners(); ++o) {
    const int* near = blocks.neighbours(o);
    owners[o] = std::any_of(near, near + span, [&](int b) { return marked[b] != 0; });
  }
}

template mpm_kernel::SetView<double> view_of(ParticleSet&, const mpm_kernel::KernelTable<double>&, int);
template mpm_kernel::SetView<float> view_of(ParticleSet&, const mpm_kernel::KernelTable<float>&, int);
template mpm_kernel::SetView<double> view_of(ParticleSet&, const Law&, const mpm_kernel::KernelTable<double>&, int);
template mpm_kernel::SetView<float> view_of(ParticleSet&, const Law&, const mpm_kernel::KernelTable<float>&, int);

}  // namespace mpm
