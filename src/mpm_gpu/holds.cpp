#include "mpm_gpu/holds.hpp"

#include <algorithm>

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
  if (!kept_) return;
  grow(run, hold_, other_, nodes);
  grow(run, key_, other_key_, nodes / per_block_);
}

void WallHolds::carry(Executor& run, const NodeView& now, bool stay) {
  if (!kept_) return;
  const std::uint16_t* from = hold_.data();
  std::uint16_t* to = other_.data();
  const std::uint64_t *old_key = key_.data(), *key = now.key;
  const long old_blocks = blocks_, per_block = per_block_;
  run.for_each("gpu: walls", now.nodes, [=](long node) {
    const long block = place_of(old_key, old_blocks, key[node / per_block]);
    to[node] = block < 0 ? std::uint16_t{0} : from[block * per_block + node % per_block];
  });
  run.replace("gpu: walls", hold_, other_, now.nodes, stay);
  std::uint64_t* kept = key_.data();
  run.for_each("gpu: walls", now.blocks, [=](long i) { kept[i] = key[i]; });
  blocks_ = now.blocks;
}

WallHolds::OfBlocks WallHolds::download() const {
  OfBlocks all;
  all.keys.resize(static_cast<std::size_t>(blocks_));
  key_.download(all.keys.data(), blocks_);
  const auto end = std::lower_bound(all.keys.begin(), all.keys.end(), kNoBlock);
  const std::ptrdiff_t blocks = end - all.keys.begin();
  all.keys.erase(end, all.keys.end());
  all.bits.resize(static_cast<std::size_t>(blocks * per_block_));
  hold_.download(all.bits.data(), blocks * per_block_);
  return all;
}

void WallHolds::upload(const OfBlocks& blocks) {
  if (!kept_) return;
  blocks_ = static_cast<long>(blocks.keys.size());
  for (auto* buffer : {&hold_, &other_}) buffer->fit(blocks_ * per_block_);
  for (auto* buffer : {&key_, &other_key_}) buffer->fit(blocks_);
  key_.upload(blocks.keys);
  hold_.upload(blocks.bits);
}

}  // namespace mpm_gpu
