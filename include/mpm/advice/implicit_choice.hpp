// Rule by which `method: auto` takes implicit steps (doc/implicit.md): where all material is soil in which forces were
// measured, each tool cuts through it or rolls on it, slower than a tenth of the waves, nothing in the scene needs
// explicit steps, and a step of the usual length spans at least three of them.
//
// A tool cuts that moves more across gravity than along it, and by no more than a cell down where it is in the ground,
// and rolls that turns and is free to move on. The force on a tool that is pressed down depends on the soil's
// stiffness, which sweeps resolve the less the finer the cells are (a wheel pressed in meets 0.4 of its force with 10
// mm and 0.05 with 5 mm); commands move a tool as no scene tells. Both stay explicit, unless target.tool says that the
// tool is a blade or a wheel. Without gravity a blade and a plate look alike, and both stay explicit.
//
// Source: the suite of tools, on which blades are within 10 % with 4 cells of depth in implicit steps, strips and discs
// are not, and the paces of the shipped scenes: an implicit step costs 1.5 to 2.5 explicit ones.
#pragma once

#include "mpm/advice/auto_method.hpp"
#include "mpm/yaml/reader.hpp"

namespace mpm {

/// Takes implicit steps, with what belongs to them, if they fit; adds why to Scene::choices. All sections of the scene
/// but `metrics` and `target` have been read. Returns true if it took them.
bool choose_implicit(const AutoMethod& asked, const Map& root, Scene& scene);

/// Transfer of implicit steps of a scene that names none.
Transfer transfer_of_implicit();
/// Takes the length of implicit steps of a scene that names none, and says so.
void take_implicit_step(Scene& scene);

}  // namespace mpm
