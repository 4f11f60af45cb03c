// JSON as text, the one way in which this package writes it.
#pragma once

#include <string>

namespace mpm {

/// `Json`: nlohmann's json or ordered_json. `indent`: spaces a level; negative: all on one line. JSON is UTF-8, and
/// names of files need not be: a wrong byte becomes U+FFFD, where the library would throw.
template <class Json>
std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace mpm
