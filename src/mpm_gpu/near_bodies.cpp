#include "mpm_gpu/near_bodies.hpp"

#include <algorithm>
#include <cmath>

namespace mpm_gpu {
namespace {

constexpr double kReachOfShapes = 2.0;  ///< cells from its nearest node in which any shape function has a node

}  // namespace

template <class T>
NearBodies<T>::NearBodies(mpm::HostContact& contact, const GridView& grid)
    : contact_(contact),
      layout_(contact.fields().front()->layout),
      grid_view_(grid),
      rubs_(std::find(grid.faces, grid.faces + 2 * layout_.dim(), Face::frictional) != grid.faces + 2 * layout_.dim()),
      copies_(layout_.dim(), true) {
  // A block's particles are within half a cell of its nodes, and their nodes as far again as shape functions reach.
  const double half = 0.5 * (kEdge - 1) + 0.5 + kReachOfShapes;
  double squared = 0.0;
  for (int k = 0; k < layout_.dim(); ++k) squared += half * half * layout_.cell(k) * layout_.cell(k);
  radius_ = std::sqrt(squared);
}

template <class T>
void NearBodies<T>::choose() {
  found_.clear();
  for (std::size_t b = 0; b < keys_.size(); ++b) {
    const std::array<int, 3> block = host_block(grid_view_, layout_.dim(), keys_[b]);
    const mpm::Vec3 first = layout_.node_position(block, 0),
                    last = layout_.node_position(block, layout_.nodes_per_block() - 1);
    if (contact_.near(0.5 * (first + last), radius_)) found_.push_back(static_cast<std::int32_t>(b));
  }
}

template <class T>
void NearBodies<T>::begin_step(Executor& run, Step<T>& step, double, long sorts) {
  const bool sorted = sorts != sorts_;
  if (sorted) copies_.download_keys(run, step.nodes, keys_);
  choose();
  if (sorted || found_ != chosen_ || generation_ != grid().blocks.generation()) {
    chosen_.swap(found_);
    take(run, step);
  }
  sorts_ = sorts;
  if (rubs_) step.nodes.near = copies_.marks();
}

template <class T>
std::vector<std::uint64_t> NearBodies<T>::fill_groups(int sets, std::vector<std::uint32_t>& particles,
                                                      std::vector<std::uint32_t>& of_block) {
  const std::size_t per_block = static_cast<std::size_t>(layout_.nodes_per_block());
  const std::size_t of_set = chosen_.size() * per_block, ends = of_set * static_cast<std::size_t>(sets);
  of_block.assign(chosen_.size(), 0);
  for (std::size_t row = 0; row < ends; ++row) of_block[row % of_set / per_block] += ranges_[ends + row] - ranges_[row];
  particles.clear();
  for (int s = 0; s < sets; ++s) {
    mpm::ParticleSet& set = contact_.sets()[static_cast<std::size_t>(s)];
    const std::size_t first = particles.size();
    set.begin.clear();
    set.group.clear();
    set.group_begin.clear();
    const auto begin_block = [&] {
      set.begin.push_back(static_cast<std::uint32_t>(particles.size() - first));
      set.group_begin.push_back(static_cast<std::uint32_t>(set.group.size()));
    };
    for (std::size_t b = 0; b < chosen_.size(); ++b) {
      if (of_block[b] == 0) continue;
      begin_block();
      const std::size_t from = static_cast<std::size_t>(s) * of_set + b * per_block;
      for (std::size_t row = from; row < from + per_block; ++row) {
        if (ranges_[row] == ranges_[ends + row]) continue;
        set.group.push_back(static_cast<std::uint32_t>(particles.size() - first));
        for (std::uint32_t p = ranges_[row]; p < ranges_[ends + row]; ++p) particles.push_back(p);
      }
    }
    begin_block();
    set.group.push_back(set.begin.back());
  }
  std::vector<std::uint64_t> owners;
  for (std::size_t b = 0; b < chosen_.size(); ++b) {
    if (of_block[b] > 0)
      owners.push_back(layout_.key(host_block(grid_view_, layout_.dim(), keys_[static_cast<std::size_t>(chosen_[b])])));
  }
  of_block.erase(std::remove(of_block.begin(), of_block.end(), 0U), of_block.end());
  return owners;
}

template <class T>
void NearBodies<T>::take(Executor& run, const Step<T>& step) {
  copies_.download_ranges(run, step, chosen_, ranges_);
  const std::vector<std::uint64_t> owners = fill_groups(step.set_count, particles_, of_block_);
  grid().rebuild(owners, 1, of_block_);
  grid().first_owner = 0;
  generation_ = grid().blocks.generation();
  blocks_.clear();
  for (int b = 0; b < grid().blocks.size(); ++b) {
    const std::uint64_t key = key_of_host_block(grid_view_, layout_.dim(), grid().blocks.block(b));
    blocks_.push_back(place_of(keys_.data(), static_cast<long>(keys_.size()), key));
  }
  copies_.take_blocks(run, step.nodes, blocks_, rubs_);
  copies_.take_particles(run, step, particles_, ids_, numbers_);
  auto id = ids_.begin();
  const double* surface = numbers_.data();
  for (mpm::ParticleSet& set : contact_.sets()) {
    const std::size_t count = set.begin.back(), room = 2 * count;
    set.id.resize(count, room);
    std::copy_n(id, count, set.id.begin());
    id += static_cast<std::ptrdiff_t>(count);
    const auto fit = [&](auto& values) { values.resize(count, room); };
    for (mpm::ParticleScalar& scalar : set.surface) {
      scalar.visit(fit);
      for (std::size_t p = 0; p < count; ++p) scalar.set(p, surface[p]);
    }
    surface += count;
    for (auto& scalar : set.x) fit(scalar);
    for (auto* scalars : {&set.v, &set.f}) {
      for (mpm::ParticleScalar& scalar : *scalars) scalar.visit(fit);
    }
  }
}

template <class T>
void NearBodies<T>::download_particles(Executor& run, const Step<T>& step) {
  std::vector<mpm::ParticleSet>& sets = contact_.sets();
  copies_.download_particles(run, step, static_cast<int>(sets.front().f.size()), numbers_);
  const std::size_t all = particles_.size();
  std::size_t first = 0;
  for (mpm::ParticleSet& set : sets) {
    const double* from = numbers_.data() + first;
    const auto copy = [&](auto& values) {
      using Number = typename std::decay_t<decltype(values)>::value_type;
      for (std::size_t p = 0; p < values.size(); ++p) values[p] = static_cast<Number>(from[p]);
      from += all;
    };
    for (auto& scalar : set.x) copy(scalar);
    for (auto* scalars : {&set.v, &set.f}) {
      for (mpm::ParticleScalar& scalar : *scalars) scalar.visit(copy);
    }
    first += set.id.size();
  }
}

// As gathered: those of the device are held by walls by now.
template <class T>
void NearBodies<T>::find_velocities() {
  mpm::Grid& near = grid();
  for (int b = 0; b < near.blocks.size(); ++b) {
    for (int n = 0; n < layout_.nodes_per_block(); ++n) {
      for (int k = 0; k < layout_.dim(); ++k) {
        near.velocity.at(b, k, n) = near.carries(b, n) ? near.momentum.at(b, k, n) / near.mass.at(b, 0, n) : 0.0;
      }
    }
  }
}

template <class T>
void NearBodies<T>::act(mpm::Hook hook, Executor& run, const Step<T>& step) {
  mpm::Grid& near = grid();
  const NodeView& nodes = step.nodes;
  const auto get = [&](const double* from, mpm::NodalField& to) {
    copies_.download(run, nodes, from, to.components(), to.data());
  };
  const auto get_soon = [&](const double* from, mpm::NodalField& to) {
    copies_.download_soon(run, nodes, from, to.components(), to.data());
  };
  switch (hook) {
    case mpm::Hook::momentum_gathered:
      get_soon(nodes.mass, near.mass);
      get_soon(nodes.momentum, near.momentum);
      download_particles(run, step);
      card::finish();  // that has not waited if there are none
      find_velocities();
      contact_.act(hook);
      break;
    case mpm::Hook::before_strain:
      get(nodes.velocity, near.velocity);
      contact_.act(hook);
      copies_.upload_for_strain(run, step, near.velocity.data());
      break;
    case mpm::Hook::momentum_updated:
      get_soon(nodes.velocity, near.velocity);
      get(nodes.acceleration, near.force);
      contact_.act(hook);
      copies_.upload_at_end(run, step, near.velocity.data(), near.force.data());
      break;
    case mpm::Hook::velocity_found:
      near.increment.resize(near.blocks.size());
      get_soon(nodes.velocity, near.velocity);
      get(nodes.increment, near.increment);
      contact_.act(hook);
      copies_.upload_first_increment(run, step, near.increment.data());
      break;
    case mpm::Hook::increment_found:
      get(nodes.increment, near.increment);
      contact_.act(hook);
      copies_.upload_increment(run, step, near.increment.data());
      get(nodes.velocity, near.velocity);  // with this increment, for the next one
      break;
    default:
      contact_.act(hook);
  }
}

template class NearBodies<double>;
template class NearBodies<float>;

}  // namespace mpm_gpu
