#include "mpm/math/files_in_use.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <regex>

#include "mpm/math/output_file.hpp"

namespace mpm {
namespace {

namespace fs = std::filesystem;

bool same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;  // error for a file that is not there
  return a == b || fs::equivalent(a, b, ignored);
}

bool lies_in(const std::string& file, const std::string& folder, const std::regex& names) {
  const fs::path path(file);
  return same_file(path.parent_path().string(), folder) && std::regex_match(path.filename().string(), names);
}

/// Files that would be written there and are links, of either kind: what they stand for may lie anywhere.
std::vector<std::string> links_in(const std::string& folder, const std::regex& names) {
  std::vector<std::string> links;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    const bool link = entry->is_symlink(ignored) || (entry->is_regular_file(ignored) && entry->hard_link_count() > 1);
    if (link && std::regex_match(entry->path().filename().string(), names)) links.push_back(entry->path().string());
  }
  return links;
}

[[noreturn]] void refuse_read(const std::string& option, const std::string& path, const std::string& what,
                              const char* choose) {
  throw FileInUse(fmt::format("{} {}: would overwrite {}; choose another {}", option, path, what, choose));
}

[[noreturn]] void refuse_written(const std::string& option, const std::string& path, const std::string& other) {
  throw FileInUse(fmt::format("{} {}: {} writes that file too; choose another name", option, path, other));
}

}  // namespace

void FilesInUse::reads(const std::string& what, const std::string& path) {
  if (!path.empty()) read_.push_back({what, behind_links(path)});
}

void FilesInUse::writes(const std::string& option, const std::string& path) {
  if (path.empty()) return;
  const std::string file = behind_links(path);
  for (const Read& known : read_) {
    if (same_file(known.file, file)) refuse_read(option, path, known.what, "name");
  }
  for (const auto& [other, names] : written_) {
    const auto same = [&](const std::string& name) { return same_file(name, file); };
    if (other != option && std::any_of(names.begin(), names.end(), same)) refuse_written(option, path, other);
  }
  for (const Folder& folder : folders_) {
    if (folder.option != option && lies_in(file, folder.folder, std::regex(folder.names)))
      refuse_written(option, path, folder.option);
  }
  written_[option].push_back(file);
}

void FilesInUse::writes_into(const std::string& option, const std::string& folder, const std::string& names) {
  if (folder.empty()) return;
  const std::string place = behind_links(folder);
  const std::regex matching(names);
  const std::vector<std::string> links = links_in(place, matching);
  const auto is_written = [&](const std::string& file) {
    return lies_in(file, place, matching) ||
           std::any_of(links.begin(), links.end(), [&](const std::string& link) { return same_file(link, file); });
  };
  for (const Read& known : read_) {
    if (is_written(known.file)) refuse_read(option, known.file, known.what, "folder");
  }
  for (const auto& [other, files] : written_) {
    if (other == option) continue;
    const auto found = std::find_if(files.begin(), files.end(), is_written);
    if (found != files.end()) refuse_written(other, *found, option);
  }
  folders_.push_back({option, place, names});
}

}  // namespace mpm
