// The keys of cracks: of all, of one, of their growth and of a material's fracture.
#pragma once

#include "mpm/crack/definition.hpp"
#include "mpm/keys/key_table.hpp"

namespace mpm {

const KeyTable<CracksDefinition>& cracks_keys();
const KeyTable<ContourDefinition>& contour_keys();
const KeyTable<CrackDefinition>& crack_keys();
/// Keys of what faces that meet do, beside the keys of a law of contact.
const KeyTable<CrackFaces>& face_keys();
const KeyTable<GrowthRule>& growth_keys();
const KeyTable<FractureConstants>& fracture_keys();
const KeyTable<TractionLawDefinition>& traction_law_keys();

}  // namespace mpm
