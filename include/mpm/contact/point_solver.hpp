// Solves for the impulses at points of the material's surface, all together: projected Gauss-Seidel, sweeps over the
// points to and fro. At a point the grid has the mean velocity of the nodes around it (step/point_weights.hpp), and an
// impulse there goes to the same nodes with the same weights.
//
// The points of one block of the grid follow each other, and blocks are taken by colour, so that blocks of one colour
// share no node: many points are solved on several threads, with the same bits for any number of them.
//
// A body that is free is solved with them: its velocity is an unknown as those of the nodes are, so a point gives way
// by the nodes' part and by the body's, n.(1/M + (r x n) I^-1 (r x n)) along the normal, and an impulse pushes both.
// Sweeps are then the steps of a nonlinear conjugate gradient method (contact/conjugate_sweeps.hpp), since what is
// light couples all that touch it, and run on one thread.
//
// Sweeps end when one changes velocities by kTolerance of the largest, or after kSweeps: what is left is less
// approach than needed, made good in the next steps; momentum is exact. Ten sweeps are enough: forces on a tool differ
// from those of forty by 0.3 %, and both by 2 % from those of six hundred (speed_tool_3d).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/contact/conjugate_sweeps.hpp"
#include "mpm/contact/contact_point.hpp"
#include "mpm/grid/fields.hpp"
#include "mpm/rigid/contact_law.hpp"
#include "mpm/rigid/free_motion.hpp"
#include "mpm/shape/kind.hpp"
#include "mpm/step/coulomb.hpp"
#include "mpm/step/step_context.hpp"

namespace mpm {

class PointSolver {
 public:
  struct Point {
    Vec3 normal;                   ///< out of the body
    Vec3 velocity;                 ///< of the body there, if it is prescribed [m/s]
    Vec3 impulse = Vec3::Zero();   ///< on the material [N s]
    double allowed = 0.0;          ///< velocity along the normal that it has at least [m/s]
    double compliance = 0.0;       ///< velocity at the point by an impulse there [1/kg]
    double with_body[2] = {};      ///< the same with that of a free body: along the normal, at most along the surface
    double friction = 0.0;         ///< coefficient that holds now
    double adhesion = 0.0;         ///< impulse that may pull [N s]
    bool sticks = false;           ///< no sliding while pressed
    Hold hold = Hold::free;        ///< in the step before, then in this one
    int found = 0;                 ///< its place among the points that were found
    int first = 0, end = 0;        ///< its parts in parts_
    FreeMotion* motion = nullptr;  ///< of its body, if that is free
    Vec3 place;                    ///< world [m]
  };
  enum class Pass {
    step,      ///< impulses >= 0, friction: decides who is held
    strain,    ///< who is held keeps to the surface, others as in step
    held,      ///< who is held keeps to the surface
    increment  ///< the same of a velocity that is added to one that does
  };
  using Member = NodalField Grid::*;

  /// `fields` outlives this.
  PointSolver(Fields& fields, ShapeKind shape, int threads) : fields_(fields), shape_(shape), threads_(threads) {}

  /// Takes the points found, in its own order and without those that have no node with mass around them.
  void connect(const std::vector<ContactPoint>& found);
  std::vector<Point>& points() { return points_; }
  const std::vector<Point>& points() const { return points_; }

  /// Takes the nodes' velocities from that member of their fields.
  void load(Member from);
  /// Adds what has changed since load().
  void store(Member to, double factor = 1.0);
  Vec3 velocity_at(const Point& point) const;
  /// Gives the points' impulses to nodes, and to bodies that are free.
  void push_all();
  /// Points of bodies that are free know what these give way by (after FreeMotion::predict).
  void find_compliance_with_bodies();
  /// `free`: some body is free, and its velocity is one more unknown.
  void solve(Pass pass, bool free);
  /// Threads that took part in the last solution; 0 before the first one that had a point.
  int solving_threads() const { return solving_threads_; }

 private:
  /// A node's part in a point.
  struct Part {
    int node;  ///< in nodes_
    double weight;
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
  /// What a sweep has done.
  struct Progress {
    double largest = 0.0;  ///< change of a velocity [m/s]
    double scale = 0.0;    ///< the largest velocity that an impulse gives its point [m/s]
  };

  /// That are worth while for so many points.
  int threads_for(int points) const;
  void find_weights(const std::vector<ContactPoint>& found);
  /// Which points belong together, in the order in which they are solved.
  void cluster(const std::vector<ContactPoint>& found);
  void add(const ContactPoint& point, int found);
  template <bool Free>
  void push(const Point& point, const Vec3& impulse);
  /// One point, once; the velocity that it changed by [m/s].
  template <Pass Kind, bool Free>
  double relax(Point& point);
  template <Pass Kind, bool Free>
  void relax(const Cluster& cluster, bool back, Progress& progress);
  template <Pass Kind>
  void sweep_prescribed();
  template <Pass Kind>
  void sweep_free();

  Fields& fields_;
  ShapeKind shape_;
  int threads_;
  int solving_threads_ = 0;
  std::vector<Point> points_;
  std::vector<Part> parts_;
  std::vector<Node> nodes_;
  std::vector<NodeOrigin> origins_;    ///< of nodes_
  std::vector<Cluster> clusters_;      ///< by colour
  std::array<int, 9> colour_begin_{};  ///< in clusters_
  SweepMemory sweeps_;

  // Kept so that a step allocates nothing.
  std::vector<Part> found_parts_;  ///< of each point found, stride_ each; nodes by their place in the field
  std::vector<int> found_count_, found_block_;
  int stride_ = 0;
  std::vector<Cluster> unsorted_;
  std::vector<int> of_point_, order_;         ///< cluster of each point found; points found in order of solution
  std::vector<std::vector<int>> slot_;        ///< of each node of each field: its place in nodes_, or -1
  std::vector<std::vector<int>> cluster_of_;  ///< of each block of each field: its place in unsorted_, or -1
};

}  // namespace mpm
