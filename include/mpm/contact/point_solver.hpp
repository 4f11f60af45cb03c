// Solves for the impulses at points of the material's surface, all together: projected Gauss-Seidel, sweeps over the
// points to and fro. At a point the grid has the mean velocity of the nodes around it (step/point_weights.hpp), and an
// impulse there goes to the same nodes with the same weights; near the edge of a face as contact/edge_cover.hpp has it.
//
// The points of one block of the grid follow each other, and blocks are taken by colour, so that blocks of one colour
// share no node: many points are solved on several threads, with the same bits for any number of them. With cubic
// splines and a point near an edge one thread solves them.
//
// Near a crack a point acts, at each node around it, on the field that its particle has there
// (step/material_nodes.hpp): fields of one body are at the same nodes, so colours hold for them, too.
//
// The velocity of a free body is an unknown like those of the nodes: the compliance of a point is the sum of the nodes'
// part and the body's, n.(1/M + (r x n) I^-1 (r x n)) along the normal, and an impulse changes both. Sweeps are then
// the steps of a nonlinear conjugate gradient method (contact/conjugate_sweeps.hpp), since a light body couples all
// points that touch it, and they run on one thread.
//
// Sweeps end when one changes velocities by at most kTolerance of the largest, or after kSweeps. With a free body they
// also end when the force and the torque on every body, free or not, have stopped changing (steady()): single points
// may go on for hundreds of sweeps, at the limit between sticking and sliding or where more points meet than the nodes
// around them have motions. What such points do to the material under one body is then less accurate than what the body
// meets. The remaining error is
// a small approach, which the next steps correct; momentum is exact. Ten sweeps are enough: forces on a tool differ
// from those of forty by 0.3 %, and both by 2 % from those of six hundred (speed_tool_3d).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/contact/body_contact.hpp"
#include "mpm/contact/conjugate_sweeps.hpp"
#include "mpm/contact/contact_point.hpp"
#include "mpm/contact/edge_cover.hpp"
#include "mpm/contact/row_impulse.hpp"
#include "mpm/grid/fields.hpp"
#include "mpm/rigid/contact_law.hpp"
#include "mpm/rigid/dynamic_motion.hpp"
#include "mpm/shape/kind.hpp"
#include "mpm/step/coulomb.hpp"
#include "mpm/step/material_nodes.hpp"
#include "mpm/step/step_context.hpp"

namespace mpm {

class PointSolver {
 public:
  struct Point {
    Vec3 normal;                  ///< out of the body
    Vec3 velocity;                ///< velocity of the body there, if its motion is prescribed [m/s]
    Vec3 impulse = Vec3::Zero();  ///< on the material [N s]
    double allowed = 0.0;         ///< least velocity along the normal [m/s]
    double compliance = 0.0;      ///< velocity at the point by an impulse there [1/kg]
    double with_body[2] =
        {};  ///< compliance with that of a free body: along the normal, and the largest along the surface
    double friction = 0.0;            ///< coefficient in this step
    double adhesion = 0.0;            ///< largest pulling impulse [N s]
    bool sticks = false;              ///< no sliding while pressed
    bool at_edge = false;             ///< true if a node of it lies in part beyond an edge
    Hold hold = Hold::free;           ///< in the step before, then in this one
    int found = 0;                    ///< index among the points that were found
    int body = 0;                     ///< index among the bodies
    int first = 0, end = 0;           ///< its parts in parts_
    DynamicMotion* motion = nullptr;  ///< motion that impulses change; null where it is prescribed
    Vec3 place;                       ///< world [m]
    Vec3 start = Vec3::Zero();        ///< velocity that the point takes from nodes before the impulses [m/s]
  };
  using Pass = ContactPass;
  using Member = NodalField Grid::*;

  /// `fields` and `bodies` must outlive this object. `sharp`: whether points see that faces end (edge_cover.hpp).
  PointSolver(Fields& fields, const std::vector<const RigidBody*>& bodies, GeometryKind geometry, ShapeKind shape,
              bool sharp, int threads)
      : fields_(fields),
        bodies_(bodies),
        edges_(bodies, geometry, fields.front()->layout.smallest_cell()),
        sharp_(sharp),
        shape_(shape),
        threads_(threads),
        on_bodies_(bodies.size()) {}

  /// Tells of cracks, which divide material near points; `sides` must outlive this object.
  void divide(const SideOfCracks& sides) { sides_ = &sides; }
  /// Takes over the points found, in the order of solution and without those that have no node with mass around them.
  void connect(const std::vector<ContactPoint>& found);
  std::vector<Point>& points() { return points_; }
  const std::vector<Point>& points() const { return points_; }

