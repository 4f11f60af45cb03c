#include "mpm_ros/node/parameter_text.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <utility>

namespace mpm_ros {

namespace {

bool blank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

std::string trimmed(const std::string& text) {
  const auto first = std::find_if_not(text.begin(), text.end(), blank);
  const auto last = std::find_if_not(text.rbegin(), std::make_reverse_iterator(first), blank).base();
  return {first, last};
}

/// Follows quotes and brackets from character to character.
class Nesting {
 public:
  /// True if the character stands outside of all quotes and brackets, which it then may open.
  bool outside(char c) {
    const bool outermost = depth_ == 0 && quote_ == 0;
    if (quote_ != 0) {
      if (c == quote_) quote_ = 0;
    } else if (c == '"' || c == '\'') {
      quote_ = c;
    } else if (c == '[' || c == '{' || c == '(') {
      ++depth_;
    } else if ((c == ']' || c == '}' || c == ')') && depth_ > 0) {
      --depth_;
    }
    return outermost;
  }
  bool closed() const { return depth_ == 0 && quote_ == 0; }

 private:
  int depth_ = 0;
  char quote_ = 0;
};

/// Without the brackets around all of it. False when there are none.
bool strip_brackets(std::string& text) {
  if (text.size() < 2 || text.front() != '[' || text.back() != ']') return false;
  Nesting nesting;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    nesting.outside(text[i]);
    if (nesting.closed()) return false;  // the first bracket ends before the text does
  }
  text = text.substr(1, text.size() - 2);
  return true;
}

/// True if "key.path=" stands at that place of the text.
bool override_at(const std::string& text, std::size_t at) {
  std::size_t end = at;
  const auto in_path = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-';
  };
  while (end < text.size() && in_path(text[end])) ++end;
  const bool named = end > at && (std::isalpha(static_cast<unsigned char>(text[at])) != 0 || text[at] == '_');
  return named && end < text.size() && text[end] == '=' && (end + 1 == text.size() || text[end + 1] != '=');
}

/// Without the quotes around all of it, if there are any.
std::string unquoted(const std::string& item) {
  if (item.size() < 2 || (item.front() != '"' && item.front() != '\'') || item.back() != item.front()) return item;
  try {
    const YAML::Node node = YAML::Load(item);
    return node.IsScalar() ? node.Scalar() : item;
  } catch (const YAML::Exception&) {
    return item;  // is refused by whoever reads it
  }
}

}  // namespace

std::optional<double> number_in(const std::string& text) {
  const std::string word = trimmed(text);
  const char* begin = word.data();
  const char* end = begin + word.size();
  if (begin != end && *begin == '+') ++begin;
  double number = 0.0;
  const auto [stop, error] = std::from_chars(begin, end, number);
  if (begin == end || error != std::errc() || stop != end) return std::nullopt;
  return number;
}

std::optional<double> number_of(const XmlRpc::XmlRpcValue& value) {
  XmlRpc::XmlRpcValue copy(value);
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeInt:
      return static_cast<int>(copy);
    case XmlRpc::XmlRpcValue::TypeDouble:
      return static_cast<double>(copy);
    case XmlRpc::XmlRpcValue::TypeString:
      return number_in(static_cast<std::string>(copy));
    default:
      return std::nullopt;
  }
}

std::optional<bool> truth_of(const XmlRpc::XmlRpcValue& value) {
  XmlRpc::XmlRpcValue copy(value);
  if (value.getType() == XmlRpc::XmlRpcValue::TypeBoolean) return static_cast<bool>(copy);
  if (value.getType() != XmlRpc::XmlRpcValue::TypeString) return std::nullopt;
  std::string word = trimmed(static_cast<std::string>(copy));
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  if (word == "true") return true;
  if (word == "false") return false;
  return std::nullopt;
}

std::vector<std::string> words_in(const std::string& text) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : text + ",") {
    if (c != ',' && c != '[' && c != ']' && !blank(c)) {
      word.push_back(c);
    } else if (!word.empty()) {
      words.push_back(unquoted(std::exchange(word, {})));
    }
  }
  return words;
}

std::vector<std::string> overrides_in(const std::string& text) {
  std::string rest = trimmed(text);
  const bool list = strip_brackets(rest);
  std::vector<std::string> items;
  std::string item;
  const auto end_item = [&] {
    if (const std::string whole = trimmed(std::exchange(item, {})); !whole.empty()) items.push_back(unquoted(whole));
  };
  // Finds where the next item could begin, from a comma or blank on.
  const auto next = [&rest](std::size_t at) {
    while (at < rest.size() && (rest[at] == ',' || blank(rest[at]))) ++at;
    return at;
  };
  Nesting nesting;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const char c = rest[i];
    if (nesting.outside(c) && (c == ',' || blank(c))) {
      const std::size_t from = next(i);
      const bool quoted = from < rest.size() && (rest[from] == '"' || rest[from] == '\'') && c == ',';
      if ((list && c == ',') || from == rest.size() || quoted || override_at(rest, from)) {
        end_item();
        continue;
      }
    }
    item.push_back(c);
  }
  end_item();
  return items;
}

}  // namespace mpm_ros
