// Sharing of owners among threads: contiguous parts of them, and so of space, with nearly the same work. A part
// keeps its nodes and particles in a core's cache from pass to pass.
//
// What scatters to nodes takes its owners colour by colour (block_table.hpp), but threads need not wait for each other
// at the end of every colour: owners of two parts share a node only where the parts touch. Of each colour a part takes
// the owners beside other parts first, when these parts have done with theirs of the colours before. So the work has to
// be balanced over a whole pass alone, and a node still gets its sums in the order of colours: the same bits for any
// number of parts and threads.
// Weak: a part is no smaller than a block, so a few blocks on many threads are shared unevenly.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "mpm/grid/block_table.hpp"

namespace mpm {

class BlockShares {
 public:
  /// Cuts the owners of `blocks` into `parts` parts, some of them empty where owners are few. `particles`: of each
  /// owner; when empty, all owners count alike. by_colour() leaves out owners without particles.
  void rebuild(const BlockTable& blocks, const std::vector<std::uint32_t>& particles, int parts);
  /// Cuts the owners with a mark (one an owner), of those that `all` visits by colour, into parts of their own.
  void rebuild_of(const BlockShares& all, const BlockTable& blocks, const std::vector<std::uint8_t>& marked);

  int parts() const { return static_cast<int>(begin_.size()) - 1; }
  /// First owner of a part; of part parts() one past the last.
  int begin(int part) const { return begin_[part]; }

  // The loops over the owners are defined in each_share.hpp, for files that are compiled with OpenMP. `name`: of the
  // loop.
  /// visit(owner) for all owners, on so many threads: for what writes to no node of another owner.
  template <class Visit>
  void at_once(const char* name, int threads, Visit&& visit) const;
  /// visit(owner) for all owners, at each node in the order of colours: for what scatters to a tile.
  template <class Visit>
  void by_colour(const char* name, int threads, Visit&& visit) const;

 private:
  /// Colours of which a part has done its owners beside other parts. A cache line each.
  struct alignas(64) Done {
    std::atomic<int> colours{0};
  };

  /// Until the parts beside this one have done with all colours before this one.
  void wait_for_others(int part, int colour) const;
  void cut(int owners, int parts);
  void rebuild(const BlockTable& blocks, int parts);

  int colours_ = 0;
  std::vector<int> begin_ = {0};  ///< first owner of each part; and one past the last
  std::vector<int> order_;        ///< owners by part, by colour, and of a colour those beside other parts first
  /// Places in order_, for each part and colour, where its owners begin and where those with neighbours in their own
  /// part alone do; and where all end.
  std::vector<int> runs_ = {0};
  std::vector<int> beside_, beside_begin_ = {0};  ///< parts that each part touches
  std::unique_ptr<Done[]> done_;                  ///< progress of each part
  int room_ = 0;                                  ///< parts in done_

  // Kept so that a sort allocates nothing.
  std::vector<std::uint32_t> particles_;  ///< number in each owner; empty where all count alike
  std::vector<int> part_of_, owner_of_block_;
  std::vector<std::uint8_t> at_edge_, touches_;
};

}  // namespace mpm
