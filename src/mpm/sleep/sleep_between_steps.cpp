// Blocks that fall asleep between two steps: those that have been at rest, when particles are sorted, and those that
// another module lays asleep; and what that module takes away, or keeps asleep.
#include <algorithm>
#include <string>
#include <utility>

#include "mpm/sleep/sleep.hpp"

namespace mpm {

void Sleep::body_put(const RigidBody&) {
  for (const auto& [name, block] : asleep_.all()) {
    if (tool_near(layout_.block(name.key), 0.0)) to_wake_.push_back(name);
  }
  if (to_wake_.empty()) return;
  sort_names(to_wake_);
  leave_what_stays();
  at_once_ = !to_wake_.empty();
}

// Does nothing in the sort after another number of ranks has read a checkpoint: nobody sleeps or wakes for it.
void Sleep::before_sort() {
  asleep_.follow_moves();
  if (just_read_) return;
  asleep_.trust_order();
  watch_.forget_rest();
  const bool any = !sleepers_.empty() || !to_wake_.empty();
  bool falls = false;
  if (across_ == nullptr && !any) return;
  const auto leave = [this](auto&& is_out) {
    sleepers_.erase(std::remove_if(sleepers_.begin(), sleepers_.end(), is_out), sleepers_.end());
  };
  // A block that particles have left holds them under the wrong name, and those put around a periodic axis are far off.
  leave([&](const SleepingBlocks::Sleeper& sleeper) {
    const Grid& grid = *parts_.fields[sleeper.name.field];
    return grid.loose[sleeper.owner - grid.first_owner] != 0;
  });
  if (across_) {
    std::vector<BlockName> falling;
    for (const SleepingBlocks::Sleeper& sleeper : sleepers_) falling.push_back(sleeper.name);
    const SleepAcrossRanks::Agreed agreed = across_->agree(any, falling, to_wake_);
    if (!agreed.any) return;
    falls = agreed.falls;
  }
  leave([&](const SleepingBlocks::Sleeper& sleeper) {
    return std::binary_search(to_wake_.begin(), to_wake_.end(), sleeper.name);
  });
  if (!across_) falls = !sleepers_.empty();
  fall_asleep();
  for (const BlockName& name : to_wake_) {
    tell_of_waking(name);
    asleep_.wake(name);
  }
  if (falls || !to_wake_.empty()) asleep_.forget_order();
  if (none_asleep()) asleep_.forget_rate();
  sleepers_.clear();
  to_wake_.clear();
  looks_waited_ = steps_waited_ = 0;
  at_once_ = false;
}

void Sleep::share_memory(Communicator&) {
  asleep_.follow_moves();
  if (just_read_) return;  // done when all has been read
  watch_.hand_over(*parts_.halo);
  across_->meet(borders_);
}

void Sleep::fall_asleep() {
  const double cell = layout_.smallest_cell();
  if (!sleepers_.empty()) parts_.probe->find_means();
  for (SleepingBlocks::Sleeper& sleeper : sleepers_) {
    const Grid& grid = *parts_.fields[sleeper.name.field];
    sleeper.forces = std::make_unique<BlockForces>();
    sleeper.since = now_;
    parts_.probe->find_forces(sleeper.name.field, sleeper.owner - grid.first_owner, *sleeper.forces);
    const RestingBlock block = awake_block(sleeper.name.field, sleeper.owner - grid.first_owner);
    for (RestPartner* partner : parts_.partners) {
      partner->add_forces(block, *sleeper.forces);
      partner->falls_asleep(block);
    }
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

bool Sleep::needs_forces() const {
  const auto has_forces = [](const RestPartner* partner) { return partner->has_forces(); };
  return !sleepers_.empty() && std::any_of(parts_.partners.begin(), parts_.partners.end(), has_forces);
}

void Sleep::find_forces(const StepContext& context) const {
  for (RestPartner* partner : parts_.partners) partner->find_forces(context);
}

RestingBlock Sleep::awake_block(int field, int owner) const {
  const Grid& grid = *parts_.fields[field];
  const int block = grid.blocks.owner_block(owner);
  return {field, grid.blocks.key(block), grid.blocks.block(block), owner, grid.first_owner, nullptr};
}

RestingBlock Sleep::asleep_block(const SleepingBlock& block, const GridLayout& layout) {
  return {block.name.field, block.name.key, layout.block(block.name.key), -1, 0, &block.particles};
}

bool Sleep::is_kept_awake(const RestingBlock& block, const RestTimes& times) const {
  const auto stirs = [&](RestPartner* partner) { return partner->stirs(block, times); };
  return std::any_of(parts_.partners.begin(), parts_.partners.end(), stirs);
}

void Sleep::ask_partners(const StepContext& context, bool after_sort) {
  const auto is_asked = [after_sort](const RestPartner* partner) { return !after_sort || partner->moves_with_sorts(); };
  if (std::none_of(parts_.partners.begin(), parts_.partners.end(), is_asked)) return;
  for (const auto& [name, block] : asleep_.all()) {
    const RestTimes times{block->since, context.start, context.start + ahead_of_looks() * context.dt,
                          definition_.balance};
    const RestingBlock asked = asleep_block(*block, layout_);
    for (RestPartner* partner : parts_.partners) {
      if (!is_asked(partner) || !partner->stirs(asked, times)) continue;
      to_wake_.push_back(name);
      at_once_ = at_once_ || partner->at_once();
      break;
    }
  }
}

void Sleep::tell_of_waking(const BlockName& name) const {
  const SleepingBlock* block = parts_.partners.empty() ? nullptr : asleep_.own(name);
  if (block == nullptr) return;
  for (RestPartner* partner : parts_.partners) partner->wakes(asleep_block(*block, layout_));
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
      if (which(key)) sleepers_.push_back({{static_cast<int>(f), key}, grid.first_owner + owner, 0.0, 0.0, nullptr});
    }
  }
  fall_asleep();
  sleepers_.clear();
  asleep_.forget_order();
}

void Sleep::take_away(const BlockName& name) {
  tell_of_waking(name);
  asleep_.take_away(name);
  if (none_asleep()) asleep_.forget_rate();
}

}  // namespace mpm
