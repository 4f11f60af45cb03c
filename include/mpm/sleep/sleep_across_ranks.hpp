// Exchange of ranks (ranks/communicator.hpp) on sleep, so that it is that of one process. A block sleeps on
// the rank that put it to sleep, wherever the grid is divided to later, and its particles go to their rank when they
// have woken. Where material of several ranks comes to rest in one block, one after another, it sleeps in parts.
//
//   before a sort: agree()   which blocks fall asleep and which wake, whoever has found it
//   after it:      meet()    what those that sleep on other ranks give to the nodes that this one knows, and the means
//                            of nodes that it has not known before
//
// Every rank knows the names of all that sleeps on others. All ranks that know a node know the same of what sleeps
// around it, so they hold it alike, as they do with all else (ranks/halo.hpp). Weak: the names grow with the whole,
// some 50 bytes a block.
#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/ranks/halo.hpp"
#include "mpm/sleep/sleep_border.hpp"
#include "mpm/sleep/sleeping_blocks.hpp"

namespace mpm {

/// Functions are collective, but for those that say so.
class SleepAcrossRanks {
 public:
  /// All outlive it.
  SleepAcrossRanks(Halo& halo, Fields& fields, SleepingBlocks& asleep)
      : halo_(halo), fields_(fields), asleep_(asleep), known_(fields.size()) {}

  Communicator& ranks() const { return halo_.ranks(); }
  struct Agreed {
    bool any;    ///< some rank has a block that is to fall asleep or wake
    bool falls;  ///< a block falls asleep on any rank
  };
  /// `to_wake` becomes what all ranks together want to wake, ascending, each once. `falling`: blocks of this rank that
  /// fall asleep unless they are among these.
  Agreed agree(bool any, const std::vector<BlockName>& falling, std::vector<BlockName>& to_wake);
  /// After ranks have met.
  void meet(std::vector<SleepBorder>& borders);
  /// After a checkpoint has been read, in place of what agree() and meet() have told so far.
  void begin_anew();

  /// Adds blocks that sleep on others and have material of another velocity field near them. Not collective.
  void add_met(std::vector<BlockName>& names) const;
  /// True if nothing sleeps on any rank. Not collective.
  bool none_asleep() const { return elsewhere_.empty() && asleep_.all().empty(); }

 private:
  /// A block as it is told of.
  struct Told {
    std::uint64_t key;
    std::int32_t field, what;
  };
  using Names = std::unordered_set<BlockName, BlockName::Hash>;

  /// Names of blocks that sleep on others around the nodes of this rank.
  Names find_around() const;
  void ask(const Names& around, std::vector<Told>& asked) const;

  Halo& halo_;
  Fields& fields_;
  SleepingBlocks& asleep_;
  Names elsewhere_;                                ///< asleep on other ranks, in whole or in part
  std::vector<std::vector<std::uint64_t>> known_;  ///< for each field, the blocks in use at the last meeting, ascending
  bool knows_all_ = true;                          ///< in place of that: there are no means but what this rank has
};

}  // namespace mpm
