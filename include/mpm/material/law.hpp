// The closed list of constitutive laws, and what the mechanics asks of each. A law is a plain class with
//
//   static constexpr int kHistory;                        scalars of history a particle
//   static constexpr int kPlasticStrain, kPlasticWork;    which of them is the equivalent plastic strain [-] and the
//                                                         plastic work [J/kg]; -1: none
//   void update(du, F, J_old, J, tau, history, p) const;  tau: Kirchhoff stress over initial density [J/kg], in and
//   out;
//                                                         du = grad v dt; F and J at the end of the increment;
//                                                         history[k][p] is scalar k of particle p
//   double elastic_energy(F, tau, J) const;               [J/kg]
//   double wave_speed(J) const;                           [m/s], fastest, tangent
//
// It is chosen once a block of particles of one material; inside the loop there is no virtual call and no branch on it.
// To add one: a definition in definition.hpp, a file beside these, its name in the two variants and in make_law().
#pragma once

#include <variant>

#include "mpm/material/definition.hpp"
#include "mpm/material/drucker_prager.hpp"
#include "mpm/material/linear_elastic.hpp"
#include "mpm/material/neo_hookean.hpp"

namespace mpm {

using Law = std::variant<LinearElastic, NeoHookean, DruckerPrager>;

/// @throws MaterialError when check() does.
Law make_law(const MaterialDefinition& material);

inline int history_size(const Law& law) {
  return std::visit([](const auto& l) { return l.kHistory; }, law);
}
inline double wave_speed(const Law& law, double j) {
  return std::visit([j](const auto& l) { return l.wave_speed(j); }, law);
}

}  // namespace mpm
