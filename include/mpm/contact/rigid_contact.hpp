// Contact of the material with one rigid body: nodes that carry mass and lie in the body (signed distance <= 0) take
// the body's velocity along its exact normal, and along the surface as friction allows.
//
// What is reported is what was applied: the wrench is the sum over nodes of the momentum that contact changed in
// momentum_updated (and takes from XPIC's increments), over the time it took; torque about the body's origin as it
// moves; the same sums, weighted by the normal part, give the centre of pressure. In an axisymmetric scene the normal
// of a node on the axis has no radial part (Nairn & Guilkey (2015) section 3.3), and reports leave out what cancels
// around the axis; the account keeps it, as radial momentum.
//
// A thin tool whose sides have a field each (tool_sides.hpp) is also in contact with nodes behind it, which a field's
// material reaches through it: those that the line from the node's mass centre meets the tool on the way to. The normal
// is that of the surface at the mass centre, the face that the material lies at.
//
// A tool in a crack has a field's material on one side of it, and nodes of that field on both: particles beside the
// tool reach nodes beyond its middle, where the surface faces the other way, and would be pushed through it. So in
// fields of bodies that cracks divide the normal of a node is that of the surface at its mass centre as well. (A wedge
// between the halves of a block had eight times the force that it has between two bodies, with contact at points.)
//
// Weak: a surface between two rows of nodes is met up to a cell early; material on both sides of a tool thinner than
// three cells shares nodes if it has one field. Source: Nairn, GIMP notes (3.12)-(3.20); method reference 5.3, 8.3; the
// normal is the exact one instead of a mass gradient.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "mpm/contact/contact_reporter.hpp"
#include "mpm/contact/tool_sides.hpp"
#include "mpm/grid/fields.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/rigid/rigid_body.hpp"
#include "mpm/step/coulomb.hpp"
#include "mpm/step/heat_sink.hpp"
#include "mpm/step/node_loss.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

class RigidContact final : public Stage, public ContactReporter {
 public:
  /// `body`, `fields` and `sides` must outlive the stage; `sides` is null in a scene without thin tools. `geometry`
  /// only tells axisymmetric scenes from others; `gravity` [m/s^2] serves the account of energy alone.
  RigidContact(const RigidBody& body, Fields& fields, int threads, GeometryKind geometry = GeometryKind::solid,
               const ToolSides* sides = nullptr, const Vec3& gravity = Vec3::Zero(), HeatSink* heat = nullptr);

  /// `fields`: one mark for each velocity field, not 0 where a normal is that at a node's mass centre. These need
  /// Grid::place on blocks that the body's bounds meet.
  void take_normals_at_centres(std::vector<std::uint8_t> fields) { centred_ = std::move(fields); }
  /// `fields`: one mark for each, not 0 for those of bodies that cracks and this thin tool divide, whose material is in
  /// another field at a node that it reaches through the tool.
  void divide(std::vector<std::uint8_t> fields) { divided_ = std::move(fields); }

  std::string name() const override { return ledger_.account().name; }
  Ranks ranks(Hook) const override { return {Rank::rigid_body}; }
  bool same_on_all_ranks() const override { return true; }

  void momentum_gathered(StepContext& context) override;
  void before_strain(StepContext& context) override;
  void momentum_updated(StepContext& context) override;
  void velocity_found(StepContext& context) override;
  void increment_found(StepContext& context) override;
  void grid_advanced(StepContext& context) override;
  void accounts(std::vector<ImpulseAccount>& list) const override { list.push_back(ledger_.account()); }
  void energies(EnergyReport& report) const override { ledger_.energies(report); }
  ContactLedger* ledger_of(const RigidBody& body) override { return &body == &body_ ? &ledger_ : nullptr; }
  void body_put(const RigidBody& body) override {
    if (&body != &body_) return;
    for (HeldNodes& held : held_) held.clear();
  }
  void serialise(StateArchive& archive) override;

  ContactLedger& ledger() { return ledger_; }

 private:
  struct Node {
    int field;
    NodeRef ref;
    Vec3 normal;    ///< out of the body
    Vec3 velocity;  ///< velocity of the body's surface there [m/s]
    Vec3 arm;       ///< from the body's origin [m]
    Hold hold;
    NodeLoss loss;  ///< in this step
  };
  struct NearBlock {
    int field, block;
  };
  Vec3 mass_centre(int field, NodeRef node) const;
  /// True if a node of a field, at a world place, is in contact if it approaches; then `point` is the surface there.
  /// `reach`: largest distance outside the body [m].
  bool touches(int field, NodeRef node, const Vec3& place, double reach, SurfacePoint& point) const;
  /// visit(node, grid of its field)
  template <class Visit>
  void each_node(Visit&& visit);
  /// Books what contact takes at a node.
  void lose(const Node& node, const Grid& grid, const SurfaceLoss& loss, double dt);
  /// Books the impulse on one node.
  void give(const Node& node, const Vec3& impulse);

  const RigidBody& body_;
  Fields& fields_;
  int threads_;
  bool axisymmetric_;
  Vec3 gravity_;  ///< [m/s^2]
  const ToolSides* sides_;
  const ThinTool* thin_;                  ///< the body as a thin tool, if its sides have a field each; else null
  std::vector<NearBlock> near_;           ///< blocks whose nodes may lie in the body
  std::vector<std::vector<Node>> nodes_;  ///< nodes of each block in near_
  std::vector<HeldNodes> held_;           ///< held nodes of each field
  std::vector<std::uint8_t> centred_;     ///< for each field, 1 if normals are those at its mass centres
  std::vector<std::uint8_t> divided_;     ///< for each field, 1 if its material is cracked and divided by the tool
  ContactLedger ledger_;
  HeatSink* heat_;
  int touching_ = 0;
};

}  // namespace mpm
