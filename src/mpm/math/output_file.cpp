#include "mpm/math/output_file.hpp"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace mpm {

std::string refused_output(const std::string& path) {
  using Type = std::filesystem::file_type;
  std::error_code ignored;  // what cannot be looked at cannot be opened either, which says why
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
