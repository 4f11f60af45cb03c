#include "mpm/math/dimension.hpp"
#include "mpm/mechanics/body_force_impl.hpp"
#include "mpm/mechanics/continuum_impl.hpp"
#include "mpm/mechanics/instances.hpp"
#include "mpm/shape/ugimp.hpp"

namespace mpm {

std::unique_ptr<Mechanics> make_solid_ugimp(std::vector<ParticleSet>& sets, const std::vector<Law>& laws,
                                            const ContinuumSettings& settings) {
  return std::make_unique<Continuum<Solid, Ugimp>>(sets, laws, settings);
}

std::unique_ptr<BodyForce> make_solid_ugimp_load(const std::vector<ParticleSet>& sets,
                                                 const std::vector<BodyForceTerm>& terms, int threads) {
  return std::make_unique<ParticleLoad<Solid, Ugimp>>(sets, terms, threads);
}

}  // namespace mpm
