// Action of two surfaces that meet on each other, as the scene defines it: Coulomb's law, sticking, adhesion, or an
// imperfect interface; and the values of that law at one time.
//
// Source: Nairn, GIMP notes (3.12)-(3.20) and method reference 8.3 for friction, 8.4 for the interface; manual,
// Friction.
#pragma once

#include <optional>
#include <string>

#include "mpm/math/function.hpp"

namespace mpm {

/// A contact law at one time. Surfaces separate freely unless they adhere.
struct FrictionLaw {
  double coefficient = 0.0;  ///< coefficient of sliding, >= 0
  bool stick = false;        ///< no sliding while pressed together
  /// Coefficient at rest, >= coefficient; negative: the same as coefficient.
  double static_coefficient = -1.0;
  double adhesion = 0.0;  ///< largest tension between the surfaces, and shear in addition to friction [Pa]

  double at_rest() const { return static_coefficient < 0.0 ? coefficient : static_coefficient; }
};

/// Stiffness of an imperfect interface: traction over displacement discontinuity [Pa/m]. Negative: perfect in that
/// direction.
struct InterfaceLaw {
  double opened = 0.0;      ///< along the normal, surfaces apart (Dnt)
  double closed = -1.0;     ///< along the normal, surfaces pressed together (Dnc)
  double tangential = 0.0;  ///< (Dt)
};

/// The law of a pair of bodies. Coefficients and adhesion may depend on t.
struct ContactLaw {
  enum class Kind {
    coulomb,
    stick,
    interface,
    one_field  ///< the two share one velocity, as if they were one body
  };
  Kind kind = Kind::coulomb;
  Function friction;                        ///< coefficient of sliding
  std::optional<Function> static_friction;  ///< at rest; without it the same as `friction`
  Function adhesion;                        ///< [Pa]
  InterfaceLaw interface;

  /// The law's values at `time` [s]. @throws FunctionError when one is not finite.
  FrictionLaw at(double time) const {
    FrictionLaw law;
    law.coefficient = friction(time);
    law.stick = kind == Kind::stick || kind == Kind::one_field;
    if (static_friction) law.static_coefficient = (*static_friction)(time);
    law.adhesion = adhesion(time);
    return law;
  }
  /// The law's values in the step of `dt` [s] that begins at `start` [s]: functions are read at the middle of the step,
  /// in every kind of contact.
  /// `between()` names the surfaces, for errors. @throws FunctionError as at(), and when friction or
  /// adhesion is negative (sliding would be driven), or friction at rest is less than that of sliding.
  template <class Between>
  FrictionLaw in_step(double start, double dt, Between&& between) const {
    const FrictionLaw law = at(start + 0.5 * dt);
    const bool at_rest = !static_friction || law.static_coefficient >= law.coefficient;
    if (!(law.coefficient >= 0.0 && at_rest && law.adhesion >= 0.0)) {
      throw FunctionError(
          "contact of " + between() +
          ": friction or adhesion is negative, or friction at rest less than that of sliding; change the law");
    }
    return law;
  }
};

}  // namespace mpm
