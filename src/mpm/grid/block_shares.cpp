#include "mpm/grid/block_shares.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <thread>

namespace mpm {
namespace {

/// Work on a block's nodes, over that on a particle; an estimate, which sets how parts are cut and no result.
constexpr std::uint64_t kBlockWork = 24;
// Looks at what another thread has done: in a loop, some tens of microseconds; then for a millisecond while others may
// have this core; and then, since that thread seems to have lost its own, at times.
constexpr int kLooks = 1000, kYields = 2000;
constexpr std::chrono::microseconds kNap{50};

}  // namespace

void BlockShares::cut(int owners, int parts) {
  const auto work_of = [&](int owner) -> std::uint64_t {
    if (particles_.empty()) return 1;
    return particles_[owner] == 0 ? 0 : kBlockWork + particles_[owner];
  };
  std::uint64_t all = 0, work = 0;
  for (int owner = 0; owner < owners; ++owner) all += work_of(owner);
  all = std::max<std::uint64_t>(all, 1);
  begin_.assign(parts + 1, owners);
  part_of_.resize(owners);
  int part = -1;
  for (int owner = 0; owner < owners; ++owner) {
    // An owner is of the part that its middle lies in.
    const std::uint64_t middle = 2 * work + work_of(owner);
    const int wanted = static_cast<int>(std::min<std::uint64_t>(middle * parts / (2 * all), parts - 1));
    while (part < wanted) begin_[++part] = owner;
    part_of_[owner] = part;
    work += work_of(owner);
  }
}

void BlockShares::rebuild(const BlockTable& blocks, const std::vector<std::uint32_t>& particles, int parts) {
  particles_ = particles;
  rebuild(blocks, parts);
}

void BlockShares::rebuild_of(const BlockShares& all, const BlockTable& blocks,
                             const std::vector<std::uint8_t>& marked) {
  particles_.resize(blocks.owners());
  for (int owner = 0; owner < blocks.owners(); ++owner) {
    const std::uint32_t particles = all.particles_.empty() ? 1 : all.particles_[owner];
    particles_[owner] = marked[owner] != 0 ? particles : 0;
  }
  rebuild(blocks, all.parts());
}

void BlockShares::rebuild(const BlockTable& blocks, int parts) {
  cut(blocks.owners(), parts);
  const int owners = blocks.owners(), span = blocks.neighbour_count();
  if (room_ < parts) {
    done_ = std::make_unique<Done[]>(parts);
    room_ = parts;
  }
  owner_of_block_.assign(blocks.size(), -1);
  for (int owner = 0; owner < owners; ++owner) owner_of_block_[blocks.owner_block(owner)] = owner;

  beside_.clear();
  beside_begin_.assign(1, 0);
  at_edge_.assign(owners, 0);
  for (int part = 0; part < parts; ++part) {
    touches_.assign(parts, 0);
    for (int owner = begin_[part]; owner < begin_[part + 1]; ++owner) {
      for (int s = 0; s < span; ++s) {
        const int other = owner_of_block_[blocks.neighbours(owner)[s]];
        if (other < 0 || part_of_[other] == part) continue;
        at_edge_[owner] = touches_[part_of_[other]] = 1;
      }
    }
    for (int other = 0; other < parts; ++other) {
      if (touches_[other] != 0) beside_.push_back(other);
    }
    beside_begin_.push_back(static_cast<int>(beside_.size()));
  }

  colours_ = blocks.colours();
  order_.clear();
  runs_.clear();
  for (int part = 0; part < parts; ++part) {
    for (int colour = 0; colour < colours_; ++colour) {
      const std::vector<int>& of_colour = blocks.owners_of_colour(colour);
      const auto first = std::lower_bound(of_colour.begin(), of_colour.end(), begin_[part]);
      const auto end = std::lower_bound(first, of_colour.end(), begin_[part + 1]);
      for (const bool edge : {true, false}) {
        runs_.push_back(static_cast<int>(order_.size()));
        std::copy_if(first, end, std::back_inserter(order_), [&](int owner) {
          const bool holds_any = particles_.empty() || particles_[owner] > 0;
          return holds_any && (at_edge_[owner] != 0) == edge;
        });
      }
    }
  }
  runs_.push_back(static_cast<int>(order_.size()));
}

void BlockShares::wait_for_others(int part, int colour) const {
  for (int i = beside_begin_[part]; i < beside_begin_[part + 1]; ++i) {
    const std::atomic<int>& other = done_[beside_[i]].colours;
    for (int look = 0; other.load(std::memory_order_acquire) < colour; ++look) {
      if (look < kLooks) {
#if defined(__x86_64__)
        __builtin_ia32_pause();
#endif
      } else if (look < kLooks + kYields) {
        std::this_thread::yield();
      } else {
        std::this_thread::sleep_for(kNap);
      }
    }
  }
}

}  // namespace mpm
