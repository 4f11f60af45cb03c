// The axis of an axisymmetric scene as a condition: nothing moves through r = 0, so nodes there have no radial
// velocity. It is set by itself wherever the grid begins at the axis. Nodes beyond the axis have mass only when planar
// functions or whole domains are asked for; what they do then is a choice (shape/axis_rules.hpp, AxisGhosts).
//
// Its impulse is radial, summed all the way round, as is that of the hoop stress: neither is a momentum of the body,
// which has one along z alone, but with both the audit closes along r too.
// Source: Nairn & Guilkey (2015), check list 2, and 4.1 for the nodes beyond.
#pragma once

#include <vector>

#include "mpm/shape/axis_rules.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

/// Reason why a particle near the axis is outside the grid.
std::optional<OutsideReason> outside_at_axis(const GridLayout& layout, const ParticleSet& set, int particle);

class Axis final : public FieldStage {
 public:
  explicit Axis(AxisGhosts ghosts) : ghosts_(ghosts) { account_.name = "axis"; }

  std::string name() const override { return account_.name; }
  Ranks ranks(Hook hook) const override { return holding(hook, Rank::axis, Rank::axis_again); }

  void momentum_gathered(FieldContext& context) override;
  void before_strain(FieldContext& context) override;
  void momentum_updated(FieldContext& context) override;
  void velocity_found(FieldContext& context) override;
  void increment_found(FieldContext& context) override;
  void grid_advanced(FieldContext& context) override;
  void accounts(std::vector<ImpulseAccount>& list) const override { list.push_back(account_); }
  std::optional<OutsideReason> why_outside(const GridLayout& layout, const ParticleSet& set,
                                           int particle) const override {
    return outside_at_axis(layout, set, particle);
  }
  void serialise(StateArchive& archive) override {
    account_.serialise(archive);
    archive.sum("given", given_);
  }

 private:
  struct Node {
    NodeRef ref;
    NodeRef twin;  ///< the node whose radial velocity it has, with the other sign; block -1: it has none
  };
  /// The radial velocity that the condition gives the node in this field.
  static double wanted(const NodalField& velocity, const Node& node);
  /// Gives it to all nodes.
  void hold(NodalField& velocity) const;

  AxisGhosts ghosts_;
  ImpulseAccount account_;
  double given_ = 0.0;  ///< radial, in this step [N s]
  std::vector<Node> nodes_;
  std::uint64_t generation_ = 0;  ///< generation of the block table that nodes_ was made from
};

/// Books the radial impulse of the internal forces, which is that of the hoop stress (their sum over the nodes is zero
/// but for it). Comes before whoever adds forces to the grid.
class HoopForce final : public FieldStage {
 public:
  HoopForce() { account_.name = "hoop stress"; }
  std::string name() const override { return account_.name; }
  Ranks ranks(Hook) const override { return {Rank::hoop_stress}; }

  void forces_gathered(FieldContext& context) override;
  void accounts(std::vector<ImpulseAccount>& list) const override { list.push_back(account_); }
  void serialise(StateArchive& archive) override { account_.serialise(archive); }

 private:
  ImpulseAccount account_;
};

/// Books the force and the weight on nodes that take no part because they have no mass or a negative one
/// (Grid::carries). They are lost to the material. The weight r makes such nodes beside the axis: a corner of a qCPDI
/// domain that touches the axis has no weight but a gradient, and a domain that reaches across it has negative weights
/// beyond. Comes after whoever adds forces to the grid. Weak: what PIC and APIC lose of such nodes' momentum is not in
/// it.
class MasslessNodes final : public FieldStage {
 public:
  explicit MasslessNodes(const Vec3& gravity) : gravity_(gravity) { account_.name = "massless nodes"; }
  std::string name() const override { return account_.name; }
  Ranks ranks(Hook) const override { return {Rank::massless_node}; }

  void forces_gathered(FieldContext& context) override;
  void accounts(std::vector<ImpulseAccount>& list) const override { list.push_back(account_); }
  void serialise(StateArchive& archive) override { account_.serialise(archive); }

 private:
  Vec3 gravity_;  ///< [m/s^2]
  ImpulseAccount account_;
};

}  // namespace mpm
