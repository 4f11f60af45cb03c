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

/// The first value of a definition that is out of the range of its key, with the path to it: of time, contact, cracks,
/// transport and sleep. Materials, method and what has a check of its own are looked at elsewhere.
std::optional<KeyFault> keys_fault(const SimulationDefinition& definition);

}  // namespace mpm
