// The keys of damping.
#pragma once

#include "mpm/keys/key_table.hpp"
#include "mpm/step/damping.hpp"

namespace mpm {

const KeyTable<DampingDefinition>& damping_keys();
const KeyTable<FeedbackDefinition>& feedback_keys();

}  // namespace mpm
