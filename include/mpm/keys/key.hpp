// A key of a scene, as a row of its section's table (key_table.hpp): its name, its place in the section's definition,
// dimension, range, default, meaning and an example.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "mpm/keys/range.hpp"
#include "mpm/math/function.hpp"
#include "mpm/math/geometry.hpp"

namespace mpm {

/// Default of a key that has to be written.
inline constexpr const char* kRequired = "required";

/// Text of a key on the pages and in --explain.
struct KeyText {
  std::string fallback;  ///< default in words, or kRequired; empty: the value that the definition begins with
  std::string meaning;
  std::string example = {};
  std::string told = {};  ///< text of --explain where the key is left out; empty: nothing
};

/// Everything about a key besides its place.
struct KeyInfo {
  std::string name;
  KeyText text;
  Dimension dimension = {};             ///< dimension of numbers and functions
  Range range = {};                     ///< range of numbers, whole numbers and functions that are constant
  std::vector<std::string> words = {};  ///< words of a choice
  std::vector<std::pair<std::string, std::size_t>> aliases = {};  ///< other words for some of them
  std::string type = {};  ///< kind of the values, of a key that its section reads itself
  bool required() const { return text.fallback == kRequired; }
};

/// A choice among words: the index of the one that holds, and a way to take another.
struct WordPlace {
  std::optional<std::size_t> index;
  std::function<void(std::size_t)> take;
};

/// Place of a key's value in a definition; nothing for a key that its section reads itself.
using KeyPlace =
    std::variant<std::monostate, double*, std::optional<double>*, int*, std::optional<int>*, bool*,
                 std::optional<bool>*, std::string*, Vec3*, Function*, std::array<Function, 3>*, WordPlace>;

/// Returns what is wrong with the value in a place, with that value, as in "-1 Pa is not greater than 0"; empty where
/// nothing is.
std::string fault_in(const KeyInfo& info, const KeyPlace& place);
/// Kind and range of the values, for the pages: "pressure > 0".
std::string type_in(const KeyInfo& info, const KeyPlace& place);
/// The value in a place, for the pages; empty where there is none.
std::string value_in(const KeyInfo& info, const KeyPlace& place);

/// A row of the table of a definition T.
template <class T>
struct Key {
  KeyInfo info;
  std::function<KeyPlace(T&)> place;
};

/// A number, vector or function with a dimension, or one of them that may be missing.
template <class T, class M>
Key<T> number(const char* name, M T::*member, const Dimension& dimension, const Range& range, KeyText text) {
  return {{name, std::move(text), dimension, range}, [member](T& of) -> KeyPlace { return &(of.*member); }};
}
/// A whole number, a truth or a text, or one of them that may be missing.
template <class T, class M>
Key<T> plain(const char* name, M T::*member, KeyText text, const Range& range = {}) {
  return {{name, std::move(text), kPlain, range}, [member](T& of) -> KeyPlace { return &(of.*member); }};
}
/// A choice among words, in the order of the enumeration M; `aliases`: other words for some of them.
template <class T, class M>
Key<T> word(const char* name, M T::*member, std::vector<std::string> words, KeyText text,
            std::vector<std::pair<std::string, std::size_t>> aliases = {}) {
  return {{name, std::move(text), kPlain, {}, std::move(words), std::move(aliases)}, [member](T& of) -> KeyPlace {
            return WordPlace{static_cast<std::size_t>(of.*member),
                             [&of, member](std::size_t index) { of.*member = static_cast<M>(index); }};
          }};
}
/// The same for a choice that may be missing.
template <class T, class M>
Key<T> word(const char* name, std::optional<M> T::*member, std::vector<std::string> words, KeyText text) {
  return {{name, std::move(text), kPlain, {}, std::move(words)}, [member](T& of) -> KeyPlace {
            WordPlace place;
            if (of.*member) place.index = static_cast<std::size_t>(*(of.*member));
            place.take = [&of, member](std::size_t index) { of.*member = static_cast<M>(index); };
            return place;
          }};
}
/// The names of an enumeration as words.
template <std::size_t N>
std::vector<std::string> words_of(const std::array<const char*, N>& names) {
  return {names.begin(), names.end()};
}
/// A key that its section reads itself; `type` is for the pages.
template <class T>
Key<T> other(const char* name, const char* type, KeyText text) {
  return {{name, std::move(text), kPlain, {}, {}, {}, type}, [](T&) { return KeyPlace(); }};
}

}  // namespace mpm
