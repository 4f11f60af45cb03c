// Cracks as a file for ParaView: a line along each face, so that an open crack is seen as such, with openings,
// tractions and what is known of the tips at the points.
#pragma once

#include <mpm_ros/Cracks.h>

#include "mpm_ros/record/vtk_file.hpp"

namespace mpm_ros {

/// Lines of each crack: the face above, then the one below, start to end. Values at the points: `crack` (from 1 in the
/// message's order), `face` (1 above, 2 below), `opening` and `slip` [m] of the face above against the one below,
/// across the chain and along it, `normal_traction` and `shear_traction` [Pa], `debonded` (0 or 1), and at tips `j`
/// [J/m^2], `k_one` and `k_two` [Pa m^0.5]: NaN at all other points. `time` [s].
/// `fine`: places are float64.
VtkFile crack_lines(double time, const Cracks& message, bool fine = false);

}  // namespace mpm_ros
