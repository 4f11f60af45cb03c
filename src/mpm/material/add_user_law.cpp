#include "mpm/material/add_user_law.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <deque>

#include "mpm/material/law.hpp"
#include "mpm/material/law_keys.hpp"

namespace mpm {
namespace {

/// Kinds by their place, which does not change, and the list of them. Made at the first call, which may come before
/// main().
struct Added {
  std::deque<UserLawKind> kinds;
  std::vector<const UserLawKind*> list;
};
Added& added() {
  static Added all;
  return all;
}

KeyTable<UserLawDefinition> keys_of(const UserLawKind& kind) {
  using User = UserLawDefinition;
  std::vector<Key<User>> rows;
  const std::size_t count = kind.constants.size();
  for (std::size_t i = 0; i < count; ++i) {
    const UserConstant& constant = kind.constants[i];
    KeyText text{kRequired, "constant of the law"};
    if (constant.otherwise) {
      text.fallback = quantity_text(*constant.otherwise, constant.dimension);
      text.told = text.fallback + ": as the law has it";
    }
    rows.push_back({{constant.key, std::move(text), constant.dimension, constant.range}, [i, count](User& of) {
                      of.constants.resize(count);
                      return KeyPlace(&of.constants[i]);
                    }});
  }
  return KeyTable<User>("materials." + kind.name).part(&User::elasticity, elasticity_keys()).rows(std::move(rows));
}

}  // namespace

UserLawDefinition UserLawKind::fresh() const {
  UserLawDefinition law;
  law.kind = this;
  for (const UserConstant& constant : constants) law.constants.push_back(constant.otherwise.value_or(0.0));
  return law;
}

const std::vector<const UserLawKind*>& user_laws() { return added().list; }

bool add_user_law(UserLawKind kind) {
  bool taken = listed_law(kind.name);
  for (const UserLawKind* other : user_laws()) taken = taken || other->name == kind.name;
  if (taken) throw MaterialError(fmt::format("a second law '{}'; give it a name of its own", kind.name));
  kind.keys = keys_of(kind);
  for (const UserConstant& constant : kind.constants) {
    const std::string fault =
        constant.otherwise ? constant.range.fault(*constant.otherwise, constant.dimension) : std::string();
    if (fault.empty()) continue;
    throw MaterialError(fmt::format("law '{}': {}: its own value {} {}; give it another", kind.name, constant.key,
                                    quantity_text(*constant.otherwise, constant.dimension), fault));
  }
  std::vector<std::string> keys = material_keys().names();
  for (const std::string& key : kind.keys.names()) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) {
      throw MaterialError(fmt::format("law '{}' has the key '{}' twice; leave one out", kind.name, key));
    }
    keys.push_back(key);
  }
  added().kinds.push_back(std::move(kind));
  added().list.push_back(&added().kinds.back());
  return true;
}

UserLaw::UserLaw(const UserLawDefinition& definition, double density)
    : calls_(definition.kind->calls), kind_(definition.kind), density_(density) {
  definition.kind->make(definition, density, law_.data());
}

Symmetric3<double> UserLaw::elastic_strain(const StressedPoint& at) const {
  return kind_->elastic_strain(law_.data(), at);
}

double UserLawDefinition::constant(const std::string& key) const {
  for (std::size_t i = 0; i < kind->constants.size(); ++i) {
    if (kind->constants[i].key == key) return constants.at(i);
  }
  throw MaterialError(fmt::format("law '{}' has no constant '{}'; add it where the law is added", kind->name, key));
}

}  // namespace mpm
