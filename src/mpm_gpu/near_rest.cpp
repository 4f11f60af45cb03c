#include "mpm_gpu/near_rest.hpp"

#include <algorithm>

namespace mpm_gpu {

template <class T>
NearRest<T>::NearRest(mpm::HostRest& rest, const GridView& grid, double reach)
    : rest_(rest),
      layout_(rest.fields().front()->layout),
      grid_view_(grid),
      copies_(layout_.dim(), false),
      home_(layout_.dim(), reach) {}

template <class T>
void NearRest<T>::begin_step(Executor&, Step<T>&, double, long sorts) {
  sorted_ = sorted_ || sorts != sorts_;
  sorts_ = sorts;
  const std::uint64_t generation = grid().blocks.generation();
  if (generation == generation_) return;
  generation_ = generation;
  take_homes();
  sorted_ = true;
}

template <class T>
void NearRest<T>::take_homes() {
  const mpm::BlockTable& blocks = grid().blocks;
  first_here_.clear();
  home_here_.clear();
  for (const mpm::ParticleSet& set : rest_.sets()) {
    home_here_.resize(std::max<std::size_t>(home_here_.size(), set.first_id + static_cast<std::size_t>(set.size())));
  }
  for (int owner = 0; owner < blocks.owners(); ++owner) {
    const std::array<int, 3>& block = blocks.block(blocks.owner_block(owner));
    for (int k = 0; k < layout_.dim(); ++k) first_here_.push_back(mpm::kBlockEdge * block[k]);
    for (const mpm::ParticleSet& set : rest_.sets()) {
      for (std::uint32_t p = set.begin[owner]; p < set.begin[owner + 1]; ++p)
        home_here_[set.id[p]] = static_cast<std::uint32_t>(owner);
    }
  }
  home_.take(home_here_, first_here_);
}

// A block of the host that no particle of the device is near any more has no mass.
template <class T>
void NearRest<T>::choose(Executor& run, const Step<T>& step) {
  mpm::Grid& near = grid();
  here_.clear();
  there_.clear();
  if (all_) {
    for (int b = 0; b < near.blocks.size(); ++b) here_.push_back(b);
  } else {
    for (const mpm::NodeRef& node : near.at_rest) here_.push_back(node.block);
    std::sort(here_.begin(), here_.end());
    here_.erase(std::unique(here_.begin(), here_.end()), here_.end());
  }
  if (here_.empty()) return;
  copies_.download_keys(run, step.nodes, keys_);
  const auto is_gone = [&](std::int32_t b) {
    const std::uint64_t key = key_of_host_block(grid_view_, layout_.dim(), near.blocks.block(b));
    const std::int32_t there = place_of(keys_.data(), static_cast<long>(keys_.size()), key);
    if (there >= 0) {
      there_.push_back(there);
    } else {
      for (mpm::NodalField* field : {&near.mass, &near.momentum, &near.velocity, &near.force})
        std::fill_n(field->block(b), field->components() * layout_.nodes_per_block(), 0.0);
    }
    return there < 0;
  };
  here_.erase(std::remove_if(here_.begin(), here_.end(), is_gone), here_.end());
  copies_.take_blocks(run, step.nodes, there_, false);
}

template <class T>
void NearRest<T>::get(Executor& run, const Step<T>& step, const double* from, mpm::NodalField& to) {
  const std::size_t of_block = static_cast<std::size_t>(to.components() * layout_.nodes_per_block());
  numbers_.resize(here_.size() * of_block);
  copies_.download(run, step.nodes, from, to.components(), numbers_.data());
  for (std::size_t b = 0; b < here_.size(); ++b)
    std::copy_n(numbers_.data() + b * of_block, of_block, to.block(here_[b]));
}

template <class T>
const double* NearRest<T>::packed(mpm::NodalField& from, std::vector<double>& room) {
  const std::size_t of_block = static_cast<std::size_t>(from.components() * layout_.nodes_per_block());
  room.resize(here_.size() * of_block);
  for (std::size_t b = 0; b < here_.size(); ++b)
    std::copy_n(from.block(here_[b]), of_block, room.data() + b * of_block);
  return room.data();
}

// The device has accelerations of all forces, with gravity. Where walls hold nodes they have changed them, and no force
// is asked for.
template <class T>
void NearRest<T>::find_unrest(Executor& run, const Step<T>& step) {
  mpm::Grid& near = grid();
  if (!here_.empty()) {
    get(run, step, step.nodes.mass, near.mass);
    get(run, step, step.nodes.momentum, near.momentum);
    get(run, step, step.nodes.acceleration, near.force);
  }
  for (const std::int32_t b : here_) {
    for (int n = 0; n < layout_.nodes_per_block(); ++n) {
      const double mass = near.mass.at(b, 0, n);
      for (int k = 0; k < layout_.dim(); ++k)
        near.force.at(b, k, n) = mass * (near.force.at(b, k, n) - grid_view_.gravity[k]);
    }
  }
  rest_.act(mpm::Hook::forces_gathered);
}

template <class T>
void NearRest<T>::act(mpm::Hook hook, Executor& run, const Step<T>& step) {
  mpm::Grid& near = grid();
  const NodeView& nodes = step.nodes;
  const bool any = !here_.empty();
  switch (hook) {
    case mpm::Hook::momentum_gathered: {
      rest_.act(hook);
      const bool all = rest_.needs_all();
      if (sorted_ || all != all_) {
        all_ = all;
        choose(run, step);
      }
      sorted_ = false;
      break;
    }
    case mpm::Hook::before_strain:
      if (!any) break;
      get(run, step, nodes.velocity, near.velocity);
      rest_.act(hook);
      copies_.upload_for_strain(run, step, packed(near.velocity, numbers_));
      break;
    case mpm::Hook::momentum_updated:
      if (!any) {
        rest_.act(hook);  // those that a tool wakes have no border where all is asleep
        break;
      }
      get(run, step, nodes.velocity, near.velocity);
      get(run, step, nodes.acceleration, near.force);
      rest_.act(hook);
      copies_.upload_at_end(run, step, packed(near.velocity, numbers_), packed(near.force, others_));
      break;
    case mpm::Hook::velocity_found:
    case mpm::Hook::increment_found:
      if (!any) break;
      near.increment.resize(near.blocks.size());
      get(run, step, nodes.increment, near.increment);
      rest_.act(hook);
      if (hook == mpm::Hook::velocity_found) {
        copies_.upload_first_increment(run, step, packed(near.increment, numbers_));
      } else {
        copies_.upload_increment(run, step, packed(near.increment, numbers_));
      }
      break;
    case mpm::Hook::grid_advanced:
      if (all_) get(run, step, nodes.acceleration, near.force);
      rest_.act(hook);
      break;
    default:
      break;
  }
}

template <class T>
void NearRest<T>::end_step(Executor& run, const Step<T>& step, double, const Taken&) {
  if (home_.any_left(run, step)) rest_.particle_left();
}

template class NearRest<double>;
template class NearRest<float>;

}  // namespace mpm_gpu
