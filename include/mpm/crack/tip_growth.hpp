// Decides whether a crack's tip grows now, and where to. A rule is a criterion and a direction; a tip has a first rule
// and may have an alternate one, which is asked while the first has never made the tip grow.
//
//   TipGrowth growth;                                   // one for each tip; part of the run's state
//   const GrowthDecision now = growth.look(tip, rules);
//   if (now.grows) growth.grown(tip, now, length);      // the tip moves by length along now.direction
//
// A tip whose criterion sets a speed c (steady state, energy balance) next grows da / c after it was due, not after
// it grew, so that its mean speed is c although looks come late. Each look allows one length; of what a tip falls
// behind it makes good one length at most. Weak: J of one look decides, and J oscillates with the waves in the body.
// Faces that touch (a negative normal opening or K_I) count as closed without load: only shear then drives growth.
// Source: crack reference 5.1-5.3.
#pragma once

#include <optional>

#include "mpm/crack/energy_balance.hpp"
#include "mpm/crack/fracture_definition.hpp"
#include "mpm/crack/stress_intensity.hpp"
#include "mpm/math/constants.hpp"
#include "mpm/math/error.hpp"
#include "mpm/math/geometry.hpp"

namespace mpm {

/// Numbers of a tip from which no decision follows. what() names the number, the time and the remedy.
class FractureError : public Error {
 public:
  using Error::Error;
};

/// State of a tip at a look at growth. Openings and K in its frame: along `direction`, and normal to it to the
/// left.
struct TipState {
  double time = 0.0;        ///< [s]
  std::optional<double> j;  ///< J of the tip, without the work of tractions behind it [J/m^2]; empty: not found
  StressIntensity k;        ///< stress intensity; without meaning where J is not known
  double normal_opening = 0.0, shear_opening = 0.0;  ///< openings of the faces next to the tip [m]
  Vec2 direction = Vec2::UnitX();                    ///< direction of the last segment, length 1
  Vec2 initial_direction = Vec2::UnitX();            ///< the same at the run's start
  double length = 0.0;                               ///< length of the crack [m]
  double open_length = 0.0;                          ///< length of its segments without tractions [m]
  double grown_area = 0.0;               ///< area of all cracks, since the start [m^2]; for energy_balance only
  std::optional<BodyEnergies> energies;  ///< for energy_balance only
};

/// Rules of a tip: those that precedence has chosen, and what they need.
struct TipRules {
  GrowthRule first, alternate;
  FractureConstants constants;
  ElasticConstants elastic;                  ///< for energy_density and energy_balance only
  double longest = 0.0, longest_open = 0.0;  ///< limits of the crack, of its part without tractions [m]; 0: no limit
};
/// The material's own rules go before those of the scene.
TipRules tip_rules(const GrowthRule& first, const GrowthRule& alternate, const FractureConstants& constants,
                   const ElasticConstants& elastic);

struct GrowthDecision {
  bool grows = false;
  Vec2 direction = Vec2::UnitX();  ///< length 1; the tip's own if it does not grow
  double angle = 0.0;              ///< from the tip's direction, counter-clockwise [rad]
  double speed = 0.0;              ///< that the criterion sets [m/s]; 0: it sets none
  double released = 0.0;           ///< by the balance of energy [J/m^2]; 0: not known
  bool alternate = false;          ///< by the second rule
  bool lacks_j = false;            ///< it does not grow for want of J
  const char* reason = "";         ///< reason why it grows or does not, for reports
};

class TipGrowth {
 public:
  /// `rules` have no criterion_fault(). @throws FractureError for numbers that are not finite, a direction without a
  /// length, and a balance of energy without energies
  GrowthDecision look(const TipState& tip, const TipRules& rules);
  /// Books that the tip has grown by `length` [m] > 0 as `decision` says, from `tip`.
  void grown(const TipState& tip, const GrowthDecision& decision, double length);

  /// True if the alternate rule is still asked.
  bool alternate_is_open() const { return !first_has_grown_; }
  /// Time before which a tip of a set speed does not grow [s]; -infinity if it has none.
  double due() const { return due_; }

  void serialise(StateArchive& archive);

 private:
  GrowthDecision judge(const GrowthRule& rule, const TipState& tip, const TipRules& rules);
  void judge_steady(const TipState& tip, const FractureConstants& constants, GrowthDecision& decision);
  void judge_balance(const TipState& tip, const TipRules& rules, GrowthDecision& decision);

  bool first_has_grown_ = false;
  bool started_ = false;  ///< steady growth
  double due_ = -kInfinity;
  EnergyBalance balance_;
};

/// Angle of a rule's growth from the tip's direction [rad]; `by_criterion` as the criterion has it.
double growth_angle(const GrowthRule& rule, const TipState& tip, const FractureConstants& constants, double kappa);

/// Time between two looks at growth [s]: `factor` times that in which a wave crosses a cell, but a step at least.
double look_interval(double step, double factor, double cell, double wave_speed);

}  // namespace mpm
