// Places of a problem's tool and ground within a cell of the grid.
//
// A suite whose faces all lie on rows of nodes shows a method at its best; a robot's tool lies anywhere. The grid is
// moved instead of the tool: its lower faces lie back by a part of a cell, its upper ones further out by the rest, and
// bodies that reach a face of the domain reach it again. Nothing else of the problem changes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "study/tool_force/row.hpp"

namespace mpm::study::tool_force {

/// Parts of a cell by which tool and ground lie beside rows of nodes along x and above them along z, in [0, 1).
using Place = std::array<double, 2>;

/// Text of a scene, moved so. @throws StudyError for a part outside [0, 1), or along an axis on which the problem
/// cannot be moved
std::string moved(const Problem& problem, const std::string& scene, const Place& place);

/// Five places that a problem can have, that on rows of nodes the first; that alone where it can have no other.
std::vector<Place> five_places(const Problem& problem);

/// The row of several places: means of force, lift, ripple, scatter and unloaded, the standard deviation of the force
/// over the exact one as `spread`, the imbalance that is furthest from 0, and the sum of processor time. A row that
/// did not end well stands for all. @param rows at least one
ForceRow mean_of(const std::vector<ForceRow>& rows);

}  // namespace mpm::study::tool_force
