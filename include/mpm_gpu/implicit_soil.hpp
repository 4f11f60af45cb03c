// Implicit steps on a device: its particles, and cells and nodes of the soil, as the solver's own implicit step moves
// them (mpm/implicit/soil_field.hpp). That step decides on the host how often the soil is swept, and finds the rows of
// contact there; so tools, robots, walls, budget, accounts and checkpoints are the solver's own. Cells are swept in the
// solver's order: blocks of one colour at once, of a block the cells that share no node.
//
// Weak: all nodes are copied to the host and back for the rows of contact, and once more at the end; a sweep waits for
// the host, which looks at its change, and copies the rows' impulses; for free bodies it copies the nodes around them
// twice. Which blocks are in use is found on the host after each sort. A node of the table takes some 600 bytes in
// single precision for each soil, and there is room for two to four times the nodes in use.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/implicit/implicit_step.hpp"
#include "mpm_gpu/near_tools.hpp"
#include "mpm_gpu/soil_map.hpp"
#include "mpm_gpu/soil_passes.hpp"
#include "mpm_gpu/soil_rows.hpp"
#include "mpm_gpu/solver.hpp"
#include "mpm_gpu/stage.hpp"

namespace mpm_gpu {

template <class T>
class ImplicitSoil final : public Stage<T>, public mpm::SoilField<T> {
 public:
  using Node = mpm_kernel::SoilNode<T>;

  /// All outlive this object, which takes the place of the soil in `solve`. `sets`: of the simulation. `rest`: sleep
  /// beside it; null without it.
  ImplicitSoil(mpm::ImplicitSolve<T>& solve, const std::vector<mpm::ParticleSet>& sets, mpm::HostRest* rest,
               Solver<T>& solver);

  // Functions of Stage.
  void make_room(Executor& run, long nodes) override;
  void begin_step(Executor& run, Step<T>& step, double start, long sorts) override;
  void act(mpm::Hook hook, Executor& run, const Step<T>& step) override;
  std::size_t bytes() const override;

  // Functions of SoilField.
  void begin(double dt, bool other_blocks) override;
  std::vector<Node>& nodes() override { return nodes_; }
  void take_rows() override;
  void meet() override;
  void show() override;
  void take_back() override;
  void go_on(T factor) override;
  void sweep(bool backwards, const std::vector<std::uint8_t>& marked,
             std::vector<mpm_kernel::SweepChange>& changes) override;
  void end_sweeps() override;
  void add_to_held(mpm::HeldImpulses& held) override;
  void finish(double dt, mpm::SoilDeeds& deeds) override;
  double of_hoops() const override { return 0.0; }
  bool put_out() override;

 private:
  SoilView<T> view();
  mpm_kernel::SoilParticles<T> particles_of(int body) const;
  void download_nodes();
  /// Gives nodes that sleep holds the velocities that they would have.
  void store_at_rest();

  mpm::ImplicitSolve<T>& solve_;
  mpm::HostRest* rest_;
  Solver<T>& solver_;
  int dim_;
  const SoilPassTable<T>& passes_;
  SoilMap<T> map_;
  SoilRows<T> rows_;
  NearTools<T> near_tools_;
  std::vector<mpm_kernel::SoilConstants> constants_;  ///< constants of each soil
  std::vector<mpm_kernel::SoilParticles<T>> shapes_;  ///< description of each body, without pointers
  Buffer<std::int32_t> soil_of_set_;

  Executor* run_ = nullptr;
  Step<T> step_{};  ///< view of the step under way, or of the last one
  double start_ = 0.0;
  long sorts_ = 0, taken_ = -1;   ///< sorts before this step, and before the blocks were taken
  std::uint64_t rest_taken_ = 0;  ///< generation of the blocks of sleep's grid then
  bool meets_ = false;            ///< there may be rows of contact, for which the host needs the nodes
  std::vector<Node> nodes_;       ///< copy on the host
  std::vector<std::uint8_t> marked_;
  std::vector<mpm_kernel::SweepChange> changes_;
  std::vector<double> impulses_;  ///< impulses of nodes at rest, three of each [N s]
  Buffer<Node> node_, before_, node_room_;
  Buffer<mpm_kernel::SoilGroup<T, 1>> cell_;
  Buffer<mpm_kernel::SoilMask<T, 1>> mask_;
  Buffer<mpm_kernel::SoilMotion<T>> motion_;
  std::array<Buffer<T>, kSoilNumbers> number_;
  Buffer<std::uint8_t> marked_there_;
  Buffer<double> impulse_room_;
  Buffer<mpm_kernel::SweepChange> change_, change_room_;
  Buffer<HeldSums> of_held_;
  Buffer<DeedSums> of_deeds_;
};

}  // namespace mpm_gpu
