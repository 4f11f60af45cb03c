// Prescribed velocities at nodes inside regions, as mpm/boundary/condition.hpp has them. The solver's own class moves
// the regions and finds nodes and velocities, on the host: the nodes when the table of blocks is a new one, of which it
// gets the keys, or a region moves; the velocities in each step, unless they do not change. What nodes give is summed
// there.
//
// Beside a frictional wall they do not act here: it would have to act after them, and acts with the other walls.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "mpm/boundary/condition.hpp"
#include "mpm_gpu/passes.hpp"
#include "mpm_gpu/stage.hpp"
#include "mpm_gpu/totals.hpp"

namespace mpm_gpu {

template <class T>
class Prescribed final : public Stage<T> {
 public:
  /// `conditions`: those of the simulation, which outlive this; null: it makes its own, from `definitions`.
  Prescribed(mpm::VelocityConditions* conditions, const std::vector<mpm::ConditionDefinition>& definitions,
             const mpm::GridLayout& layout, const Passes<T>& passes);

  void make_room(Executor& run, long nodes) override;
  void begin_step(Executor& run, Step<T>& step, double start, long sorts) override;
  void act(mpm::Hook hook, Executor& run, const Step<T>& step) override;
  void tell_modules() override;
  std::size_t bytes() const override;

 private:
  void find_blocks(Executor& run, const Step<T>& step);
  /// Lists of the nodes that are held now, for kernels.
  void upload_nodes();
  void upload_velocities();
  void add_up(Executor& run);
  HeldView view();

  std::unique_ptr<mpm::VelocityConditions> own_;
  mpm::VelocityConditions& conditions_;
  mpm::GridLayout layout_;
  const Passes<T>& passes_;
  long sorts_ = -1, nodes_ = 0, entries_ = 0;
  bool moved_ = false;  ///< true if the motion of this step has been updated
  std::vector<std::uint64_t> keys_;
  std::vector<std::array<int, 3>> blocks_;  ///< blocks of the table, as the solver numbers them
  std::vector<std::uint32_t> node_here_, first_here_, entry_here_;
  std::vector<double> direction_here_, start_here_, end_here_, factor_here_;
  std::vector<long> begin_;  ///< first share of each condition, and the end
  Buffer<std::uint64_t> key_;
  Buffer<std::uint32_t> node_, first_, entry_;
  Buffer<double> direction_, start_, end_, given_, work_, factor_, share_;
  std::vector<Total> impulse_;  ///< impulse of each condition, along its direction
  Total works_;
};

}  // namespace mpm_gpu
