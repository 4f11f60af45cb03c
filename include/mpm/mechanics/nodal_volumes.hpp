// Volumes, volume gradients and places of the material at nodes, by the kernels of the mechanics.
//
// No kernel is its own: scatter_load takes any three numbers a particle by m S, and the internal force of a body whose
// particles have mass 1 and the stress -V_p I is the sum of V_p G. About an axis the hoop component stays out and V_p
// is the area of the section, so the sum of G alone is taken (method reference 8.1, the area gradient). Weak: a
// particle's place is one number in single precision too, rounded as its mass is. Source: method reference 8.1, 8.2;
// Nairn & Guilkey (2015) (54), (55).
#pragma once

#include <memory>
#include <vector>

#include "mpm/kernel/kernels.hpp"
#include "mpm/material/law.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/step/volume_survey.hpp"

namespace mpm {

/// `kernels`: of the sets' precision, T double or float. `laws` and `densities` [kg/m^3, undeformed]: of each set.
/// `fields`, sets and laws outlive the result; for displacements sets have their start_x.
template <class T>
std::unique_ptr<VolumeSurvey> make_volume_survey(const mpm_kernel::KernelTable<T>& kernels, Fields& fields,
                                                 std::vector<ParticleSet>& sets, const std::vector<Law>& laws,
                                                 std::vector<double> densities, GeometryKind geometry, int threads);

}  // namespace mpm
