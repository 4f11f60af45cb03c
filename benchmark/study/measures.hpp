// The error measures that several suites share.
#pragma once

#include "study/suite.hpp"

namespace mpm::study {

/// Largest RMS over the particles of the distance from where they should be, over `length` [m]: of all sync points.
std::unique_ptr<ErrorMeasure> displacement_error(GeometryKind geometry, Motion motion, double length);

/// Largest |energy / energy at the start - 1| of all sync points.
std::unique_ptr<ErrorMeasure> energy_drift();

}  // namespace mpm::study
