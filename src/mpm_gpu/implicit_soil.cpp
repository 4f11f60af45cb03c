#include "mpm_gpu/implicit_soil.hpp"

#include <algorithm>
#include <cmath>

namespace mpm_gpu {
namespace {

static_assert(kFreeComponent == mpm::SoilGrid::kFree && kAtRestComponent == mpm::SoilGrid::kAtRest);

constexpr double kMoved = 2.0;  ///< cells beyond the nodes of a block within which its particles are at a step's end

}  // namespace

template <class T>
ImplicitSoil<T>::ImplicitSoil(mpm::ImplicitSolve<T>& solve, const std::vector<mpm::ParticleSet>& sets, double across,
                              mpm::HostRest* rest, Solver<T>& solver)
    : solve_(solve),
      rest_(rest),
      solver_(solver),
      layout_(solve.grid().layout),
      across_(across),
      passes_(soil_passes(layout_.dim(), T())),
      copies_(layout_.dim(), false) {
  const mpm::SoilBodies& bodies = solve.bodies();
  for (const mpm::ImplicitSoil& soil : bodies.soils) constants_.push_back(soil.constants());
  sets_of_.assign(bodies.soils.size(), 0);
  double squared = 0.0;
  for (int k = 0; k < layout_.dim(); ++k) {
    const double half = (0.5 * (kEdge - 1) + kMoved) * layout_.cell(k);
    squared += half * half;
  }
  radius_ = std::sqrt(squared);
  long particles = 0;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const mpm::SoilBodies::Body& body = bodies.list[s];
    sets_of_[static_cast<std::size_t>(body.soil)] |= std::uint64_t{1} << s;
    mpm_kernel::SoilParticles<T> shape{};
    mpm::describe(bodies.soils[static_cast<std::size_t>(body.soil)], shape);
    for (int k = 0; k < layout_.dim(); ++k) {
      shape.half[k] = sets[s].half[k];
      shape.origin[k] = layout_.origin(k);
      shape.inverse_cell[k] = layout_.inverse_cell(k);
    }
    shape.mass = sets[s].mass;
    shapes_.push_back(shape);
    particles += sets[s].size();
  }
  for (Buffer<T>& one : number_) one.fit(particles);
  solve.use(*this);
}

template <class T>
void ImplicitSoil<T>::make_room(Executor&, long nodes) {
  const long cells = nodes * static_cast<long>(constants_.size()), blocks = nodes / nodes_of_block(layout_.dim());
  node_.fit(nodes + 1);
  before_.fit(nodes);
  node_room_.fit(nodes);
  cell_.fit(cells);
  mask_.fit(cells);
  motion_.fit(cells);
  holder_.fit(3 * nodes);
  map_there_.fit(nodes);
  for (Buffer<std::int32_t>* buffer : {&order_}) buffer->fit(blocks);
  ranges_there_.fit(4 * blocks);
  marked_there_.fit(blocks);
  change_.fit(blocks << layout_.dim());
  change_room_.fit(blocks);
  of_held_.fit(Executor::groups_of(cells));
  of_deeds_.fit(Executor::groups_of(nodes));
  taken_ = -1;  // what was there may be lost
}

template <class T>
void ImplicitSoil<T>::begin_step(Executor& run, StepView<T>& step, double start, long sorts) {
  run_ = &run;
  start_ = start;
  step.settings.solved = true;
  step_ = step;
  sorts_ = sorts;
}

template <class T>
void ImplicitSoil<T>::act(mpm::Hook hook, Executor& run, const StepView<T>& step) {
  if (hook != mpm::Hook::momentum_updated) return;
  run_ = &run;
  step_ = step;
  if (sorts_ != taken_) take_blocks();
  solve_.solve_step(start_, step.settings.dt);
}

