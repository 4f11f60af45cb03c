// The keys of robots.
#pragma once

#include "mpm/keys/key_table.hpp"
#include "mpm/robot/definition.hpp"

namespace mpm {

const KeyTable<RobotDefinition>& robot_keys();
const KeyTable<BaseDefinition>& base_keys();
const KeyTable<JointDefinition>& joint_keys();
const KeyTable<SensorDefinition>& sensor_keys();

}  // namespace mpm
