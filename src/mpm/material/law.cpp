#include "mpm/material/law.hpp"

#include <utility>
#include <vector>

#include "mpm/material/add_user_law.hpp"

namespace mpm {
namespace {

constexpr std::size_t kListed = std::variant_size_v<Law> - 1;
static_assert(std::is_same_v<std::variant_alternative_t<kListed, Law>, UserLaw>, "laws of users come last");

template <std::size_t... Number>
bool has_name(const std::string& name, std::index_sequence<Number...>) {
  return ((name == std::variant_alternative_t<Number, LawDefinition>::kName) || ...);
}

template <std::size_t... Number>
void add_names(bool (*fits)(const LawTraits&), std::vector<std::string>& names, std::index_sequence<Number...>) {
  const auto add = [&](const LawTraits& traits, const char* name) {
    if (fits(traits)) names.emplace_back(name);
  };
  (add(kTraitsOf<std::variant_alternative_t<Number, Law>>, std::variant_alternative_t<Number, LawDefinition>::kName),
   ...);
  for (const UserLawKind* kind : user_laws()) add(kind->traits, kind->name.c_str());
}

}  // namespace

bool listed_law(const std::string& name) { return has_name(name, std::make_index_sequence<kListed>()); }

LawTraits traits_of(const UserLaw& law) { return law.kind().traits; }
LawTraits traits_of(const LawDefinition& law) {
  const auto* own = std::get_if<UserLawDefinition>(&law);
  if (own != nullptr && own->kind != nullptr) return own->kind->traits;
  return std::visit([](const auto& own) { return kTraitsOf<typename std::decay_t<decltype(own)>::Law>; }, law);
}

std::string law_names(bool (*fits)(const LawTraits&)) {
  std::vector<std::string> names;
  add_names(fits, names, std::make_index_sequence<kListed>());
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
