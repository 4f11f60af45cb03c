// The root of the library's errors. Each folder of the library derives a type of its own, so that a caller can tell bad
// input (exit code 2) from failed physics (exit code 3) without reading the text.
#pragma once

#include <stdexcept>
#include <string>

namespace mpm {

/// Base of every error the library throws. what() is one line that says what is wrong, where, and what to do.
class Error : public std::runtime_error {
 public:
  /// `text` may quote user input as it is: control characters become '?', and a very long text loses its middle,
  /// because the place stands at its beginning and the advice at its end.
  explicit Error(const std::string& text);
};

}  // namespace mpm
