// Contact of rigid bodies with each other and with the walls of the domain, where the scene says `collide`.
//
// At the start of a step the points of each body (rigid/touch_points.hpp) are looked up in the exact distance of the
// other one, and those of the other in its; each that may touch within the step is a row: no approach beyond the gap,
// Coulomb friction, no rebound. Rows are solved with the points at which bodies meet the material, sweep by sweep, so
// that a body between another body and soil is in balance with both. A row between two links of one robot knows that
// one's impulse moves the other. Two bodies whose motion is prescribed have no rows: nothing gives way.
//
// Impulses begin at zero in each step, so that there is no state between steps. A small overlap is pushed out by a
// tenth a step.
//
// Weak: a ball that comes to a corner of the other body is slowed when the corner is a step's way before it. A tower of
// many bodies, or a heavy body on a light one, needs more sweeps than a step does; the error is a small approach, which
// the next steps correct.
//
// Source: time stepping of Moreau (1988) and Stewart & Trinkle (1996), solved by projected Gauss-Seidel.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mpm/contact/conjugate_sweeps.hpp"
#include "mpm/contact/row_impulse.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/rigid/rigid_body.hpp"

namespace mpm {

/// A wall of the domain that bodies do not pass.
struct BodyWall {
  std::string name;
  Vec3 normal = Vec3::UnitZ();                    ///< into the domain
  double place = 0.0;                             ///< position along the normal [m]
  std::optional<double> friction = std::nullopt;  ///< coefficient; without one that of the body counts
};

struct BodyContactSettings {
  GeometryKind geometry = GeometryKind::solid;
  double cell = 0.0;     ///< [m]
  double gravity = 0.0;  ///< [m/s^2]
  std::vector<BodyWall> walls;
};

/// An impulse on a body; the opposite one acts on the other body, if it is one.
struct BodyImpulse {
  int body = 0, other = -1;  ///< -1: a wall
  Vec3 impulse, place;       ///< [N s]; world [m]
  double loss = 0.0;         ///< energy that friction and impact take [J]
  double pushed = 0.0;       ///< work of the one whose motion is prescribed on the other [J]
};

class BodyContact {
 public:
  /// `bodies` must outlive this. @throws RigidError as check_overlaps()
  BodyContact(const std::vector<RigidBody*>& bodies, const BodyContactSettings& settings);

  /// @throws RigidError when two bodies that collide, or one and a wall, overlap by more than a hundredth of the
  /// smaller one's size. `with`: the one that is looked at; null for all.
  void check_overlaps(const RigidBody* with = nullptr) const;
  /// True if some body may meet another one, or a wall, in the course of the run.
  bool any() const { return !pairs_.empty(); }
  /// Finds the rows of a step.
  void find(double dt);
  bool touches() const { return !rows_.empty(); }

  /// Begins a solution: impulses are zero, compliances those of the bodies now.
  void begin();
  /// Compliances anew, when those of robots have changed.
  void find_compliance();
  /// Parts of one solution: begin_sweeps(), then sweeps, each followed by change() and go_on() (conjugate_sweeps.hpp).
  void begin_sweeps() { conjugate_.emplace(memory_); }
  SweepProgress sweep(ContactPass pass, bool back);
  double change() const { return conjugate_->change(rows_); }
  void go_on(double change_of_all);

  /// Calls `visit` with a BodyImpulse for each row that acts. `with_loss`: with the energy that it takes.
  template <class Visit>
  void each_impulse(bool with_loss, Visit&& visit) const {
    for (const Row& row : rows_) {
      if (row.impulse.isZero(0.0)) continue;
      visit(BodyImpulse{row.body, row.other, row.impulse, row.place, with_loss ? loss_of(row) : 0.0,
                        with_loss ? -row.impulse.dot(row.velocity) : 0.0});
    }
  }

 private:
  /// Two bodies, or a body and a wall, that may meet.
  struct Pair {
    int body, other;  ///< numbers of bodies; of a wall -1 - its number
    double friction;
  };
  struct Row {
    Vec3 normal;    ///< out of the other one, towards the body
    Vec3 place;     ///< world [m]
    Vec3 velocity;  ///< velocity of the body against the other, the part that is prescribed [m/s]
    Vec3 impulse = Vec3::Zero();
    double allowed = 0.0, friction = 0.0, adhesion = 0.0;
    double with_body[2] = {};  ///< compliance along the normal, and the largest along the surface [1/kg]
    bool sticks = false;
    Hold hold = Hold::free;
    int body = 0, other = -1;
    DynamicMotion *motion = nullptr, *other_motion = nullptr;  ///< null where prescribed
  };
  struct Body {
    std::vector<TouchPoint> points;  ///< in the order of x
    double largest = 0.0;            ///< radius of the largest ball [m]
    double reach = 0.0;              ///< distance of the farthest point from the origin [m]
    double size = 0.0;               ///< [m]
  };

  /// Calls `found(place, gap, normal)`, world, for each point of the body within `margin` of the other one.
  template <class Found>
  void look(int body, int other, double margin, Found&& found) const;
  void find(const Pair& pair, double margin, double dt);
  void add(int body, int other, const Vec3& place, double gap, const Vec3& normal, double friction, double dt);
  double speed(int body) const;
  /// Distance within which points may touch in a step of dt [m].
  double margin(double dt) const;
  Vec3 slip(const Row& row, bool with_prescribed) const;
  double loss_of(const Row& row) const;
  template <ContactPass Kind>
  double relax(Row& row);

  const std::vector<RigidBody*>& bodies_;
  BodyContactSettings settings_;
  std::vector<Body> touching_;  ///< one for each of the bodies; without points for those that meet none
  std::vector<Pair> pairs_;
  std::vector<Row> rows_;
  SweepMemory memory_;
  std::optional<ConjugateSweeps<Row>> conjugate_;
};

}  // namespace mpm
