#include "mpm/math/error.hpp"

namespace mpm {
namespace {

constexpr std::size_t kLongest = 800;
constexpr std::size_t kBeginning = 400;
constexpr std::size_t kEnd = 300;

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }  // UTF-8

std::string one_line(std::string text) {
  if (text.size() > kLongest) {
    std::size_t stop = kBeginning, resume = text.size() - kEnd;
    while (stop > 0 && continues_character(text[stop])) --stop;
    while (resume < text.size() && continues_character(text[resume])) ++resume;
    text = text.substr(0, stop) + " [...] " + text.substr(resume);
  }
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return text;
}

}  // namespace

Error::Error(const std::string& text) : std::runtime_error(one_line(text)) {}

}  // namespace mpm
