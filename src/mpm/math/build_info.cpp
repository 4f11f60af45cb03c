#include "mpm/math/build_info.hpp"

namespace mpm {

std::string build_version() { return MPM_VERSION; }
std::string source_folder() { return MPM_SOURCE_FOLDER; }
std::string installed_folder() { return MPM_INSTALLED_FOLDER; }

}  // namespace mpm
