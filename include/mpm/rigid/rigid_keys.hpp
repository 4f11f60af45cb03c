// The keys of free rigid bodies, of those that collide, and of the limits of commands.
#pragma once

#include "mpm/keys/key_table.hpp"
#include "mpm/rigid/collide.hpp"
#include "mpm/rigid/free_motion.hpp"
#include "mpm/rigid/motion_limits.hpp"

namespace mpm {

const KeyTable<FreeDefinition>& free_keys();
const KeyTable<CollideDefinition>& collide_keys();
const KeyTable<MotionLimits>& limit_keys();

}  // namespace mpm
