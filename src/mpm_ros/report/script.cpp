#include "mpm_ros/report/script.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "mpm_ros/report/report_error.hpp"

namespace mpm_ros {

Script::Script(std::vector<std::string> words, Streams streams) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  // A socket in place of a pipe: a reader that is gone is an error of send(), no signal.
  int ends[2] = {-1, -1};
  if (streams.input && socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    throw ReportError(fmt::format("{} cannot be given its input: {}", words[0], std::strerror(errno)));
  }
  if (streams.input) posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
  if (streams.quiet) {
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  }
  const int failure = posix_spawnp(&child_, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (ends[1] >= 0) close(ends[1]);
  input_ = ends[0];
  if (failure != 0) {
    child_ = 0;
    if (input_ >= 0) close(input_);
    throw ReportError(fmt::format("{} cannot be run: {}", words[0], std::strerror(failure)));
  }
}

Script::~Script() { finish(); }

bool Script::write(const void* data, std::size_t bytes) {
  const char* next = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t sent = send(input_, next, bytes, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    next += sent;
    bytes -= static_cast<std::size_t>(sent);
  }
  return true;
}

int Script::finish() {
  if (input_ >= 0) close(input_);
  input_ = -1;
  if (child_ == 0) return 0;
  int status = 0;
  while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = 0;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace mpm_ros
