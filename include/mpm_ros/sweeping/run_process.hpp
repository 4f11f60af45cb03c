// A run in a process of its own, which takes nobody with it when it crashes and ends when this process does, however.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace mpm_ros {

/// End of a process: one of them is 0 or more.
struct ProcessEnd {
  int code = -1;    ///< its exit code
  int signal = -1;  ///< that killed it
};

class RunProcess {
 public:
  /// Starts a program. `words`: its path and arguments. What it prints is added to the file `log`. `lock`: a
  /// descriptor that it holds until it has ended. Signals of the terminal (Ctrl-C) do not reach it.
  /// @throws MachineError
  RunProcess(const std::vector<std::string>& words, const std::string& log, int lock);
  /// Kills it if it has not ended.
  ~RunProcess();
  RunProcess(const RunProcess&) = delete;
  RunProcess& operator=(const RunProcess&) = delete;

  /// Nothing while it runs.
  std::optional<ProcessEnd> end();

 private:
  pid_t child_ = 0;
};

}  // namespace mpm_ros
