#include "mpm/material/path_driver.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "mpm/math/exponential.hpp"
#include "mpm/math/principal.hpp"

namespace mpm {
namespace {

constexpr int kTermsOfStep = 12;      ///< terms of exp(du), as in MaterialPoint
constexpr double kLargestStep = 0.3;  ///< largest strain of a step for which kTermsOfStep are exact to round-off
constexpr double kTolerance = 1e-11;  ///< part of the largest stress
constexpr double kRoundOffOfModulus = 1e-14;  ///< part of the modulus
constexpr double kTangentStrain = 1e-8;       ///< for differences: half of the digits
constexpr int kIterations = 50;
constexpr int kHalvings = 20;
constexpr int kDivisions = 6;  ///< halvings of a step in which Newton's method does not converge

double largest(const Components& c) {
  double result = 0.0;
  for (const double value : c) result = std::max(result, std::abs(value));
  return result;
}

bool finite(const Components& c) {
  return std::all_of(c.begin(), c.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

/// A leg and the progress along it.
struct PathDriver::Progress {
  const Leg& leg;
  double begin;  ///< time [s]
  Components strain, stress;
  std::vector<int> unknowns;  ///< components whose stress is controlled
  double share = 0.0;         ///< part of the leg that is done
};

/// The values prescribed for one step.
struct PathDriver::Step {
  const Leg& leg;
  const std::vector<int>& unknowns;
  double dt;
  double time;           ///< at its end [s]
  double growth = 0.0;   ///< strain of the step that brings no stress
  Components goal{};     ///< stress at its end, where it is controlled [Pa]
  double tolerance = 0;  ///< [Pa]

  /// grad v dt
  Matrix3<double> gradient(const Components& d) const {
    const auto upper = [&](int k) { return leg.control[k] == Control::simple_shear ? 2.0 * d[k] : d[k]; };
    const auto lower = [&](int k) { return leg.control[k] == Control::simple_shear ? 0.0 : d[k]; };
    return {d[0], upper(5), upper(4), lower(5), d[1], upper(3), lower(4), lower(3), d[2]};
  }
};

PathDriver::PathDriver(const MaterialDefinition& material) : point_(material), density_(material.density) {
  const double speed = point_.wave_speed();
  modulus_ = density_ * speed * speed;
}

MaterialPoint PathDriver::advanced(const Step& step, const Components& increment) const {
  MaterialPoint next = point_;
  next.advance(step.gradient(increment), step.dt, step.growth);
  return next;
}

void PathDriver::run(const Leg& leg, const std::function<void()>& after_step) {
  if (leg.steps < 1) throw PathError(fmt::format("{} steps; take at least one", leg.steps));
  if (!(leg.duration > 0.0) || !std::isfinite(leg.duration)) {
    throw PathError(fmt::format("a leg of the path takes {:g} s; it must be positive and finite", leg.duration));
  }
  if (!finite(leg.target)) throw PathError("a strain or stress of the path is not finite");
  Progress progress{leg, time_, strain_, components(point_.cauchy()), {}};
  for (int k = 0; k < kComponents; ++k) {
    if (leg.control[k] == Control::stress) progress.unknowns.push_back(k);
  }
  last_ = {};
  for (int n = 1; n <= leg.steps; ++n) {
    advance_to(progress, static_cast<double>(n) / leg.steps, 0);
    if (after_step) after_step();
  }
}

void PathDriver::advance_to(Progress& progress, double share, int divisions) {
  const Leg& leg = progress.leg;
  const double part = share - progress.share;
  Step step{leg, progress.unknowns, part * leg.duration, progress.begin + share * leg.duration, part * leg.growth};
  Components increment{};
  for (int k = 0; k < kComponents; ++k) {
    const double target = leg.control[k] == Control::simple_shear ? 0.5 * leg.target[k] : leg.target[k];
    if (leg.control[k] == Control::stress) {
      step.goal[k] = progress.stress[k] + share * (target - progress.stress[k]);
      increment[k] = last_[k];
      continue;
    }
    const double way = leg.from_start ? target : target - progress.strain[k];
    increment[k] = progress.strain[k] + share * way - strain_[k];
    if (std::abs(increment[k]) > kLargestStep) {
      throw PathError(fmt::format("{} is strained by {:.3g} in one step, more than {:g}; take more steps",
                                  kComponentNames[k], increment[k], kLargestStep));
    }
  }
  const Components stress = components(point_.cauchy());
  step.tolerance = kTolerance * std::max(largest(stress), largest(step.goal)) + kRoundOffOfModulus * modulus_;
  if (!step.unknowns.empty() && !solve(step, increment)) {
    if (divisions == kDivisions) give_up(step, increment);
    last_ = {};
    advance_to(progress, 0.5 * (progress.share + share), divisions + 1);
    advance_to(progress, share, divisions + 1);
    return;
  }
  accept(step, increment);
  progress.share = share;
}

void PathDriver::accept(const Step& step, const Components& increment) {
  const Components before = components(point_.cauchy());
  MaterialPoint next = advanced(step, increment);
  const Components after = components(next.cauchy());
  if (!finite(after) || !(next.j() > 0.0)) {
    throw PathFailure(
        fmt::format("the law fails at t = {:.6g} s: J = {:g}, szz = {:g} Pa; take more steps, or a smaller strain",
                    step.time, next.j(), after[2]));
  }
  for (int k = 0; k < kComponents; ++k) {
    const double twice = k < 3 ? 1.0 : 2.0;
    work_ += 0.5 * twice * (before[k] * point_.j() + after[k] * next.j()) * increment[k] / density_;
    strain_[k] += increment[k];
  }
  last_ = increment;
  f_ = product(exponential(step.gradient(increment), kTermsOfStep), f_);
  point_ = std::move(next);
  time_ = step.time;
}

bool PathDriver::solve(const Step& step, Components& increment) const {
  const auto size = static_cast<Eigen::Index>(step.unknowns.size());
  const auto residual = [&](const Components& d) {
    const Components stress = components(advanced(step, d).cauchy());
    Eigen::VectorXd r(size);
    for (Eigen::Index i = 0; i < size; ++i) r[i] = stress[step.unknowns[i]] - step.goal[step.unknowns[i]];
    return r;
  };
  const auto reached = [&step](const Eigen::VectorXd& r) { return r.cwiseAbs().maxCoeff() <= step.tolerance; };
  /// Newton's method with line search from `d`; false where it leads no nearer to the goal.
  const auto newton = [&](Components& d, bool central) {
    Eigen::VectorXd r = residual(d);
    for (int iteration = 0; iteration < kIterations && !reached(r); ++iteration) {
      Eigen::MatrixXd tangent(size, size);
      for (Eigen::Index j = 0; j < size; ++j) {
        const double strain = std::copysign(kTangentStrain, -r[j]);
        Components moved = d;
        moved[step.unknowns[j]] += strain;
        tangent.col(j) = (residual(moved) - r) / strain;
        if (!central) continue;
        moved[step.unknowns[j]] -= 2.0 * strain;
        tangent.col(j) = 0.5 * (tangent.col(j) + (r - residual(moved)) / strain);
      }
      if (!tangent.allFinite()) return false;
      // Least squares, because a law may have no stiffness left in a direction.
      const Eigen::VectorXd correction = tangent.completeOrthogonalDecomposition().solve(-r);
      bool better = false;
      double part = std::min(1.0, 0.5 * kLargestStep / std::max(correction.cwiseAbs().maxCoeff(), 1e-300));
      for (int halving = 0; halving < kHalvings && !better; ++halving, part *= 0.5) {
        Components moved = d;
        for (Eigen::Index i = 0; i < size; ++i) moved[step.unknowns[i]] += part * correction[i];
        if (largest(moved) > kLargestStep) continue;
        const Eigen::VectorXd trial = residual(moved);
        better = trial.allFinite() && trial.norm() < r.norm();
        if (better) {
          d = moved;
          r = trial;
        }
      }
      if (!better) return false;
    }
    return reached(r);
  };
  // Differences are taken in the direction of the correction, since at a corner of a law the other side may have no
  // stiffness. Where that fails, they are taken to both sides: where equal stresses make the corner, the mean is right.
  const Components start = increment;
  if (newton(increment, false)) return true;
  Components other = start;
  if (!newton(other, true)) return false;
  increment = other;
  return true;
}

void PathDriver::give_up(const Step& step, const Components& increment) const {
  const Components stress = components(advanced(step, increment).cauchy());
  int worst = step.unknowns.front();
  for (const int k : step.unknowns) {
    if (std::abs(stress[k] - step.goal[k]) > std::abs(stress[worst] - step.goal[worst])) worst = k;
  }
  const char* name = kComponentNames[worst];
  throw PathFailure(
      fmt::format("the material cannot carry s{} = {:.6g} Pa at t = {:.6g} s: it reaches {:.6g} Pa; ask for less, take "
                  "more steps, or control the strain e{} instead",
                  name, step.goal[worst], step.time, stress[worst], name));
}

Symmetric3<double> PathDriver::logarithmic_strain() const {
  const Symmetric3<double> b = left_cauchy_green(f_);
  Principal<double> stretch = principal(b);
  for (double& value : stretch.value) value = 0.5 * std::log(value);
  return compose(stretch, b);
}

}  // namespace mpm
