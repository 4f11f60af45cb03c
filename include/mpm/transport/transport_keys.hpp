// The keys of what is transported.
#pragma once

#include "mpm/keys/key_table.hpp"
#include "mpm/transport/definition.hpp"

namespace mpm {

/// Keys of each quantity.
const KeyTable<QuantityDefinition>& quantity_keys();
/// Keys of `temperature` alone.
const KeyTable<QuantityDefinition>& heat_keys();
const KeyTable<ToolHeatDefinition>& tool_heat_keys();

}  // namespace mpm
