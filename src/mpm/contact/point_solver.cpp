#include "mpm/contact/point_solver.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/loop/loop.hpp"

namespace mpm {
namespace {

constexpr int kSweeps = 10;
constexpr double kTolerance = 1e-3;      ///< change of velocity in a sweep over the largest one, at which sweeps end
constexpr int kSweepsFree = 400;         ///< with a body that is free
constexpr double kToleranceFree = 1e-5;  ///< the same as kTolerance
constexpr double kSteady = 3e-5;         ///< change of a body's force in a sweep over the sum of magnitudes
constexpr int kSteadySweeps = 3;         ///< one after another, at which sweeps end: to and fro differ
constexpr int kPointsToSweep = 500;  ///< for each thread: fewer do not pay for the waiting at the end of every colour

}  // namespace

int PointSolver::threads_for(int points) const { return std::clamp(points / kPointsToSweep, 1, threads_); }

void PointSolver::load(Member from) {
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    NodeOrigin& origin = origins_[n];
    const Grid& grid = *fields_[origin.field];
    const Vec3 v = nodal_vector(grid.*from, grid.layout, origin.ref);
    nodes_[n].velocity = origin.loaded = {v.x(), v.y(), v.z()};
  }
  for (const Start& one : starts_) points_[one.point].start.setZero();
  for (const Start& one : starts_) {
    for (int k = 0; k < 3; ++k) points_[one.point].start[k] += one.factor * origins_[one.node].loaded[k];
  }
}

void PointSolver::store(Member to, double factor) {
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const NodeOrigin& origin = origins_[n];
    Grid& grid = *fields_[origin.field];
    Vec3 change;
    for (int k = 0; k < 3; ++k) change[k] = factor * (nodes_[n].velocity[k] - origin.loaded[k]);
    add_nodal_vector(grid.*to, grid.layout, origin.ref, change);
  }
}

Vec3 PointSolver::velocity_at(const Point& point) const {
  Vec3 v = point.start;
  for (int i = point.first; i < point.end; ++i) {
    const Node& node = nodes_[parts_[i].node];
    for (int k = 0; k < 3; ++k) v[k] += parts_[i].reading * node.velocity[k];
  }
  return v;
}

Vec3 PointSolver::carried_at(const Point& point) const {
  Vec3 v = Vec3::Zero();
  for (int i = point.first; i < point.end; ++i) {
    const Node& node = nodes_[parts_[i].node];
    for (int k = 0; k < 3; ++k) v[k] += parts_[i].weight * node.velocity[k];
  }
  return v;
}

void PointSolver::add_impulses(Member to, double factor) {
  for (const Point& point : points_) {
    for (int i = point.first; i < point.end; ++i) {
      const NodeOrigin& origin = origins_[parts_[i].node];
      Grid& grid = *fields_[origin.field];
      add_nodal_vector(grid.*to, grid.layout, origin.ref, (factor * parts_[i].weight) * point.impulse);
    }
  }
}

template <bool Free>
void PointSolver::push(const Point& point, const Vec3& impulse) {
  if constexpr (Free) {
    if (point.motion != nullptr) point.motion->push(-impulse, point.place);
  }
  for (int i = point.first; i < point.end; ++i) {
    Node& node = nodes_[parts_[i].node];
    const double lifted = parts_[i].weight * node.inverse_mass;
    for (int k = 0; k < 3; ++k) node.velocity[k] += lifted * impulse[k];
  }
}

void PointSolver::push_all() {
  for (const Point& point : points_) push<true>(point, point.impulse);
}

void PointSolver::push_bodies() {
  for (const Point& point : points_) {
    if (point.motion != nullptr) point.motion->push(-point.impulse, point.place);
  }
}

void PointSolver::find_compliance_with_bodies() {
  for (Point& point : points_) {
    point.with_body[0] = point.with_body[1] = point.compliance;
    if (point.motion == nullptr) continue;
    const Mat3 lift = point.motion->compliance_at(point.place);
    const double across = point.normal.dot(lift * point.normal);
    point.with_body[0] += across;
    point.with_body[1] += lift.trace() - across;  // the sum of the two principal values
  }
}

template <PointSolver::Pass Kind, bool Free>
double PointSolver::relax(Point& point) {
  if (Kind != Pass::step && Kind != Pass::strain && !is_bound<Kind>(point)) return 0.0;
  Vec3 slip = velocity_at(point);
  double compliance = point.compliance, compliance_along = point.compliance;
  if constexpr (Free) {
    compliance = point.with_body[0];
    compliance_along = point.with_body[1];
  }
  if (Free && point.motion != nullptr) {
    slip -= point.motion->velocity_at(point.place);
  } else if (Kind != Pass::increment) {
    slip -= point.velocity;
  }
  const Vec3 impulse = next_impulse<Kind>(point, slip, compliance, compliance_along), change = impulse - point.impulse;
  if (change.isZero(0.0)) return 0.0;
  point.impulse = impulse;
  push<Free>(point, change);
  return change.norm() * compliance;
}

