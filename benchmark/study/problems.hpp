// The problems, each in its own file of src/mpm/study; suites.cpp puts them in order.
#pragma once

#include "study/suite.hpp"

namespace mpm::study {

Suite vibrating_bar();
/// `geometry`: line, plane_strain or solid. `amplitude` of the displacement over the length of the body.
Suite manufactured(const std::string& name, GeometryKind geometry, double amplitude);
/// `angle` that the middle of the ring turns by [rad].
Suite vortex(const std::string& name, double angle);
Suite rotation();
Suite colliding_disks();
Suite plate_compression();
Suite sliding_block();

}  // namespace mpm::study
