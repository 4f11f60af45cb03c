#include "mpm_ros/report/temporary_folder.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "mpm_ros/report/report_error.hpp"

namespace mpm_ros {

TemporaryFolder::TemporaryFolder() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error) {
    throw ReportError(fmt::format("TMPDIR names no folder for temporary files: {}; set it to one", error.message()));
  }
  path_ = (folder / "bag_report_XXXXXX").string();
  if (mkdtemp(path_.data()) == nullptr) {
    throw ReportError(fmt::format("{}: no temporary folder can be made: {}", path_, std::strerror(errno)));
  }
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace mpm_ros
