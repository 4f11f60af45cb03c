#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "mpm/advice/auto_method.hpp"
#include "mpm/math/build_info.hpp"
#include "mpm/math/input_file.hpp"

namespace mpm {

MethodCostsFile load_method_costs(const std::string& path) {
  MethodCostsFile file;
  file.path = path;
  std::ifstream stream;
  if (!open_input(stream, path).empty()) {
    file.fault = path + " cannot be read; run scripts/methods, or name a table in MPM_ROS_METHOD_COSTS";
    return file;
  }
  try {
    file.costs = choice::read_method_costs(stream);
  } catch (const choice::ChoiceError& error) {
    file.fault = path + ": " + error.what();
  }
  return file;
}

MethodCostsFile load_method_costs() {
  if (const char* variable = std::getenv("MPM_ROS_METHOD_COSTS")) return load_method_costs(std::string(variable));
  namespace fs = std::filesystem;
  const fs::path beside = source_folder() + "/config/method_costs.csv";
  const fs::path installed = installed_folder() + "/config/method_costs.csv";
  std::error_code ignored;
  return load_method_costs(fs::is_regular_file(beside, ignored) ? beside.string() : installed.string());
}

}  // namespace mpm
