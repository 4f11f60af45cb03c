// A height field in a plane: a single row of heights.
#pragma once

#include <memory>

#include "mpm/rigid/surface.hpp"

namespace mpm {

/// Result of make_height_field() with one row, without end along y; the numbers are checked already.
std::unique_ptr<Surface> make_height_profile(const HeightGrid& grid);

/// An edge or corner this near, as a part of the grid's spacing, is touched: the direction to it is rounding.
constexpr double kTouching = 1e-9;

}  // namespace mpm
