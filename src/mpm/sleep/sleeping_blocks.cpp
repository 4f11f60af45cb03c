#include "mpm/sleep/sleeping_blocks.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <string>
#include <utility>

#include "mpm/particles/append.hpp"

namespace mpm {
namespace {

constexpr std::uint64_t kAwake = ~std::uint64_t{0};  ///< in place of the key of the block that a particle sleeps in

}  // namespace

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
  first_.resize(sets_.size());
  owned_[s].resize(sets_[s].id.size());
  std::vector<std::uint32_t>& changes = sets_[s].rest_changes;  // those beyond the end are kept: counts go on
  changes.resize(std::max(changes.size(), sets_[s].id.size() / ParticleSet::kRestGroup + 1));
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
  first_[s] = set.awake();
}

SleepingBlock& SleepingBlocks::block(const BlockName& name) {
  std::unique_ptr<SleepingBlock>& block = by_name_[name];
  if (block == nullptr) {
    block = std::make_unique<SleepingBlock>();
    block->name = name;
    block->particles.resize(sets_.size());
  }
  return *block;
}

TakenMotion SleepingBlocks::put_to_sleep(const std::vector<Sleeper>& sleepers) {
  std::vector<SleepingBlock*> blocks;
  for (const Sleeper& sleeper : sleepers) {
    SleepingBlock& block = this->block(sleeper.name);
    if (block.mass == 0.0) block.since = sleeper.since;
    block.rate = std::max(block.rate, sleeper.rate);
    rate_ = std::max(rate_, sleeper.rate);
    block.forces.add(*sleeper.forces);  // material that came to rest where some was asleep adds to it
    blocks.push_back(&block);
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
    displaced.block->particles[s][displaced.index] = from;
    owned_[s][from] = displaced;
  }
  set.asleep -= static_cast<int>(own.size());
  first_[s] = set.awake();
}

void SleepingBlocks::wake(const BlockName& name) {
  const auto found = by_name_.find(name);
  if (found == by_name_.end()) return;
  for (std::size_t s = 0; s < sets_.size(); ++s) wake_set(s, *found->second);
  mass_ -= found->second->mass;
  by_name_.erase(found);
  if (by_name_.empty()) mass_ = 0.0;
}

// Each goes by the last one of the set, which takes its place.
void SleepingBlocks::take_out_of_set(std::size_t s, SleepingBlock& block) {
  ParticleSet& set = sets_[s];
  std::vector<std::uint32_t>& own = block.particles[s];
  std::sort(own.begin(), own.end());
  std::size_t last = set.id.size();
  for (auto place = own.rbegin(); place != own.rend(); ++place) {
    --last;
    for (const std::size_t changed : {static_cast<std::size_t>(*place), last})
      ++set.rest_changes[changed / ParticleSet::kRestGroup];
    if (*place == last) continue;
    copy_particle(set, last, *place);
    const Owned moved = owned_[s][last];
    moved.block->particles[s][moved.index] = *place;
    owned_[s][*place] = moved;
  }
  set.asleep -= static_cast<int>(own.size());
  cut_off(set, last);
  owned_[s].resize(last);
}

void SleepingBlocks::take_away(const BlockName& name) {
  const auto found = by_name_.find(name);
  if (found == by_name_.end()) return;
  for (std::size_t s = 0; s < sets_.size(); ++s) take_out_of_set(s, *found->second);
  mass_ -= found->second->mass;
  by_name_.erase(found);
  if (by_name_.empty()) mass_ = 0.0;
}

void SleepingBlocks::forget_order() {
  for (ParticleSet& set : sets_) {
    set.begin.clear();
    set.sorts_by_id = true;
  }
}

void SleepingBlocks::trust_order() {
  for (ParticleSet& set : sets_) set.sorts_by_id = false;
}

void SleepingBlocks::follow_moves() {
  for (std::size_t s = 0; s < first_.size(); ++s) follow_moves(s);
}

// Follows the moves that mpm::permute() makes (particles/permute.hpp).
void SleepingBlocks::follow_moves(std::size_t s) {
  ParticleSet& set = sets_[s];
  const int before = std::exchange(first_[s], set.awake()), first = set.awake();
  if (first == before || set.asleep == 0) return;
  const int moved = std::min(std::abs(first - before), set.asleep);
  const bool to_end = first > before;
  const int from = to_end ? before : before + set.asleep - moved, to = to_end ? first + set.asleep - moved : first;
  const std::vector<Owned> owned(owned_[s].begin() + from, owned_[s].begin() + from + moved);
  make_room(s);
  for (int i = 0; i < moved; ++i) {
    const auto place = static_cast<std::uint32_t>(to + i);
    owned_[s][place] = owned[i];
    owned[i].block->particles[s][owned[i].index] = place;
  }
  ++set.rest_changes[set.size() / ParticleSet::kRestGroup];  // the last group, which may have lost some
}

std::size_t SleepingBlocks::particles() const {
  std::size_t count = 0;
  for (const ParticleSet& set : sets_) count += static_cast<std::size_t>(set.asleep);
  return count;
}

