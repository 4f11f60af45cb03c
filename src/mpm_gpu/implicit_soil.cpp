#include "mpm_gpu/implicit_soil.hpp"

#include <algorithm>

namespace mpm_gpu {

template <class T>
ImplicitSoil<T>::ImplicitSoil(mpm::ImplicitSolve<T>& solve, const std::vector<mpm::ParticleSet>& sets,
                              mpm::HostRest* rest, Solver<T>& solver)
    : solve_(solve),
      rest_(rest),
      solver_(solver),
      dim_(solve.grid().layout.dim()),
      passes_(soil_passes(dim_, T())),
      map_(solve.grid().layout),
      rows_(solve.tools(), solve.walls(), passes_, dim_),
      near_tools_(solve.out_of_tools(), solve.bodies(), solve.grid().layout) {
  const mpm::SoilBodies& bodies = solve.bodies();
  for (const mpm::ImplicitSoil& soil : bodies.soils) constants_.push_back(soil.constants());
  std::vector<std::int32_t> soil_of_set;
  long particles = 0;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    soil_of_set.push_back(bodies.list[s].soil);
    mpm_kernel::SoilParticles<T> shape{};
    mpm::describe(bodies.soils[static_cast<std::size_t>(soil_of_set.back())], shape);
    shape.mass = sets[s].mass;
    shapes_.push_back(shape);
    particles += sets[s].awake();
  }
  for (Buffer<T>& one : number_) one.fit(particles);
  soil_of_set_.fit(static_cast<long>(soil_of_set.size()));
  soil_of_set_.upload(soil_of_set);
  solve.use(this);
}

template <class T>
void ImplicitSoil<T>::make_room(Executor&, long nodes) {
  const long cells = nodes * static_cast<long>(constants_.size()), blocks = nodes / nodes_of_block(dim_);
  map_.make_room(nodes);
  rows_.make_room(nodes, dim_);
  node_.fit(nodes + 1);
  before_.fit(nodes);
  node_room_.fit(nodes);
  cell_.fit(cells);
  mask_.fit(cells);
  motion_.fit(cells);
  marked_there_.fit(blocks);
  change_.fit(blocks << dim_);
  change_room_.fit(blocks);
  of_held_.fit(Executor::groups_of(cells));
  of_deeds_.fit(Executor::groups_of(nodes));
  taken_ = -1;  // the memory may be another
}

template <class T>
void ImplicitSoil<T>::begin_step(Executor&, Step<T>& step, double start, long sorts) {
  start_ = start;
  step.settings.solved = true;
  sorts_ = sorts;
}

// Sleep, which acts before, has found which nodes it holds.
template <class T>
void ImplicitSoil<T>::act(mpm::Hook hook, Executor& run, const Step<T>& step) {
  if (hook != mpm::Hook::momentum_updated) return;
  run_ = &run;
  step_ = step;
  const std::uint64_t rest = rest_ == nullptr ? 0 : rest_->fields().front()->blocks.generation();
  if (sorts_ != taken_ || rest != rest_taken_) {
    map_.take_blocks(run, step, passes_, solve_.grid(), rest_);
    taken_ = sorts_;
    rest_taken_ = rest;
  }
  solve_.solve_step(start_, step.settings.dt);
}

template <class T>
SoilView<T> ImplicitSoil<T>::view() {
  SoilView<T> view{};
  view.node = node_.data();
  view.before = before_.data();
  view.cell = cell_.data();
  view.mask = mask_.data();
  view.motion = motion_.data();
  for (int i = 0; i < kSoilNumbers; ++i) view.number[i] = number_[static_cast<std::size_t>(i)].data();
  view.holder = map_.holders();
  view.change = change_.data();
  view.lightest = solve_.lightest();
  view.soil_of_set = soil_of_set_.data();
  view.soils = static_cast<int>(constants_.size());
  view.loads = solve_.loads();
  return view;
}

template <class T>
mpm_kernel::SoilParticles<T> ImplicitSoil<T>::particles_of(int body) const {
  mpm_kernel::SoilParticles<T> view = shapes_[static_cast<std::size_t>(body)];
  const ParticleView<T>& of = step_.particles;
  const mpm::SoilBodies& bodies = solve_.bodies();
  const auto number = static_cast<std::size_t>(bodies.list[static_cast<std::size_t>(body)].soil);
  const mpm::ImplicitSoil& soil = bodies.soils[number];
  for (int i = 0; i < 9; ++i) view.f[i] = of.f[i];
  for (int i = 0; i < 6; ++i) view.tau[i] = of.tau[i];
  view.strain = of.history[soil.strain_at];
  view.opening = soil.opening_at ? of.history[*soil.opening_at] : nullptr;
  view.work = of.history[soil.work_at];
  view.masses = of.mass;
  return view;
}

template <class T>
void ImplicitSoil<T>::begin(double dt, bool other_blocks) {
  if (other_blocks) {
    map_.take_grid(solve_.soil_grid());
    nodes_.assign(static_cast<std::size_t>(solve_.soil_grid().numbers()), Node{});
    const Node none{};
    node_.upload(&none, 1, map_.none());
    meets_ = solve_.tools().any() || !solve_.soil_grid().frictional().empty();
  }
  const SoilView<T> soil = view();
  passes_.load(*run_, step_, soil);
  for (int s = 0; s < step_.set_count; ++s) passes_.numbers(*run_, step_.sets[s], particles_of(s), soil);
  for (std::size_t s = 0; s < constants_.size(); ++s)
    passes_.cells(*run_, step_, soil, static_cast<int>(s), dt, constants_[s]);
  for (int c = 0; c < 1 << dim_; ++c) passes_.push(*run_, step_, soil, map_.blocks_of(c), map_.count_of(c));
  download_nodes();
}

