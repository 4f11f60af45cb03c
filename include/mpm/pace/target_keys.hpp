// The keys of a target.
#pragma once

#include "mpm/keys/key_table.hpp"
#include "mpm/pace/target.hpp"

namespace mpm::pace {

const KeyTable<Target>& target_keys();

}  // namespace mpm::pace
