#include "mpm/math/output_file.hpp"

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

}  // namespace mpm
