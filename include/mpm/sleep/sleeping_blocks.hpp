// The blocks of material that are asleep, and their particles: the last ones of each set (ParticleSet::asleep), which
// steps do not touch and reports read as ever. A block that falls asleep or wakes changes places with others, particle
// by particle, so that this costs as much as the block has particles, however much is asleep.
//
// A block remembers the force that it had on the grid when it fell asleep, so that a loss of balance can be seen.
//
// Over several ranks each has here what sleeps on it (sleep_across_ranks.hpp), and of blocks beside its own material
// that sleep on others, in whole or in part, what they give to the grid.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mpm/grid/grid_layout.hpp"
#include "mpm/math/geometry.hpp"
#include "mpm/math/state_archive.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/step/block_probe.hpp"

namespace mpm {

/// A block of a velocity field.
struct BlockName {
  int field = 0;
  std::uint64_t key = 0;
  bool operator<(const BlockName& other) const { return field != other.field ? field < other.field : key < other.key; }
  bool operator==(const BlockName& other) const { return field == other.field && key == other.key; }
  struct Hash {
    std::size_t operator()(const BlockName& name) const {
      return (name.key * 0x9E3779B97F4A7C15ull) ^ static_cast<std::size_t>(name.field);
    }
  };
};

/// Puts what has names into their order, and leaves one of each.
template <class T, class NameOf>
void sort_by_name(std::vector<T>& list, NameOf&& name_of) {
  std::sort(list.begin(), list.end(), [&](const T& a, const T& b) { return name_of(a) < name_of(b); });
  const auto same = [&](const T& a, const T& b) { return name_of(a) == name_of(b); };
  list.erase(std::unique(list.begin(), list.end(), same), list.end());
}
inline void sort_names(std::vector<BlockName>& names) {
  sort_by_name(names, [](const BlockName& name) { return name; });
}

struct SleepingBlock {
  BlockName name;
  double rate = 0.0;                                  ///< by which the fastest wave would cross a cell [1/s]
  double mass = 0.0;                                  ///< mass of its particles [kg]
  double since = 0.0;                                 ///< time at which its first particles fell asleep [s]
  BlockForces forces;                                 ///< on the nodes of its tile
  std::vector<std::vector<std::uint32_t>> particles;  ///< places of those of each set
};

/// Motion that was taken from particles when they fell asleep.
struct TakenMotion {
  Vec3 momentum = Vec3::Zero();  ///< [N s]
  double energy = 0.0;           ///< kinetic [J]
};

class SleepingBlocks {
 public:
  /// `sets` outlive it. `averaged`: volume changes are averaged over the grid.
  SleepingBlocks(std::vector<ParticleSet>& sets, const GridLayout& layout, bool averaged)
      : sets_(sets), layout_(layout), averaged_(averaged) {}

  /// A block that is to fall asleep: all particles of an owner (numbered through all fields).
  struct Sleeper {
    BlockName name;
    int owner = 0;
    double rate = 0.0;
    double since = 0.0;  ///< as in SleepingBlock
    std::unique_ptr<BlockForces> forces;
  };
  /// Puts them to sleep, in ascending order of owners; particles have to be sorted. After it they are not any more.
  TakenMotion put_to_sleep(const std::vector<Sleeper>& sleepers);
  /// Wakes the block of this name, if it is asleep. Particles have to be sorted after it.
  void wake(const BlockName& name);
  /// Takes the block of this name out of its sets, if it is asleep: its particles are there no more. Those that are
  /// awake stay where they are.
  void take_away(const BlockName& name);
  /// To be called when blocks have fallen asleep or woken, on any rank: particles that are awake may have changed
  /// places, and the next sort takes those of a node in the order of their ids (ParticleSet::sorts_by_id).
  void forget_order();
  /// To be called before a sort, and before forget_order(): since the last sort no block has fallen asleep or woken.
  void trust_order();
  /// To be called when nothing is asleep on any rank.
  void forget_rate() { rate_ = 0.0; }

  /// Over several ranks: follows particles asleep that have changed places since others that are awake have come to
  /// this rank or gone (ranks/hand_over.hpp).
  void follow_moves();
  /// A block that sleeps on other ranks, too, or on others alone, with what all its material gives to the grid.
  void know_whole(std::unique_ptr<SleepingBlock> whole) { whole_[whole->name] = std::move(whole); }
  bool knows_whole(const BlockName& name) const { return whole_.count(name) != 0; }
  void forget_whole(const BlockName& name) { whole_.erase(name); }
  /// Forgets all that keep(name) does not ask for.
  template <class Keep>
  void forget_wholes_but(Keep&& keep) {
    for (auto one = whole_.begin(); one != whole_.end();) one = keep(one->first) ? std::next(one) : whole_.erase(one);
  }

  /// Returns what the block gives to the grid, on whichever rank it sleeps, or null.
  const SleepingBlock* find(const BlockName& name) const {
    if (!whole_.empty()) {
      const auto found = whole_.find(name);
      if (found != whole_.end()) return found->second.get();
    }
    return own(name);
  }
  /// The block of this name that sleeps on this rank, or null.
  const SleepingBlock* own(const BlockName& name) const {
    const auto found = by_name_.find(name);
    return found == by_name_.end() ? nullptr : found->second.get();
  }
  /// True if find() gives null for any name.
  bool finds_none() const { return by_name_.empty() && whole_.empty(); }
  using ByName = std::unordered_map<BlockName, std::unique_ptr<SleepingBlock>, BlockName::Hash>;
  /// Those of this rank, in no order.
  const ByName& all() const { return by_name_; }
  std::size_t particles() const;
  double mass() const { return mass_; }  ///< [kg]
  /// The largest rate of any block that is asleep, or has been since none was [1/s].
  double rate() const { return rate_; }

  void serialise(StateArchive& archive);

 private:
  /// Owner of a particle asleep, and its index in the block's list.
  struct Owned {
    SleepingBlock* block = nullptr;
    std::uint32_t index = 0;
  };

  void make_room(std::size_t s);
  void exchange(ParticleSet& set, std::uint32_t p, std::uint32_t q);
  /// Both arrays of positions have what is asleep, since steps swap them.
  void settle_place(ParticleSet& set, std::uint32_t p);
  TakenMotion stop(ParticleSet& set, std::uint32_t p);
  void note(std::size_t s, std::uint32_t p, SleepingBlock* block);
  void put_set(std::size_t s, const std::vector<Sleeper>& sleepers, const std::vector<SleepingBlock*>& blocks,
               TakenMotion& taken);
  void wake_set(std::size_t s, SleepingBlock& block);
  void take_out_of_set(std::size_t s, SleepingBlock& block);
  void follow_moves(std::size_t s);
  /// Takes the places of a set's particles; `block_of`: the key of the block that each sleeps in, or kAwake.
  void take_places(std::size_t s, std::vector<std::uint64_t> block_of, bool merging);
  /// The block of this name on this rank; one with nothing in it if there is none.
  SleepingBlock& block(const BlockName& name);
  void serialise_blocks(StateArchive& archive);

  std::vector<ParticleSet>& sets_;
  const GridLayout& layout_;
  bool averaged_;
  ByName by_name_, whole_;
  std::vector<std::vector<Owned>> owned_;  ///< owners in each set, by place
  std::vector<int> first_;                 ///< for each set, the place of the first one asleep
  std::vector<std::uint32_t> free_;        ///< places that put_set() may exchange with
  double mass_ = 0.0, rate_ = 0.0;
};

}  // namespace mpm
