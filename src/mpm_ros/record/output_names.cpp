#include "mpm_ros/record/output_names.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "mpm/math/error.hpp"
#include "mpm_ros/csv/csv_writer.hpp"

namespace mpm_ros {
namespace {

namespace fs = std::filesystem;

/// The wall time, local: part of a name.
std::string date_and_time() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%d-%H-%M-%S}", fmt::localtime(now));
}

/// "F.bag" with a number: "F_2.bag".
fs::path numbered(const fs::path& path, int number) {
  if (number <= 1) return path;
  return path.parent_path() / fmt::format("{}_{}{}", path.stem().string(), number, path.extension().string());
}

}  // namespace

std::string bag_path(const std::string& name, const std::string& scene, int run, const std::string& folder) {
  if (name != "auto") return numbered(folder.empty() ? fs::path(name) : fs::path(folder) / name, run).string();
  const fs::path path =
      fs::path(folder.empty() ? "." : folder) / fmt::format("mpm_{}_{}.bag", file_stem(scene), date_and_time());
  std::error_code ignored;
  int number = run;
  while (fs::exists(numbered(path, number), ignored)) ++number;
  return numbered(path, number).string();
}

std::string make_run_folder(const std::string& base, const std::string& scene) {
  std::error_code error;
  fs::create_directories(base, error);
  const std::string name = fmt::format("{}_{}", file_stem(scene), date_and_time());
  // Making a folder fails when it is there: two runs that begin in the same second get one each.
  for (int number = 1; !error; ++number) {
    const fs::path folder = fs::path(base) / (number == 1 ? name : fmt::format("{}_{}", name, number));
    if (fs::create_directory(folder, error)) return folder.string();
  }
  throw mpm::Error(fmt::format("--out {}: no folder can be made in it ({}); choose another", base, error.message()));
}

std::string absolute_path(const std::string& path) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error);
  return error ? path : absolute.string();
}

}  // namespace mpm_ros
