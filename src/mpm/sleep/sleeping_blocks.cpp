#include "mpm/sleep/sleeping_blocks.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace mpm {

void SleepingBlocks::exchange(ParticleSet& set, std::uint32_t p, std::uint32_t q) {
  set.each_scalar([&](auto& values) { std::swap(values[p], values[q]); });
  std::swap(set.id[p], set.id[q]);
  if (!set.side.empty()) std::swap(set.side[p], set.side[q]);
  for (const std::uint32_t place : {p, q}) ++set.rest_changes[place / ParticleSet::kRestGroup];
}

void SleepingBlocks::settle_place(ParticleSet& set, std::uint32_t p) {
  for (std::size_t k = 0; k < set.next_x.size(); ++k) set.next_x[k][p] = set.x[k][p];
}

TakenMotion SleepingBlocks::stop(ParticleSet& set, std::uint32_t p) {
  TakenMotion taken;
  ++set.rest_changes[p / ParticleSet::kRestGroup];
  const double mass = set.mass_of(static_cast<int>(p));
  for (int k = 0; k < layout_.dim(); ++k) taken.momentum[layout_.axis(k)] = mass * set.v[k][p];
  taken.energy = taken.momentum.squaredNorm() / (2.0 * mass);
  for (auto* scalars : {&set.v, &set.affine}) {
    for (ParticleScalar& scalar : *scalars) scalar.set(p, 0.0);
  }
  return taken;
}

void SleepingBlocks::make_room(std::size_t s) {
  owned_.resize(sets_.size());
  owned_[s].resize(sets_[s].id.size());
  sets_[s].rest_changes.resize(sets_[s].id.size() / ParticleSet::kRestGroup + 1);
}

void SleepingBlocks::note(std::size_t s, std::uint32_t p, SleepingBlock* block) {
  std::vector<std::uint32_t>& list = block->particles[s];
  owned_[s][p] = {block, static_cast<std::uint32_t>(list.size())};
  list.push_back(p);
}

// Those to sleep are to be the last ones awake: each that is not change places with one there that stays awake.
void SleepingBlocks::put_set(std::size_t s, const std::vector<Sleeper>& sleepers,
                             const std::vector<SleepingBlock*>& blocks, TakenMotion& taken) {
  ParticleSet& set = sets_[s];
  make_room(s);
  std::uint32_t count = 0;
  for (const Sleeper& sleeper : sleepers) count += set.begin[sleeper.owner + 1] - set.begin[sleeper.owner];
  const auto end = static_cast<std::uint32_t>(set.awake()), border = end - count;
  free_.clear();
  std::uint32_t next = border;
  for (const Sleeper& sleeper : sleepers) {
    const std::uint32_t first = std::max(border, set.begin[sleeper.owner]);
    for (; next < first; ++next) free_.push_back(next);
    next = std::max(next, set.begin[sleeper.owner + 1]);
  }
  for (; next < end; ++next) free_.push_back(next);

  std::size_t used = 0;
  for (std::size_t i = 0; i < sleepers.size(); ++i) {
    for (std::uint32_t p = set.begin[sleepers[i].owner]; p < set.begin[sleepers[i].owner + 1]; ++p) {
      std::uint32_t place = p;
      if (p < border) exchange(set, p, place = free_[used++]);
      const TakenMotion motion = stop(set, place);
      taken.momentum += motion.momentum;
      taken.energy += motion.energy;
      settle_place(set, place);
      note(s, place, blocks[i]);
      blocks[i]->mass += set.mass_of(static_cast<int>(place));
      mass_ += set.mass_of(static_cast<int>(place));
    }
  }
  set.asleep += static_cast<int>(count);
}

TakenMotion SleepingBlocks::put_to_sleep(const std::vector<Sleeper>& sleepers) {
  std::vector<SleepingBlock*> blocks;
  for (const Sleeper& sleeper : sleepers) {
    std::unique_ptr<SleepingBlock>& block = by_name_[sleeper.name];
    if (block == nullptr) {
      block = std::make_unique<SleepingBlock>();
      block->name = sleeper.name;
      block->particles.resize(sets_.size());
    }
    block->rate = std::max(block->rate, sleeper.rate);
    rate_ = std::max(rate_, sleeper.rate);
    for (int t = 0; t < BlockForces::kMostNodes; ++t) {  // material that came to rest where some was asleep adds to it
      block->forces.mass[t] += sleeper.forces->mass[t];
      for (int k = 0; k < layout_.dim(); ++k) block->forces.force[k][t] += sleeper.forces->force[k][t];
    }
    blocks.push_back(block.get());
  }
  TakenMotion taken;
  for (std::size_t s = 0; s < sets_.size(); ++s) put_set(s, sleepers, blocks, taken);
  return taken;
}

