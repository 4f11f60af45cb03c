#include "mpm/yaml/reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "mpm/math/nearest.hpp"
#include "mpm/math/odd_characters.hpp"

namespace mpm {
namespace {

/// Largest size of a number in SI units, and one over the least: no quantity of a scene comes near, what stands for
/// "without limit" fits, and products of a few numbers stay within those of a double.
constexpr double kMostNumber = 1e60;

const Later* find_later(const std::string& word, const std::vector<Later>& later) {
  for (const Later& entry : later) {
    if (entry.word == word) return &entry;
  }
  return nullptr;
}

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::vector<std::string> with_later(std::vector<std::string> words, const std::vector<Later>& later) {
  for (const Later& entry : later) words.push_back(entry.word);
  return words;
}

/// Without what is there twice, as where several laws have a key.
std::vector<std::string> distinct(std::vector<std::string> words) {
  std::vector<std::string> once;
  for (std::string& word : words) {
    if (!contains(once, word)) once.push_back(std::move(word));
  }
  return once;
}

const char* kind_of(const YAML::Node& node) {
  if (node.IsMap()) return "a map of keys";
  if (node.IsSequence()) return "a list";
  return node.IsScalar() ? "one value" : "nothing";
}

/// To be added to an error of a text that is no number, where there are constants that may be meant.
std::string with_constants(const ReadContext& context) {
  return context.constants.empty() ? "" : ", or an expression of the constants " + context.constants.names();
}

}  // namespace

Value::Value(const ReadContext& context, YAML::Node node, std::string path)
    : context_(&context), node_(std::move(node)), path_(std::move(path)) {}

std::string Value::where() const {
  return fmt::format("{}: {}", context_->source->where(node_), path_.empty() ? context_->source->kind() : path_);
}

void Value::fail(const std::string& what) const {
  std::string text = where() + ": " + what;
  // A character may look right and be another.
  const std::string odd = is_text() ? odd_character(node_.Scalar()) : "";
  if (!odd.empty() && what.find(odd) == std::string::npos) text += "; " + odd;
  throw SceneError(text);
}

std::string Value::text() const {
  if (!is_text()) fail(fmt::format("found {}; write one value", kind_of(node_)));
  return node_.Scalar();
}

double Value::quantity(const Dimension& dimension) const {
  if (!is_text()) {
    fail(fmt::format("found {}; write {}, such as {}", kind_of(node_), describe(dimension), example(dimension)));
  }
  double value = 0.0;
  try {
    value = parse_quantity(node_.Scalar(), dimension, context_->units);
  } catch (const UnitError& error) {
    const std::optional<double> found = of_constants(dimension);
    if (!found) fail(error.what() + with_constants(*context_));
    value = *found;
  }
  const double size = std::abs(value);
  if (size > kMostNumber || (size > 0.0 && size < 1.0 / kMostNumber)) {
    fail(fmt::format("'{}' is beyond {:g} to {:g} SI units, where products overflow; write {}, such as {}", text(),
                     1.0 / kMostNumber, kMostNumber, describe(dimension), example(dimension)));
  }
  return value;
}

std::optional<double> Value::of_constants(const Dimension& dimension) const {
  const SceneConstants& constants = context_->constants;
  const std::string word = text();
  if (!constants.used_by(word)) return std::nullopt;
  const auto own = constants.dimension_of(word);
  if (own && !(*own == dimension)) {
    fail(fmt::format("the constant '{}' is {}, but {} is expected; write one such as {}", word, describe(*own),
                     describe(dimension), example(dimension)));
  }
  try {
    const Function function = Function::parse(word, {}, FunctionPlaces::present, constants.numbers());
    if (function.uses_time() || function.uses_place())
      fail(fmt::format("'{}' depends on time or place, and this is a number; use constants alone", word));
    return function(0.0) * context_->units.factor(dimension);
  } catch (const FunctionError& error) {
    fail(error.what());
  }
}

void Value::check(double value, const Dimension& dimension, const Range& range) const {
  const std::string fault = range.fault(value, dimension);
  if (fault.empty()) return;
  const std::string noun = describe(dimension);
  const bool from_zero = range.least == 0.0 && range.most == kInfinity;
  const char* const none = range.or_none ? ", or none" : "";
  if (from_zero) {
    fail(fmt::format("'{}' {}; write {}{}, such as {}{}", text(), fault, range.with_least ? "0 or " : "", noun,
                     example(dimension), none));
  }
  // A plain angle is in radians, which is seldom meant.
  const std::string degrees = dimension == kAngle ? fmt::format(", {},", quantity_text(value, kAngle)) : "";
  fail(fmt::format("'{}'{} {}; write {} {}{}", text(), degrees, fault, dimension == kPlain ? "a number" : noun,
                   range.words(dimension), none));
}

double Value::number(const Dimension& dimension, const Range& range) const {
  if (range.or_none && is_text() && text() == "none") return kInfinity;
  const double value = quantity(dimension);
  check(value, dimension, range);
  return value;
}

int Value::integer(const Range& range) const {
  const std::string word = text();
  int value = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || stop != word.data() + word.size()) {
    fail(fmt::format("'{}' is not a whole number; write one, such as 2", word));
  }
  if (const std::string fault = range.fault(value, kPlain); !fault.empty())
    fail(fmt::format("{} {}; write a whole number {}", value, fault, range.words(kPlain)));
  return value;
}

