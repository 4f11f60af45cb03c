// Choice of a rank's particles from the start, so that it never has those of others. All ranks look at the places of
// all particles and count them by block; the grid is divided by these numbers, as it is later in the run
// (territory.hpp); then they look at all places once more, and each keeps what lies in its own blocks.
//
//   for each body: part.begin_body(); for each place: part.count(place);
//   part.divide();
//   for each body, place: if (part.keeps(place)) ...
//
// Weak: the time that this takes does not become less with more ranks.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "mpm/ranks/communicator.hpp"
#include "mpm/ranks/territory.hpp"

namespace mpm {

class OwnPart {
 public:
  OwnPart(const Communicator& ranks, const GridLayout& layout);

  void begin_body() { bodies_.emplace_back(); }
  /// A particle of the body begun last.
  void count(const Vec3& place);
  void divide();
  bool keeps(const Vec3& place);
  /// Particles of a body that this rank keeps, and that the body has.
  std::size_t own(std::size_t body) const;
  std::uint64_t whole(std::size_t body) const { return bodies_[body].whole; }

 private:
  struct Body {
    std::unordered_map<std::uint64_t, std::uint64_t> particles;  ///< by key of the block
    std::uint64_t whole = 0;
  };

  std::uint64_t block_of(const Vec3& place) const;

  const int rank_;
  const GridLayout layout_;
  Territory territory_;
  std::vector<Body> bodies_;
  // Block of the last place asked about: neighbours are in the same block mostly.
  std::uint64_t last_ = ~std::uint64_t{0};
  bool last_kept_ = false;
};

}  // namespace mpm
