// Solves for the generalised velocities of a robot at the end of a step: M v = b + impulses of the joints' laws
// (joint_law.hpp), exactly, by finding the piece of each law that holds.
//
// On given pieces the equations are linear. Where a velocity or an impulse is then outside its piece, the joint goes on
// to the piece beside it; since M is positive definite and the laws fall, the solution is unique. Joints change piece
// all at once; if that has not ended after kTogether rounds, one at a time, that of the largest number, which ends
// (Murty, 1974).
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "mpm/robot/joint_law.hpp"

namespace mpm {

class JointSolution {
 public:
  explicit JointSolution(int freedoms);

  /// Laws of the step, to be set before begin().
  std::vector<JointLaw>& laws() { return laws_; }
  const std::vector<JointLaw>& laws() const { return laws_; }
  /// Begins a step with its mass matrix and laws, from these velocities.
  void begin(const Eigen::MatrixXd& mass, const Eigen::VectorXd& velocities);
  /// Finds pieces and velocities for momentum b. @return true if a piece has changed
  bool solve(const Eigen::VectorXd& b);
  /// Velocities on the present pieces, whether they hold or not.
  void solve_linear(const Eigen::VectorXd& b);
  const Eigen::VectorXd& velocities() const { return velocities_; }
  /// Change of velocities by generalised impulses, on the present pieces; one column each.
  void respond(const Eigen::MatrixXd& impulses, Eigen::MatrixXd& into) const;
  /// True if the velocity does not change by impulses, whatever piece holds.
  bool is_prescribed(int freedom) const { return laws_[freedom].is_prescribed(); }

 private:
  /// @throws RigidError when no force resists some motion: the mass matrix is singular
  void factor();

  std::vector<JointLaw> laws_;
  std::vector<int> pieces_;
  Eigen::MatrixXd mass_, reduced_;
  Eigen::VectorXd velocities_, right_;
  Eigen::LLT<Eigen::MatrixXd> factors_;
};

}  // namespace mpm
