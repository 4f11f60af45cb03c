#include "mpm_gpu/soil_rows.hpp"

#include <algorithm>

namespace mpm_gpu {

template <class T>
void SoilRows<T>::take(const SoilMap<T>& map, const mpm::SoilGrid& grid) {
  const int most = std::max(tools_.bound(), walls_.count());
  tools_here_.assign(tools_.rows(0), tools_.rows(0) + tools_.bound());
  for (auto& row : tools_here_) {
    for (int& node : row.node) node = map.node(node);
  }
  walls_here_.assign(walls_.rows(0), walls_.rows(0) + walls_.count());
  for (auto& row : walls_here_) row.node = map.node(row.node);
  row_.grow(tools_.bound());
  row_.upload(tools_here_);
  wall_.grow(walls_.count());
  wall_.upload(walls_here_);
  impulse_room_.grow(3L * most);
  impulses_.resize(3 * static_cast<std::size_t>(most));
  list_.clear();
  for (int c = 0; c < colours_; ++c) {
    begin_[static_cast<std::size_t>(c)] = static_cast<long>(list_.size() / 4);
    for (const int b : grid.blocks_of_colour(c)) {
      if (tools_.count(b) + walls_.count(b) == 0) continue;
      const auto row = static_cast<std::int32_t>(tools_.rows(b) - tools_.rows(0));
      const auto wall = static_cast<std::int32_t>(walls_.rows(b) - walls_.rows(0));
      list_.insert(list_.end(), {row, row + tools_.count(b), wall, wall + walls_.count(b)});
    }
  }
  begin_[static_cast<std::size_t>(colours_)] = static_cast<long>(list_.size() / 4);
  ranges_.upload(list_);
  tools_.free_nodes(free_here_);
  const auto is_none = [&](int node) { return map.node(node) == map.none(); };
  free_here_.erase(std::remove_if(free_here_.begin(), free_here_.end(), is_none), free_here_.end());
  free_.clear();
  for (const int node : free_here_) free_.push_back(map.node(node));
  free_there_.grow(static_cast<long>(free_.size()));
  free_there_.upload(free_);
  node_room_.grow(static_cast<long>(free_.size()));
  shown_.resize(free_.size());
}

template <class T>
void SoilRows<T>::meet(Executor& run, const SoilView<T>& soil) {
  for (std::size_t c = 0; c < static_cast<std::size_t>(colours_); ++c)
    passes_.meet(run, soil, view(begin_[c]), begin_[c + 1] - begin_[c]);
  if (tools_.bound() == 0) return;
  download(run, tools_.bound(), 0);
  const T* from = impulses_.data();
  for (int i = 0; i < tools_.bound(); ++i, from += 3) std::copy_n(from, 3, tools_.rows(0)[i].impulse);
}

template <class T>
void SoilRows<T>::go_on(Executor& run, T factor) {
  passes_.go_on_in_rows(run, view(), tools_.bound(), walls_.count(), factor);
}

template <class T>
void SoilRows<T>::end_sweeps(Executor& run) {
  if (walls_.count() == 0) return;
  download(run, 0, walls_.count());
  const T* from = impulses_.data();
  for (int i = 0; i < walls_.count(); ++i, from += 3) std::copy_n(from, 3, walls_.rows(0)[i].impulse);
}

template <class T>
void SoilRows<T>::download(Executor& run, long tools, long walls) {
  passes_.impulses(run, view(), tools, walls, impulse_room_.data());
  impulse_room_.download(impulses_.data(), 3 * (tools + walls));
}

template <class T>
void SoilRows<T>::show(Executor& run, const SoilView<T>& soil, std::vector<Node>& nodes) {
  const long count = static_cast<long>(free_.size());
  if (count == 0) return;
  passes_.pack(run, soil, free_there_.data(), count, node_room_.data());
  node_room_.download(shown_.data(), count);
  for (std::size_t i = 0; i < free_.size(); ++i) nodes[static_cast<std::size_t>(free_here_[i])] = shown_[i];
}

template <class T>
void SoilRows<T>::take_back(Executor& run, const SoilView<T>& soil, const std::vector<Node>& nodes) {
  const long count = static_cast<long>(free_.size());
  if (count == 0) return;
  for (std::size_t i = 0; i < free_.size(); ++i) shown_[i] = nodes[static_cast<std::size_t>(free_here_[i])];
  node_room_.upload(shown_.data(), count);
  passes_.unpack(run, soil, free_there_.data(), count, node_room_.data());
}

template <class T>
std::size_t SoilRows<T>::bytes() const {
  return row_.bytes() + wall_.bytes() + ranges_.bytes() + free_there_.bytes() + impulse_room_.bytes() +
         node_room_.bytes();
}

template class SoilRows<double>;
template class SoilRows<float>;

}  // namespace mpm_gpu