// Stores the owner of each particle by its place: waking brings lists of any order into that of places. If another
// number of ranks reads them, the particles and what a block gives to the grid are shared out; a block then sleeps on
// several ranks.
void SleepingBlocks::serialise(StateArchive& archive) {
  serialise_blocks(archive);
  for (std::size_t s = 0; s < sets_.size(); ++s) {
    const StateArchive::Group group(archive, "set_" + std::to_string(s));
    const StateArchive::Share share(archive);
    const ParticleSet& set = sets_[s];
    std::vector<std::uint64_t> block_of;
    if (!archive.reading()) {
      block_of.assign(set.size(), kAwake);
      for (int p = set.awake(); p < set.size(); ++p) block_of[p] = owned_[s][p].block->name.key;
    }
    archive.list("block_of", block_of);
    if (archive.reading()) take_places(s, block_of, archive.merging());
  }
  archive.sum("mass", mass_);
  std::vector<double> rates{rate_};
  archive.list("rate", rates);
  if (!archive.reading()) return;
  rate_ = *std::max_element(rates.begin(), rates.end());
  if (!archive.merging()) return;
  mass_ = 0.0;
  for (const auto& one : by_name_) mass_ += one.second->mass;
}

void SleepingBlocks::serialise_blocks(StateArchive& archive) {
  std::vector<const SleepingBlock*> blocks;  // to write; what is read replaces those that are here
  if (!archive.reading()) {
    for (const auto& one : by_name_) blocks.push_back(one.second.get());
  }
  std::sort(blocks.begin(), blocks.end(), [](const auto* a, const auto* b) { return a->name < b->name; });
  std::vector<int> fields;
  std::vector<std::uint64_t> keys;
  std::vector<double> rates, masses, since;
  for (const SleepingBlock* block : blocks) {
    fields.push_back(block->name.field);
    keys.push_back(block->name.key);
    rates.push_back(block->rate);
    masses.push_back(block->mass);
    since.push_back(block->since);
  }
  const StateArchive::Group group(archive, "blocks");
  {
    const StateArchive::Share share(archive);
    archive.list("field", fields);
    archive.list("key", keys);
    archive.list("rate", rates);
    archive.list("mass", masses);
    archive.list("since", since);
  }
  if (archive.reading()) {
    by_name_.clear();
    whole_.clear();
    for (std::size_t b = 0; b < keys.size(); ++b) {
      SleepingBlock& read = block({fields[b], keys[b]});
      read.rate = std::max(read.rate, rates[b]);
      read.since = since[b];
      if (!archive.merging()) read.mass = masses[b];
    }
  }
  const StateArchive::Share share(archive, BlockForces::kMostNodes);
  std::vector<float> values;
  const auto numbers = [&](const std::string& name, auto&& of_tile) {
    values.clear();
    for (const SleepingBlock* block : blocks) {
      const auto& own = *of_tile(block->forces);
      values.insert(values.end(), own.begin(), own.end());
    }
    archive.list(name, values);
    for (std::size_t b = 0; b < keys.size() && archive.reading(); ++b) {
      auto& own = *of_tile(block({fields[b], keys[b]}).forces);
      for (int t = 0; t < BlockForces::kMostNodes; ++t) own[t] += values[b * BlockForces::kMostNodes + t];
    }
  };
  numbers("given_mass", [](auto& forces) { return &forces.mass; });
  for (int k = 0; k < layout_.dim(); ++k) {
    numbers("given_force" + std::to_string(k), [k](auto& forces) { return &forces.force[k]; });
  }
  if (averaged_) numbers("given_stress", [](auto& forces) { return &forces.stress; });
}

// Makes those asleep the last ones: they are scattered where the particles of several ranks are read as one list.
void SleepingBlocks::take_places(std::size_t s, std::vector<std::uint64_t> block_of, bool merging) {
  ParticleSet& set = sets_[s];
  std::vector<std::uint32_t> order(block_of.size());
  std::iota(order.begin(), order.end(), 0);
  const auto asleep = std::stable_partition(order.begin(), order.end(), [&](auto p) { return block_of[p] == kAwake; });
  if (merging) {
    const auto reorder = [&](auto& values) {
      const auto before = values;
      for (std::size_t p = 0; p < order.size(); ++p) values[p] = before[order[p]];
    };
    set.each_scalar(reorder);
    reorder(set.id);
    if (!set.side.empty()) reorder(set.side);
    reorder(block_of);
    set.begin.clear();  // forgets the blocks of what was there before
  }
  set.sorts_by_id = merging;
  set.asleep = static_cast<int>(order.end() - asleep);
  make_room(s);
  first_[s] = set.awake();
  for (std::uint32_t& changes : set.rest_changes) ++changes;
  for (int p = set.awake(); p < set.size(); ++p) {
    SleepingBlock& block = this->block({set.field_of(p), block_of[p]});
    settle_place(set, static_cast<std::uint32_t>(p));
    note(s, static_cast<std::uint32_t>(p), &block);
    if (merging) block.mass += set.mass_of(p);
  }
}

}  // namespace mpm
