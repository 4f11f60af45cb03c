// Taking over of the grid's motion by particles, a register of them at a time, and the distance that they may go before
// they have to be sorted.
//
// kIncrement   velocity gains a dt, less the slip that the PIC fraction takes away. GIMP notes (2.15), (2.16). What is
//              taken times the mean of the velocity before and after is the kinetic energy that goes with it, exactly.
// kAdopt       velocity becomes the grid's; x += (V^n + V^{n+1}) dt / 2. Method reference 6.6 (XPIC, FMPM).
// kAffine      velocity becomes the grid's; x += V^{n+1} dt, without which angular momentum is not kept.
// About an axis (Rings) the displacement gains what moves a particle by the grid's velocity at its place in place of
// the mean one in its domain (AxisMotion::point): method reference 3.5. Damped: less (alpha_g v0 + alpha_p V^n) dt, v0
// the grid's velocity before the step, or of what is adopted that one; GIMP notes (2.31)-(2.34), method reference 6.6.
#pragma once

#include "mpm/kernel/chunks.hpp"
#include "mpm/kernel/weights.hpp"

namespace mpm {

/// `Weighed`: some particles have masses of their own.
template <class T, int Dim, mpm_kernel::Motion Kind, bool Rings, bool Weighed>
class Advance {
  using W = Wide<T>;

 public:
  Advance(const SetView<T>& set, const mpm_kernel::MoveSettings& settings)
      : set_(set),
        dt_(settings.dt),
        half_dt_(0.5 * settings.dt),
        pic_(1.0 - settings.flip),
        rate_{W(settings.grid_damping), W(settings.particle_damping)} {}

  /// Component c of particles [p, p + lanes), of which the grid says velocity and acceleration. Moves them; returns
  /// their displacement [m]. `beside`: of rings, a displacement that comes to the velocity's.
  template <bool Counted, bool Damped>
  W particles(int c, int p, int lanes, W grid_velocity, W acceleration, W beside) {
    W velocity = W::load_first(set_.v[c] + p, lanes);
    W displacement = advance<Counted, Damped>(c, p, lanes, grid_velocity, acceleration, velocity);
    if constexpr (Rings) displacement += beside;
    velocity.store_first(set_.v[c] + p, lanes);
    W::B::displace(set_.next_x[c] + p, set_.x[c] + p, displacement.v, lanes);
    return displacement;
  }

  /// Velocity that moves rings by the grid's motion at their places: displacement beside that by the mean motion in
  /// their domains, of which the arguments are the differences.
  W to_point(W velocity, W acceleration) const {
    return dt_ * (Kind == mpm_kernel::kIncrement ? velocity - half_dt_ * acceleration : velocity);
  }

  /// Adds what damping and PIC took, if they were counted.
  void add_to(mpm_kernel::Moved& moved) const {
    const double mass = Weighed && weighs_each<Rings>(set_) ? 1.0 : set_.mass;  // or they were weighed one by one
    for (int c = 0; c < Dim; ++c) moved.drag[c] += total(drag_[c]) * mass;
    moved.slip_energy += 0.5 * total(slip_work_) * mass;
    moved.drag_energy += 0.5 * total(drag_work_) * mass;
    moved.grid_kinetic += 0.5 * total(grid_square_) * mass;
    moved.particle_kinetic += 0.5 * total(own_square_) * mass;
  }

 private:
  template <bool Counted, bool Damped>
  W advance(int c, int p, int lanes, W grid_velocity, W acceleration, W& velocity) {
    const W old = velocity;
    W drag(0.0);
    if constexpr (Damped) drag = damping(c, p, lanes, seen(grid_velocity, acceleration), old);
    if constexpr (Kind == mpm_kernel::kIncrement) {
      const W slip = pic_ * (velocity - (grid_velocity - acceleration * dt_));
      velocity += acceleration * dt_ - slip;
      if constexpr (Damped) velocity -= drag * dt_;
      if constexpr (Counted) slip_work_ += weigh(p, lanes, slip * (old + velocity));
      if constexpr (Damped) drag_work_ += weigh(p, lanes, drag * dt_ * (old + velocity));
      if constexpr (Damped) acceleration += drag;
      return dt_ * (grid_velocity - W(0.5) * slip - half_dt_ * acceleration);
    }
    velocity = grid_velocity;
    if constexpr (Damped) velocity -= drag * dt_;
    if constexpr (Damped) drag_work_ += weigh(p, lanes, drag * dt_ * (old + velocity));
    return Kind == mpm_kernel::kAdopt ? half_dt_ * (old + velocity) : dt_ * velocity;
  }

