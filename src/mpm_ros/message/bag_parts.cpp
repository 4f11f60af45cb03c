#include "mpm_ros/message/bag_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "mpm_ros/message/bag_error.hpp"

namespace mpm_ros {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPart = "_part";

/// True if `name` is `stem`_partNNNN`extension`, whatever the number.
bool is_part(const std::string& name, const std::string& stem, const std::string& extension) {
  const std::string begin = stem + kPart;
  if (name.size() <= begin.size() + extension.size() || name.compare(0, begin.size(), begin) != 0) return false;
  if (name.compare(name.size() - extension.size(), extension.size(), extension) != 0) return false;
  return std::all_of(name.begin() + static_cast<std::ptrdiff_t>(begin.size()),
                     name.end() - static_cast<std::ptrdiff_t>(extension.size()),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

}  // namespace

std::string part_path(const std::string& bag, int part) {
  if (part <= 1) return bag;
  const fs::path whole(bag);
  const std::string name = fmt::format("{}{}{:04}{}", whole.stem().string(), kPart, part, whole.extension().string());
  return (whole.parent_path() / name).string();
}

std::vector<std::string> parts_of(const std::string& bag) {
  std::vector<std::string> parts = {bag};
  std::error_code ignored;
  for (int part = 2; fs::is_regular_file(part_path(bag, part), ignored); ++part) parts.push_back(part_path(bag, part));
  return parts;
}

int remove_later_parts(const std::string& bag) {
  const fs::path whole(bag);
  const fs::path folder = whole.has_parent_path() ? whole.parent_path() : fs::path(".");
  std::error_code error;
  std::vector<fs::path> parts;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (is_part(entry.path().filename().string(), whole.stem().string(), whole.extension().string()))
      parts.push_back(entry.path());
  }
  for (const fs::path& part : parts) {
    if (fs::remove(part, error)) continue;
    throw BagError(fmt::format("bag {}: {} of an earlier recording cannot be removed ({}); choose another name", bag,
                               part.string(), error.message()));
  }
  return static_cast<int>(parts.size());
}

}  // namespace mpm_ros
