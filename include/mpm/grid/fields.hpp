// Velocity fields: bodies that may move apart where they share nodes (contact, the two sides of a thin tool) each have
// a grid of their own. All have one layout, walls and least mass; each has its own blocks, so memory and work follow
// the material of the field. A block has the same key in every field. A scene without such bodies has one field.
//
// A particle gives to one field, ParticleSet::field_of(), and takes from the same. Whatever acts between fields does so
// at nodes that carry mass in both.
// Source: Bardenhagen, Brackbill & Sulsky (2000), The material-point method for granular materials, Comput. Methods
// Appl. Mech. Engrg 187, 529-541; held here as sparse grids.
#pragma once

#include <memory>
#include <vector>

#include "mpm/grid/nodal_fields.hpp"

namespace mpm {

using Fields = std::vector<std::unique_ptr<Grid>>;  ///< at least one

/// `count` fields, without blocks yet. @throws GridError when their blocks cannot be numbered
Fields make_fields(const GridLayout& layout, int count = 1);

}  // namespace mpm
