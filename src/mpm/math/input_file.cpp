#include "mpm/math/input_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <system_error>

namespace mpm {
namespace {

std::string because(int error) {
  return std::string("it cannot be read (") + std::strerror(error) + "); check the path and its permissions";
}

}  // namespace

std::string refused_input(const std::string& path) {
  using Type = std::filesystem::file_type;
  std::error_code error;
  switch (std::filesystem::status(path, error).type()) {
    case Type::regular:
      return access(path.c_str(), R_OK) == 0 ? std::string() : because(errno);
    case Type::not_found:
      return "no such file; check the path";
    case Type::directory:
      return "it is a folder; name a file";
    case Type::none:
    case Type::unknown:
      return because(error ? error.value() : EACCES);
    default:
      return "it is a device, a pipe or a socket; name a regular file";
  }
}

std::string open_input(std::ifstream& file, const std::string& path) {
  if (std::string refused = refused_input(path); !refused.empty()) return refused;
  errno = 0;
  file.open(path, std::ios::binary);
  return file ? std::string() : because(errno != 0 ? errno : EIO);
}

std::string read_input(const std::string& path, std::string& bytes) {
  std::ifstream file;
  if (std::string refused = open_input(file, path); !refused.empty()) return refused;
  bytes.assign(std::istreambuf_iterator<char>(file), {});
  return file.bad() ? because(EIO) : std::string();
}

}  // namespace mpm
