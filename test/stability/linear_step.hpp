// Theory of the time step: one step of the method as a matrix, for small motion about an unstressed lattice of
// particles in plane strain. It is built from the shape functions alone, independently of the solver. Units: cell 1,
// density 1, speed of pressure waves 1, so that the time step is the Courant number.
//
// With lumped nodal mass M, consistent mass C = S^T m S and the grid's stiffness K = sum V G^T D G, FLIP with nodal
// velocities M^-1 S m v changes stress by A v dt and velocity by -A* stress dt, where A* is the adjoint of A in the
// particles' mass and compliance. So USF is the leapfrog scheme of an oscillator, stable while dt < 2 / omega with
// omega^2 the largest eigenvalue of M^-1 C M^-1 K. Modified USL and USAVG make the same two changes in another order,
// divided into halves: similar matrices with the same limit. (Derived here; method reference 1.1, 5.4 and 6 for the
// passes.) With walls, or a transfer other than FLIP, the step is not a leapfrog, and the matrix is applied repeatedly.
// Weak: moving, rotating and deforming particles are not included.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <vector>

#include "axis_weights.hpp"
#include "mpm/definition/definition.hpp"

namespace stability {

class LinearStep {
 public:
  using Matrix = Eigen::MatrixXd;
  using Place = std::array<double, 2>;  ///< x and z [cells]

  static constexpr std::array<double, 2> kFree = {-1e9, 1e9};

  /// `held`: numbers of the nodes along either axis that walls fix.
  LinearStep(const mpm::MethodDefinition& method, std::vector<Place> places, double poisson,
             std::array<double, 2> held = kFree)
      : method_(method), places_(std::move(places)), lambda_(poisson / (1.0 - poisson)), shear_(0.5 * (1.0 - lambda_)) {
    mass_ = 1.0 / (method.particles_per_direction * method.particles_per_direction);
    fill(held);
    lumped_ = mass_ * s_.rowwise().sum();
    average_ = lumped_.cwiseInverse().asDiagonal() * (mass_ * s_);
    if (apic()) fill_affine();
  }

  /// The largest stable Courant number of FLIP without walls, with any of the three updates.
  double flip_limit() const {
    const Eigen::Index n = s_.rows(), p = s_.cols();
    Matrix k(2 * n, 2 * n);
    for (int i = 0; i < 2; ++i) {
      const Matrix &own = g_[i], &other = g_[1 - i];
      k.block(i * n, i * n, n, n) = mass_ * (own * own.transpose() + shear_ * other * other.transpose());
      k.block(i * n, (1 - i) * n, n, n) =
          mass_ * (lambda_ * own * other.transpose() + shear_ * other * own.transpose());
    }
    // W K W^T with W = sqrt(m) S^T M^-1 is symmetric and has the eigenvalues of M^-1 C M^-1 K.
    Matrix w = Matrix::Zero(2 * p, 2 * n);
    w.topLeftCorner(p, n) = std::sqrt(mass_) * s_.transpose() * lumped_.cwiseInverse().asDiagonal();
    w.bottomRightCorner(p, n) = w.topLeftCorner(p, n);
    const Matrix product = w * k * w.transpose();
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(product, Eigen::EigenvaluesOnly);
    return 2.0 / std::sqrt(solver.eigenvalues().maxCoeff());
  }

  Eigen::Index particles() const { return s_.cols(); }
  /// Size of a state of one_step().
  Eigen::Index states() const { return s_.cols() * (apic() ? 9 : 5); }

  /// One step of a state: vx and vz of all particles, xx, zz and xz of stress over density, and with APIC the four
  /// components of the velocity's gradient, xx, xz, zx, zz.
  Eigen::VectorXd one_step(const Eigen::VectorXd& state, double dt) const {
    Parts s = split(state);
    const mpm::UpdateScheme update = method_.update;
    const Pair gathered = gather(s);
    if (update == mpm::UpdateScheme::usf) strain(s, hold(gathered), dt);
    if (update == mpm::UpdateScheme::usavg) strain(s, hold(gathered), 0.5 * dt);
    transfer(s, gathered, accelerate(s, gathered, dt), dt);
    if (update == mpm::UpdateScheme::usavg) strain(s, hold(gather(s)), 0.5 * dt);
    if (update == mpm::UpdateScheme::usl) strain(s, hold(gather(s)), dt);
    return join(s);
  }

