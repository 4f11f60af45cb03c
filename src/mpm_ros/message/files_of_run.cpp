#include "mpm_ros/message/files_of_run.hpp"

#include <filesystem>

#include "mpm_ros/message/bag_parts.hpp"

namespace mpm_ros {
namespace {

/// `text` as a regular expression that matches it alone.
std::string literal(const std::string& text) {
  std::string pattern;
  for (const char c : text) {
    if (std::string("^$\\.*+?()[]{}|/").find(c) != std::string::npos) pattern += '\\';
    pattern += c;
  }
  return pattern;
}

}  // namespace

void reads_bag(const std::string& what, const std::string& bag, mpm::FilesInUse& files) {
  if (bag.empty()) return;
  for (const std::string& part : parts_of(bag)) files.reads(what, part);
}

void writes_bag(const std::string& option, const std::string& bag, mpm::FilesInUse& files) {
  if (bag.empty() || bag == "auto") return;
  files.writes(option, bag);
  const std::filesystem::path path(bag);
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  files.writes_into(option, folder.string(),
                    literal(path.stem().string()) + "_part[0-9]+" + literal(path.extension().string()));
}

}  // namespace mpm_ros
