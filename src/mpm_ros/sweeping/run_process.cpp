#include "mpm_ros/sweeping/run_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "mpm_ros/sweep/study.hpp"

namespace mpm_ros {
namespace {

constexpr int kNotStarted = 127;

/// In the child: only what is allowed between fork and exec.
[[noreturn]] void become(char** words, int log, int lock, pid_t parent) {
  // A signal to the parent alone would otherwise leave it running; the parent may have ended already.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kNotStarted);
  setpgid(0, 0);
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing < 0 || dup2(nothing, STDIN_FILENO) < 0 || dup2(log, STDOUT_FILENO) < 0 || dup2(log, STDERR_FILENO) < 0)
    _exit(kNotStarted);
  fcntl(lock, F_SETFD, 0);
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  execv(words[0], words);
  _exit(kNotStarted);
}

}  // namespace

RunProcess::RunProcess(const std::vector<std::string>& words, const std::string& log, int lock) {
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file < 0) throw MachineError(fmt::format("{}: cannot be written ({})", log, std::strerror(errno)));
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t parent = getpid();
  child_ = fork();
  if (child_ == 0) become(arguments.data(), file, lock, parent);
  const int error = errno;
  close(file);
  if (child_ > 0) return;
  child_ = 0;
  throw MachineError(fmt::format("no process can be started ({}); lower --jobs", std::strerror(error)));
}

RunProcess::~RunProcess() {
  if (child_ == 0) return;
  kill(child_, SIGKILL);
  while (waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

std::optional<ProcessEnd> RunProcess::end() {
  int status = 0;
  const pid_t ended = waitpid(child_, &status, WNOHANG);
  if (ended == 0 || (ended < 0 && errno == EINTR)) return std::nullopt;
  child_ = 0;
  ProcessEnd end;
  if (ended > 0 && WIFEXITED(status)) end.code = WEXITSTATUS(status);
  if (ended > 0 && WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  return end;
}

}  // namespace mpm_ros
