// Definition of tractions between the faces of a crack: a law of the opening, such as that of a glue or of
// fibres that bridge the crack. Stresses in Pa, openings in m.
// Source: GIMP notes 3.2; NairnMPM's manual, Traction Laws.
#pragma once

#include <array>
#include <string>

#include "mpm/math/function.hpp"

namespace mpm {

enum class TractionKind { triangular, cubic, trilinear, exponential, linear, pressure, coupled, mixed };
inline constexpr std::array<const char*, 8> kTractionKindNames = {"triangular", "cubic",    "trilinear", "exponential",
                                                                  "linear",     "pressure", "coupled",   "mixed"};

/// The law along one direction, normal to the faces or along them.
struct TractionMode {
  double strength = 0.0;    ///< largest traction; of a trilinear law the one at the first corner [Pa]
  double opening = 0.0;     ///< at which the law has failed [m]
  double elastic = 0.0;     ///< up to which it is elastic; of a trilinear law the first corner's, of a cubic one 0 [m]
  double strength_2 = 0.0;  ///< traction of a trilinear law at the second corner [Pa]
  double elastic_2 = 0.0;   ///< opening of the second corner [m]
  double decay = 0.0;       ///< alpha of an exponential law
  double stiffness = 0.0;   ///< stiffness of a linear law [Pa/m]
};

struct TractionLawDefinition {
  std::string name;
  TractionKind kind = TractionKind::triangular;
  TractionKind curve = TractionKind::triangular;  ///< curve of a mixed law: triangular, cubic, trilinear or exponential
  TractionMode normal, shear;
  /// Exponent n of (G_I/G_Ic)^n + (G_II/G_IIc)^n = 1, at which a law whose directions know nothing of each other has
  /// failed; 0 or less: when one of them has.
  double mix = 1.0;
  Function pressure;            ///< pressure over time [Pa]; negative opens
  double least_opening = -1.0;  ///< below which the pressure does not act; negative: it acts always [m]
  std::string where;            ///< "file:line: key.path", for errors; may be empty
};

}  // namespace mpm
