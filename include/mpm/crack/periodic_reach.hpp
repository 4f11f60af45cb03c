// Distance that cracks keep from periodic faces. Material goes around there, but a crack's line does not: whatever asks
// for what lies on either side of it must not have to look through the face.
#pragma once

#include <string>
#include <vector>

#include "mpm/crack/crack_fields.hpp"

namespace mpm {

/// Distance of a line from a periodic face [cells]: centres of particles may lie two cells beyond it between sorts, and
/// reach two more.
inline constexpr double kLineFromPeriodicFace = 4.0;

/// Says which crack has a line nearer to a periodic face than that, or a tip nearer by its contour of `contour` cells;
/// empty if none has.
std::string periodic_fault(const std::vector<Crack>& cracks, const GridLayout& layout, int contour);

}  // namespace mpm
