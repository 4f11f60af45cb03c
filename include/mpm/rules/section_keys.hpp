// The keys of the sections time, method and contact.
#pragma once

#include "mpm/definition/definition.hpp"
#include "mpm/keys/key_table.hpp"

namespace mpm {

const KeyTable<TimeDefinition>& time_keys();
const KeyTable<MethodDefinition>& method_keys();
const KeyTable<AxisRules>& axis_keys();
/// Keys of all contact, without those of a law.
const KeyTable<ContactDefinition>& contact_keys();
/// The keys of a law of contact.
const KeyTable<ContactLaw>& contact_law_keys();
const KeyTable<GeostaticDefinition>& geostatic_keys();

}  // namespace mpm
