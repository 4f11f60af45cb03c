#include "mpm/ranks/own_part.hpp"

#include <algorithm>

namespace mpm {

OwnPart::OwnPart(const Communicator& ranks, const GridLayout& layout)
    : rank_(ranks.rank()), layout_(layout), territory_(layout_, ranks.size()) {}

// As HandOver finds it, so that nothing is handed over before it has moved.
std::uint64_t OwnPart::block_of(const Vec3& place) const {
  std::array<int, 3> block{};
  for (int k = 0; k < layout_.dim(); ++k) {
    block[k] = GridLayout::nearest(layout_.in_cells(k, place[layout_.axis(k)])) / kBlockEdge;
  }
  return layout_.key(block);
}

void OwnPart::count(const Vec3& place) {
  Body& body = bodies_.back();
  ++body.particles[block_of(place)];
  ++body.whole;
}

void OwnPart::divide() {
  std::unordered_map<std::uint64_t, std::uint64_t> all;
  for (const Body& body : bodies_) {
    for (const auto& [key, particles] : body.particles) all[key] += particles;
  }
  Territory::Load load(all.begin(), all.end());
  std::sort(load.begin(), load.end());
  territory_.cut(load, [](double*, int) {});
}

bool OwnPart::keeps(const Vec3& place) {
  const std::uint64_t key = block_of(place);
  if (key != last_) {
    last_ = key;
    last_kept_ = territory_.owner(key) == rank_;
  }
  return last_kept_;
}

std::size_t OwnPart::own(std::size_t body) const {
  std::size_t sum = 0;
  for (const auto& [key, particles] : bodies_[body].particles) {
    if (territory_.owner(key) == rank_) sum += particles;
  }
  return sum;
}

}  // namespace mpm