template <class T>
void ImplicitSoil<T>::take_blocks() {
  const long all = step_.nodes.blocks;
  copies_.download_keys(*run_, step_.nodes, keys_);
  passes_.owners(*run_, step_, marked_there_.data());
  bytes_.resize(static_cast<std::size_t>(all));
  marked_there_.download(bytes_.data(), all);
  const int dim = layout_.dim();
  owners_.clear();
  for (std::size_t b = 0; b < keys_.size(); ++b) {
    if (bytes_[b] != 0) owners_.push_back(layout_.key(host_block(step_.grid, dim, keys_[b])));
  }
  mpm::Grid& grid = solve_.grid();
  grid.rebuild(owners_);
  grid.first_owner = 0;
  blocks_.clear();
  map_.clear();
  const std::int32_t per_block = nodes_of_block(dim);
  for (int b = 0; b < grid.blocks.size(); ++b) {
    const std::uint64_t key = key_of_host_block(step_.grid, dim, grid.blocks.block(b));
    blocks_.push_back(place_of(keys_.data(), all, key));
    for (std::int32_t n = 0; n < per_block; ++n) map_.push_back(blocks_.back() * per_block + n);
  }
  map_there_.upload(map_);
  take_rest();
  taken_ = sorts_;
  none_ = static_cast<std::int32_t>(step_.nodes.nodes);
  fresh_ = true;
}

// Sleep has a grid of its own, of the blocks that the host has sorted particles into.
template <class T>
void ImplicitSoil<T>::take_rest() {
  mpm::Grid& grid = solve_.grid();
  grid.at_rest.clear();
  at_rest_.clear();
  if (rest_ == nullptr) return;
  const mpm::Grid& of = *rest_->fields().front();
  for (const mpm::NodeRef& node : of.at_rest) {
    const int block = grid.blocks.find(of.blocks.key(node.block));
    if (block < 0) continue;
    grid.at_rest.push_back({block, node.node});
    at_rest_.push_back(map_[static_cast<std::size_t>(block * layout_.nodes_per_block() + node.node)]);
  }
  forces_.resize(3 * at_rest_.size());
  at_rest_there_.grow(static_cast<long>(at_rest_.size()));
  at_rest_there_.upload(at_rest_);
  force_room_.grow(static_cast<long>(forces_.size()));
}

template <class T>
void ImplicitSoil<T>::take_grid() {
  const mpm::SoilGrid& grid = solve_.soil_grid();
  bytes_.assign(static_cast<std::size_t>(3 * step_.nodes.nodes), kFreeComponent);
  for (std::size_t n = 0; n < map_.size(); ++n) {
    for (int a = 0; a < 3; ++a) {
      bytes_[3 * static_cast<std::size_t>(map_[n]) + static_cast<std::size_t>(a)] = grid.holder(static_cast<int>(n), a);
    }
  }
  holder_.upload(bytes_);
  list_.clear();
  const int colours = 1 << layout_.dim();
  for (int c = 0; c < colours; ++c) {
    colour_[static_cast<std::size_t>(c)] = static_cast<long>(list_.size());
    for (const int block : grid.blocks_of_colour(c)) list_.push_back(blocks_[static_cast<std::size_t>(block)]);
  }
  colour_[static_cast<std::size_t>(colours)] = static_cast<long>(list_.size());
  order_.upload(list_);
  nodes_.assign(static_cast<std::size_t>(grid.numbers()), Node{});
  const Node none{};
  node_.upload(&none, 1, none_);
  fresh_ = false;
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
  view.holder = holder_.data();
  view.change = change_.data();
  view.lightest = solve_.lightest();
  view.across = across_;
  view.soils = static_cast<int>(constants_.size());
  view.loads = solve_.loads();
  return view;
}

template <class T>
RowsView<T> ImplicitSoil<T>::rows() {
  return {row_.data(), wall_.data(), ranges_there_.data()};
}

template <class T>
mpm_kernel::SoilParticles<T> ImplicitSoil<T>::particles_of(int body) const {
  mpm_kernel::SoilParticles<T> view = shapes_[static_cast<std::size_t>(body)];
  const ParticleView<T>& of = step_.particles;
  const mpm::SoilBodies& bodies = solve_.bodies();
  const mpm::ImplicitSoil& soil =
      bodies.soils[static_cast<std::size_t>(bodies.list[static_cast<std::size_t>(body)].soil)];
  for (int k = 0; k < 3; ++k) view.x[k] = of.x[k];
  for (int i = 0; i < 9; ++i) view.f[i] = of.f[i];
  for (int i = 0; i < 6; ++i) view.tau[i] = of.tau[i];
  view.strain = of.history[soil.strain_at];
  view.opening = soil.opening_at ? of.history[*soil.opening_at] : nullptr;
  view.work = of.history[soil.work_at];
  view.masses = of.mass;
  return view;
}

