// The initial state of a particle that is to start under a stress or at a temperature. The same Cauchy stress means the
// same in every law; laws differ in the variables from which they compute it:
//
//   the stress itself    linear_elastic, drucker_prager, mohr_coulomb, mu_i, cam_clay, norsand: F = I
//   J and the stress     j2_plasticity, johnson_cook: pressure by a change of volume along the axes that can strain,
//                        the deviator is carried
//   J alone              newtonian_fluid, ideal_gas: pressure; a deviator cannot be carried
//   F                    neo_hookean, viscoelastic: F is the pure stretch that has this stress, found in principal
//                        axes by Newton's method. In plane strain F_yy = 1, so yy follows from the rest.
//
// In a line F_yy = F_zz = 1 and the stress has one free component, xx. In plane stress yy is zero, and laws that
// compute stress from F find F_yy like the rest of F.
//
// States are found from the laws themselves, by a step of unlimited duration without motion: stress has then relaxed,
// and flow has come to rest. A stress that changes in such a step cannot be carried, above all one outside a yield
// surface.
#pragma once

#include <optional>
#include <string>

#include "mpm/material/law.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/math/tensor.hpp"

namespace mpm {

/// Thrown for a state that a material cannot start in; what() does not name the place, which the caller knows.
class InitialStateError : public Error {
 public:
  using Error::Error;
};

struct InitialState {
  Matrix3<double> f = Matrix3<double>::identity();
  Symmetric3<double> tau{};         ///< Kirchhoff stress over initial density [J/kg]
  double temperature_excess = 0.0;  ///< temperature minus the law's reference temperature [K]
  double hardening = 0.0;           ///< the law's history scalar kHardening
  double j() const { return determinant(f); }
};

/// The state that is required of a particle at the start.
struct InitialRequest {
  std::optional<Symmetric3<double>> cauchy;  ///< [Pa], tension positive
  bool yy_follows = false;  ///< plane strain: yy follows from the rest, cauchy.yy is ignored; always so in a line
  std::optional<double> temperature;  ///< [K]
};

class InitialStates {
 public:
  /// @throws MaterialError
  InitialStates(const MaterialDefinition& material, GeometryKind geometry);

  /// The state that meets the request. @throws InitialStateError
  InitialState find(const InitialRequest& request) const;
  /// True if the material can carry the stress at rest.
  bool carries(const Symmetric3<double>& cauchy) const;
  /// Index in history of temperature minus reference temperature, or -1.
  int temperature_index() const;
  /// Index in history of the initial hardening, or -1.
  int hardening_index() const;
  /// True if the geometry is plane strain and yy follows from the other components.
  bool yy_is_bound() const;

 private:
  InitialState volume_for(const Symmetric3<double>& cauchy, double excess) const;
  InitialState stretch_for(const Symmetric3<double>& cauchy, bool yy_follows) const;
  /// tau of a state after unlimited time at rest.
  Symmetric3<double> relaxed(const InitialState& state) const;
  Symmetric3<double> cauchy_of(const InitialState& state) const;
  [[noreturn]] void refuse(const std::string& why) const;

  MaterialDefinition material_;
  Law law_;
  GeometryKind geometry_;
  double least_ = 0.0;  ///< stress at the round-off of the stiffness [Pa]
};

/// Ratio of horizontal to vertical stress at rest: 1 - sin(phi) for soils (Jaky 1944; mu_s for mu_i;
/// times OCR^sin(phi) for cam_clay and norsand, Mayne & Kulhawy 1982), nu / (1 - nu) for
/// elastic solids, 1 for fluids and for johnson_cook, which has no Poisson's ratio. No value for a gas, whose pressure
/// at rest does not come from its weight.
std::optional<double> pressure_at_rest(const LawDefinition& law);

}  // namespace mpm
