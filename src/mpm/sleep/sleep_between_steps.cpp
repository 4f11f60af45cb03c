// Blocks that fall asleep between two steps: those that have been at rest, when particles are sorted, and those that
// another module lays asleep; and what that module takes away, or keeps asleep.
#include <algorithm>
#include <string>
#include <utility>

#include "mpm/sleep/sleep.hpp"

namespace mpm {

void Sleep::fall_asleep() {
  const double cell = layout_.smallest_cell();
  for (SleepingBlocks::Sleeper& sleeper : sleepers_) {
    const Grid& grid = *parts_.fields[sleeper.name.field];
    sleeper.forces = std::make_unique<BlockForces>();
    parts_.probe->find_forces(sleeper.name.field, sleeper.owner - grid.first_owner, *sleeper.forces);
    for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
      const auto first = static_cast<int>(parts_.sets[s].begin[sleeper.owner]);
      const auto last = static_cast<int>(parts_.sets[s].begin[sleeper.owner + 1]);
      if (last > first) {
        sleeper.rate = std::max(sleeper.rate, parts_.probe->fastest(static_cast<int>(s), first, last, cell));
      }
    }
  }
  if (!sleepers_.empty()) {
    const TakenMotion taken = asleep_.put_to_sleep(sleepers_);
    account_.add(-taken.momentum);
    energy_ += taken.energy;
  }
}

void Sleep::leave_what_stays() {
  if (!stays_ || to_wake_.empty()) return;
  const auto stays = [this](const BlockName& name) { return stays_(name.key); };
  to_wake_.erase(std::remove_if(to_wake_.begin(), to_wake_.end(), stays), to_wake_.end());
  at_once_ = at_once_ && !to_wake_.empty();
}

void Sleep::lay_asleep(const Which& which) {
  sleepers_.clear();
  for (std::size_t f = 0; f < parts_.fields.size(); ++f) {
    const Grid& grid = *parts_.fields[f];
    for (int owner = 0; owner < grid.blocks.owners(); ++owner) {
      const std::uint64_t key = grid.blocks.key(grid.blocks.owner_block(owner));
      if (which(key)) sleepers_.push_back({{static_cast<int>(f), key}, grid.first_owner + owner, 0.0, nullptr});
    }
  }
  fall_asleep();
  sleepers_.clear();
  asleep_.forget_order();
}

void Sleep::take_away(const BlockName& name) {
  asleep_.take_away(name);
  if (none_asleep()) asleep_.forget_rate();
}

}  // namespace mpm
