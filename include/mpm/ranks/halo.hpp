// Nodes that several ranks give to. Each rank spreads its own particles to its own grid; a node that particles of two
// ranks reach then has a part of its sum on either. After every pass that spreads, each of them gets the parts of the
// others and adds all of them in the order of ranks. So all that know a node have the same bits, do to it what a step
// does to nodes (motion, walls, contact) each for itself, and gather from it without asking again.
//
//   sort:   halo.meet(fields, near tools?)      who gives to what; blocks that only others give to join the grid
//   spread: owners of halo.at_border(field) give to their nodes
//           halo.begin(field, nodal field)      sends what they gave to nodes that others know
//           owners of halo.inside(field) give to theirs, while that travels
//           halo.end(field, nodal field)
//
// Ranks that meet at a block have it in all velocity fields that any of them has it in, since contact looks at nodes of
// several. Blocks near tools are on all ranks: contact at points couples everything that touches one tool, and each
// rank solves it for itself. So are blocks near cracks, whose faces, chains and tips each rank moves for itself. Of a
// block a rank sends the nodes that its particles can reach. Weak: it receives nodes that its own particles do not
// reach, so that all who have a block hold the same; what is near tools and cracks is sent to all ranks.
#pragma once

#include <array>
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
  /// True if all ranks have to have a block: by its coordinates.
  using Everywhere = std::function<bool(const std::array<int, 3>&)>;

  /// Both must outlive this object.
  Halo(Communicator& ranks, const Territory& territory) : ranks_(ranks), territory_(territory) {}

  Communicator& ranks() const { return ranks_; }
  /// The rank whose block this is.
  int owner(std::uint64_t key) const { return territory_.owner(key); }
  /// Says of more blocks that all ranks have to have them; the answer is the same on all ranks whenever these meet.
  void add_everywhere(Everywhere everywhere) { everywhere_.push_back(std::move(everywhere)); }
  /// After the blocks of `fields` have been made anew from the particles of this rank.
  void meet(Fields& fields, const Everywhere& everywhere);
  /// Adds what others have spread to the nodes of a velocity field; `values` have its blocks. It is begin() and end().
  void add(int field, NodalField& values);
  /// The same of two fields of nodes at once, of which the second may be null. Owners at_border() have given to them,
  /// those inside() may until end() of the same fields.
  using Values = std::array<NodalField*, 2>;
  void begin(int field, const Values& values);
  void end(int field, const Values& values);
  /// Owners of a velocity field that may give to a node that another rank knows, and all others.
  const BlockShares& at_border(int field) const { return fields_[field].at_border; }
  const BlockShares& inside(int field) const { return fields_[field].inside; }
  /// The nodes of a block, one bit each.
  using Nodes = std::uint64_t;
  /// Adds the nodes that others may give to, for each block of a velocity field.
  void add_reached(int field, std::vector<Nodes>& nodes) const {
    for (const Piece& piece : fields_[field].in) nodes[piece.block] |= piece.nodes;
  }

  /// Numbers received since the start, of 8 bytes each.
  std::uint64_t numbers_received() const { return numbers_received_; }

 private:
  /// A block of a velocity field that a rank gives to.
  struct Use {
    std::uint64_t field, key;
    Nodes nodes;  ///< those that it may give to
    bool operator<(const Use& other) const { return field != other.field ? field < other.field : key < other.key; }
  };
  /// A use by another rank.
  struct Given {
    Use use;
    int rank;     ///< by whom
    bool met;     ///< true if this rank has the block, too, in some field
    bool to_all;  ///< true if it is sent to all ranks
  };
  /// Nodes of a block as they are sent, in a buffer of nodes.
  struct Piece {
    int block;
    Nodes nodes;
    int at, count;  ///< place and number of these nodes there
    int rank;       ///< from whom
  };
  /// A block to add to: pieces [first, first + count) of what is received, in the order of ranks; the first `before` of
  /// them are of lower ranks than this one.
  struct Sum {
    int block;
    int first, count, before;
    bool own;  ///< true if this rank gives to it
  };
  struct OfField {
    std::vector<Piece> out, in;
    int out_rows = 0, in_rows = 0;  ///< rows of kRow nodes each
    std::vector<Sum> sums;
    std::unique_ptr<Communicator::Copies> copies;
    std::vector<double> sent, received;
    BlockShares at_border, inside;
  };

  std::vector<int> ranks_around(const GridLayout& layout, std::uint64_t key) const;
  bool owns(const Use& use) const;
  /// Nodes that the owners of each block of a grid may give to.
  std::vector<Nodes> reach(const BlockTable& blocks) const;
  void find_own(const Fields& fields, const Everywhere& everywhere);
  /// Tells others what this rank gives to, and hears what they do.
  std::vector<Given> hear();
  void admit(Fields& fields, const std::vector<Given>& given);
  /// [rank][field]: the row at which that rank's part begins.
  using Begins = std::vector<std::vector<std::int32_t>>;
  /// Lays out what this rank sends: what all get, then a part for each rank.
  Begins plan_sending(const Fields& fields, const std::vector<Given>& given);
  /// Tells others where their parts begin, and hears where this rank's do.
  Begins exchange(const Begins& begins);
  void plan_receiving(const Fields& fields, std::vector<Given> given, const Begins& begins);
  void find_counted(Fields& fields, const std::vector<Given>& given);
  /// `shared`: of each block of a field, whether another rank knows it.
  void divide(int field, const Grid& grid, const std::vector<std::uint8_t>& shared);

  Communicator& ranks_;
  const Territory& territory_;
  std::vector<Everywhere> everywhere_;
  std::vector<OfField> fields_;
  std::uint64_t numbers_received_ = 0;

  // Results of the last meeting.
  std::vector<Use> own_;                 ///< blocks that this rank gives to, ascending
  std::vector<std::uint64_t> own_keys_;  ///< the same, in whichever field
  std::vector<std::vector<Use>> told_;   ///< to each rank
  std::vector<Use> told_all_;
};

}  // namespace mpm
