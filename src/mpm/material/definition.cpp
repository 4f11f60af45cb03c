#include "mpm/material/definition.hpp"

#include "mpm/material/add_user_law.hpp"

namespace mpm {

namespace {

template <class Definition>
auto elasticity_in(const Definition& d, int) -> decltype(std::optional<Elasticity>(d.elasticity)) {
  return d.elasticity;
}
template <class Definition>
std::optional<Elasticity> elasticity_in(const Definition&, long) {
  return std::nullopt;
}
template <class Definition>
auto friction_in(const Definition& d, int) -> decltype(std::optional<double>(d.friction_angle)) {
  return d.friction_angle;
}
template <class Definition>
std::optional<double> friction_in(const Definition&, long) {
  return std::nullopt;
}

}  // namespace

std::optional<Elasticity> elasticity_of(const LawDefinition& law) {
  return std::visit([](const auto& own) { return elasticity_in(own, 0); }, law);
}

std::optional<double> friction_angle(const LawDefinition& law) {
  if (std::holds_alternative<J2PlasticityDefinition>(law)) return 0.0;
  return std::visit([](const auto& own) { return friction_in(own, 0); }, law);
}

std::string law_name(const LawDefinition& law) {
  const auto* own = std::get_if<UserLawDefinition>(&law);
  if (own != nullptr && own->kind != nullptr) return own->kind->name;
  return std::visit([](const auto& listed) { return listed.kName; }, law);
}

}  // namespace mpm
