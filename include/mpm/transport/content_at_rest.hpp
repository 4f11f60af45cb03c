// A transported quantity where blocks sleep (sleep/sleep.hpp). Nothing flows within a block asleep. At the nodes that
// it shares with what is awake it takes part in what the nodes are: it brings the capacity that it had there and the
// content, and the flow that its particles gave to them when it fell asleep goes on, so that a steady state stays one.
// What comes to these nodes is kept for it, node by node, and handed to its particles when it wakes; so no content is
// lost, and that of particles and of what is kept is what accounts say.
//
//   it wakes           when a node that it shares has changed by `change`
//   it falls asleep    when no particle of it has changed faster, for a time, than by `change` in the time in which it
//                      diffuses across a block, (4 h)^2 C / K; what is frozen in it is less than `change` then
//
// A block stays awake where a source, a flux or a value that changes with time feeds it.
//
// Weak: a front goes no farther than the nodes of a border until it has changed these by `change`.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/math/state_archive.hpp"
#include "mpm/step/rest_partner.hpp"

namespace mpm {

class ContentAtRest {
 public:
  using Name = std::pair<int, std::uint64_t>;  ///< velocity field and key of a block
  /// Numbers of the nodes of a block's tile, as in BlockForces.
  struct Tile {
    std::vector<double> capacity;  ///< [content/quantity]
    std::vector<double> value;     ///< as it fell asleep
    std::vector<double> flow;      ///< [content/s]
    std::vector<double> room;      ///< volume over mass, times mass, where it is needed [m^3]
    std::vector<double> came;      ///< content that came since
    bool changed = false;          ///< a node has changed by `change`
    double at(int t) const { return value[t] + came[t] / capacity[t]; }
    double& share(int t, bool by_volume) { return by_volume ? room[t] : capacity[t]; }
  };
  /// A node that a block asleep shares with what is awake.
  struct Shared {
    NodeRef node;
    Tile* tile;
    int at;       ///< number in the tile
    bool active;  ///< something awake is there in this update
  };

  /// `change`: of the quantity, that wakes a block; `rate`: fastest change of a block that may fall asleep [1/s];
  /// `after`: for so long [s].
  ContentAtRest(const GridLayout& layout, double change, double rate, double after);

  double rate() const { return rate_; }
  /// To be called before an update: finds what is shared, when blocks have changed.
  void follow(const Fields& fields);
  std::vector<Shared>& shared(int field) { return shared_[field]; }
  /// To be called after an update: `changes`: fastest change of each owner of a field since the last [1/s].
  void watch(const Fields& fields, int field, const std::vector<double>& changes, double now);
  /// Looks for blocks that have to wake.
  void find_changed();

  /// True if a block has been quiet for long enough.
  bool quiet(const RestingBlock& block, double now) const;
  bool changed(const RestingBlock& block) const;
  /// The tile of a block that falls asleep; new, or with what sleeps there already.
  Tile& tile(const RestingBlock& block);
  /// Takes the tile of a block that wakes; empty if there is none.
  Tile take(const RestingBlock& block);

  void serialise(StateArchive& archive);
  /// Adds what came to each block, in the order of their names.
  void hashed(std::vector<double>& numbers) const;

 private:
  std::vector<Name> names() const;
  struct Watched {
    std::uint64_t key = 0;
    double since = 0.0;  ///< quiet since then [s]
  };
  struct Hash {
    std::size_t operator()(const Name& name) const {
      return (name.second * 0x9E3779B97F4A7C15ull) ^ static_cast<std::size_t>(name.first);
    }
  };

  const GridLayout* layout_;
  double change_, rate_, after_;
  int nodes_ = 1;                                             ///< number of a tile's nodes
  std::array<std::vector<std::pair<int, int>>, 27> of_side_;  ///< for each block around a tile: number in it, and node
  std::unordered_map<Name, Tile, Hash> tiles_;
  std::vector<std::vector<Shared>> shared_;    ///< nodes of each field
  std::vector<std::vector<Watched>> watched_;  ///< blocks of each field, in the order of keys
  std::vector<Watched> before_;
  std::uint64_t generation_ = 0;  ///< generation of the blocks that shared_ is of
};

}  // namespace mpm