  // The grid's velocity that damping acts on: of the step's start, or the one that is adopted.
  W seen(W grid_velocity, W acceleration) const {
    return Kind == mpm_kernel::kIncrement ? grid_velocity - acceleration * dt_ : grid_velocity;
  }
  W damping(int c, int p, int lanes, W grid_velocity, W own) {
    const double* const* of_place = set_.damping;
    const W on_grid = of_place[0] == nullptr ? rate_[0] : W(W::B::place(of_place[0] + p, lanes, 0.0, 1.0, 0.0));
    const W on_own = of_place[1] == nullptr ? rate_[1] : W(W::B::place(of_place[1] + p, lanes, 0.0, 1.0, 0.0));
    const W drag = on_grid * grid_velocity + on_own * own;
    drag_[c] += weigh(p, lanes, drag * dt_);
    grid_square_ += weigh(p, lanes, grid_velocity * grid_velocity);
    own_square_ += weigh(p, lanes, own * own);
    return drag;
  }
  // A term of a sum over particles of mass 1, or of masses of their own; lanes beyond the last particle give nothing.
  W weigh(int p, int lanes, W x) const {
    const auto there = WideMask<T>::first(lanes);
    if constexpr (Weighed) {
      if (weighs_each<Rings>(set_)) return select(there, mass_of<true>(set_, p, lanes) * x, W(0.0));
    }
    return select(there, x, W(0.0));
  }

  static double total(W sum) {
    double all = 0.0;
    for (int l = 0; l < W::kLanes; ++l) all += static_cast<double>(lane(sum, l));
    return all;
  }

  const SetView<T>& set_;
  W dt_, half_dt_, pic_, rate_[2];
  W drag_[Dim] = {}, grid_square_ = W(0.0), own_square_ = W(0.0);
  W slip_work_ = W(0.0), drag_work_ = W(0.0);  // twice
};

/// Distance that particles of a set may go before they have to be sorted.
template <class T, int Dim, int Nodes>
class Reach {
  using W = Wide<T>;

 public:
  Reach(const GridView& grid, const BlockView& block, const SetView<T>& set) {
    for (int k = 0; k < Dim; ++k) {
      inverse_cell_[k] = W(grid.inverse_cell[k]);
      // The nearest node must keep its neighbours on each side in the tile, or in its six nodes.
      const double lowest = set.lowest[k] - block.corner[k], highest = set.highest[k] - block.corner[k];
      const double first = kFirst, last = kTileEdge - 1 - kFirst;
      lowest_[k] = W(lowest > first ? lowest : first);
      highest_[k] = W(highest < last ? highest : last);
    }
  }
  static WideMask<T> everywhere() { return WideMask<T>::first(W::kLanes); }
  /// `cells`: where they were in the tile; `displacement` [m].
  void check(int k, W cells, W displacement, int lanes, WideMask<T>& inside, WideMask<T>& tight) const {
    const WideMask<T> beyond = !WideMask<T>::first(lanes);
    cells += displacement * inverse_cell_[k];
    inside = inside & (((cells >= lowest_[k]) & (cells <= highest_[k])) | beyond);
    tight = tight &
            (((cells >= W(lowest_nearest(false) - kBeside)) & (cells <= W(highest_nearest(false) + kBeside))) | beyond);
  }

 private:
  static constexpr double kBeside = 0.5 - mpm_kernel::kSlack;  ///< largest distance of a particle from its nearest node
  /// A stencil of three is laid around a nearest node; one of five reaches two cells to each side of a particle.
  static constexpr double kFirst = Nodes == 3 ? lowest_nearest(true) - kBeside : 1.0 + mpm_kernel::kSlack;
  W lowest_[Dim], highest_[Dim], inverse_cell_[Dim];
};

}  // namespace mpm
