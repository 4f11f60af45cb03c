// Files of a study: written whole, read whole, and locked.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "mpm/math/input_file.hpp"
#include "mpm/math/output_file.hpp"
#include "mpm_ros/sweep/study.hpp"

namespace mpm_ros {
namespace {

[[noreturn]] void fail_to_write(const std::string& path, int error) {
  const bool room = error == ENOSPC || error == EFBIG || error == EDQUOT;
  throw MachineError(fmt::format("{}: cannot be written ({}); {}", path, std::strerror(error),
                                 room ? "make room on its disk" : "check the folder and its permissions"));
}

/// Brings to the disk what was written to an open file or folder. True also where the file system knows no such thing.
bool reach_disk(int descriptor) { return fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP; }

bool write_all(int descriptor, const std::string& text) {
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t count = write(descriptor, text.data() + written, text.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    written += static_cast<std::size_t>(count);
  }
  return true;
}

/// An open descriptor of the lock's file, locked; -1 when another process holds it and `wait` is false.
int locked(const std::string& path, bool wait) {
  const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) fail_to_write(path, errno);
  int result = -1;
  do {
    result = flock(descriptor, wait ? LOCK_EX : LOCK_EX | LOCK_NB);
  } while (result != 0 && errno == EINTR);
  if (result == 0) return descriptor;
  const int error = errno;
  close(descriptor);
  if (error == EWOULDBLOCK) return -1;
  throw MachineError(
      fmt::format("{}: cannot be locked ({}); choose a folder on a disk with file locks", path, std::strerror(error)));
}

}  // namespace

void write_whole(const std::string& name, const std::string& text) {
  const std::string path = mpm::behind_links(name);  // a link stays one
  const std::string part = path + ".part";
  const int descriptor = open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) fail_to_write(path, errno);
  bool good = write_all(descriptor, text) && reach_disk(descriptor);
  int error = errno;
  if (close(descriptor) != 0 && good) {
    good = false;
    error = errno;
  }
  if (good && std::rename(part.c_str(), path.c_str()) != 0) {
    good = false;
    error = errno;
  }
  if (!good) {
    unlink(part.c_str());
    fail_to_write(path, error);
  }
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const int parent = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (parent < 0) return;
  reach_disk(parent);
  close(parent);
}

std::optional<std::string> read_whole(const std::string& path) {
  std::string text;
  if (!mpm::read_input(path, text).empty()) return std::nullopt;
  return text;
}

std::optional<FileLock> FileLock::try_take(const std::string& path) {
  const int descriptor = locked(path, false);
  if (descriptor < 0) return std::nullopt;
  return FileLock(descriptor);
}

FileLock FileLock::take(const std::string& path) { return FileLock(locked(path, true)); }

FileLock::~FileLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace mpm_ros
