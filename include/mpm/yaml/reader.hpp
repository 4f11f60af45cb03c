// Reading the tree of a scene: each value knows its path and line, and each map refuses unknown keys.
//
//   const Map grid(value, {"cell", "min", "max"});
//   const double cell = grid.at("cell").positive(kLength);
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mpm/keys/key_table.hpp"
#include "mpm/math/function.hpp"
#include "mpm/math/geometry.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/yaml/named_constants.hpp"
#include "mpm/yaml/source.hpp"
#include "mpm/yaml/units.hpp"

namespace mpm {

/// Context shared by all values of a scene.
struct ReadContext {
  const Source* source = nullptr;
  UnitSystem units;
  GeometryKind geometry = GeometryKind::solid;  ///< determines which components vectors have
  SceneConstants constants;                     ///< that numbers and functions may name
};

class Value {
 public:
  Value(const ReadContext& context, YAML::Node node, std::string path);

  const std::string& path() const { return path_; }
  const YAML::Node& node() const { return node_; }
  const ReadContext& context() const { return *context_; }
  bool is_map() const { return node_.IsMap(); }
  bool is_list() const { return node_.IsSequence(); }
  bool is_text() const { return node_.IsScalar(); }

  /// "file:line: key.path"
  std::string where() const;
  /// @throws SceneError always: where(), then `what`.
  [[noreturn]] void fail(const std::string& what) const;

  /// A number or quantity, or an expression of the scene's constants, converted to SI.
  double number(const Dimension& dimension, const Range& range = kAny) const;
  double positive(const Dimension& dimension) const { return number(dimension, kPositive); }
  double non_negative(const Dimension& dimension) const { return number(dimension, kNotNegative); }
  int integer(const Range& range = kAny) const;
  bool truth() const { return choice({"false", "true"}) == 1; }
  std::string text() const;
  /// A word that is valid in topic names: a letter, then letters, digits and '_'.
  std::string name() const;
  /// The index of the value in `words`.
  std::size_t choice(const std::vector<std::string>& words, const std::vector<Later>& later = {}) const;
  /// A number, a quantity, or an expression of t, x, y, z (and X, Y, Z if `places` allows it) in the scene's units. Of
  /// a constant the range is checked.
  Function function(const Dimension& dimension, FunctionPlaces places = FunctionPlaces::present,
                    const Range& range = kAny) const;
  /// Three components; two (x, z) in planar scenes; one, with or without brackets, in a line. The other components are
  /// 0.
  Vec3 vector(const Dimension& dimension) const;
  std::array<Function, 3> functions(const Dimension& dimension, FunctionPlaces places = FunctionPlaces::present) const;
  /// Exactly three components in any geometry (rotations).
  std::array<Function, 3> three_functions(const Dimension& dimension) const;
  /// The elements of a list.
  std::vector<Value> elements() const;
  /// An element of a list, or the value of a key; the caller has checked that it is there.
  Value child(const YAML::Node& node, const std::string& part) const;

 private:
  std::vector<Value> components() const;
  double quantity(const Dimension& dimension) const;
  /// Refuses a number out of its range.
  void check(double value, const Dimension& dimension, const Range& range) const;
  /// The value of an expression of the scene's constants, in SI; nothing for a text that names none.
  std::optional<double> of_constants(const Dimension& dimension) const;

  const ReadContext* context_;
  YAML::Node node_;
  std::string path_;
};

/// A map that has only known keys.
class Map {
 public:
  /// @throws SceneError when the value is not a map, or has a key that is not among `keys`.
  Map(const Value& value, std::vector<std::string> keys, const std::vector<Later>& later = {});

  /// @throws SceneError when the key is not there, or has no value.
  Value at(const std::string& key) const;
  /// The value, or nothing when the key is not there. @throws SceneError when the key has no value.
  std::optional<Value> find(const std::string& key) const;
  const Value& value() const { return value_; }
  [[noreturn]] void fail(const std::string& what) const { value_.fail(what); }
  /// Fails at the key of the fault, if it is written.
  [[noreturn]] void fail(const KeyFault& fault) const;

 private:
  Value value_;
  std::vector<std::string> keys_;
};

/// Reads the value of a key into its place in a definition, if the key is there and has a place.
/// @throws SceneError when it is missing and required, or its value is not one of the key
void read_key(const Map& map, const KeyInfo& key, const KeyPlace& place);
/// Refuses a pair of keys that breaks its rule.
void check_pair(const Map& map, const KeyPair& pair);

/// Reads the keys of a definition that have a place in it. @throws SceneError
template <class T>
void read_keys(const Map& map, const KeyTable<T>& table, T& object) {
  for (const KeyPair& pair : table.pairs()) check_pair(map, pair);
  for (const Key<T>& key : table.keys()) read_key(map, key.info, key.place(object));
}
/// The same for a section that has the keys of one definition. Returns its map, for keys that the section reads itself.
template <class T>
Map read_keys(const Value& value, const KeyTable<T>& table, T& object) {
  Map map(value, table.names(), table.advice());
  read_keys(map, table, object);
  return map;
}
/// Notes the defaults of keys that are left out, where --explain tells them.
template <class T>
void tell_defaults(const Map& map, const KeyTable<T>& table, Scene& scene) {
  for (const Key<T>& key : table.keys()) {
    if (!key.info.text.told.empty() && !map.find(key.info.name))
      scene.choices.emplace_back(map.value().path() + "." + key.info.name, key.info.text.told);
  }
}

/// The one key of a map such as {sphere: …}, among `keys`, and its value.
std::pair<std::string, Value> only_key(const Value& value, const std::vector<std::string>& keys,
                                       const std::vector<Later>& later = {});

}  // namespace mpm
