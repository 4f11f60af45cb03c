// Tractions between the faces of a crack that follow from its opening and its history. Four families:
//
//   decoupled  triangular, cubic, trilinear, exponential: each direction knows only its own largest opening; fails when
//              one direction has, or when (G_I/G_Ic)^n + (G_II/G_IIc)^n = 1. The tractions left then drop to zero.
//   coupled    sawtooth of one dimensionless opening (Hoegberg 2006)
//   mixed      one damage for both directions, each with a curve of its own (Nairn & Aimene 2021)
//   linear     springs that never break; pressure: a load, given by time
//
// Work is summed by the trapezoid rule along the straight way from the last openings to the present ones, with knots
// where damage begins to grow and where the law fails. Faces that are closed have no normal traction, contact has: a
// negative normal opening counts as 0, except for pressure. Weak: `coupled` and `mixed` split the energy between the
// modes by that straight way, which errs with the square of a step that turns.
// Source: crack reference 5.4, 5.5; NairnMPM's manual, Traction Laws.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mpm/crack/traction_curve.hpp"
#include "mpm/crack/traction_law_definition.hpp"
#include "mpm/math/state_archive.hpp"

namespace mpm {

/// Direction at faces: normal to them (mode I) or along them (mode II).
enum class CrackMode { normal, shear };

/// Traction between the faces; positive pulls faces of positive opening together [Pa].
struct Traction {
  double normal = 0.0, shear = 0.0;
};

/// Displacement of the face above relative to the one below [m].
struct FaceOpening {
  double normal = 0.0, shear = 0.0;
};

/// History of one point of a crack; the members that its law does not need stay 0.
struct TractionState {
  std::array<double, 2> largest{};     ///< opening so far, by CrackMode, of a decoupled law [m]
  double damage = 0.0;                 ///< coupled: largest opening over that of failure; mixed: D [1]
  std::array<double, 2> dissipated{};  ///< by CrackMode [J/m^2]
  double freed = 0.0;                  ///< stored when the law failed before its traction was gone [J/m^2]
  double work = 0.0;                   ///< that opened the faces against the tractions, the integral of T du [J/m^2]
  FaceOpening opening;                 ///< at the last step [m]
  Traction traction;                   ///< at the last step [Pa]
  bool failed = false;                 ///< nothing holds the faces any more
};

/// Writes or reads the histories of all points.
void serialise(StateArchive& archive, std::vector<TractionState>& states);

class TractionLaw {
 public:
  /// @throws CrackError for numbers that make no law; it names the law and its place in the scene
  explicit TractionLaw(TractionLawDefinition definition);

  /// Tractions at the present openings [m] and time [s]; the history follows. A law whose pressure is an expression
  /// serves one thread at a time (math/function.hpp).
  /// @throws CrackError for an opening that is not finite; FunctionError
  Traction advance(double normal_opening, double shear_opening, double time, TractionState& state) const;

  /// Energy that closing from these openings [m], reached by advance(), gives back [J/m^2]. Work is what is stored and
  /// what is released, except under pressure, which is a load.
  double stored(const TractionState& state, double normal_opening, double shear_opening) const;
  /// Dissipated, and freed at failure [J/m^2].
  double released(const TractionState& state) const;
  /// Part that the faces between the tip and this point take from J on a contour through it (crack reference 4.5): the
  /// work done here, under pressure the present one times the opening on which it acts [J/m^2].
  double face_work(const TractionState& state) const;

  /// The largest change of traction with opening [Pa/m], for the limit of the step.
  double stiffness() const;
  /// G_c [J/m^2]; infinite for a law that never fails.
  double toughness(CrackMode mode) const;
  const TractionLawDefinition& definition() const { return definition_; }

 private:
  void check_coupled() const;
  bool has_curves() const;
  std::array<double, 2> secants(const TractionState& state) const;
  double coupled_factor(double damage) const;
  bool decoupled_failed(const TractionState& state) const;
  void advance_decoupled(const FaceOpening& from, const FaceOpening& to, TractionState& state) const;
  void advance_coupled(const FaceOpening& from, const FaceOpening& to, TractionState& state) const;
  void advance_mixed(const FaceOpening& from, const FaceOpening& to, TractionState& state) const;
  double damage_at(const FaceOpening& opening, double least) const;

  TractionLawDefinition definition_;
  std::array<TractionCurve, 2> curve_;
};

}  // namespace mpm