std::string Value::name() const {
  std::string word = text();
  const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  const auto good = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  if (word.empty() || word.size() > 64 || !letter(word[0]) || !std::all_of(word.begin(), word.end(), good)) {
    fail(fmt::format(
        "'{}' is not a name; write a letter and then letters, digits and '_', for it becomes part of topic names",
        word));
  }
  return word;
}

std::size_t Value::choice(const std::vector<std::string>& words, const std::vector<Later>& later) const {
  const std::string word = text();
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  if (const Later* entry = find_later(word, later)) fail(fmt::format("'{}' is no word here; {}", word, entry->advice));
  fail(fmt::format(
      "'{}' is not known; {}", word,
      nearest(word, words).empty() ? fmt::format("write one of {}", fmt::join(words, ", ")) : suggest(word, words)));
}

Function Value::function(const Dimension& dimension, FunctionPlaces places, const Range& range) const {
  const std::string word = text();
  double number = 0.0;
  std::string rest;
  // A number followed by a word, 1/s or % is a quantity; anything else that is more than a number is an expression.
  const bool starts_with_number = split_number(word, number, rest);
  const bool has_unit =
      starts_with_number && !rest.empty() &&
      (std::isalnum(static_cast<unsigned char>(rest[0])) || rest == "%" || static_cast<unsigned char>(rest[0]) >= 0x80);
  if (starts_with_number && (rest.empty() || has_unit)) return {this->number(dimension, range)};
  const UnitSystem& units = context_->units;
  const SceneConstants& constants = context_->constants;
  if (constants.has(word)) return {this->number(dimension, range)};
  try {
    Function function =
        Function::parse(word, {units.factor(dimension), units.time, units.length}, places, constants.numbers());
    if (!constants.used_by(word) || function.uses_time() || function.uses_place()) return function;
    check(function(0.0), dimension, range);
    return {function(0.0)};
  } catch (const FunctionError& error) {
    fail(fmt::format("{}; write {}, such as {}, or an expression", error.what(), describe(dimension),
                     example(dimension)));
  }
}

std::vector<Value> Value::components() const {
  const int expected = dimensions(context_->geometry);
  if (expected == 1 && is_text()) return {*this};
  if (!is_list() || node_.size() != static_cast<std::size_t>(expected)) {
    const std::string found = is_list() ? fmt::format("{} components", node_.size()) : kind_of(node_);
    static constexpr std::array<const char*, 3> kWanted = {"one component, x, for the scene is a line",
                                                           "two components, [x, z], for the scene is planar",
                                                           "three components, [x, y, z]"};
    const char* wanted = axisymmetric(context_->geometry)
                             ? "two components, [x, z], for the scene is axisymmetric: x is r"
                             : kWanted[expected - 1];
    fail(fmt::format("found {}; write {}", found, wanted));
  }
  return elements();
}

Vec3 Value::vector(const Dimension& dimension) const {
  const std::vector<Value> parts = components();
  const std::vector<int> axes = axes_of(context_->geometry);
  Vec3 vector = Vec3::Zero();
  for (std::size_t k = 0; k < axes.size(); ++k) vector[axes[k]] = parts[k].number(dimension);
  return vector;
}

std::array<Function, 3> Value::functions(const Dimension& dimension, FunctionPlaces places) const {
  const std::vector<Value> parts = components();
  const std::vector<int> axes = axes_of(context_->geometry);
  std::array<Function, 3> functions;
  for (std::size_t k = 0; k < axes.size(); ++k) functions[axes[k]] = parts[k].function(dimension, places);
  return functions;
}

std::array<Function, 3> Value::three_functions(const Dimension& dimension) const {
  if (!is_list() || node_.size() != 3) fail("write three components, about x, y and z");
  const std::vector<Value> parts = elements();
  return {parts[0].function(dimension), parts[1].function(dimension), parts[2].function(dimension)};
}

std::vector<Value> Value::elements() const {
  if (!is_list()) fail(fmt::format("found {}; write a list", kind_of(node_)));
  std::vector<Value> values;
  for (std::size_t i = 0; i < node_.size(); ++i) values.push_back(child(node_[i], element_name(node_, i)));
  return values;
}

