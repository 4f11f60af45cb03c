// `constants` of a scene: numbers with names, which expressions may use, and keys that take a number.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "mpm/math/function.hpp"
#include "mpm/yaml/units.hpp"

namespace mpm {

class SceneConstants {
 public:
  bool empty() const { return numbers_.empty(); }
  /// `number`: in the scene's units; `dimension`: of a constant that was written with its unit.
  void add(const std::string& name, double number, const std::optional<Dimension>& dimension);
  /// For expressions.
  const NamedConstants& numbers() const { return numbers_; }
  /// The dimension of the constant that a text names; nothing for another text, and for a constant without a unit.
  std::optional<Dimension> dimension_of(const std::string& text) const;
  bool has(const std::string& name) const;
  /// True if an expression names one of them. Those that it names count as used from now on.
  bool used_by(const std::string& expression) const;
  /// Names that nothing has used so far, in order.
  std::vector<std::string> unused() const;
  /// "slip, v".
  std::string names() const;

 private:
  NamedConstants numbers_;
  std::vector<std::optional<Dimension>> dimensions_;
  mutable std::set<std::string> used_;
};

}  // namespace mpm
