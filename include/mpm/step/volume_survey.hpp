// Data that contact between materials needs from the mechanics: volume, volume gradient and mean place of the material
// at the nodes of some blocks of a velocity field.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/grid/fields.hpp"

namespace mpm {

/// The data of one velocity field, valid on the blocks that were asked for. About an axis volumes are areas of
/// sections.
struct NodalVolumes {
  NodalVolumes(int dim, int nodes)
      : volume(1, nodes),
        start_volume(1, nodes),
        gradient(dim, nodes),
        position(dim, nodes),
        displacement(dim, nodes),
        slope(static_cast<std::size_t>(dim), NodalField(dim, nodes)) {}

  NodalField volume;        ///< sum of V_p S, as deformed [m^3]
  NodalField start_volume;  ///< the same, undeformed [m^3]
  NodalField gradient;      ///< sum of V_p G: out of the material [m^2]
  NodalField position;      ///< sum of m x S [kg m]
  NodalField displacement;  ///< sum of m (x - X) S [kg m]
  /// [c], component k: sum of m S d u_c / d x_k, u the displacement [kg].
  std::vector<NodalField> slope;
};

/// Data to be computed besides volume and gradient.
struct SurveyWants {
  bool start_volume = false, position = false, displacement = false, slope = false;
};

class VolumeSurvey {
 public:
  virtual ~VolumeSurvey() = default;
  /// Computes the data of velocity field `field` at the present positions of particles, on the marked blocks (one mark
  /// for each block).
  virtual void survey(int field, const std::vector<std::uint8_t>& marked, const SurveyWants& wants,
                      NodalVolumes& result) = 0;
};

}  // namespace mpm
