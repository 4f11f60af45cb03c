// Nodes that several ranks give to. Each rank spreads its own particles to its own grid; a node that particles of two
// ranks reach then has a part of its sum on either. After every pass that spreads, each of them gets the parts of the
// others and adds all of them in the order of ranks. So all that know a node have the same bits, do to it what a step
// does to nodes (motion, walls, contact) each for itself, and gather from it without asking again.
//
//   sort:   halo.meet(fields, near tools?)      who gives to what; blocks that only others give to join the grid
//   spread: halo.add(field, nodal field)
//
// Ranks that meet at a block have it in all velocity fields that any of them has it in, since contact looks at nodes of
// several. Blocks near tools are on all ranks: contact at points couples everything that touches one tool, and each
// rank solves it for itself. So are blocks near cracks, whose faces, chains and tips each rank moves for itself. Weak:
// whole blocks are sent, the nodes beyond two from the border too; what is near tools and cracks is sent to all ranks.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/ranks/communicator.hpp"
#include "mpm/ranks/territory.hpp"

namespace mpm {

class Halo {
 public:
  /// Whether all ranks have to have a block: by its coordinates.
  using Everywhere = std::function<bool(const std::array<int, 3>&)>;

  /// Both must outlive this object.
  Halo(Communicator& ranks, const Territory& territory) : ranks_(ranks), territory_(territory) {}

  Communicator& ranks() const { return ranks_; }
  /// Says of more blocks that all ranks have to have them; the answer is the same on all ranks whenever these meet.
  void add_everywhere(Everywhere everywhere) { everywhere_.push_back(std::move(everywhere)); }
  /// After the blocks of `fields` have been made anew from the particles of this rank.
  void meet(Fields& fields, const Everywhere& everywhere);
  /// Adds what others have spread to the nodes of a velocity field; `values` have its blocks.
  void add(int field, NodalField& values);

  /// Blocks whose nodes come from other ranks in every pass, over all fields.
  std::uint64_t blocks_received() const;
  /// Numbers received since the start, of 8 bytes each.
  std::uint64_t numbers_received() const { return numbers_received_; }
  std::uint64_t exchanges() const { return exchanges_; }

 private:
  /// A block of a velocity field that a rank gives to.
  struct Use {
    std::uint64_t field, key;
    bool operator<(const Use& other) const { return field != other.field ? field < other.field : key < other.key; }
  };
  /// A use by another rank.
  struct Given {
    Use use;
    int rank, row;  ///< by whom, and which of the blocks it is there
    bool met;       ///< whether this rank has the block, too, in some field
  };
  /// A block to add to: its copies from other ranks are rows [first, first + count) of what is received, in the order
  /// of ranks; the first `before` of them are of lower ranks than this one.
  struct Sum {
    int block;
    int first, count, before;
    bool own;  ///< whether this rank gives to it
  };
  struct OfField {
    std::vector<Sum> sums;
    std::unique_ptr<Communicator::Copies> copies;
    std::vector<double> received;
    int rows = 0;
  };

  std::vector<int> ranks_around(const GridLayout& layout, std::uint64_t key) const;
  bool owns(const Use& use) const;
  void find_own(const Fields& fields, const Everywhere& everywhere);
  /// Tells others what this rank gives to, and hears what they do.
  std::vector<Given> hear();
  void admit(Fields& fields, const std::vector<Given>& given);
  void find_rows(const Fields& fields, std::vector<Given>& given);
  /// Leaves what was met, in the order of fields, blocks and ranks.
  void plan(const Fields& fields, std::vector<Given>& given);
  void find_counted(Fields& fields, const std::vector<Given>& given) const;

  Communicator& ranks_;
  const Territory& territory_;
  std::vector<Everywhere> everywhere_;
  std::vector<OfField> fields_;
  std::uint64_t numbers_received_ = 0, exchanges_ = 0;

  // Of the last meeting.
  std::vector<Use> own_;                 ///< what this rank gives to, ascending
  std::vector<std::uint64_t> own_keys_;  ///< the same, in whichever field
  std::vector<std::vector<Use>> told_;   ///< to each rank
  std::vector<Use> told_all_;
};

}  // namespace mpm
