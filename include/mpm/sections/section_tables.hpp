// The keys of sections whose definitions are of the scene alone.
#pragma once

#include "mpm/advice/auto_method.hpp"
#include "mpm/keys/key_table.hpp"
#include "mpm/scene/scene.hpp"

namespace mpm {

const KeyTable<OutputDefinition>& output_keys();
const KeyTable<GroundOutput>& ground_keys();
const KeyTable<BodyDefinition>& body_keys();
const KeyTable<RigidBodyDefinition>& rigid_body_keys();
const KeyTable<AutoMethod>& auto_keys();

}  // namespace mpm
