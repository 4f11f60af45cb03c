// Contact of the material with rigid bodies at points of the material's surface: on each particle near a body, the
// point nearest to it (contact/point_search.hpp). There the velocity that the grid has at that very place, by hat
// functions, may at most close the gap in a step, and slides as friction allows. The impulses that ensure this are
// spread to nodes by the same functions, by which internal forces end at the surface of a filled cell: so a uniform
// stress is in equilibrium wherever the surface lies between the nodes, and nothing acts before surfaces meet.
//
// All bodies are solved together: impulses >= 0 along the exact normals, within the cone of friction
// (contact/point_solver.hpp), beginning with the forces of the step before (contact/point_memory.hpp).
//
// Friction falls from that at rest to that of sliding over a thousandth of a cell of slip (slip weakening). The shares
// of two neighbouring points in a load are not determined; without weakening sliding would spread at once from the
// first point that gives way.
//
// While strain is updated, points that were held stay held and open ones may not close more than their gap
// (step/coulomb.hpp says why). The velocity of a free body is then found together with them, as in the step,
// and forgotten: by that with which a light body falls, strain would get several times the energy of the fall. A free
// body keeps the velocity that the solution gave it, because that velocity moves it. Increments of XPIC and FMPM are
// solved together with free bodies too, since they exchange momentum.
//
// Friction takes the impulse along the surface times the mean slip before and after it. The slip before is that at the
// end of the step before. Between two steps particles and nodes exchange velocities; the work of the impulse on this
// change, J.dv / 2, belongs to the transfer and is not friction. So a point that sticks in both steps takes no energy.
// A new point begins with the slip of the gathered velocities.
//
// In scenes with laws between deformable bodies, or with cracks, the tools' forces of the step before are added to the
// nodes' forces, and the solution corrects them. Pairs and the faces of cracks act before tools, and in this way know
// how hard tools press.
//
// What else is lost, of motion that is held up and of particles that move past a point which is held, is the account
// `contact_loss`: all that the material loses by the work of the impulse and of the step's forces, as
// step/node_loss.hpp derives it for nodes, less friction and cutting. At a point p, with weights w of nodes,
//   -J.(U0 + U1)/2 + a (I0.D - J.c0) + b (I1.D - J.c1),   D = sum w (dv - g dt),
// U the slip sum w V - v that particles have at the ends of the step, c the change of sum w V that contact makes there
// for strain, and I the impulses by which it does. (F dt is m (dv - g dt) less all impulses of contact; summed over
// points, which share nodes, F dt.c is I.D - J.c.) With USF, whose particles are not gathered again in the step, U1 is
// the U0 of the next step at the same particle: the account is complete a step later, takes the two steps to be as
// long, and leaves this term out for a particle that has no point then.
//
// A point that comes under a surface from beside it, or starts there, keeps its initial overlap.
//
// Where a face ends, points see the part of their nodes that lies before it (contact/edge_cover.hpp); the energy that
// goes where material is cut at an edge is booked beside friction.
//
// Weak: A particle drawn into a body is pushed out slowly (kPushOut), and one near an edge, which moves slower than the
// face, not at all: it passes under the edge. A block that slides with friction vibrates more
// than with contact at nodes. Source: contact as impulses at points with complementarity is usual for rigid bodies
// (Moreau, Jean: non-smooth contact dynamics); the law at a point is GIMP notes (3.12)-(3.20), method reference 8.3,
// without its node.
#pragma once

#include <string>
#include <vector>

#include "mpm/contact/contact_reporter.hpp"
#include "mpm/contact/free_bodies.hpp"
#include "mpm/contact/point_memory.hpp"
#include "mpm/contact/point_search.hpp"
#include "mpm/contact/point_solver.hpp"
#include "mpm/step/heat_sink.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

struct PointContactSettings {
  GeometryKind geometry = GeometryKind::solid;
  ShapeKind shape = ShapeKind::ugimp;
  double across = 1.0;  ///< thickness [m] of a plane, area [m^2] of a line
  int threads = 1;
  Vec3 gravity = Vec3::Zero();         ///< acts on free bodies [m/s^2]
  bool with_pairs = false;             ///< true if deformable bodies have laws with each other, or there are cracks
  HeatSink* heat = nullptr;            ///< receiver of friction and touch, if there is heat
  bool sharp_edges = true;             ///< true if points see that faces end (contact/edge_cover.hpp)
  Communicator* ranks = nullptr;       ///< communicator of a run over several ranks; else null
  BodyContactSettings meeting;         ///< contact of rigid bodies with each other and with walls
  const NodeChoice* choice = nullptr;  ///< choice of particles near cracks, which divide() then tells of; else null
};