  /// Reads the nodes' velocities from this member of their fields.
  void load(Member from);
  /// Adds the change of the nodes' velocities since load(), times `factor`.
  void store(Member to, double factor = 1.0);
  /// Velocity of the material as contact sees it [m/s].
  Vec3 velocity_at(const Point& point) const;
  /// The nodes' velocities, weighted as an impulse is spread [m/s]. Near an edge on a free surface this is not what
  /// contact sees: an impulse times the difference is the energy that is lost where material is cut (edge_cover.hpp).
  Vec3 carried_at(const Point& point) const;
  /// The nodes of the material at a point that was found, beside a crack those on its side.
  MaterialNodes nodes_of(const ContactPoint& point) const;
  /// Applies the points' impulses to nodes and to free bodies.
  void push_all();
  /// Applies them to free bodies alone.
  void push_bodies();
  /// Adds the points' impulses, times `factor`, to this member of their fields: a momentum or a force.
  void add_impulses(Member to, double factor);
  /// Adds the compliance of free bodies to that of their points. Call after FreeBodies::predict().
  void find_compliance_with_bodies();
  /// `free`: whether some body is free, so that its velocity is an unknown too. `bodies`: where bodies meet each other
  /// in this step, which is solved with the points; null without.
  void solve(Pass pass, bool free, BodyContact* bodies = nullptr);
  /// Threads that took part in the last solution; 0 before the first one that had a point.
  int solving_threads() const { return solving_threads_; }

 private:
  /// A node of a point.
  struct Part {
    int node;        ///< in nodes_
    double weight;   ///< part of an impulse
    double reading;  ///< factor of its velocity
  };
  /// A node whose velocity before the impulses a point sees.
  struct Start {
    int point, node;  ///< in points_, in nodes_
    double factor;
  };
  struct alignas(32) Node {
    std::array<double, 3> velocity;  ///< [m/s]
    double inverse_mass;             ///< [1/kg]
  };
  struct NodeOrigin {
    int field;
    NodeRef ref;
    std::array<double, 3> loaded;  ///< velocity [m/s]
  };
  /// The points of one block of a field, [first, end) of points_.
  struct Cluster {
    int field, block, colour, first, end;
  };
  /// Number of threads that pays for this number of points.
  int threads_for(int points) const;
  void find_weights(const std::vector<ContactPoint>& found);
  /// Puts the points of one block together, in the order in which they are solved.
  void cluster(const std::vector<ContactPoint>& found);
  void add(const ContactPoint& point, int found);
  template <bool Free>
  void push(const Point& point, const Vec3& impulse);
  /// Updates the impulse of one point. Returns the change of velocity [m/s].
  template <Pass Kind, bool Free>
  double relax(Point& point);
  template <Pass Kind, bool Free>
  void relax(const Cluster& cluster, bool back, SweepProgress& progress);
  template <Pass Kind>
  void sweep_prescribed();
  template <Pass Kind>
  void sweep_free(BodyContact* bodies);
  /// True if the last sweep changed no body's force and torque by more than a part of their sums of magnitudes.
  bool steady();

  Fields& fields_;
  const std::vector<const RigidBody*>& bodies_;
  EdgeCover edges_;
  bool sharp_;
  const SideOfCracks* sides_ = nullptr;
  ShapeKind shape_;
  int threads_;
  int solving_threads_ = 0;
  bool any_at_edge_ = false;  ///< true if a point lies near an edge
  std::vector<Point> points_;
  std::vector<Part> parts_;
  std::vector<Start> starts_;
  std::vector<Node> nodes_;
  std::vector<NodeOrigin> origins_;    ///< origin of each of nodes_
  std::vector<Cluster> clusters_;      ///< by colour
  std::array<int, 9> colour_begin_{};  ///< in clusters_
  SweepMemory sweeps_;
  /// Action of all points on a body: the change in the last sweep, and sums of magnitudes.
  struct OnBody {
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();  ///< [N s], [N m s]
    double all_force = 0.0, all_torque = 0.0;
  };
  std::vector<OnBody> on_bodies_;

  // Kept so that a step allocates nothing.
  std::vector<PointNode> found_nodes_;  ///< stride_ of them for each point found
  std::vector<int> found_count_, found_block_;
  std::vector<std::uint8_t> found_at_edge_;
  int stride_ = 0;
  std::vector<Cluster> unsorted_;
  std::vector<int> of_point_, order_;   ///< cluster of each point found; indices of points in the order of solution
  std::vector<std::vector<int>> slot_;  ///< for each node of each field its index in nodes_, or -1
  std::vector<std::vector<int>> cluster_of_;  ///< for each block of each field its index in unsorted_, or -1
};

}  // namespace mpm
