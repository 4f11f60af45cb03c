#include "mpm/math/dimension.hpp"
#include "mpm/mechanics/continuum_impl.hpp"
#include "mpm/mechanics/instances.hpp"
#include "mpm/shape/ugimp.hpp"

namespace mpm {

std::unique_ptr<Mechanics> make_solid_ugimp(std::vector<ParticleSet>& sets, const ContinuumSettings& settings) {
  return std::make_unique<Continuum<Solid, Ugimp>>(sets, settings);
}

}  // namespace mpm
