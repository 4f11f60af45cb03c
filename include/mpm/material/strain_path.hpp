// Paths of strain and stress along which a piece of material is driven, as in a laboratory. A path consists of legs, on
// each of which every component has either a strain or a stress that changes at a constant rate. Components: xx, yy,
// zz, yz, xz, xy.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mpm/math/error.hpp"

namespace mpm {

/// Thrown for a path that cannot be driven, which is bad input.
class PathError : public Error {
 public:
  using Error::Error;
};

constexpr int kComponents = 6;
using Components = std::array<double, kComponents>;
/// "xx", "yy", "zz", "yz", "xz", "xy"
extern const std::array<const char*, kComponents> kComponentNames;

/// The prescribed quantity of a component. Strain is the integral of the rate of deformation: logarithmic strain where
/// the axes do not turn.
enum class Control {
  strain,        ///< tensor component; a shear strain without rotation
  simple_shear,  ///< engineering shear, displacement along the first axis in proportion to the second (xz: d vx / dz)
  stress         ///< Cauchy stress [Pa]
};

struct Leg {
  double duration = 0.0;  ///< [s]
  int steps = 0;
  std::array<Control, kComponents> control{};
  Components target{};      ///< value at the end of the leg, approached at a constant rate
  double growth = 0.0;      ///< growth in a leg: strain that brings no stress, logarithmic, alike along all axes
  bool from_start = false;  ///< strains of `target` are relative to the start of the leg instead of the path
};
using StrainPath = std::vector<Leg>;

/// Parameters of the paths below. Those without a value have a default; a parameter that a path does not use is
/// refused.
struct PathDefinition {
  /// Strain at the end: along z (`triaxial`: beyond that of the confining pressure), of volume, or engineering shear;
  /// compression is negative. Default -0.01, for shear 0.01.
  std::optional<double> strain;
  std::optional<double> confining;  ///< `triaxial`: confining pressure [Pa], > 0; default 1e5
  std::optional<double> stress;     ///< `creep`: the constant stress [Pa]; no default
  std::optional<double> rate;       ///< strain rate [1/s], > 0; default 1
  std::optional<double> hold;       ///< `relaxation`, `creep`: time at constant strain or stress [s], > 0; default 1
  bool shear = false;               ///< `relaxation`, `creep`: shear xz instead of strain along z with free sides
  int steps = 100;                  ///< per leg
};

/// "uniaxial_strain", "uniaxial_stress", "triaxial", "simple_shear", "volumetric", "relaxation", "creep"
const std::vector<std::string>& strain_path_names();
/// Makes the path of this name. @throws PathError for an unknown name or a number that the path cannot have
StrainPath make_strain_path(const std::string& name, const PathDefinition& definition);

}  // namespace mpm
