// Soil of an implicit step in the memory of this processor: the solver's own grid and particles. Private to this
// folder.
#pragma once

#include "mpm/implicit/implicit_step.hpp"
#include "mpm/implicit/out_of_tools.hpp"
#include "mpm/implicit/soil_cells.hpp"
#include "mpm/implicit/soil_field.hpp"
#include "mpm/implicit/tool_rows.hpp"
#include "mpm/implicit/wall_rows.hpp"

namespace mpm {

/// Parts of the step that a field acts on; all outlive it.
template <class T>
struct FieldParts {
  const mpm_kernel::SweepTable<T>& table;
  Grid& grid;
  std::vector<ParticleSet>& sets;
  const SoilGrid& soil_grid;
  ToolRows<T>& tools;
  WallRows<T>& walls;
  const OutOfTools& out;
};

template <class T>
class HostField final : public SoilField<T> {
 public:
  using Node = mpm_kernel::SoilNode<T>;

  /// `lightest`: added to a node's mass in the solve [kg]; `loads`: as ImplicitSettings::loads.
  HostField(const FieldParts<T>& parts, const SoilBodies& bodies, int threads, double lightest, bool loads);

  void begin(double dt, bool other_blocks) override;
  std::vector<Node>& nodes() override { return nodes_; }
  void take_rows() override {}
  void meet() override;
  void show() override {}
  void take_back() override {}
  void go_on(T factor) override;
  void sweep(bool backwards, const std::vector<std::uint8_t>& marked,
             std::vector<mpm_kernel::SweepChange>& changes) override;
  void end_sweeps() override {}
  void add_to_held(HeldImpulses& held) override { cells_.add_to_held(held); }
  void finish(double dt, SoilDeeds& deeds) override;
  double of_hoops() const override { return cells_.of_hoops(); }
  bool put_out() override { return parts_.out.put(parts_.sets, parts_.grid, threads_); }

 private:
  mpm_kernel::SoilBlock<T> block_at(int block);
  void load();
  SoilDeeds store(int block, double dt);

  FieldParts<T> parts_;
  SoilCells<T> cells_;
  int threads_;
  double lightest_;
  bool loads_;
  std::vector<Node> nodes_;
  std::vector<Node> before_;      ///< as the last pair of sweeps began with them
  std::vector<SoilDeeds> deeds_;  ///< deeds of each block
};

}  // namespace mpm
