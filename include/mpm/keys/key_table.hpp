// A section of a scene as a table of keys. From it come its reading and the errors of that (yaml/reader.hpp), the
// check of a definition made in C++, and a table of the pages (sections/all_keys.hpp). It stands beside the definition:
//
//   const KeyTable<SleepDefinition>& sleep_keys() {
//     static const auto keys = KeyTable<SleepDefinition>("sleep").rows(
//         {number("balance", &SleepDefinition::balance, kPlain, kPositive, {"", "part of the force …", "0.4"})});
//     return keys;
//   }
//
// Checks of several keys at once stay with the section, but for the two that are frequent: keys of which one is to be
// written, and keys that go together.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mpm/keys/key.hpp"

namespace mpm {

/// A key or word that people write and that there is not, or not at this place, and what to use instead.
struct Later {
  std::string word;
  std::string advice;
};

/// Fault of a section: its key, or a path to it within the section, and what is wrong and what to write instead.
struct KeyFault {
  std::string key, text;
};

/// Two keys of which exactly one is to be written, or both or neither.
struct KeyPair {
  std::string first, second;
  bool together = false;
  /// The sentence that asks for it.
  std::string rule() const {
    return together ? first + " and " + second + " go together; write both or neither"
                    : "write exactly one of " + first + " and " + second;
  }
};

/// A row as the pages show it.
struct KeyRow {
  std::string name, type, fallback, meaning, example;
};
/// Rows as a table in Markdown.
std::string markdown(const std::vector<KeyRow>& rows);
/// The row of a key; `place`: in a definition that has not been read.
KeyRow row_of(const KeyInfo& info, const KeyPlace& place, const std::vector<KeyPair>& pairs);

template <class T>
class KeyTable {
 public:
  /// `section`: path of the section in scenes, such as "method.damping".
  explicit KeyTable(std::string section) : section_(std::move(section)) {}

  KeyTable rows(std::vector<Key<T>> more) && {
    keys_.insert(keys_.end(), more.begin(), more.end());
    return std::move(*this);
  }
  /// Adds the keys of a part of the definition, which stand in the same section.
  template <class P, class Base>
  KeyTable part(P Base::*member, const KeyTable<P>& of) && {
    for (const Key<P>& key : of.keys())
      keys_.push_back({key.info, [place = key.place, member](T& whole) { return place(whole.*member); }});
    pairs_.insert(pairs_.end(), of.pairs().begin(), of.pairs().end());
    return std::move(*this);
  }
  KeyTable one_of(const char* first, const char* second) && { return std::move(*this).pair({first, second, false}); }
  KeyTable together(const char* first, const char* second) && { return std::move(*this).pair({first, second, true}); }
  KeyTable advise(std::vector<Later> advice) && {
    advice_ = std::move(advice);
    return std::move(*this);
  }

  const std::string& section() const { return section_; }
  const std::vector<Key<T>>& keys() const { return keys_; }
  const std::vector<KeyPair>& pairs() const { return pairs_; }
  const std::vector<Later>& advice() const { return advice_; }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const Key<T>& key : keys_) names.push_back(key.info.name);
    return names;
  }

  /// The first value of a definition out of its range, if any.
  std::optional<KeyFault> fault(T of) const {
    for (const Key<T>& key : keys_) {
      std::string text = fault_in(key.info, key.place(of));
      if (!text.empty()) return KeyFault{key.info.name, std::move(text)};
    }
    return {};
  }

  std::vector<KeyRow> page() const {
    std::vector<KeyRow> rows;
    T fresh{};
    for (const Key<T>& key : keys_) rows.push_back(row_of(key.info, key.place(fresh), pairs_));
    return rows;
  }

 private:
  KeyTable pair(KeyPair pair) && {
    pairs_.push_back(std::move(pair));
    return std::move(*this);
  }

  std::string section_;
  std::vector<Key<T>> keys_;
  std::vector<KeyPair> pairs_;
  std::vector<Later> advice_;
};

}  // namespace mpm
