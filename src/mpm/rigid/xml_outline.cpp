#include "xml_outline.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <utility>

#include "mpm/rigid/surface.hpp"

namespace mpm {
namespace {

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// The place after `word`, searched from `from` on; the end where it does not come.
std::size_t after(const std::string& text, const char* word, std::size_t from) {
  const std::size_t found = text.find(word, from);
  return found == std::string::npos ? text.size() : found + std::strlen(word);
}

/// The place after the '>' that ends a tag, which is none in quotes.
std::size_t end_of_tag(const std::string& text, std::size_t from) {
  char quote = '\0';
  for (std::size_t i = from; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return i + 1;
    }
  }
  return text.size();
}

[[noreturn]] void too_deep(int line, int deepest) {
  throw RigidError(
      fmt::format("line {}: elements lie in each other more than {} deep; write it flatter", line, deepest));
}

class XmlReader {
 public:
  /// `keep`: the elements, and not their depth alone.
  XmlReader(const std::string& text, int deepest, bool keep) : text_(text), deepest_(deepest), keep_(keep) {}

  std::vector<XmlElement> read() {
    for (std::size_t at = text_.find('<'); at < text_.size(); at = text_.find('<', at)) at = read_tag(at);
    while (!open_.empty()) close_last(text_.size());
    return std::move(elements_);
  }

 private:
  struct Open {
    std::string name;
    int place;  ///< in the list
  };

  std::size_t read_tag(std::size_t at) {
    if (text_.compare(at, 4, "<!--") == 0) return after(text_, "-->", at + 4);
    if (text_.compare(at, 9, "<![CDATA[") == 0) return after(text_, "]]>", at + 9);
    if (text_.compare(at, 2, "<!") == 0 || text_.compare(at, 2, "<?") == 0) return after(text_, ">", at);
    const std::size_t end = end_of_tag(text_, at + 1);
    if (text_.compare(at, 2, "</") == 0) {
      close(name_from(at + 2), end);
      return end;
    }
    if (static_cast<int>(open_.size()) >= deepest_) {
      count_lines(at);
      too_deep(line_, deepest_);
    }
    const std::string name = name_from(at + 1);
    const bool whole = end - at > 2 && text_[end - 2] == '/';
    const int parent = open_.empty() ? -1 : open_.back().place;
    if (!whole) open_.push_back({name, static_cast<int>(elements_.size())});
    if (!keep_) return end;
    count_lines(at);
    const std::size_t first = at + 1 + name.size(), last = std::max(first, end - (whole ? 2 : 1));
    elements_.push_back({name, text_.substr(first, last - first), parent, line_, at, end});
    return end;
  }

  void count_lines(std::size_t to) {
    const auto place = [&](std::size_t at) { return text_.begin() + static_cast<std::ptrdiff_t>(at); };
    line_ += static_cast<int>(std::count(place(counted_), place(to), '\n'));
    counted_ = to;
  }

  std::string name_from(std::size_t at) const {
    std::size_t end = at;
    while (end < text_.size() && !is_space(text_[end]) && text_[end] != '>' && text_[end] != '/') ++end;
    return text_.substr(at, end - at);
  }

  /// Ends the innermost open element of that name, and those inside it that have no end.
  void close(const std::string& name, std::size_t end) {
    const auto named = [&](const Open& open) { return open.name == name; };
    if (std::none_of(open_.begin(), open_.end(), named)) return;
    while (!named(open_.back())) close_last(end);
    close_last(end);
  }

  void close_last(std::size_t end) {
    if (keep_) elements_[static_cast<std::size_t>(open_.back().place)].end = end;
    open_.pop_back();
  }

  const std::string& text_;
  int deepest_;
  bool keep_;
  int line_ = 1;
  std::size_t counted_ = 0;  ///< up to where lines are
  std::vector<XmlElement> elements_;
  std::vector<Open> open_;
};

}  // namespace

std::vector<XmlElement> outline_of_xml(const std::string& text, int deepest) {
  return XmlReader(text, deepest, true).read();
}

void check_depth_of_xml(const std::string& text, int deepest) { XmlReader(text, deepest, false).read(); }

std::string attribute_of(const XmlElement& element, const std::string& name) {
  const std::string& text = element.attributes;
  std::size_t at = 0;
  while (at < text.size()) {
    while (at < text.size() && is_space(text[at])) ++at;
    const std::size_t equals = text.find('=', at);
    if (equals == std::string::npos) break;
    std::string found = text.substr(at, equals - at);
    while (!found.empty() && is_space(found.back())) found.pop_back();
    std::size_t open = equals + 1;
    while (open < text.size() && is_space(text[open])) ++open;
    if (open == text.size()) break;
    const std::size_t close = text.find(text[open], open + 1);
    if (close == std::string::npos) break;
    if (found == name) return text.substr(open + 1, close - open - 1);
    at = close + 1;
  }
  return {};
}

void check_depth_of_json(const std::string& text, int deepest) {
  int depth = 0, line = 1;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') ++line;
    if (quoted) {
      if (c == '\\') ++i;
      if (c == '"') quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '{' || c == '[') {
      if (++depth > deepest) too_deep(line, deepest);
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

}  // namespace mpm
