// Contact of the material with rigid bodies at points of the material's surface: on each particle near a body, the
// point nearest to it (particle_reach.hpp). There the velocity that the grid has at that very place, by hat functions,
// may close the gap in a step and no more, and slides as friction allows. The impulses that keep to this are spread to
// nodes by the same functions, which are also those that internal forces of a filled cell end with: so a uniform stress
// is in equilibrium wherever the surface lies between the nodes, and nothing acts before surfaces meet.
//
// All bodies are solved together: impulses >= 0 along the exact normals, within the cone of friction, by sweeps over
// the points to and fro (projected Gauss-Seidel) that begin with the forces of the step before. What the sweeps leave
// (a part kTolerance of the approach) is less approach than needed, made good in the next steps; momentum is exact.
//
// Friction falls from that at rest to that of sliding over a thousandth of a cell of slip (slip weakening): which of
// two neighbouring points bears how much is not determined, and what gave way at once would tear along the surface.
//
// While strain is updated, points that were held stay held and open ones may not close more than their gap
// (step/coulomb.hpp says why). Friction at rest and adhesion are remembered by particle.
//
// A sharp edge divides what it meets: a particle beside one is there with its centre, not with its reach. What comes
// under a surface from beside it, or starts there, keeps the overlap that it came with.
//
// A body that is free is solved with them: its velocity is an unknown as those of the nodes are, so a point gives way
// by the nodes' part and by the body's, n.(1/M + (r x n) I^-1 (r x n)) along the normal, and an impulse pushes both.
// Sweeps are then the steps of a nonlinear conjugate gradient method (contact/conjugate_sweeps.hpp), since what is
// light couples all that touch it. While strain is updated the body keeps the velocity that this solve gave it: it is
// the one that moves it. Increments of XPIC and FMPM are solved with it too, since what they give is momentum.
//
// Weak: a particle has one point a body: in an inner corner the one at the nearer face. An edge that cuts is blunt by
// up to a cell, since particles above and below it share nodes. A particle drawn into a body is pushed out slowly
// (kPushOut). A block that slides with friction swings more than with contact at nodes.
// Source: contact as impulses at points with complementarity is usual for rigid bodies (Moreau, Jean: non-smooth
// contact dynamics); the law at a point is GIMP notes (3.12)-(3.20), method reference 8.3, without its node.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mpm/contact/conjugate_sweeps.hpp"
#include "mpm/contact/contact_reporter.hpp"
#include "mpm/grid/fields.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/shape/kind.hpp"
#include "mpm/step/coulomb.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

struct PointContactSettings {
  GeometryKind geometry = GeometryKind::solid;
  ShapeKind shape = ShapeKind::ugimp;
  double across = 1.0;  ///< thickness [m] of a plane, area [m^2] of a line
  int threads = 1;
  /// Of each body, the body itself if some of its velocities are free, else null.
  std::vector<RigidBody*> free;
  Vec3 gravity = Vec3::Zero();  ///< on bodies that are free [m/s^2]
};

class PointContact final : public Stage, public ContactReporter {
 public:
  /// Bodies, sets and fields outlive the stage. `laws`: of each body against each set, the sets of a body together.
  PointContact(std::vector<const RigidBody*> bodies, const std::vector<ParticleSet>& sets, Fields& fields,
               std::vector<ContactLaw> laws, const PointContactSettings& settings);

  std::string name() const override { return "point_contact"; }
  Ranks ranks(Hook) const override { return {Rank::rigid_body}; }

  void momentum_gathered(StepContext& context) override;
  void before_strain(StepContext& context) override;
  void momentum_updated(StepContext& context) override;
  void velocity_found(StepContext& context) override;
  void increment_found(StepContext& context) override;
  void grid_advanced(StepContext& context) override;
  void accounts(std::vector<ImpulseAccount>& list) const override;
  void energies(EnergyReport& report) const override;
  ContactLedger* ledger_of(const RigidBody& body) override;
  void keep(StateArchive& archive) override;