class PointContact final : public Stage, public ContactReporter {
 public:
  /// Bodies, sets and fields must outlive the stage. `laws`: one for each body and set, those of one body together.
  PointContact(std::vector<RigidBody*> bodies, const std::vector<ParticleSet>& sets, Fields& fields,
               std::vector<ContactLaw> laws, const PointContactSettings& settings);

  /// Tells on which side of cracks material is; `sides` must outlive the stage.
  void divide(const SideOfCracks& sides) { solver_.divide(sides); }

  std::string name() const override { return "point_contact"; }
  Ranks ranks(Hook) const override { return {Rank::rigid_body}; }
  bool same_on_all_ranks() const override { return true; }

  void momentum_gathered(StepContext& context) override;
  void before_strain(StepContext& context) override;
  void forces_gathered(StepContext& context) override;
  void momentum_updated(StepContext& context) override;
  void velocity_found(StepContext& context) override;
  void increment_found(StepContext& context) override;
  void grid_advanced(StepContext& context) override;
  void accounts(std::vector<ImpulseAccount>& list) const override;
  void energies(EnergyReport& report) const override;
  ContactLedger* ledger_of(const RigidBody& body) override;
  void check_put(const RigidBody& body) const override { free_.check_overlaps(body); }
  void body_put(const RigidBody& body) override;
  void serialise(StateArchive& archive) override;

  const PointSolver& solver() const { return solver_; }

 private:
  using Pass = PointSolver::Pass;
  /// A point at one end of the step.
  struct End {
    Vec3 slip = Vec3::Zero();     ///< slip of the material, as particles carry it, against the body [m/s]
    Vec3 change = Vec3::Zero();   ///< change of that slip by contact, for strain [m/s]
    Vec3 impulse = Vec3::Zero();  ///< by which contact makes that change [N s]
  };
  /// Data that the stage keeps for each point of the solver, in the same order.
  struct Contact {
    const ContactPoint* found;
    Vec3 start = Vec3::Zero();    ///< impulse that the step's solution begins with [N s]
    Vec3 before = Vec3::Zero();   ///< relative velocity before the impulses [m/s]
    Vec3 cut = Vec3::Zero();      ///< part of that which the nodes do not carry [m/s]
    End first, last;              ///< the two ends of the step
    Vec3 impulse = Vec3::Zero();  ///< on the material in the step [N s]
    Vec3 gained = Vec3::Zero();   ///< change of velocity in the step, without that by gravity [m/s]
    bool acted = false;           ///< true if the impulses of the step have been found
    double gap = 0.0;             ///< counted from the initial overlap [m]
    double slid = 0.0;            ///< slip since the point was at rest [m]
    double overlap = 0.0;         ///< initial overlap, <= 0 [m]
  };

  /// Sets the point's law for this step and returns its data; `memory`: null if it had no point in the step before.
  Contact recall(const ContactPoint& found, const PointMemory::Entry* memory, PointSolver::Point& point,
                 double dt) const;
  /// Energy that the material loses at a point by one end of the step, which has this part of the strain [J].
  static double lost(const Contact& contact, const End& end, double strain);
  void clear_impulses();
  /// Sets the impulses that the step's solution begins with.
  void begin_impulses();
  /// Books the impulse of a point whose body moves with `velocity` there.
  void give(std::size_t point, const Vec3& velocity, const Vec3& mean_slip);

  std::vector<RigidBody*> bodies_;
  std::vector<const RigidBody*> surfaces_;  ///< the same, for the search
  const std::vector<ParticleSet>& sets_;
  Fields& fields_;
  HeatSink* heat_;
  std::vector<ContactLaw> laws_;
  std::vector<FrictionLaw> laws_now_;
  std::vector<ContactLedger> ledgers_;
  double cell_;       ///< the smallest edge [m]
  double cut_ = 0.0;  ///< energy taken at edges since the start [J]
  bool with_pairs_;   ///< as in the settings
  Vec3 gravity_;      ///< [m/s^2]
  PointSearch search_;
  PointSolver solver_;
  PointMemory memory_;
  FreeBodies free_;
  std::vector<Contact> contacts_;
};

}  // namespace mpm
