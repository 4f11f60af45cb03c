#include "mpm/robot/joint_solution.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/rigid/surface.hpp"

namespace mpm {
namespace {

constexpr int kTogether = 12;        ///< rounds in which all joints that do not fit change piece
constexpr int kRounds = 400;         ///< at most
constexpr double kRoundOff = 1e-12;  ///< part of a velocity or an impulse by which it may be outside its piece

}  // namespace

JointSolution::JointSolution(int freedoms)
    : laws_(freedoms),
      pieces_(freedoms, 0),
      mass_(freedoms, freedoms),
      reduced_(freedoms, freedoms),
      velocities_(Eigen::VectorXd::Zero(freedoms)),
      right_(freedoms),
      factors_(freedoms) {}

void JointSolution::begin(const Eigen::MatrixXd& mass, const Eigen::VectorXd& velocities) {
  mass_ = mass;
  velocities_ = velocities;
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    // The piece at the last velocity is the best guess: laws have other pieces in each step.
    pieces_[i] = laws_[i].piece_at(velocities_[static_cast<Eigen::Index>(i)]);
  }
  factor();
}

void JointSolution::factor() {
  reduced_ = mass_;
  for (std::size_t k = 0; k < laws_.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const JointLaw::Piece& piece = laws_[k].piece(pieces_[k]);
    if (piece.vertical) {
      reduced_.row(i).setZero();
      reduced_.col(i).setZero();
      reduced_(i, i) = 1.0;
    } else {
      reduced_(i, i) += piece.slope;
    }
  }
  factors_.compute(reduced_);
  if (factors_.info() != Eigen::Success) {
    throw RigidError(
        "no mass or moment of inertia resists a motion of its joints; give its links some about every axis");
  }
}

void JointSolution::solve_linear(const Eigen::VectorXd& b) {
  right_ = b;
  for (std::size_t k = 0; k < laws_.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const JointLaw::Piece& piece = laws_[k].piece(pieces_[k]);
    if (piece.vertical) {
      right_ -= piece.least * mass_.col(i);
    } else {
      right_[i] += piece.offset;
    }
  }
  for (std::size_t k = 0; k < laws_.size(); ++k) {
    const JointLaw::Piece& piece = laws_[k].piece(pieces_[k]);
    if (piece.vertical) right_[static_cast<Eigen::Index>(k)] = piece.least;
  }
  velocities_ = right_;
  factors_.solveInPlace(velocities_);
}

bool JointSolution::solve(const Eigen::VectorXd& b) {
  bool changed = false;
  for (int round = 0; round < kRounds; ++round) {
    solve_linear(b);
    bool moved = false;
    for (std::size_t back = laws_.size(); back-- > 0;) {
      const auto i = static_cast<Eigen::Index>(back);
      const JointLaw& law = laws_[back];
      const JointLaw::Piece& piece = law.piece(pieces_[back]);
      int step = 0;
      if (piece.vertical) {
        const double needed = mass_.row(i).dot(velocities_) - b[i];
        const double room = kRoundOff * (std::abs(needed) + mass_(i, i) * std::abs(piece.least));
        if (needed > piece.high + room) step = -1;
        if (needed < piece.low - room) step = 1;
      } else {
        const double room = kRoundOff * std::abs(velocities_[i]);
        if (velocities_[i] < piece.least - room) step = -1;
        if (velocities_[i] > piece.most + room) step = 1;
      }
      if (step == 0) continue;
      pieces_[back] = std::clamp(pieces_[back] + step, 0, law.count() - 1);
      moved = true;
      if (round >= kTogether) break;
    }
    if (!moved) break;
    changed = true;
    factor();
  }
  return changed;
}

void JointSolution::respond(const Eigen::MatrixXd& impulses, Eigen::MatrixXd& into) const {
  into = impulses;
  for (std::size_t k = 0; k < laws_.size(); ++k) {
    if (laws_[k].piece(pieces_[k]).vertical) into.row(static_cast<Eigen::Index>(k)).setZero();
  }
  factors_.solveInPlace(into);
}

}  // namespace mpm
