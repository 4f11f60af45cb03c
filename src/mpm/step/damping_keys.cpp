#include "mpm/step/damping_keys.hpp"

namespace mpm {

const KeyTable<FeedbackDefinition>& feedback_keys() {
  using Feedback = FeedbackDefinition;
  constexpr Dimension kGain{-2, 0, 0, 0};
  static const auto keys =
      KeyTable<Feedback>("method.damping.feedback")
          .rows({number("gain", &Feedback::gain, kGain, kPositive,
                        {kRequired, "K in dα/dt = 2K/m (E - `target`), α = 0 at the start; m is the mass of all bodies",
                         "100 1/m^2"}),
                 number("target", &Feedback::target, kEnergy, kNotNegative,
                        {"",
                         "kinetic energy to settle at, of all bodies together, of `t` alone; planar scenes: of the "
                         "whole thickness",
                         "1e-3*t"}),
                 number("limit", &Feedback::limit, kRate, or_none(kPositive),
                        {"", "largest α; without a limit α can overdamp", "200 1/s"}),
                 word("of", &Feedback::of, {"grid", "particle"},
                      {"",
                       "`grid`: E is the energy of the grid's velocity at the particles, and α adds to `grid`; "
                       "`particle`: E is that of the particles' own velocity, and α adds to `particle`",
                       "particle"})});
  return keys;
}

const KeyTable<DampingDefinition>& damping_keys() {
  using Damping = DampingDefinition;
  static const auto keys =
      KeyTable<Damping>("method.damping")
          .rows(
              {number("grid", &Damping::grid, kRate, kNotNegative,
                      {"", "velocity loses this part of the grid's velocity per unit of time: α<sub>g</sub> v⁰ dt",
                       "20 1/s"}),
               number("particle", &Damping::particle, kRate, kNotNegative,
                      {"", "velocity loses this part of itself: α<sub>p</sub> v dt", "5*(z < 0.1)"}),
               number("pic", &Damping::pic, kPlain, kPart,
                      {"",
                       "part of PIC in the update of a *step*: it replaces the fraction in `transfer`, which must then "
                       "be `flip`, by one that changes with time or place",
                       "0.01*(t < 1)"}),
               word("placement", &Damping::in_force, {"update", "force"},
                    {"`force`; `update` for a rate that is a function of place",
                     "where `grid` and `feedback` of the grid act, see below; refused without either", "update"}),
               other<Damping>("feedback", "map, below", {"none", "a rate that is controlled by the kinetic energy"})});
  return keys;
}

}  // namespace mpm
