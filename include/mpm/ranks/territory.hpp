// Choice of the rank that a block of the grid belongs to: the blocks in their order along the Hilbert curve, cut into
// as many parts as there are ranks, with nearly as many particles each. A rank keeps the cuts alone, so nothing here
// grows with the grid.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mpm/grid/grid_layout.hpp"
#include "mpm/math/state_archive.hpp"

namespace mpm {

class Territory {
 public:
  /// Particles by block: key and number, each block once.
  using Load = std::vector<std::pair<std::uint64_t, std::uint64_t>>;
  /// Replaces numbers by their sums over ranks; does nothing where `load` is that of the whole run already.
  using Sum = std::function<void(double*, int)>;

  /// `layout` must outlive this object. All belongs to the first of `parts` ranks until it is cut.
  Territory(const GridLayout& layout, int parts);

  int parts() const { return static_cast<int>(cuts_.size()) - 1; }
  /// The rank of a block, given by its key.
  int owner(std::uint64_t key) const;
  /// Cuts anew, so that ranks have nearly as many particles each. `load`: this rank's blocks.
  void cut(const Load& load, const Sum& sum);
  /// For checkpoints.
  void serialise(StateArchive& archive) {
    archive.list("cuts", cuts_);
    if (archive.reading()) known_.clear();
  }

 private:
  std::uint64_t place(std::uint64_t key) const;

  const GridLayout& layout_;
  int bits_;                         ///< bits of a block's number along an axis
  std::vector<std::uint64_t> cuts_;  ///< rank r has the places [cuts_[r], cuts_[r + 1]) of the curve
  mutable std::unordered_map<std::uint64_t, int> known_;  ///< ranks of keys asked about since the last cut
};

}  // namespace mpm
