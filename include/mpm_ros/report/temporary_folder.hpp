// A place for files that nobody keeps.
#pragma once

#include <string>

namespace mpm_ros {

/// A folder under the system's temporary one (TMPDIR), removed with its content at the end.
class TemporaryFolder {
 public:
  /// @throws ReportError
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::string& path() const { return path_; }
  /// Path of a file of that name in it.
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace mpm_ros
