// Law of a joint in one step: the impulse that drive, damping, friction and limits give a generalised velocity, by its
// value at the end of the step.
//
// All of them are implicit, so that a stiff drive or a limit needs no small step. The impulse falls with the velocity,
// along straight pieces: a position drive is a slope between the limits of its effort, where it is level; a drive by
// velocity, friction at rest and a limit of position are vertical, with the velocity given and the impulse within a
// range.
#pragma once

#include <array>

#include "mpm/math/constants.hpp"

namespace mpm {

/// Actions on a joint in a step. Efforts in [N] or [N m], velocities in [m/s] or [rad/s].
struct JointActions {
  enum class Drive { effort, rigid, spring } drive = Drive::effort;
  double effort = 0.0;        ///< effort of a drive by effort
  double target = 0.0;        ///< velocity of a rigid drive
  double at_rest = 0.0;       ///< effort of a spring at velocity 0
  double slope = 0.0;         ///< effort that a spring loses by velocity [N s/m], [N m s/rad]
  double limit = kInfinity;   ///< limit of the drive's effort
  double damping = 0.0;       ///< [N s/m], [N m s/rad]
  double friction = 0.0;      ///< the same at rest and in motion
  double least = -kInfinity;  ///< velocities that limits of position leave
  double most = kInfinity;
};

/// Parts of the impulse of a step.
struct JointImpulses {
  double drive = 0.0, damping = 0.0, friction = 0.0, limit = 0.0;  ///< [N s], [N m s]
};

class JointLaw {
 public:
  struct Piece {
    bool vertical = false;
    double least = -kInfinity, most = kInfinity;  ///< velocities; equal where vertical
    double offset = 0.0, slope = 0.0;             ///< impulse = offset - slope * velocity
    double low = 0.0, high = 0.0;                 ///< impulses where vertical
  };

  /// A velocity on which nothing acts.
  JointLaw() { pieces_[0] = {}; }
  JointLaw(const JointActions& actions, double dt);
  /// A velocity that is prescribed.
  static JointLaw prescribed(double velocity);

  int count() const { return count_; }
  const Piece& piece(int i) const { return pieces_[i]; }
  /// True if the velocity is the same whatever the impulse.
  bool is_prescribed() const { return count_ == 1 && pieces_[0].vertical; }
  /// The piece that holds at the velocity: of two that meet there the left one.
  int piece_at(double velocity) const;
  /// Parts of an impulse that the law gives at this velocity.
  JointImpulses parts(double velocity, double impulse) const;

 private:
  void add_vertical(double velocity, double low, double high);
  /// The drive's impulse at a velocity where it is not vertical.
  double drive_at(double velocity) const;

  static constexpr int kMost = 11;  ///< five places where pieces meet, vertical or not, and what lies between
  std::array<Piece, kMost> pieces_;
  int count_ = 1;
  JointActions actions_;
  double dt_ = 0.0;
};

}  // namespace mpm