template <class T>
void ImplicitSoil<T>::begin(double dt) {
  if (fresh_) take_grid();
  const SoilView<T> soil = view();
  passes_.load(*run_, step_, soil);
  for (int s = 0; s < step_.set_count; ++s) passes_.numbers(*run_, step_, step_.sets[s], particles_of(s), soil);
  for (std::size_t s = 0; s < constants_.size(); ++s)
    passes_.cells(*run_, step_, soil, static_cast<int>(s), sets_of_[s], dt, constants_[s]);
  const int colours = 1 << layout_.dim();
  for (std::size_t c = 0; c < static_cast<std::size_t>(colours); ++c) {
    passes_.push(*run_, step_, soil, order_.data() + colour_[c], colour_[c + 1] - colour_[c]);
  }
  download_nodes();
}

template <class T>
void ImplicitSoil<T>::download_nodes() {
  const long count = static_cast<long>(map_.size());
  passes_.pack(*run_, view(), map_there_.data(), count, node_room_.data());
  node_room_.download(nodes_.data(), count);
}

template <class T>
void ImplicitSoil<T>::take_rows() {
  const long count = static_cast<long>(map_.size());
  node_room_.upload(nodes_.data(), count);
  passes_.unpack(*run_, view(), map_there_.data(), count, node_room_.data());
  upload_rows();
  solve_.tools().free_nodes(free_nodes_);
  free_nodes_.erase(
      std::remove_if(free_nodes_.begin(), free_nodes_.end(), [&](int node) { return there(node) == none_; }),
      free_nodes_.end());
  free_.clear();
  for (const int node : free_nodes_) free_.push_back(there(node));
  free_there_.grow(static_cast<long>(free_.size()));
  free_there_.upload(free_);
}

template <class T>
void ImplicitSoil<T>::upload_rows() {
  mpm::ToolRows<T>& tools = solve_.tools();
  mpm::WallRows<T>& walls = solve_.walls();
  const auto count = [](int number) { return static_cast<std::size_t>(number); };
  rows_.assign(tools.rows(0), tools.rows(0) + tools.bound());
  for (auto& row : rows_) {
    for (int& node : row.node) node = there(node);
  }
  walls_.assign(walls.rows(0), walls.rows(0) + walls.count());
  for (auto& row : walls_) row.node = there(row.node);
  row_.grow(tools.bound());
  row_.upload(rows_);
  wall_.grow(walls.count());
  wall_.upload(walls_);
  impulse_room_.grow(3L * std::max(tools.bound(), walls.count()));
  impulses_.resize(3 * std::max(count(tools.bound()), count(walls.count())));
  list_.clear();
  const int colours = 1 << layout_.dim();
  for (int c = 0; c < colours; ++c) {
    touched_[static_cast<std::size_t>(c)] = static_cast<long>(list_.size() / 4);
    for (const int b : solve_.soil_grid().blocks_of_colour(c)) {
      if (tools.count(b) + walls.count(b) == 0) continue;
      const auto row = static_cast<std::int32_t>(tools.rows(b) - tools.rows(0));
      const auto wall = static_cast<std::int32_t>(walls.rows(b) - walls.rows(0));
      list_.insert(list_.end(), {row, row + tools.count(b), wall, wall + walls.count(b)});
    }
  }
  touched_[static_cast<std::size_t>(colours)] = static_cast<long>(list_.size() / 4);
  ranges_there_.upload(list_);
}

template <class T>
void ImplicitSoil<T>::meet() {
  const SoilView<T> soil = view();
  const int colours = 1 << layout_.dim();
  for (std::size_t c = 0; c < static_cast<std::size_t>(colours); ++c) {
    RowsView<T> of_colour = rows();
    of_colour.range += 4 * touched_[c];
    passes_.meet(*run_, soil, of_colour, touched_[c + 1] - touched_[c]);
  }
  mpm::ToolRows<T>& tools = solve_.tools();
  if (tools.bound() == 0) return;
  download_impulses(tools.bound(), 0);
  for (int i = 0; i < tools.bound(); ++i) {
    for (int a = 0; a < 3; ++a) tools.rows(0)[i].impulse[a] = impulses_[static_cast<std::size_t>(3 * i + a)];
  }
}

