#include "mpm/crack/traction_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/crack/crack_error.hpp"

namespace mpm {
namespace {

constexpr double kLeastDecay = 1e-3;      ///< below it the exponential is a straight line but for round-off
constexpr double kLeastSoftening = 1e-9;  ///< part of a trilinear law's secant from its first corner to its second
constexpr int kMostNewtonSteps = 100;

void expect_positive(double number, const char* what, const char* unit) {
  if (!(number > 0.0) || !std::isfinite(number)) {
    throw CrackError(
        fmt::format("the {} of a traction law must be positive and finite, it is {} {}", what, number, unit));
  }
}

void expect_less(double elastic, double opening) {
  if (!(elastic < opening)) {
    throw CrackError(fmt::format(
        "a traction law is elastic up to {} m and has failed at {} m: the first must be less than the second", elastic,
        opening));
  }
}

}  // namespace

double exponential_area(double decay) {
  const double rest = std::exp(-decay);
  return 2.0 * (1.0 / decay + rest / std::expm1(-decay));
}

TractionCurve::TractionCurve(TractionKind shape, const TractionMode& mode) : shape_(shape), opening_(mode.opening) {
  expect_positive(mode.strength, "strength", "Pa");
  expect_positive(mode.opening, "opening at failure", "m");
  switch (shape) {
    case TractionKind::triangular:
    case TractionKind::trilinear:
      make_lines(mode);
      break;
    case TractionKind::cubic:
      make_cubic(mode);
      break;
    case TractionKind::exponential:
      make_exponential(mode);
      break;
    default:
      throw CrackError(
          fmt::format("'{}' is no shape of a traction curve; shapes are triangular, cubic, trilinear and "
                      "exponential",
                      kTractionKindNames[static_cast<std::size_t>(shape)]));
  }
}

void TractionCurve::make_lines(const TractionMode& mode) {
  expect_positive(mode.elastic, "elastic opening", "m");
  expect_less(mode.elastic, mode.opening);
  elastic_ = mode.elastic;
  stiffness_ = mode.strength / mode.elastic;
  corner_[corners_++] = {mode.elastic, mode.strength};
  if (shape_ == TractionKind::trilinear) {
    expect_positive(mode.strength_2, "traction at the second corner", "Pa");
    if (!(mode.elastic_2 >= mode.elastic && mode.elastic_2 <= mode.opening)) {
      throw CrackError(
          fmt::format("the second corner of a trilinear traction law, at {} m, must lie between the first "
                      "one and failure, from {} to {} m",
                      mode.elastic_2, mode.elastic, mode.opening));
    }
    if (!(mode.strength_2 / mode.elastic_2 < (1.0 - kLeastSoftening) * stiffness_)) {
      throw CrackError(
          fmt::format("the second corner of a trilinear traction law has {} Pa at {} m: it must lie below "
                      "the line through the origin and the first corner",
                      mode.strength_2, mode.elastic_2));
    }
    corner_[corners_++] = {mode.elastic_2, mode.strength_2};
  }
  corner_[corners_++] = {mode.opening, 0.0};
  toughness_ = dissipated(opening_);
}

void TractionCurve::make_cubic(const TractionMode& mode) {
  stiffness_ = 27.0 * mode.strength / (4.0 * mode.opening);
  toughness_ = 9.0 / 16.0 * mode.strength * mode.opening;
}

void TractionCurve::make_exponential(const TractionMode& mode) {
  expect_positive(mode.elastic, "elastic opening", "m");
  expect_less(mode.elastic, mode.opening);
  if (!(mode.decay >= kLeastDecay) || !std::isfinite(mode.decay)) {
    throw CrackError(
        fmt::format("the decay of an exponential traction law must be {} or more, it is {}; take a "
                    "triangular law for a straight line",
                    kLeastDecay, mode.decay));
  }
  elastic_ = mode.elastic;
  strength_ = mode.strength;
  decay_ = mode.decay;
  stiffness_ = strength_ / elastic_;
  toughness_ = 0.5 * strength_ * (elastic_ + exponential_area(decay_) * (opening_ - elastic_));
}

double TractionCurve::exponential_traction(double delta) const {
  const double xi = (delta - elastic_) / (opening_ - elastic_);
  return strength_ * (std::exp(-decay_ * xi) - std::exp(-decay_)) / -std::expm1(-decay_);
}

double TractionCurve::secant(double delta) const {
  if (delta >= opening_) return 0.0;
  if (delta <= elastic_) return stiffness_;
  if (shape_ == TractionKind::cubic) {
    const double left = 1.0 - delta / opening_;
    return stiffness_ * left * left;
  }
  if (shape_ == TractionKind::exponential) return exponential_traction(delta) / delta;
  int i = 0;
  while (delta >= corner_[i + 1].opening) ++i;
  const Corner &a = corner_[i], &b = corner_[i + 1];
  return (a.traction + (b.traction - a.traction) * (delta - a.opening) / (b.opening - a.opening)) / delta;
}

// On a straight line S - delta S' is its height above the origin, so that the energy grows evenly.
double TractionCurve::dissipated(double delta) const {
  delta = std::min(delta, opening_);
  if (delta <= elastic_) return 0.0;
  if (shape_ == TractionKind::cubic) {
    const double x = delta / opening_;
    return toughness_ * x * x * x * (4.0 - 3.0 * x);
  }
  if (shape_ == TractionKind::exponential) {
    const double xi = (delta - elastic_) / (opening_ - elastic_);
    const double area = -std::expm1(-decay_ * xi) / decay_ - std::exp(-decay_) * xi;
    return 0.5 * strength_ * elastic_ + strength_ * (opening_ - elastic_) * area / -std::expm1(-decay_) -
           0.5 * exponential_traction(delta) * delta;
  }
  double energy = 0.0;
  for (int i = 0; i + 1 < corners_ && delta >= corner_[i].opening; ++i) {
    const Corner &a = corner_[i], &b = corner_[i + 1];
    const double part = delta >= b.opening ? 1.0 : (delta - a.opening) / (b.opening - a.opening);
    energy += 0.5 * part * (a.traction * b.opening - b.traction * a.opening);
  }
  return energy;
}

double TractionCurve::opening_at(double damage) const {
  if (damage <= 0.0) return elastic_;
  if (damage >= 1.0) return opening_;
  if (shape_ == TractionKind::cubic) return opening_ * (1.0 - std::sqrt(1.0 - damage));
  const double secant = (1.0 - damage) * stiffness_;
  if (shape_ == TractionKind::exponential) {
    // Traction less secant is convex and falls: from the left Newton's method rises to the root without passing it.
    double delta = elastic_;
    for (int n = 0; n < kMostNewtonSteps; ++n) {
      const double slope = strength_ * decay_ * std::exp(-decay_ * (delta - elastic_) / (opening_ - elastic_)) /
                           (std::expm1(-decay_) * (opening_ - elastic_));
      const double next = delta + (exponential_traction(delta) - secant * delta) / (secant - slope);
      if (!(next > delta)) break;
      delta = next;
    }
    return std::min(delta, opening_);
  }
  int i = 0;
  while (secant * corner_[i + 1].opening < corner_[i + 1].traction) ++i;
  const Corner &a = corner_[i], &b = corner_[i + 1];
  const double width = b.opening - a.opening, drop = a.traction - b.traction;
  return (a.traction * width + drop * a.opening) / (secant * width + drop);
}

}  // namespace mpm
