// Paths of strain and stress that a piece of material is driven along, as laboratories do: legs, on each of which every
// component is either strained or stressed at a constant rate. Components: xx, yy, zz, yz, xz, xy.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mpm/math/error.hpp"

namespace mpm {

/// A path that cannot be driven: bad input.
class PathError : public Error {
 public:
  using Error::Error;
};

constexpr int kComponents = 6;
using Components = std::array<double, kComponents>;
/// "xx", "yy", "zz", "yz", "xz", "xy"
extern const std::array<const char*, kComponents> kComponentNames;

/// What is prescribed of a component. Strain is the integral of the rate of deformation: along axes that do not turn,
/// the logarithmic strain.
enum class Control {
  strain,        ///< of the tensor; a shear strain without rotation
  simple_shear,  ///< engineering shear, the first axis displaced in proportion to the second (xz: d vx / dz)
  stress         ///< Cauchy stress [Pa]
};

struct Leg {
  double duration = 0.0;  ///< [s]
  int steps = 0;
  std::array<Control, kComponents> control{};
  Components target{};      ///< at the end of the leg; a component goes there from where it is at a constant rate
  bool from_start = false;  ///< strains of `target` count from the start of the leg, not from the path's
};
using StrainPath = std::vector<Leg>;

/// What the paths below are made from. What is not given has a default; what a path has no use for is refused.
struct PathDefinition {
  /// Reached at the end: along z (`triaxial`: beyond what the confining pressure did), of volume, or engineering shear;
  /// compression is negative. Default -0.01, shear 0.01.
  std::optional<double> strain;
  std::optional<double> confining;  ///< `triaxial`: pressure around [Pa], > 0; default 1e5
  std::optional<double> stress;     ///< `creep`: what is held [Pa]; no default
  std::optional<double> rate;       ///< of the strain [1/s], > 0; default 1
  std::optional<double> hold;       ///< `relaxation`, `creep`: for how long [s], > 0; default 1
  bool shear = false;               ///< `relaxation`, `creep`: in shear xz, in place of along z with free sides
  int steps = 100;                  ///< a leg
};

/// "uniaxial_strain", "uniaxial_stress", "triaxial", "simple_shear", "volumetric", "relaxation", "creep"
const std::vector<std::string>& strain_path_names();
/// @throws PathError for an unknown name, or a number that the path cannot have.
StrainPath make_strain_path(const std::string& name, const PathDefinition& definition);

}  // namespace mpm
