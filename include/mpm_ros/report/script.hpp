// Another program, started beside this one.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <string>
#include <vector>

namespace mpm_ros {

class Script {
 public:
  struct Streams {
    bool input = false;  ///< its standard input is what write() is given
    bool quiet = false;  ///< output is dropped
  };
  /// `words`: the program (looked for along PATH when it has no slash) and its arguments.
  /// @throws ReportError when it cannot be started
  Script(std::vector<std::string> words, Streams streams);
  /// Waits for its end.
  ~Script();
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;

  /// False when it no longer reads.
  bool write(const void* data, std::size_t bytes);
  /// Ends its input, waits for its end; its exit code, or -1 when a signal ended it.
  int finish();

 private:
  pid_t child_ = 0;
  int input_ = -1;
};

}  // namespace mpm_ros
