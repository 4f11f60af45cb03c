#include "mpm/math/output_file.hpp"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace mpm {

std::string refused_output(const std::string& path) {
  using Type = std::filesystem::file_type;
  std::error_code ignored;  // error for what cannot be looked at; it cannot be opened either, which says why
  switch (std::filesystem::status(path, ignored).type()) {
    case Type::none:
    case Type::not_found:
    case Type::regular:
    case Type::unknown:
      return {};
    case Type::directory:
      return "it is a folder; name a file";
    default:
      return "it is a device, a pipe or a socket; name a regular file, or a new one";
  }
}

std::string behind_links(const std::string& path) {
  namespace fs = std::filesystem;
  constexpr int kMostLinks = 40;  // as the system's own limit: then they go round
  std::error_code error;
  fs::path file = fs::absolute(path, error);
  if (error) return path;
  for (int links = 0; links < kMostLinks && fs::is_symlink(fs::symlink_status(file, error)); ++links) {
    const fs::path target = fs::read_symlink(file, error);
    if (error) break;
    file = target.is_absolute() ? target : file.parent_path() / target;
  }
  const fs::path folder = fs::weakly_canonical(file.parent_path(), error);
  return error ? file.lexically_normal().string() : (folder / file.filename()).lexically_normal().string();
}

std::uint64_t inode_of(const std::string& path) {
  struct stat about {};
  return stat(path.c_str(), &about) == 0 ? about.st_ino : 0;
}

std::string open_output(std::ofstream& file, const std::string& path) {
  if (std::string refused = refused_output(path); !refused.empty()) return refused;
  errno = 0;
  file.open(path, std::ios::trunc | std::ios::binary);
  if (file) return {};
  return std::string(errno != 0 ? std::strerror(errno) : "it cannot be opened") +
         "; check the folder and its permissions, or choose another";
}

}  // namespace mpm
