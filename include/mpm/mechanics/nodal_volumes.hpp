// Volumes, volume gradients and places of the material at nodes, by the transfers of step/scalar_transfer.hpp.
//
// About an axis V_p is the area of the particle's section, and the hoop function stays out of the gradient (method
// reference 8.1, the area gradient). The area is that of a ring of the particle's volume around the place of the
// particle, now or at the start. Weak: a particle's place is one number in single precision too, rounded as its mass
// is. Source: method reference 8.1, 8.2; Nairn & Guilkey (2015) (54), (55).
#pragma once

#include <memory>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/grid/node_choice.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/step/scalar_transfer.hpp"
#include "mpm/step/volume_survey.hpp"

namespace mpm {

/// `transfer`: of these fields and sets. `densities` [kg/m^3, undeformed]: of each set. `fields`, `sets` and `choice`
/// (that of the transfer) outlive the result; sets have their start_x where displacements are asked for, and about an
/// axis for volumes at the start.
std::unique_ptr<VolumeSurvey> make_volume_survey(std::unique_ptr<ScalarTransfer> transfer, Fields& fields,
                                                 std::vector<ParticleSet>& sets, std::vector<double> densities,
                                                 GeometryKind geometry, int threads,
                                                 const NodeChoice* choice = nullptr);

}  // namespace mpm
