#include "mpm/math/odd_characters.hpp"

#include <fmt/format.h>

#include <array>

namespace mpm {
namespace {

struct OddCharacter {
  const char* bytes;  ///< UTF-8
  const char* name;
  const char* code;
  const char* plain;
};

constexpr std::array<OddCharacter, 24> kOdd = {{{"\u2212", "Unicode minus", "U+2212", "-"},
                                                {"\u2010", "Unicode hyphen", "U+2010", "-"},
                                                {"\u2011", "no-break hyphen", "U+2011", "-"},
                                                {"\u2013", "en dash", "U+2013", "-"},
                                                {"\u2014", "em dash", "U+2014", "-"},
                                                {"\u00a0", "no-break space", "U+00A0", " "},
                                                {"\u202f", "narrow no-break space", "U+202F", " "},
                                                {"\u2009", "thin space", "U+2009", " "},
                                                {"\u2007", "figure space", "U+2007", " "},
                                                {"\u3000", "wide space", "U+3000", " "},
                                                {"\u200b", "zero-width space", "U+200B", ""},
                                                {"\ufeff", "byte order mark", "U+FEFF", ""},
                                                {"\u00b5", "micro sign", "U+00B5", "u"},
                                                {"\u03bc", "Greek mu", "U+03BC", "u"},
                                                {"\u00b0", "degree sign", "U+00B0", "deg"},
                                                {"\u00b2", "superscript two", "U+00B2", "^2"},
                                                {"\u00b3", "superscript three", "U+00B3", "^3"},
                                                {"\u00b7", "middle dot", "U+00B7", "*"},
                                                {"\u22c5", "dot operator", "U+22C5", "*"},
                                                {"\u00d7", "multiplication sign", "U+00D7", "*"},
                                                {"\u2215", "division slash", "U+2215", "/"},
                                                {"\uff1a", "wide colon", "U+FF1A", ":"},
                                                {"\u2019", "curved quote", "U+2019", "'"},
                                                {"\u201c", "curved quote", "U+201C", "\""}}};

const OddCharacter* odd_at(const std::string& text, std::size_t place) {
  if (static_cast<unsigned char>(text[place]) < 0x80) return nullptr;
  for (const OddCharacter& odd : kOdd) {
    if (text.compare(place, std::string(odd.bytes).size(), odd.bytes) == 0) return &odd;
  }
  return nullptr;
}

}  // namespace

std::string odd_character(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const OddCharacter* odd = odd_at(text, i);
    if (odd == nullptr) continue;
    const std::string plain = odd->plain;
    const std::string what = fmt::format("it has a {} ({})", odd->name, odd->code);
    if (plain.empty()) return what + ", which is not seen; delete it";
    if (plain == " ") return what + ", which looks like a space; type the space anew";
    return what + fmt::format("; write '{}' in its place", plain);
  }
  return {};
}

std::string with_plain_characters(const std::string& text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size();) {
    if (const OddCharacter* odd = odd_at(text, i)) {
      plain += odd->plain;
      i += std::string(odd->bytes).size();
    } else {
      plain += text[i++];
    }
  }
  return plain;
}

}  // namespace mpm