template <PointSolver::Pass Kind, bool Free>
void PointSolver::relax(const Cluster& cluster, bool back, SweepProgress& progress) {
  const auto visit = [&](Point& point) {
    progress.largest = std::max(progress.largest, relax<Kind, Free>(point));
    progress.scale = std::max(progress.scale, point.impulse.norm() * (Free ? point.with_body[0] : point.compliance));
  };
  if (back) {
    for (int i = cluster.end; i-- > cluster.first;) visit(points_[i]);
  } else {
    for (int i = cluster.first; i < cluster.end; ++i) visit(points_[i]);
  }
}

template <PointSolver::Pass Kind>
void PointSolver::sweep_prescribed() {
  // Splines reach so far that the nodes beyond edges may belong to two blocks of one colour.
  const bool far = any_at_edge_ && traits_of(shape_).surface_degree > 1;
  const int threads = far ? 1 : threads_for(static_cast<int>(points_.size()));
  const int colours = static_cast<int>(colour_begin_.size()) - 1;
  SweepProgress all[2];  // progress of this sweep, and of the next
  for_team("contact: sweeps over points", threads, [&](const Team& team) {
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      const bool back = sweep % 2 != 0;
      SweepProgress own;
      for (int c = 0; c < colours; ++c) {
        const int colour = back ? colours - 1 - c : c;
        const int first = colour_begin_[colour], end = colour_begin_[colour + 1];
        if (first == end) continue;
        const auto [part_first, part_end] = team.part(end - first);
        for (int i = part_first; i < part_end; ++i) {
          relax<Kind, false>(clusters_[back ? end - 1 - i : first + i], back, own);
        }
        team.meet();
      }
      in_turn([&] {
        all[sweep % 2].largest = std::max(all[sweep % 2].largest, own.largest);
        all[sweep % 2].scale = std::max(all[sweep % 2].scale, own.scale);
      });
      team.meet();
      const bool done = all[sweep % 2].largest <= kTolerance * all[sweep % 2].scale;
      if (team.thread == 0) {
        all[(sweep + 1) % 2] = {};
        solving_threads_ = team.threads;
      }
      team.meet();
      if (done) break;
    }
  });
}

template <PointSolver::Pass Kind>
void PointSolver::sweep_free(BodyContact* bodies) {
  // Strain needs no more accuracy than before a prescribed body: its impulses are not given.
  constexpr bool kTrial = Kind == Pass::strain;
  constexpr int kMost = kTrial ? kSweeps : kSweepsFree;
  constexpr double kEnough = kTrial ? kTolerance : kToleranceFree;
  solving_threads_ = 1;
  ConjugateSweeps<Point> conjugate(sweeps_);
  if (bodies != nullptr) bodies->begin_sweeps();
  const int count = static_cast<int>(clusters_.size());
  int steady_for = 0;
  for (int sweep = 0; sweep < kMost; ++sweep) {
    conjugate.begin(points_);
    const bool back = sweep % 2 != 0;
    SweepProgress progress, between;  // progress of points, and of rows between bodies
    for (int i = 0; i < count; ++i) relax<Kind, true>(clusters_[back ? count - 1 - i : i], back, progress);
    if (bodies != nullptr) between = bodies->sweep(Kind, back);
    const bool bodies_done = between.largest <= kEnough * between.scale;
    steady_for = !kTrial && bodies_done && steady() ? steady_for + 1 : 0;
    const bool done = (progress.largest <= kEnough * progress.scale || steady_for == kSteadySweeps) && bodies_done;
    if (done || sweep + 1 == kMost) break;
    const double change = conjugate.change(points_) + (bodies != nullptr ? bodies->change() : 0.0);
    conjugate.go_on(points_, change, [&](Point& point, const Vec3& more) {
      point.impulse += more;
      push<true>(point, more);
    });
    if (bodies != nullptr) bodies->go_on(change);
  }
}

bool PointSolver::steady() {
  for (OnBody& one : on_bodies_) one = {};
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point& point = points_[i];
    OnBody& one = on_bodies_[point.body];
    const Vec3 change = point.impulse - sweeps_.before[i], arm = point.place - bodies_[point.body]->pose().position;
    one.force += change;
    one.torque += arm.cross(change);
    const double size = point.impulse.norm();
    one.all_force += size;
    one.all_torque += arm.norm() * size;
  }
  return std::all_of(on_bodies_.begin(), on_bodies_.end(), [](const OnBody& one) {
    return one.force.norm() <= kSteady * one.all_force && one.torque.norm() <= kSteady * one.all_torque;
  });
}

void PointSolver::solve(Pass pass, bool free, BodyContact* bodies) {
  if (points_.empty() && bodies == nullptr) return;
  switch (pass) {
    case Pass::step:
      return free ? sweep_free<Pass::step>(bodies) : sweep_prescribed<Pass::step>();
    case Pass::strain:
      return free ? sweep_free<Pass::strain>(bodies) : sweep_prescribed<Pass::strain>();
    case Pass::held:
      return sweep_prescribed<Pass::held>();
    case Pass::increment:
      return free ? sweep_free<Pass::increment>(bodies) : sweep_prescribed<Pass::increment>();
  }
}

}  // namespace mpm
