// The keys of the sleep of material at rest.
#pragma once

#include "mpm/keys/key_table.hpp"
#include "mpm/sleep/sleep_definition.hpp"

namespace mpm {

const KeyTable<SleepDefinition>& sleep_keys();

}  // namespace mpm
