// The keys of a volume in which material is counted.
#pragma once

#include "mpm/keys/key_table.hpp"
#include "mpm/volumes/volume_definition.hpp"

namespace mpm {

const KeyTable<VolumeDefinition>& volume_keys();

}  // namespace mpm