 private:
  struct Point {
    int body = 0, field = 0;
    int law = 0;                   ///< in laws_now_
    std::uint32_t particle = 0;    ///< its id
    Vec3 place, normal;            ///< world [m]; out of the body
    Vec3 velocity;                 ///< of the body there [m/s]
    double gap = 0.0;              ///< negative inside [m]
    double area = 0.0;             ///< of the surface that the point stands for [m^2]
    int first = 0, end = 0;        ///< its parts in parts_
    double compliance = 0.0;       ///< velocity at the point by an impulse there [1/kg]
    double with_body[2] = {};      ///< the same with that of a free body: along the normal, at most along the surface
    Vec3 impulse = Vec3::Zero();   ///< on the material [N s]
    Vec3 approach = Vec3::Zero();  ///< relative velocity before the impulses [m/s]
    double slid = 0.0;             ///< since it was at rest [m]
    double overlap = 0.0;          ///< that it came with, <= 0; gap is counted from there [m]
    bool adheres = false;          ///< it was held in the step before, or touches
    Hold hold = Hold::free;        ///< in the step before, then in this one
  };
  /// A node's part in a point.
  struct Part {
    int node;  ///< in nodes_
    double weight;
    double lifted;  ///< weight over mass [1/kg]
  };
  struct Node {
    int field;
    NodeRef ref;
    double inverse_mass;  ///< [1/kg]
  };
  /// What is kept of a point.
  struct Memory {
    std::uint64_t id;  ///< of particle and body
    Vec3 force;        ///< on the material [N]
    double slid;       ///< since it was at rest [m]
    double overlap;
    Hold hold;
  };
  struct NearBlock {
    int field, owner;  ///< the owner among those of its field
  };
  enum class Pass {
    step,      ///< impulses >= 0, friction: decides who is held
    strain,    ///< who is held keeps to the surface, others as in step
    held,      ///< who is held keeps to the surface
    increment  ///< the same of a velocity that is added to one that does
  };
  using Member = NodalField Grid::*;

  void find_blocks(const GridLayout& layout, double band);
  void find_points(const StepContext& context);
  template <class Geometry>
  void find_points_in(const StepContext& context);
  /// Nodes and parts of the points found, and what is remembered of them.
  void connect(const StepContext& context);
  void recall(Point& point, double dt) const;
  /// Takes the nodes' velocities from that member of their fields.
  void load(Member from);
  /// Adds what has changed since load().
  void store(Member to, double factor = 1.0);
  Vec3 velocity_at(const Point& point) const;
  /// `Free`, of this and what follows: some body is free, and its velocity is one more unknown.
  template <bool Free>
  void push(const Point& point, const Vec3& impulse);
  /// How fast the point may approach (negative) or has to be moved out [m/s].
  double allowed(const Point& point, double dt) const;
  /// One point, once; the velocity that it changed by [m/s].
  template <Pass Kind, bool Free>
  double relax(Point& point, double dt);
  template <Pass Kind, bool Free>
  void solve(double dt);
  template <bool Free>
  void decide(StepContext& context);
  void give(const Point& point, const Vec3& mean_slip);

  /// Null for a body that only moves as it is told.
  FreeMotion* free_motion(int body) const {
    return settings_.free[body] != nullptr ? settings_.free[body]->free_motion() : nullptr;
  }
  /// Velocities of free bodies without contact, and what that they give way adds to the points' compliances.
  void predict_free(double dt);
  void solve_increment_free(double dt);
  /// What the point gave to its body, if that is free.
  void take_free(const Point& point, const Vec3& mean_slip);
  void finish_free();

  std::vector<const RigidBody*> bodies_;
  const std::vector<ParticleSet>& sets_;
  Fields& fields_;
  PointContactSettings settings_;
  std::vector<ContactLaw> laws_;
  std::vector<FrictionLaw> laws_now_;
  std::vector<ContactLedger> ledgers_;
  double push_out_ = 0.0;   ///< [m] a step at most
  double touching_ = 0.0;   ///< [m]
  double at_rest_ = 0.0;    ///< [m] a step
  double weakening_ = 0.0;  ///< [m]

  std::vector<NearBlock> near_;               ///< blocks with particles near a body
  std::vector<std::vector<Point>> of_block_;  ///< their points
  std::vector<Point> points_;
  std::vector<Part> parts_;
  std::vector<Node> nodes_;
  std::vector<std::vector<int>> slot_;                    ///< of each node of each field: its place in nodes_, or -1
  std::vector<std::array<double, 3>> velocity_, loaded_;  ///< of nodes_ [m/s]
  std::vector<Memory> memory_;                            ///< by id
  std::vector<Vec3> kept_;                                ///< impulses, while strain is updated [N s]

  /// What contact gave to a free body in the step.
  struct Taken {
    BodyMomentum impulse;
    double loss = 0.0;  ///< [J]
  };
  bool any_free_ = false;
  std::vector<Taken> taken_;  ///< of each body
  SweepMemory sweeps_;
};

}  // namespace mpm
