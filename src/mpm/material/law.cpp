#include "mpm/material/law.hpp"

#include <utility>
#include <vector>

namespace mpm {
namespace {

template <std::size_t... Number>
void add_names(bool (*fits)(const LawTraits&), std::vector<std::string>& names, std::index_sequence<Number...>) {
  const auto add = [&](const LawTraits& traits, const char* name) {
    if (fits(traits)) names.emplace_back(name);
  };
  (add(kTraitsOf<std::variant_alternative_t<Number, Law>>, std::variant_alternative_t<Number, LawDefinition>::kName),
   ...);
}

}  // namespace

std::string law_names(bool (*fits)(const LawTraits&)) {
  std::vector<std::string> names;
  add_names(fits, names, std::make_index_sequence<std::variant_size_v<Law>>());
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 < names.size() ? ", " : " and ";
    text += names[i];
  }
  return text;
}

Law make_law(const MaterialDefinition& material) {
  check(material);
  return std::visit([&](const auto& d) -> Law { return typename std::decay_t<decltype(d)>::Law(d, material.density); },
                    material.law);
}

}  // namespace mpm