 private:
  using Vector = Eigen::VectorXd;
  using Pair = std::array<Vector, 2>;
  struct Parts {
    Pair v;
    std::array<Vector, 3> stress;
    std::array<Pair, 2> gradient;  // [component][axis], APIC only
  };

  bool apic() const { return method_.transfer.kind == mpm::TransferKind::apic; }

  // Fills the weights of the nodes in reach.
  void fill(const std::array<double, 2>& held) {
    const double half = 0.5 / method_.particles_per_direction;
    Place low = places_[0], high = places_[0];
    for (const Place& place : places_) {
      for (int k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], place[k]);
        high[k] = std::max(high[k], place[k]);
      }
    }
    std::vector<std::array<std::vector<double>, 3>> rows;  // rows of S, dS/dx and dS/dz
    for (double x = std::floor(low[0]) - 2.0; x <= high[0] + 3.0; ++x) {
      for (double z = std::floor(low[1]) - 2.0; z <= high[1] + 3.0; ++z) {
        std::array<std::vector<double>, 3> row;
        double carried = 0.0;
        for (const Place& place : places_) {
          const auto [sx, dx] = walled_weight(method_.shape, place[0], x, half, held[0], held[1]);
          const auto [sz, dz] = walled_weight(method_.shape, place[1], z, half, held[0], held[1]);
          row[0].push_back(sx * sz);
          row[1].push_back(dx * sz);
          row[2].push_back(sx * dz);
          carried += sx * sz;
        }
        if (!(carried > 1e-30)) continue;  // as in the solver, which leaves out nodes without mass
        nodes_.push_back({x, z});
        moves_.push_back(std::min(x, z) > held[0] && std::max(x, z) < held[1]);
        rows.push_back(std::move(row));
      }
    }
    for (Matrix* m : {&s_, &g_[0], &g_[1]}) m->resize(rows.size(), places_.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t p = 0; p < places_.size(); ++p) {
        s_(i, p) = rows[i][0][p];
        g_[0](i, p) = rows[i][1][p];
        g_[1](i, p) = rows[i][2][p];
      }
    }
  }

  // Fills weight times distance from particle to node, and the inverse second moments of the weights.
  void fill_affine() {
    arm_ = {s_, s_};
    for (Eigen::Index p = 0; p < s_.cols(); ++p) {
      Eigen::Matrix2d moment = Eigen::Matrix2d::Zero();
      for (Eigen::Index i = 0; i < s_.rows(); ++i) {
        const Eigen::Vector2d way(nodes_[i][0] - places_[p][0], nodes_[i][1] - places_[p][1]);
        moment += s_(i, p) * way * way.transpose();
        for (int k = 0; k < 2; ++k) arm_[k](i, p) *= way[k];
      }
      inverse_moment_.push_back(moment.inverse());
    }
  }

  Parts split(const Vector& state) const {
    const Eigen::Index p = s_.cols();
    Parts s;
    for (int k = 0; k < 2; ++k) s.v[k] = state.segment(k * p, p);
    for (int c = 0; c < 3; ++c) s.stress[c] = state.segment((2 + c) * p, p);
    for (int c = 0; apic() && c < 4; ++c) s.gradient[c / 2][c % 2] = state.segment((5 + c) * p, p);
    return s;
  }
  Vector join(const Parts& s) const {
    const Eigen::Index p = s_.cols();
    Vector state(states());
    for (int k = 0; k < 2; ++k) state.segment(k * p, p) = s.v[k];
    for (int c = 0; c < 3; ++c) state.segment((2 + c) * p, p) = s.stress[c];
    for (int c = 0; apic() && c < 4; ++c) state.segment((5 + c) * p, p) = s.gradient[c / 2][c % 2];
    return state;
  }

  Pair gather(const Parts& s) const {
    Pair grid;
    for (int k = 0; k < 2; ++k) {
      grid[k] = average_ * s.v[k];
      for (int j = 0; apic() && j < 2; ++j) {
        grid[k] += mass_ * (arm_[j] * s.gradient[k][j]).cwiseQuotient(lumped_);
      }
    }
    return grid;
  }
  Pair hold(Pair grid) const {
    for (std::size_t i = 0; i < moves_.size(); ++i) {
      if (!moves_[i]) grid[0][i] = grid[1][i] = 0.0;
    }
    return grid;
  }
  void strain(Parts& s, const Pair& grid, double dt) const {
    const Vector xx = g_[0].transpose() * grid[0], zz = g_[1].transpose() * grid[1];
    s.stress[0] += dt * (xx + lambda_ * zz);
    s.stress[1] += dt * (lambda_ * xx + zz);
    s.stress[2] += dt * shear_ * (g_[1].transpose() * grid[0] + g_[0].transpose() * grid[1]);
  }
  // A wall cancels the momentum of a node: its acceleration stops the node within the step.
  Pair accelerate(const Parts& s, const Pair& gathered, double dt) const {
    Pair a;
    for (int k = 0; k < 2; ++k) {
      const Vector &along = s.stress[k], &across = s.stress[2];
      a[k] = -mass_ * (g_[k] * along + g_[1 - k] * across).cwiseQuotient(lumped_);
      for (std::size_t i = 0; i < moves_.size(); ++i) {
        if (!moves_[i]) a[k][i] = -gathered[k][i] / dt;
      }
    }
    return a;
  }
  void transfer(Parts& s, const Pair& gathered, const Pair& acceleration, double dt) const {
    const mpm::Transfer& how = method_.transfer;
    const auto back = s_.transpose();
    Pair next;
    for (int k = 0; k < 2; ++k) {
      const Vector gain = dt * (back * acceleration[k]);
      next[k] = gathered[k] + dt * acceleration[k];
      switch (how.kind) {
        case mpm::TransferKind::flip:
          s.v[k] += gain - (1.0 - how.flip) * (s.v[k] - back * gathered[k]);
          break;
        case mpm::TransferKind::xpic:
          s.v[k] = back * sharpened(gathered[k], how.order) + gain;
          break;
        case mpm::TransferKind::fmpm:
          s.v[k] = back * sharpened(next[k], how.order);
          break;
        case mpm::TransferKind::apic:
          s.v[k] = back * next[k];
          break;
      }
    }
    for (int k = 0; apic() && k < 2; ++k) {
      const Vector b[2] = {arm_[0].transpose() * next[k], arm_[1].transpose() * next[k]};
      for (Eigen::Index p = 0; p < s_.cols(); ++p) {
        const Eigen::Vector2d row = inverse_moment_[p] * Eigen::Vector2d(b[0][p], b[1][p]);
        for (int j = 0; j < 2; ++j) s.gradient[k][j][p] = row[j];
      }
    }
  }
  // Sum of (I - S+ S)^j v over j < order: method reference 6.6.
  Vector sharpened(const Vector& v, int order) const {
    Vector sum = v, part = v;
    for (int j = 1; j < order; ++j) {
      part -= average_ * (s_.transpose() * part);
      sum += part;
    }
    return sum;
  }

  mpm::MethodDefinition method_;
  std::vector<Place> places_;
  double lambda_, shear_;  // relative to K + 4 G / 3
  double mass_ = 0.0;      // mass, and volume, of a particle
  std::vector<Place> nodes_;
  std::vector<bool> moves_;    // per node: not fixed by a wall
  Matrix s_;                   // nodes x particles
  std::array<Matrix, 2> g_;    // gradients along x and z, nodes x particles
  Vector lumped_;              // M
  Matrix average_;             // M^-1 S m
  std::array<Matrix, 2> arm_;  // APIC only
  std::vector<Eigen::Matrix2d> inverse_moment_;
};

}  // namespace stability