Value Value::child(const YAML::Node& node, const std::string& part) const {
  return {*context_, node, join_path(path_, part)};
}

Map::Map(const Value& value, std::vector<std::string> keys, const std::vector<Later>& later)
    : value_(value), keys_(distinct(std::move(keys))) {
  if (!value.is_map()) {
    value.fail(fmt::format("found {}; write keys, of {}", kind_of(value.node()), fmt::join(keys_, ", ")));
  }
  for (const auto& entry : value.node()) {
    const std::string& key = entry.first.Scalar();
    if (contains(keys_, key)) continue;
    if (key == "<<") {
      value.child(entry.first, key)
          .fail(
              "merge keys are not understood; write the keys out, or give a whole value a name with & and use it with "
              "*");
    }
    // The error names the line of the key, not of its value.
    const Value culprit = value.child(entry.first, key);
    if (const Later* known = find_later(key, later))
      culprit.fail(fmt::format("'{}' is no key here; {}", key, known->advice));
    culprit.fail(fmt::format(
        "unknown key '{}'; {}", key,
        nearest(key, with_later(keys_, later)).empty() ? suggest(key, keys_) : suggest(key, with_later(keys_, later))));
  }
}

std::optional<Value> Map::find(const std::string& key) const {
  if (!contains(keys_, key)) throw std::logic_error("scene reader asked for the undeclared key " + key);
  const YAML::Node node = value_.node()[key];
  if (!node) return std::nullopt;
  if (node.IsNull()) {
    // A missing value has no line of its own, so the error names the line of the key.
    value_.child(key_node(value_.node(), key), key)
        .fail("has no value; write one, or leave the key out for its default");
  }
  return value_.child(node, key);
}

Value Map::at(const std::string& key) const {
  if (auto found = find(key)) return *found;
  value_.fail(fmt::format("the key '{}' is missing; add it", key));
}

namespace {

/// Reads a value into its place.
struct Reading {
  const Value& value;
  const KeyInfo& key;
  void operator()(std::monostate) const {}
  void operator()(double* place) const { *place = value.number(key.dimension, key.range); }
  void operator()(std::optional<double>* place) const { *place = value.number(key.dimension, key.range); }
  void operator()(int* place) const { *place = value.integer(key.range); }
  void operator()(std::optional<int>* place) const { *place = value.integer(key.range); }
  void operator()(bool* place) const { *place = value.truth(); }
  void operator()(std::optional<bool>* place) const { *place = value.truth(); }
  void operator()(std::string* place) const { *place = value.text(); }
  void operator()(Vec3* place) const { *place = value.vector(key.dimension); }
  void operator()(Function* place) const { *place = value.function(key.dimension, FunctionPlaces::present, key.range); }
  void operator()(std::array<Function, 3>* place) const { *place = value.functions(key.dimension); }
  void operator()(const WordPlace& place) const {
    std::vector<std::string> words = key.words;
    for (const auto& [alias, index] : key.aliases) words.push_back(alias);
    const std::size_t found = value.choice(words), own = key.words.size();
    place.take(found < own ? found : key.aliases[found - own].second);
  }
};

}  // namespace

void read_key(const Map& map, const KeyInfo& key, const KeyPlace& place) {
  const std::optional<Value> value = key.required() ? map.at(key.name) : map.find(key.name);
  if (value) std::visit(Reading{*value, key}, place);
}

void check_pair(const Map& map, const KeyPair& pair) {
  const bool both = map.find(pair.first).has_value() == map.find(pair.second).has_value();
  if (both != pair.together) map.fail(pair.rule());
}

void Map::fail(const KeyFault& fault) const {
  if (const auto value = find(fault.key)) value->fail(fault.text);
  fail(fault.key + ": " + fault.text);
}

std::pair<std::string, Value> only_key(const Value& value, const std::vector<std::string>& keys,
                                       const std::vector<Later>& later) {
  if (value.is_map()) {
    for (const auto& entry : value.node()) {
      const std::string& key = entry.first.Scalar();
      if (contains(keys, key) || find_later(key, later) != nullptr || key == "<<") continue;
      const std::string near = nearest(key, keys);
      value.child(entry.first, key)
          .fail(fmt::format("unknown key '{}'; {}write one of {}", key,
                            near.empty() ? "" : fmt::format("did you mean '{}'? ", near), fmt::join(keys, ", ")));
    }
  }
  const Map map(value, keys, later);
  if (value.node().size() != 1)
    value.fail(fmt::format("found {} keys; write one of {}", value.node().size(), fmt::join(keys, ", ")));
  std::string key = value.node().begin()->first.Scalar();
  Value found = map.at(key);
  return {std::move(key), std::move(found)};
}

}  // namespace mpm
