// The root of the library's errors. Each floor derives one type of its own, so that a caller can tell bad input
// (exit code 2) from failed physics (exit code 3) without reading the text.
#pragma once

#include <stdexcept>
#include <string>

namespace mpm {

/// Base of every error the library throws. what() is one line that says what, where and what to do.
class Error : public std::runtime_error {
 public:
  /// What a user wrote may be quoted in `text` as it is: control characters become '?', and what would fill a screen
  /// loses its middle, for the place stands at the beginning and the advice at the end.
  explicit Error(const std::string& text);
};

}  // namespace mpm
