// The instantiations of Continuum and of ParticleLoad, one translation unit each.
#pragma once

#include "mpm/mechanics/body_force.hpp"
#include "mpm/mechanics/continuum.hpp"

namespace mpm {

std::unique_ptr<Mechanics> make_plane_strain_ugimp(std::vector<ParticleSet>& sets, const std::vector<Law>& laws,
                                                   const ContinuumSettings& settings);
std::unique_ptr<Mechanics> make_solid_ugimp(std::vector<ParticleSet>& sets, const std::vector<Law>& laws,
                                            const ContinuumSettings& settings);
std::unique_ptr<BodyForce> make_plane_strain_ugimp_load(const std::vector<ParticleSet>& sets,
                                                        const std::vector<BodyForceTerm>& terms, int threads);
std::unique_ptr<BodyForce> make_solid_ugimp_load(const std::vector<ParticleSet>& sets,
                                                 const std::vector<BodyForceTerm>& terms, int threads);

}  // namespace mpm
