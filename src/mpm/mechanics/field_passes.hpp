// The passes of continuum mechanics over the particles of all velocity fields, block by block, and over their nodes.
//
// What spreads to nodes begins with zero and ends with the sums of everybody who gives to them: of particles that
// choose a field at every node (grid/node_choice.hpp), and of other ranks (ranks/halo.hpp). Over ranks the blocks at
// their borders come first, and the others while what the first have given travels. `name` is that of the pass in a
// profile. Private to this folder.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <vector>

#include "mpm/grid/node_choice.hpp"
#include "mpm/mechanics/kernel_views.hpp"
#include "mpm/ranks/halo.hpp"
#include "mpm/step/damping.hpp"

namespace mpm {

/// A velocity field at work: its grid, and the sets that have particles in it. T is the precision of the particles.
template <class T>
struct FieldAtWork {
  explicit FieldAtWork(Grid& grid) : grid(grid), mean(1, grid.layout.nodes_per_block()) {}
  int count() const { return static_cast<int>(views.size()); }
  const mpm_kernel::SetView<T>* sets() const { return views.data(); }

  Grid& grid;
  mpm_kernel::GridView view{};
  std::vector<mpm_kernel::SetView<T>> views;
  std::vector<int> set;                  ///< index of each
  std::vector<std::uint8_t> loose;       ///< marks of each owner, after the motion
  std::vector<mpm_kernel::Moved> taken;  ///< by damping and PIC, of each owner
  NodalField mean;                       ///< mean of dilatation or stress, where these are averaged
};

template <class T>
class FieldPasses {
 public:
  using Field = FieldAtWork<T>;

  /// All outlive this object; the last two may be null.
  FieldPasses(Fields& fields, int threads, NodeChoice* choice, Halo* halo)
      : threads_(threads), choice_(choice), halo_(halo) {
    for (auto& grid : fields) fields_.emplace_back(*grid);
    if (choice != nullptr) patches_.emplace(choice->grid());
  }

  std::vector<Field>& fields() { return fields_; }
  const std::vector<Field>& fields() const { return fields_; }
  /// Field of patches, where particles choose a field at every node.
  std::optional<Field>& patches() { return patches_; }

  // Particles that choose a field at every node have nodes of their own, as if they were a field.
  template <class Act>
  void each_field(Act&& act) {
    for (Field& field : fields_) act(field);
    if (patches_) act(*patches_);
  }

  /// visit(field, block) for every block with particles: for what writes to no node.
  template <class Visit>
  void each_block(const char* name, Visit&& visit) {
    each_field([&](Field& field) {
      each_owner_at_once(name, field.grid, threads_, [&](const mpm_kernel::BlockView& block) { visit(field, block); });
    });
  }

  /// visit(field, block), at a node a colour after the other: for what adds to these fields of nodes, two at most.
  template <class Visit>
  void spread(const char* name, std::initializer_list<NodalField Grid::*> to, Visit&& visit) {
    const TimeProfile::Part part(name);
    const auto by_colour = [&](Field& field, const BlockShares& owners) {
      owners.by_colour(name, threads_, [&](int owner) { visit(field, view_of(field.grid, owner)); });
    };
    each_field([&](Field& field) {
      each_node_range(name, field.grid, [&](int first, int last) {
        for (NodalField Grid::*const nodes : to) clear(field.grid.*nodes, first, last);
      });
    });
    const int fields = static_cast<int>(fields_.size());
    const bool overlaps = halo_ != nullptr && !patches_;
    if (overlaps) {
      for (int f = 0; f < fields; ++f) by_colour(fields_[f], halo_->at_border(f));
    } else {
      each_field([&](Field& field) { by_colour(field, field.grid.shares); });
      for (NodalField Grid::*const nodes : to) {
        if (choice_ != nullptr) choice_->give(nodes);
      }
    }
    if (halo_ == nullptr) return;
    const auto values = [&](int f) {
      Halo::Values list{};
      std::transform(to.begin(), to.end(), list.begin(), [&](auto nodes) { return &(fields_[f].grid.*nodes); });
      return list;
    };
    for (int f = 0; f < fields; ++f) halo_->begin(f, values(f));
    for (int f = 0; f < fields && overlaps; ++f) by_colour(fields_[f], halo_->inside(f));
    for (int f = 0; f < fields; ++f) halo_->end(f, values(f));
  }

  // Takes the values of the fields' nodes that particles which choose a field read.
  void take(NodalField Grid::*what) {
    if (choice_ != nullptr) choice_->take(what);
  }
  void take_for_strain(double step) {
    if (choice_ != nullptr) choice_->take_for_strain(step);
  }

  /// pass(first block, last block), the blocks in use shared out among the threads.
  template <class Pass>
  void each_node_range(const char* name, const Grid& grid, Pass&& pass) const {
    constexpr int kBlocks = 16;           // a range
    constexpr int kRangesPerThread = 64;  // fewer do not pay for the start of a thread
    const int blocks = grid.blocks.size(), ranges = (blocks + kBlocks - 1) / kBlocks;
    const int threads = std::clamp(ranges / kRangesPerThread, 1, threads_);
    for_groups(name, threads, blocks, kBlocks, [&](int first, int last, int) { pass(first, last); });
  }

  /// visit(block, node, 1 / mass): zero where no particle is.
  template <class Visit>
  void each_carrying(const char* name, const Grid& grid, Visit&& visit) const {
    each_node_range(name, grid, [&](int first, int last) {
      for (int b = first; b < last; ++b) {
        for (int n = 0; n < grid.layout.nodes_per_block(); ++n) {
          visit(b, n, grid.carries(b, n) ? 1.0 / grid.mass.at(b, 0, n) : 0.0);
        }
      }
    });
  }

  void clear(const char* name, const Grid& grid, NodalField& nodes) const {
    each_node_range(name, grid, [&](int first, int last) { clear(nodes, first, last); });
  }

 private:
  static void clear(NodalField& nodes, int first, int last) {
    const std::ptrdiff_t numbers = static_cast<std::ptrdiff_t>(nodes.components()) * nodes.nodes_per_block();
    std::fill_n(nodes.block(first), (last - first) * numbers, 0.0);
  }

  int threads_;
  NodeChoice* choice_;
  Halo* halo_;
  std::vector<Field> fields_;
  std::optional<Field> patches_;
};

}  // namespace mpm
