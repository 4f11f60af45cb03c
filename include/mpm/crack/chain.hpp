// A crack as a chain of points without mass, joined by straight segments: its place, its two surfaces, its tips, and
// how it moves with the material and grows. Above is the left side for one who walks from the start (end 0) to the end
// (end 1). Places lie in the plane of the grid's axes [m].
//
// Motion: a surface moves with velocity V and acceleration a of its side's nodes at the end of a step by
//   dt (3/2 V - 1/2 V_before - a dt),
// which is exact for constant velocity and for constant acceleration. Where a traction follows from the opening it
// moves by dt V: then force, velocity and place take turns and an oscillation keeps its energy, which it would else
// gain in every step, however short. Where V_before is not known (first step, grown point, side that has just met
// nodes) it is V - a dt, which is so too.
//
// Weak: a point that no material surrounds stays where it is, so that the end of an exterior crack lags behind a body
// that moves far. Points are not redistributed where the chain stretches.
// Source: crack reference 1.1, 1.4, 3.2 to 3.5, 5.3, 5.4; NairnMPM's manual, Cracks and MovePlane; for prevent()
// lengths are taken relative to the segment's own.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "mpm/crack/definition.hpp"
#include "mpm/math/geometry.hpp"
#include "mpm/math/state_archive.hpp"

namespace mpm {

/// A point of the chain: places [m], and velocities at the end of the last step [m/s], zero where it did not move.
struct CrackPoint {
  Vec2 place = Vec2::Zero(), above = Vec2::Zero(), below = Vec2::Zero();
  Vec2 start = Vec2::Zero();  ///< its place when the run began, or when growth made it
  Vec2 velocity = Vec2::Zero(), velocity_above = Vec2::Zero(), velocity_below = Vec2::Zero();
  /// True if that velocity comes from nodes, to go on from.
  bool known = false, known_above = false, known_below = false;

  /// Half way between its surfaces [m].
  Vec2 middle() const { return 0.5 * (above + below); }
};

/// Motion of nodes at a place: sums weighted by shape function and mass, over those that carry material.
struct SurfaceMotion {
  Vec2 velocity = Vec2::Zero();      ///< at the end of the step [m/s]
  Vec2 acceleration = Vec2::Zero();  ///< in the step [m/s^2]
  bool known = false;                ///< some node near carries material
  bool pulled = false;               ///< a traction that follows from the opening acts there
};

/// By which an exterior end is lengthened for crossing tests, of its last segment.
inline constexpr double kExteriorReach = 4.0;

class Chain {
 public:
  using Move = CracksDefinition::Move;

  /// `points`: at least two, such that line_fault() finds no fault [m].
  Chain(const std::vector<Vec2>& points, const std::array<CrackEnd, 2>& ends, bool fixed);

  const std::vector<CrackPoint>& points() const { return points_; }
  int size() const { return static_cast<int>(points_.size()); }
  bool fixed() const { return fixed_; }
  CrackEnd end(int end) const { return ends_[end]; }
  /// Makes an end another kind of end: a tip that stops for good, for example.
  void set_end(int end, CrackEnd kind);
  /// Number of the point at an end.
  int point_at(int end) const { return end == 0 ? 0 : size() - 1; }

  /// Line that crossing tests see: the places of all points, where those of exterior ends lie farther out by
  /// kExteriorReach times the last segment. So segment k is the chain's, and a part of a lengthened segment is not that
  /// part of the chain's.
  const std::vector<Vec2>& line() const { return line_; }
  /// Bounds of the line's segments from number kRun k on, kRun of them or what is left: segments far from a place are
  /// passed by run after run.
  struct Extent {
    Vec2 low, high;  ///< [m]
    bool misses(const Vec2& other_low, const Vec2& other_high) const {
      return (low.array() > other_high.array()).any() || (high.array() < other_low.array()).any();
    }
  };
  static constexpr int kRun = 8;
  const std::vector<Extent>& extents() const { return extents_; }

  /// Distance of a place from the nearest of the segments, as points() has them [m].
  double distance(const Vec2& place) const;
  /// Unit vector in which an end points out of the chain.
  Vec2 direction(int end) const;
  /// Unit vector along the chain at a point: the bisector of its segments.
  Vec2 tangent(int point) const;
  /// Part of the chain that belongs to a point, half of each of its segments, from start to end [m]. Its length times
  /// the thickness is the area of its tractions.
  Vec2 tangent_area(int point) const;
  /// A point's surface above, or below, moved to its own side by 1e-8 of its segments: from there crossings tell which
  /// nodes are on its side [m].
  Vec2 beside(int point, bool above) const;
  /// Surface above minus surface below [m].
  Vec2 opening(int point) const { return points_[point].above - points_[point].below; }
  /// Opening near a tip in its own frame [m]: across its direction, positive if open, and along it, positive if its
  /// left side has moved ahead. (1, 4, 1) / 6 of the three points next to the tip, or that of the first for a chain of
  /// fewer than four points.
  Vec2 tip_opening(int end) const;
  /// Along the middles between the surfaces [m].
  double length() const;
  /// The part of it that belongs to points for which `open(number of the point)` is true; half of each segment belongs
  /// to each of its points [m].
  template <class Open>
  double open_length(Open&& open) const;

  /// Moves the surfaces by `above` and `below` and the places by the mean of both or by `centre`, all of size()
  /// entries; `centre` is read only for Move::centre_of_mass. A side without material moves with the other, without
  /// either the point rests. What would move by more than `largest` [m] in `dt` [s] stays. Returns how many moves were
  /// stopped so. A fixed chain does not move.
  int move(const SurfaceMotion* above, const SurfaceMotion* below, const SurfaceMotion* centre, double dt, Move by,
           double largest);
  /// Puts surfaces that lie on the wrong side of the segments at their point back onto them, and returns how many. One
  /// that is farther away than the segment is long, or less deep than 1e-5 of it, is left.
  int prevent();

  /// Adds points beyond an end, the nearest to it first [m]; its kind of end moves to the last. Numbers of points after
  /// them rise if they are added at the start.
  void grow(int end, const std::vector<Vec2>& points);

  /// Writes or reads its state, for checkpoints.
  void serialise(StateArchive& archive);
  /// Appends its state to the numbers whose hash tells runs apart.
  void hashed(std::vector<double>& numbers) const;

 private:
  void update_line();

  std::vector<CrackPoint> points_;
  std::array<CrackEnd, 2> ends_;
  bool fixed_;
  std::vector<Vec2> line_;
  std::vector<Extent> extents_;
};

/// Edge of a cell along the larger component of a direction [m].
double cell_along(const Vec2& direction, const Vec2& cells);

/// The points by which a tip grows: `length` [edges of a cell, by cell_along()] along a unit vector, in one segment, or
/// from 0.75 on in equal ones of about half an edge. `cells`: edges of a cell along both axes [m].
std::vector<Vec2> growth_points(const Vec2& tip, const Vec2& direction, double length, const Vec2& cells);

template <class Open>
double Chain::open_length(Open&& open) const {
  double sum = 0.0;
  for (int k = 0; k + 1 < size(); ++k) {
    const double half = 0.5 * (points_[k + 1].middle() - points_[k].middle()).norm();
    sum += (open(k) ? half : 0.0) + (open(k + 1) ? half : 0.0);
  }
  return sum;
}

}  // namespace mpm
