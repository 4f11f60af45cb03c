#include "mpm/keys/key.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mpm/keys/key_table.hpp"

namespace mpm {
namespace {

const std::vector<std::string> kTruths = {"false", "true"};

std::string fault_of(double value, const KeyInfo& info) {
  if (value == info.range.unset) return {};
  const std::string fault = info.range.fault(value, info.dimension);
  return fault.empty() ? fault : quantity_text(value, info.dimension) + " " + fault;
}
std::string fault_of(const Function& value, const KeyInfo& info) {
  return value.is_constant() ? fault_of(value(0.0), info) : "";
}
template <class N>
std::string fault_of(const std::optional<N>& value, const KeyInfo& info) {
  return value ? fault_of(static_cast<double>(*value), info) : "";
}
std::string fault_of(const std::optional<bool>&, const KeyInfo&) { return {}; }
std::string fault_of(const std::string&, const KeyInfo&) { return {}; }
template <class V>
auto fault_of(const V& value, const KeyInfo& info) -> decltype(value[2], std::string()) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::string fault = fault_of(value[axis], info); !fault.empty()) return fault;
  }
  return {};
}

std::string value_of(double value, const KeyInfo& info) {
  const bool none = value == info.range.unset || (info.range.or_none && value == kInfinity);
  return none ? "" : quantity_text(value, info.dimension);
}
std::string value_of(int value, const KeyInfo&) { return std::to_string(value); }
std::string value_of(bool value, const KeyInfo&) { return kTruths[value ? 1 : 0]; }
std::string value_of(const std::string& value, const KeyInfo&) { return value; }
std::string value_of(const Function& value, const KeyInfo& info) {
  return value.is_constant() ? value_of(value(0.0), info) : value.text();
}
template <class N>
std::string value_of(const std::optional<N>& value, const KeyInfo& info) {
  return value ? value_of(*value, info) : "";
}
template <class V>
auto value_of(const V& value, const KeyInfo& info) -> decltype(value[2], std::string()) {
  return fmt::format("[{}, {}, {}]", value_of(value[0], info), value_of(value[1], info), value_of(value[2], info));
}

/// Dimension without its article, and range.
std::string number_type(const KeyInfo& info, const char* before) {
  const std::string noun = info.dimension == kPlain ? "a number" : describe(info.dimension);
  const std::string words = info.range.signs(info.dimension);
  return fmt::format("{}{}{}{}{}", before, noun.substr(noun.find(' ') + 1), words.empty() ? "" : " ", words,
                     info.range.or_none ? ", or `none`" : "");
}

struct TypeOf {
  const KeyInfo& info;
  std::string operator()(std::monostate) const { return info.type; }
  std::string operator()(const double*) const { return number_type(info, ""); }
  std::string operator()(const std::optional<double>*) const { return number_type(info, ""); }
  std::string operator()(const int*) const {
    const std::string words = info.range.signs(kPlain);
    return "whole number" + (words.empty() ? words : " " + words);
  }
  std::string operator()(const std::optional<int>*) const { return (*this)(static_cast<const int*>(nullptr)); }
  std::string operator()(const bool*) const { return "`false`, `true`"; }
  std::string operator()(const std::optional<bool>*) const { return "`false`, `true`"; }
  std::string operator()(const std::string*) const { return info.type.empty() ? "text" : info.type; }
  std::string operator()(const Vec3*) const { return number_type(info, "vector, "); }
  std::string operator()(const Function*) const { return number_type(info, "function, "); }
  std::string operator()(const std::array<Function, 3>*) const { return number_type(info, "vector of functions, "); }
  std::string operator()(const WordPlace&) const {
    std::string text = fmt::format("`{}`", fmt::join(info.words, "`, `"));
    for (const auto& [alias, index] : info.aliases) text += fmt::format("; `{}` is `{}`", alias, info.words[index]);
    return text;
  }
};

}  // namespace

std::string fault_in(const KeyInfo& info, const KeyPlace& place) {
  if (std::holds_alternative<std::monostate>(place) || std::holds_alternative<WordPlace>(place)) return {};
  return std::visit(
      [&](const auto& at) -> std::string {
        if constexpr (std::is_pointer_v<std::decay_t<decltype(at)>>) return fault_of(*at, info);
        return {};
      },
      place);
}

std::string type_in(const KeyInfo& info, const KeyPlace& place) { return std::visit(TypeOf{info}, place); }

std::string value_in(const KeyInfo& info, const KeyPlace& place) {
  if (const auto* word = std::get_if<WordPlace>(&place)) return word->index ? info.words.at(*word->index) : "";
  return std::visit(
      [&](const auto& at) -> std::string {
        if constexpr (std::is_pointer_v<std::decay_t<decltype(at)>>) return value_of(*at, info);
        return {};
      },
      place);
}

KeyRow row_of(const KeyInfo& info, const KeyPlace& place, const std::vector<KeyPair>& pairs) {
  std::string fallback = info.text.fallback, value = value_in(info, place);
  for (const KeyPair& pair : pairs) {
    if (pair.first != info.name && pair.second != info.name) continue;
    const std::string& beside = pair.first == info.name ? pair.second : pair.first;
    if (fallback.empty())
      fallback = pair.together ? fmt::format("none; goes with `{}`", beside) : fmt::format("this or `{}`", beside);
  }
  if (fallback.empty() && !std::holds_alternative<std::monostate>(place))
    fallback = value.empty() ? "none" : fmt::format("`{}`", value);
  const auto quoted = [](const std::string& text) { return text.empty() ? text : fmt::format("`{}`", text); };
  return {quoted(info.name), type_in(info, place), fallback, info.text.meaning, quoted(info.text.example)};
}

std::string markdown(const std::vector<KeyRow>& rows) {
  std::string text = "| key | type | default | meaning | example |\n|---|---|---|---|---|\n";
  for (const KeyRow& row : rows) {
    text += fmt::format("| {} | {} | {} | {} | {} |\n", row.name, row.type, row.fallback, row.meaning, row.example);
  }
  return text;
}

}  // namespace mpm
