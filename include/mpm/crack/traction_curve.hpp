// Traction between the faces of a crack along one direction while it opens for the first time: S(delta), delta the
// largest opening so far. On the way back the traction falls along the secant, S(delta) u / delta, to the origin. What
// is dissipated is Omega(delta), with dOmega = 1/2 (S - delta S') d delta. Damage is D = 1 - S / (k delta), k the slope
// at the origin. Weak: no law whose secant rises (S - delta S' < 0), which would heal as it opens. Source: crack
// reference 5.5; NairnMPM's manual, Traction Laws.
#pragma once

#include <array>

#include "mpm/crack/traction_law_definition.hpp"

namespace mpm {

class TractionCurve {
 public:
  /// Without traction.
  TractionCurve() = default;
  /// `shape`: triangular, cubic, trilinear or exponential. @throws CrackError for numbers that make no such curve
  TractionCurve(TractionKind shape, const TractionMode& mode);

  /// Traction over opening at a largest opening of `delta` [Pa/m].
  double secant(double delta) const;
  /// By then [J/m^2].
  double dissipated(double delta) const;
  /// The largest opening at which the damage is D, from 0 to 1 [m].
  double opening_at(double damage) const;
  /// Slope at the origin, which no other exceeds [Pa/m].
  double stiffness() const { return stiffness_; }
  /// G_c, dissipated when it has failed [J/m^2].
  double toughness() const { return toughness_; }
  /// Up to which nothing is dissipated [m]; 0 for a cubic law.
  double elastic() const { return elastic_; }
  /// At which it has failed [m].
  double opening() const { return opening_; }

 private:
  struct Corner {
    double opening = 0.0, traction = 0.0;
  };
  void make_lines(const TractionMode& mode);
  void make_cubic(const TractionMode& mode);
  void make_exponential(const TractionMode& mode);
  double exponential_traction(double delta) const;

  TractionKind shape_ = TractionKind::triangular;
  double stiffness_ = 0.0, toughness_ = 0.0, elastic_ = 0.0, opening_ = 0.0;
  double strength_ = 0.0, decay_ = 0.0;  ///< constants of an exponential law
  int corners_ = 0;                      ///< number of corners of a law of straight lines
  std::array<Corner, 3> corner_;
};

/// f of an exponential law's toughness, 1/2 sigma [u_e + f (u_c - u_e)]; 1 for a straight line, less with more decay.
double exponential_area(double decay);

}  // namespace mpm
