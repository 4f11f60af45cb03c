// The keys of ground that follows bodies.
#pragma once

#include "mpm/bed/bed_definition.hpp"
#include "mpm/keys/key_table.hpp"

namespace mpm {

const KeyTable<BedDefinition>& bed_keys();

}  // namespace mpm
