#include "mpm_ros/report/reindex.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "mpm_ros/message/bag_error.hpp"
#include "mpm_ros/report/report_error.hpp"
#include "mpm_ros/report/script.hpp"

namespace mpm_ros {

std::string reindexed_copy(const std::string& path, const std::string& folder) {
  namespace fs = std::filesystem;
  constexpr double kGigabyte = 1e9;
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  const fs::space_info space = fs::space(folder, error);
  if (!error && space.available < size) {
    throw BagError(fmt::format(
        "{}: cut short while it was recorded, and {} has no room for a copy of {:.1f} GB with an index; set "
        "TMPDIR to a larger disk, or repair the bag in its place with: rosbag reindex {}",
        path, folder, static_cast<double>(size) / kGigabyte, path));
  }
  int code = 0;
  try {
    code = Script({"rosbag", "reindex", "-q", "--output-dir=" + folder, path}, {false, true}).finish();
  } catch (const ReportError& problem) {
    throw BagError(
        fmt::format("{}: cut short while it was recorded, and {}; install python3-rosbag", path, problem.what()));
  }
  const fs::path copy = fs::path(folder) / fs::path(path).filename();
  if (code != 0 || !fs::exists(copy, error)) {
    throw BagError(
        fmt::format("{}: cut short while it was recorded, and nothing in it can be saved (rosbag reindex {} "
                    "says why); record again",
                    path, path));
  }
  return copy.string();
}

}  // namespace mpm_ros
