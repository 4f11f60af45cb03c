#include "mpm/mechanics/kernel_views.hpp"

#include <type_traits>

namespace mpm {

mpm_kernel::GridView view_of(Grid& grid) {
  mpm_kernel::GridView view{};
  for (int k = 0; k < grid.layout.dim(); ++k) {
    view.origin[k] = grid.layout.origin(k);
    view.inverse_cell[k] = grid.layout.inverse_cell(k);
  }
  view.least_mass = grid.least_mass;
  view.mass = grid.mass.data();
  view.momentum = grid.momentum.data();
  view.velocity = grid.velocity.data();
  view.force = grid.force.data();
  return view;
}

template <class T>
mpm_kernel::SetView<T> view_of(ParticleSet& set, const Law& law) {
  mpm_kernel::SetView<T> view{};
  view.group = set.group.data();
  view.group_begin = set.group_begin.data();
  view.mass = set.mass;
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
  std::visit(
      [&](const auto& kind) {
        static_assert(std::decay_t<decltype(kind)>::kHistory <= mpm_kernel::kMostHistory);
        view.law = &kind;
      },
      law);
  view.law_kind = static_cast<int>(law.index());
  return view;
}

template mpm_kernel::SetView<double> view_of<double>(ParticleSet&, const Law&);
template mpm_kernel::SetView<float> view_of<float>(ParticleSet&, const Law&);

}  // namespace mpm
