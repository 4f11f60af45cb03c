// The state that a particle starts in when it is to start under a stress or at a temperature. The same Cauchy stress
// means the same in every law; what differs is what the law keeps it in:
//
//   the stress itself    linear_elastic, drucker_prager, mohr_coulomb: F = I
//   J and the stress     j2_plasticity, johnson_cook: pressure by a change of volume along the axes that can strain,
//                        the deviator is carried
//   J alone              newtonian_fluid, ideal_gas: pressure; a deviator cannot be carried
//   F                    neo_hookean, viscoelastic: F is the pure stretch that has this stress, found in principal
//                        axes by Newton's method. In plane strain F_yy = 1, so yy follows from the rest.
//
// In a line F_yy = F_zz = 1 and the stress has one free component, xx; in plane stress yy is zero and F_yy is found as
// the rest of F is, where a law keeps it in F.
//
// Found from the laws themselves, by a step without motion that lasts for ever: what relaxes has relaxed, what flows
// has come to rest. A stress that such a step changes cannot be carried, above all one outside a yield surface.
#pragma once

#include <optional>
#include <string>

#include "mpm/material/law.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/math/tensor.hpp"

namespace mpm {

/// A state that a material cannot start in; what() has no place, which the caller knows.
class InitialStateError : public Error {
 public:
  using Error::Error;
};

struct InitialState {
  Matrix3<double> f = Matrix3<double>::identity();
  Symmetric3<double> tau{};         ///< Kirchhoff stress over initial density [J/kg]
  double temperature_excess = 0.0;  ///< over the law's reference temperature [K]
  double j() const { return determinant(f); }
};

/// What a particle is asked to start in.
struct InitialRequest {
  std::optional<Symmetric3<double>> cauchy;  ///< [Pa], tension positive
  bool yy_follows = false;                   ///< plane strain: cauchy.yy is what it makes it; always so in a line
  std::optional<double> temperature;         ///< [K]
};

class InitialStates {
 public:
  /// @throws MaterialError
  InitialStates(const MaterialDefinition& material, GeometryKind geometry);

  /// @throws InitialStateError
  InitialState find(const InitialRequest& request) const;
  /// Whether a stress can be carried.
  bool carries(const Symmetric3<double>& cauchy) const;
  /// Which scalar of history is the temperature less the reference one, or -1.
  int temperature_index() const;
  /// Whether yy is not free in plane strain: it follows from the other components.
  bool yy_is_bound() const;

 private:
  InitialState volume_for(const Symmetric3<double>& cauchy, double excess) const;
  InitialState stretch_for(const Symmetric3<double>& cauchy, bool yy_follows) const;
  /// tau of a state that has been held for ever.
  Symmetric3<double> held(const InitialState& state) const;
  Symmetric3<double> cauchy_of(const InitialState& state) const;
  [[noreturn]] void refuse(const std::string& why) const;

  MaterialDefinition material_;
  Law law_;
  GeometryKind geometry_;
  double least_ = 0.0;  ///< stress that is round-off of the stiffness [Pa]
};

/// Ratio of horizontal to vertical stress at rest: 1 - sin(phi) for soils (Jaky 1944), nu / (1 - nu) for elastic
/// solids, 1 for fluids and for johnson_cook, which has no Poisson's ratio. Nothing for a gas, which is not held by its
/// weight.
std::optional<double> pressure_at_rest(const LawDefinition& law);

}  // namespace mpm
