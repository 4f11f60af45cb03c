// Contact of the material with one rigid body: nodes that carry mass and lie in the body (signed distance <= 0) take
// the body's velocity along its exact normal, and along the surface as friction allows.
//
// What is reported is what was applied: the wrench is the sum over nodes of the momentum that contact changed in
// momentum_updated (and takes from XPIC's increments), over the time it took; torque about the body's origin as it
// moves; the same sums, weighted by the normal part, give the centre of pressure. In an axisymmetric scene the normal
// of a node on the axis has no radial part (Nairn & Guilkey (2015) section 3.3), and reports leave out what cancels
// around the axis; the account keeps it, as radial momentum. Weak: a surface between two rows of nodes is met up to a
// cell early; material on both sides of a tool thinner than three cells shares nodes. Source: Nairn, GIMP notes
// (3.12)-(3.20); method reference 5.3, 8.3; the normal is the exact one instead of a mass gradient.
#pragma once

#include <vector>

#include "mpm/contact/contact_report.hpp"
#include "mpm/grid/fields.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/rigid/rigid_body.hpp"
#include "mpm/step/coulomb.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

class RigidContact final : public Stage {
 public:
  /// `body` and `fields` outlive the stage. Solid stands for every geometry that is not axisymmetric.
  RigidContact(const RigidBody& body, Fields& fields, int threads, GeometryKind geometry = GeometryKind::solid);

  void momentum_gathered(StepContext& context) override;
  void before_strain(StepContext& context) override;
  void momentum_updated(StepContext& context) override;
  void velocity_found(StepContext& context, NodalField& velocity) override;
  void increment_found(StepContext& context, NodalField& increment) override;
  void grid_advanced(StepContext& context) override;
  void accounts(std::vector<ImpulseAccount>& list) const override { list.push_back(account_); }

  /// What the material did to the body since the last call; `now` [s].
  ContactReport take(double now);
  /// Work of the body on the material since the start: impulse times the body's velocity where it acts [J].
  double work() const { return work_; }

 private:
  struct Node {
    int field;
    NodeRef ref;
    Vec3 normal;    ///< out of the body
    Vec3 velocity;  ///< of the body's surface there [m/s]
    Vec3 arm;       ///< from the body's origin [m]
    Hold hold;
  };
  struct NearBlock {
    int field, block;
  };
  /// visit(node, grid of its field)
  template <class Visit>
  void each_node(Visit&& visit);
  /// Books what one node was given.
  void give(const Node& node, const Vec3& impulse);
  /// What is left of a sum over the whole body.
  Vec3 whole(const Vec3& sum) const { return axisymmetric_ ? Vec3(0.0, 0.0, sum.z()) : sum; }

  const RigidBody& body_;
  Fields& fields_;
  int threads_;
  bool axisymmetric_;
  std::vector<NearBlock> near_;           ///< blocks whose nodes may lie in the body
  std::vector<std::vector<Node>> nodes_;  ///< of each block in near_
  std::vector<HeldNodes> held_;           ///< of each field
  ImpulseAccount account_;                ///< given to the material
  Vec3 given_ = Vec3::Zero();             ///< in this step [N s]
  Vec3 given_angular_ = Vec3::Zero();     ///< about the body's origin [N m s]
  double work_ = 0.0;

  Vec3 impulse_ = Vec3::Zero();          ///< on the body since the last report [N s]
  Vec3 angular_impulse_ = Vec3::Zero();  ///< [N m s]
  Vec3 friction_ = Vec3::Zero();         ///< the part of impulse_ along the surface [N s]
  double pressed_ = 0.0;                 ///< normal impulses since the last report [N s]
  Vec3 pressed_arm_ = Vec3::Zero();      ///< arms times those magnitudes [N s m]
  Wrench peak_;
  int touching_ = 0;
  double last_report_ = 0.0;
};

}  // namespace mpm
