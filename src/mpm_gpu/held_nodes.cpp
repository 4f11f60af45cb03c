#include "mpm_gpu/held_nodes.hpp"

#include <map>

#include "mpm_gpu/walls.hpp"

namespace mpm_gpu {
namespace {

mpm::Hold of_host(Hold hold) { return hold == kSticks ? mpm::Hold::stick : mpm::Hold::slide; }
Hold of_device(mpm::Hold hold) { return hold == mpm::Hold::stick ? kSticks : kSlides; }

}  // namespace

mpm::HeldNodes held_nodes(const WallHolds& holds, const GridView& grid, const mpm::GridLayout& layout, int face) {
  const WallHolds::OfBlocks all = holds.download();
  const int dim = layout.dim(), per_block = nodes_of_block(dim);
  mpm::HeldNodes held;
  for (std::size_t i = 0; i < all.bits.size(); ++i) {
    const Hold hold = held_now(all.bits[i], face / 2);
    if (hold == kFree) continue;
    int number[3] = {};
    number_of_node(grid, dim, all.keys.data(), static_cast<long>(i), number);
    if (face_at(grid, number, face / 2) != face) continue;
    const std::size_t block = i / static_cast<std::size_t>(per_block), local = i % static_cast<std::size_t>(per_block);
    held.add(mpm::HeldNodes::id(layout.key(host_block(grid, dim, all.keys[block])), static_cast<int>(local)),
             of_host(hold));
  }
  return held;
}

void hold_nodes(WallHolds& holds, const GridView& grid, const mpm::GridLayout& layout, int face,
                const mpm::HeldNodes& nodes) {
  const auto per_block = static_cast<std::size_t>(nodes_of_block(layout.dim()));
  const WallHolds::OfBlocks before = holds.download();
  std::map<std::uint64_t, std::vector<std::uint16_t>> blocks;
  for (std::size_t b = 0; b < before.keys.size(); ++b) {
    const auto first = before.bits.begin() + static_cast<std::ptrdiff_t>(b * per_block);
    blocks[before.keys[b]].assign(first, first + static_cast<std::ptrdiff_t>(per_block));
  }
  nodes.each([&](std::uint64_t id, mpm::Hold hold) {
    const std::uint64_t key = key_of_host_block(grid, layout.dim(), layout.block(mpm::HeldNodes::block_key(id)));
    std::vector<std::uint16_t>& bits = blocks.try_emplace(key, per_block).first->second;
    std::uint16_t& one = bits[static_cast<std::size_t>(mpm::HeldNodes::node(id))];
    one = with_now(one, face / 2, of_device(hold));
  });
  WallHolds::OfBlocks after;
  for (const auto& [key, bits] : blocks) {
    after.keys.push_back(key);
    after.bits.insert(after.bits.end(), bits.begin(), bits.end());
  }
  holds.upload(after);
}

}  // namespace mpm_gpu
