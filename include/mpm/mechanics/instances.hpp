// The instantiations of Continuum, one translation unit each.
#pragma once

#include "mpm/mechanics/continuum.hpp"

namespace mpm {

std::unique_ptr<Mechanics> make_plane_strain_ugimp(std::vector<ParticleSet>& sets, const std::vector<Law>& laws,
                                                   const ContinuumSettings& settings);
std::unique_ptr<Mechanics> make_solid_ugimp(std::vector<ParticleSet>& sets, const std::vector<Law>& laws,
                                            const ContinuumSettings& settings);

}  // namespace mpm
