// Characters that look like plain ones and are others: a Unicode minus, a no-break space, a degree sign. Editors and
// web pages put them into text, where nobody sees them.
#pragma once

#include <string>

namespace mpm {

/// The first of them in a text, and what to write: "it has a no-break space (U+00A0), which looks like a space; type
/// the space anew". Empty without one.
std::string odd_character(const std::string& text);
/// The text with plain characters in their place: "kg/m³" becomes "kg/m^3", "35°" "35deg", "µm" "um".
std::string with_plain_characters(const std::string& text);

}  // namespace mpm