template <class T>
void ImplicitSoil<T>::download_nodes() {
  if (!meets_) return;
  passes_.pack(*run_, view(), map_.all(), map_.count(), node_room_.data());
  node_room_.download(nodes_.data(), map_.count());
}

template <class T>
void ImplicitSoil<T>::take_rows() {
  if (!meets_) return;
  node_room_.upload(nodes_.data(), map_.count());
  passes_.unpack(*run_, view(), map_.all(), map_.count(), node_room_.data());
  rows_.take(map_, solve_.soil_grid());
}

template <class T>
void ImplicitSoil<T>::meet() {
  rows_.meet(*run_, view());
}

template <class T>
void ImplicitSoil<T>::show() {
  rows_.show(*run_, view(), nodes_);
}

template <class T>
void ImplicitSoil<T>::take_back() {
  rows_.take_back(*run_, view(), nodes_);
}

template <class T>
void ImplicitSoil<T>::go_on(T factor) {
  passes_.go_on(*run_, step_, view(), factor);
  rows_.go_on(*run_, factor);
}

template <class T>
void ImplicitSoil<T>::sweep(bool backwards, const std::vector<std::uint8_t>& marked,
                            std::vector<mpm_kernel::SweepChange>& changes) {
  const long all = step_.nodes.blocks;
  const std::vector<std::int32_t>& blocks = map_.blocks();
  marked_.assign(static_cast<std::size_t>(all), 0);
  for (std::size_t b = 0; b < blocks.size(); ++b) marked_[static_cast<std::size_t>(blocks[b])] = marked[b];
  marked_there_.upload(marked_);
  const SoilView<T> soil = view();
  for (int c = 0; c < 1 << dim_; ++c) {
    passes_.sweep(*run_, step_, soil, map_.blocks_of(c), map_.count_of(c), marked_there_.data(), backwards);
  }
  passes_.changes(*run_, soil, all, change_room_.data());
  changes_.resize(static_cast<std::size_t>(all));
  change_room_.download(changes_.data(), all);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (marked[b] != 0) changes[b] = changes_[static_cast<std::size_t>(blocks[b])];
  }
}

template <class T>
void ImplicitSoil<T>::end_sweeps() {
  download_nodes();
  rows_.end_sweeps(*run_);
}

template <class T>
void ImplicitSoil<T>::add_to_held(mpm::HeldImpulses& held) {
  held.add(passes_.held(*run_, step_, view(), of_held_).of);
  const long count = map_.at_rest();
  if (count == 0) return;
  impulses_.resize(3 * static_cast<std::size_t>(count));
  impulse_room_.grow(3 * count);
  passes_.held_at_rest(*run_, step_, view(), map_.at_rest_there(), count, impulse_room_.data());
  impulse_room_.download(impulses_.data(), 3 * count);
  const double* impulse = impulses_.data();
  for (const mpm::NodeRef& node : solve_.grid().at_rest) {
    const int number = node.block * nodes_of_block(dim_) + node.node;
    for (int a = 0; a < 3; ++a) held.add(number, a, mpm::SoilGrid::kAtRest, *impulse++);
  }
}

template <class T>
void ImplicitSoil<T>::finish(double, mpm::SoilDeeds& deeds) {
  const SoilView<T> soil = view();
  passes_.motion(*run_, step_, soil);
  for (int s = 0; s < step_.set_count; ++s) {
    const int number = solve_.bodies().list[static_cast<std::size_t>(s)].soil;
    passes_.take(*run_, step_, step_.sets[s], particles_of(s), soil, number);
  }
  const DeedSums sums = passes_.deeds(*run_, step_, soil, of_deeds_);
  for (int a = 0; a < 3; ++a) {
    for (std::size_t w = 0; w < 6; ++w) deeds.held[w][static_cast<std::size_t>(a)] += sums.held.of[w][a];
    deeds.light[a] += sums.light[a];
  }
  deeds.taken += sums.taken;
  passes_.store(*run_, step_, soil);
  store_at_rest();
}

// They have what cells, and rows of tools, have given them.
template <class T>
void ImplicitSoil<T>::store_at_rest() {
  const long count = map_.at_rest();
  if (count == 0) return;
  const mpm::Grid& grid = solve_.grid();
  std::fill(impulses_.begin(), impulses_.end(), 0.0);
  double* impulse = impulses_.data();
  for (const mpm::NodeRef& node : grid.at_rest) {
    for (int k = 0; k < dim_; ++k) impulse[grid.layout.axis(k)] = grid.force.at(node.block, k, node.node);
    impulse += 3;
  }
  impulse_room_.upload(impulses_);
  passes_.store_at_rest(*run_, step_, view(), map_.at_rest_there(), count, impulse_room_.data());
}

template <class T>
bool ImplicitSoil<T>::put_out() {
  if (near_tools_.put_out(*run_, step_, map_, solve_.grid())) solver_.sort_next();
  return false;  // the host has nothing to sort
}

template <class T>
std::size_t ImplicitSoil<T>::bytes() const {
  std::size_t sum = map_.bytes() + rows_.bytes() + node_.bytes() + before_.bytes() + node_room_.bytes() +
                    cell_.bytes() + mask_.bytes() + soil_of_set_.bytes() + motion_.bytes() + marked_there_.bytes() +
                    impulse_room_.bytes() + change_.bytes() + change_room_.bytes() + of_held_.bytes() +
                    of_deeds_.bytes();
  for (const Buffer<T>& one : number_) sum += one.bytes();
  return sum;
}

template class ImplicitSoil<double>;
template class ImplicitSoil<float>;

}  // namespace mpm_gpu