template <class T>
void ImplicitSoil<T>::download_impulses(long rows, long walls) {
  passes_.impulses(*run_, this->rows(), rows, walls, impulse_room_.data());
  impulse_room_.download(impulses_.data(), 3 * (rows + walls));
}

template <class T>
void ImplicitSoil<T>::show() {
  const long count = static_cast<long>(free_.size());
  if (count == 0) return;
  shown_.resize(free_.size());
  passes_.pack(*run_, view(), free_there_.data(), count, node_room_.data());
  node_room_.download(shown_.data(), count);
  for (std::size_t i = 0; i < free_.size(); ++i) nodes_[static_cast<std::size_t>(free_nodes_[i])] = shown_[i];
}

template <class T>
void ImplicitSoil<T>::take_back() {
  const long count = static_cast<long>(free_.size());
  if (count == 0) return;
  for (std::size_t i = 0; i < free_.size(); ++i) shown_[i] = nodes_[static_cast<std::size_t>(free_nodes_[i])];
  node_room_.upload(shown_.data(), count);
  passes_.unpack(*run_, view(), free_there_.data(), count, node_room_.data());
}

template <class T>
void ImplicitSoil<T>::go_on(T factor) {
  passes_.go_on(*run_, step_, view(), factor);
  passes_.go_on_in_rows(*run_, rows(), solve_.tools().bound(), solve_.walls().count(), factor);
}

template <class T>
void ImplicitSoil<T>::sweep(bool backwards, const std::vector<std::uint8_t>& marked,
                            std::vector<mpm_kernel::SweepChange>& changes) {
  const long all = step_.nodes.blocks;
  marked_.assign(static_cast<std::size_t>(all), 0);
  for (std::size_t b = 0; b < blocks_.size(); ++b) marked_[static_cast<std::size_t>(blocks_[b])] = marked[b];
  marked_there_.upload(marked_);
  const SoilView<T> soil = view();
  const int colours = 1 << layout_.dim();
  for (std::size_t c = 0; c < static_cast<std::size_t>(colours); ++c) {
    passes_.sweep(*run_, step_, soil, order_.data() + colour_[c], colour_[c + 1] - colour_[c], marked_there_.data(),
                  backwards);
  }
  passes_.changes(*run_, soil, all, change_room_.data());
  changes_.resize(static_cast<std::size_t>(all));
  change_room_.download(changes_.data(), all);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (marked[b] != 0) changes[b] = changes_[static_cast<std::size_t>(blocks_[b])];
  }
}

template <class T>
void ImplicitSoil<T>::end_sweeps() {
  download_nodes();
  mpm::WallRows<T>& walls = solve_.walls();
  if (walls.count() == 0) return;
  download_impulses(0, walls.count());
  for (int i = 0; i < walls.count(); ++i) {
    for (int a = 0; a < 3; ++a) walls.rows(0)[i].impulse[a] = impulses_[static_cast<std::size_t>(3 * i + a)];
  }
}

template <class T>
void ImplicitSoil<T>::add_to_held(mpm::HeldImpulses& held) {
  held.add(passes_.held(*run_, step_, view(), of_held_).of);
  const long count = static_cast<long>(at_rest_.size());
  if (count == 0) return;
  passes_.held_at_rest(*run_, step_, view(), at_rest_there_.data(), count, force_room_.data());
  force_room_.download(forces_.data(), 3 * count);
  const std::vector<mpm::NodeRef>& nodes = solve_.grid().at_rest;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const int node = nodes[i].block * layout_.nodes_per_block() + nodes[i].node;
    for (int a = 0; a < 3; ++a) held.add(node, a, mpm::SoilGrid::kAtRest, forces_[3 * i + static_cast<std::size_t>(a)]);
  }
}

