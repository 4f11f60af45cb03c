#include "mpm_gpu/holds.hpp"

namespace mpm_gpu {
namespace {

template <class T>
void grow(Executor& run, Buffer<T>& values, Buffer<T>& room, long count) {
  if (values.size() >= count) return;
  room.fit(count);
  const T* from = values.data();
  T* to = room.data();
  run.for_each("gpu: walls", values.size(), [=](long i) { to[i] = from[i]; });
  values.swap(room);
  room.fit(count);
}

}  // namespace

void WallHolds::make_room(Executor& run, long nodes) {
  if (faces_ == 0) return;
  grow(run, hold_, other_, faces_ * nodes);
  grow(run, key_, other_key_, nodes / per_block_);
}

void WallHolds::carry(Executor& run, const NodeView& now) {
  if (faces_ == 0) return;
  const std::uint8_t* from = hold_.data();
  std::uint8_t* to = other_.data();
  const std::uint64_t *old_key = key_.data(), *key = now.key;
  const long old_blocks = blocks_, per_block = per_block_, nodes = now.nodes;
  const int faces = faces_;
  run.for_each("gpu: walls", nodes, [=](long node) {
    const long block = place_of(old_key, old_blocks, key[node / per_block]);
    const long old = block * per_block + node % per_block, old_nodes = old_blocks * per_block;
    for (int face = 0; face < faces; ++face) to[face * nodes + node] = block < 0 ? 0 : from[face * old_nodes + old];
  });
  hold_.swap(other_);
  std::uint64_t* kept = key_.data();
  run.for_each("gpu: walls", now.blocks, [=](long i) { kept[i] = key[i]; });
  blocks_ = now.blocks;
}

}  // namespace mpm_gpu
