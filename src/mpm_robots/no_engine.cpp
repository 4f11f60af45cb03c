// A build without robots.
#include "mpm_robots/robots.hpp"

namespace mpm {

void provide_robots() {}
std::string robot_engine_name() { return {}; }

}  // namespace mpm