template <class T>
void ImplicitSoil<T>::finish(double, mpm::SoilDeeds& deeds) {
  const SoilView<T> soil = view();
  passes_.motion(*run_, step_, soil);
  for (int s = 0; s < step_.set_count; ++s) {
    passes_.take(*run_, step_, step_.sets[s], particles_of(s), soil,
                 solve_.bodies().list[static_cast<std::size_t>(s)].soil);
  }
  const DeedSums sums = passes_.deeds(*run_, step_, soil, of_deeds_);
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t w = 0; w < 6; ++w) deeds.held[w][a] += sums.held.of[w][a];
    deeds.light[static_cast<Eigen::Index>(a)] += sums.light[a];
  }
  deeds.taken += sums.taken;
  passes_.store(*run_, step_, soil);
  store_at_rest();
}

// With what cells, and rows of tools, have given them.
template <class T>
void ImplicitSoil<T>::store_at_rest() {
  const long count = static_cast<long>(at_rest_.size());
  if (count == 0) return;
  const mpm::Grid& grid = solve_.grid();
  std::fill(forces_.begin(), forces_.end(), 0.0);
  for (std::size_t i = 0; i < grid.at_rest.size(); ++i) {
    const mpm::NodeRef& node = grid.at_rest[i];
    for (int k = 0; k < layout_.dim(); ++k)
      forces_[3 * i + static_cast<std::size_t>(layout_.axis(k))] = grid.force.at(node.block, k, node.node);
  }
  force_room_.upload(forces_);
  passes_.store_at_rest(*run_, step_, view(), at_rest_there_.data(), count, force_room_.data());
}

template <class T>
bool ImplicitSoil<T>::put_out() {
  const mpm::ToolRows<T>& tools = solve_.tools();
  const int dim = layout_.dim(), last = layout_.nodes_per_block() - 1;
  list_.clear();
  for (int b = 0; b < solve_.grid().blocks.size(); ++b) {
    const std::array<int, 3>& block = solve_.grid().blocks.block(b);
    const mpm::Vec3 low = layout_.node_position(block, 0), high = layout_.node_position(block, last);
    if (tools.near(0.5 * (low + high), radius_)) list_.push_back(blocks_[static_cast<std::size_t>(b)]);
  }
  if (list_.empty()) return false;
  copies_.download_ranges(*run_, step_, list_, ranges_);
  near_.clear();
  const std::size_t rows = ranges_.size() / 2;
  ends_.clear();
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::uint32_t p = ranges_[row]; p < ranges_[rows + row]; ++p) near_.push_back(p);
    if ((row + 1) % (rows / static_cast<std::size_t>(step_.set_count)) == 0) ends_.push_back(near_.size());
  }
  copies_.take_particles(*run_, step_, near_, ids_, surfaces_);
  copies_.download_particles(*run_, step_, 0, places_);
  const std::size_t count = near_.size();
  bool any = false;
  for (std::size_t s = 0, p = 0; s < ends_.size(); ++s) {
    for (; p < ends_[s]; ++p) {
      double x[3] = {};
      for (std::size_t k = 0; k < static_cast<std::size_t>(dim); ++k) x[k] = places_[k * count + p];
      if (!tools.put_out(*solve_.bodies().list[s].set, x)) continue;
      for (std::size_t k = 0; k < static_cast<std::size_t>(dim); ++k) places_[k * count + p] = x[k];
      any = true;
    }
  }
  if (!any) return false;
  copies_.upload_places(*run_, step_, places_);
  solver_.sort_next();
  return false;
}

template <class T>
std::size_t ImplicitSoil<T>::bytes() const {
  std::size_t sum = node_.bytes() + before_.bytes() + node_room_.bytes() + cell_.bytes() + mask_.bytes() +
                    motion_.bytes() + holder_.bytes() + marked_there_.bytes() + order_.bytes() + map_there_.bytes() +
                    free_there_.bytes() + at_rest_there_.bytes() + force_room_.bytes() + ranges_there_.bytes() +
                    row_.bytes() + wall_.bytes() + impulse_room_.bytes() + change_.bytes() + change_room_.bytes() +
                    of_held_.bytes() + of_deeds_.bytes();
  for (const Buffer<T>& one : number_) sum += one.bytes();
  return sum;
}

template class ImplicitSoil<double>;
template class ImplicitSoil<float>;

}  // namespace mpm_gpu