// Its particles become the last ones awake: each that does not lie there changes places with one asleep that does.
void SleepingBlocks::wake_set(std::size_t s, SleepingBlock& block) {
  ParticleSet& set = sets_[s];
  std::vector<std::uint32_t>& own = block.particles[s];
  std::sort(own.begin(), own.end());
  const auto begin = static_cast<std::uint32_t>(set.awake()), end = begin + static_cast<std::uint32_t>(own.size());
  std::size_t far = 0;  // the first of its particles that lie beyond
  while (far < own.size() && own[far] < end) ++far;
  const std::size_t near = far;
  for (std::uint32_t place = begin, i = 0; place < end; ++place) {
    if (i < near && own[i] == place) {
      ++i;
      continue;
    }
    const std::uint32_t from = own[far++];
    exchange(set, place, from);
    settle_place(set, from);
    const Owned displaced = owned_[s][place];
    displaced.block->particles[s][displaced.rank] = from;
    owned_[s][from] = displaced;
  }
  set.asleep -= static_cast<int>(own.size());
}

void SleepingBlocks::wake(const BlockName& name) {
  const auto found = by_name_.find(name);
  if (found == by_name_.end()) return;
  for (std::size_t s = 0; s < sets_.size(); ++s) wake_set(s, *found->second);
  mass_ -= found->second->mass;
  by_name_.erase(found);
  if (by_name_.empty()) mass_ = rate_ = 0.0;
}

std::size_t SleepingBlocks::particles() const {
  std::size_t count = 0;
  for (const ParticleSet& set : sets_) count += static_cast<std::size_t>(set.asleep);
  return count;
}

// Whose a particle is is stored by place; lists in order of place are what waking makes of any order.
void SleepingBlocks::serialise(StateArchive& archive) {
  std::vector<SleepingBlock*> blocks;
  for (const auto& one : by_name_) blocks.push_back(one.second.get());
  std::sort(blocks.begin(), blocks.end(), [](const auto* a, const auto* b) { return a->name < b->name; });
  std::vector<std::unique_ptr<SleepingBlock>> read;
  archive.rows("blocks", blocks);
  if (archive.reading()) {
    by_name_.clear();
    for (SleepingBlock*& block : blocks) {
      read.push_back(std::make_unique<SleepingBlock>());
      block = read.back().get();
      block->particles.resize(sets_.size());
    }
  }
  archive.column("blocks/field", blocks, [](SleepingBlock* block) -> int& { return block->name.field; });
  archive.column("blocks/key", blocks, [](SleepingBlock* block) -> std::uint64_t& { return block->name.key; });
  archive.column("blocks/rate", blocks, [](SleepingBlock* block) -> double& { return block->rate; });
  archive.column("blocks/mass", blocks, [](SleepingBlock* block) -> double& { return block->mass; });
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const StateArchive::Group group(archive, "block_" + std::to_string(b));
    std::vector<float> values(blocks[b]->forces.mass.begin(), blocks[b]->forces.mass.end());
    for (const auto& component : blocks[b]->forces.force)
      values.insert(values.end(), component.begin(), component.end());
    archive.list("forces", values);
    const float* from = values.data();
    std::copy_n(from, BlockForces::kMostNodes, blocks[b]->forces.mass.begin());
    for (auto& component : blocks[b]->forces.force) {
      std::copy_n(from += BlockForces::kMostNodes, BlockForces::kMostNodes, component.begin());
    }
  }
  std::map<const SleepingBlock*, std::uint32_t> number;
  for (std::size_t b = 0; b < blocks.size(); ++b) number[blocks[b]] = static_cast<std::uint32_t>(b);
  for (std::size_t s = 0; s < sets_.size(); ++s) {
    const StateArchive::Group group(archive, "set_" + std::to_string(s));
    ParticleSet& set = sets_[s];
    archive.value("asleep", set.asleep);
    std::vector<std::uint32_t> of_block;
    if (!archive.reading()) {
      for (int p = set.awake(); p < set.size(); ++p) of_block.push_back(number.at(owned_[s][p].block));
    }
    archive.list("of_block", of_block);
    if (!archive.reading()) continue;
    make_room(s);
    for (std::uint32_t& changes : set.rest_changes) ++changes;
    for (int p = set.awake(); p < set.size(); ++p) {
      settle_place(set, static_cast<std::uint32_t>(p));
      note(s, static_cast<std::uint32_t>(p), blocks[of_block[p - set.awake()]]);
    }
  }
  for (std::unique_ptr<SleepingBlock>& block : read) {
    const BlockName name = block->name;
    by_name_[name] = std::move(block);
  }
  archive.value("mass", mass_);
  archive.value("rate", rate_);
}

}  // namespace mpm
