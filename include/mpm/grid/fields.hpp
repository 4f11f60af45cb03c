// Velocity fields: bodies that may move apart where they share nodes (contact, the two sides of a thin tool) have a
// grid each. All fields have the same layout, walls and least mass; each has its own blocks, so memory and work follow
// the material of the field. A block has the same key in every field. A scene without such bodies has one field.
//
// A particle spreads to and gathers from one field, ParticleSet::field_of(); near a crack it chooses one at every node
// (grid/node_choice.hpp). Interaction between fields takes place at
// nodes that carry mass in both.
// Source: Bardenhagen, Brackbill & Sulsky (2000), The material-point method for granular materials, Comput. Methods
// Appl. Mech. Engrg 187, 529-541; here the grids are sparse.
#pragma once

#include <memory>
#include <vector>

#include "mpm/grid/nodal_fields.hpp"

namespace mpm {

using Fields = std::vector<std::unique_ptr<Grid>>;  ///< at least one

/// @throws GridError when there are too many blocks to number in so many fields
void check_field_count(const GridLayout& layout, int count);
/// Makes `count` fields without blocks. @throws GridError when there are too many blocks to number
Fields make_fields(const GridLayout& layout, int count = 1);

}  // namespace mpm
