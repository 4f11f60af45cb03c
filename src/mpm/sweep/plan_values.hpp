// The values of one parameter of a plan: a list, a grid, or draws.
#pragma once

#include <string>
#include <vector>

#include "mpm/sweep/draw.hpp"
#include "mpm/yaml/reader.hpp"

namespace mpm::sweep {

/// A value as `--set` takes it: YAML on one line.
std::string one_line(const YAML::Node& node);

/// Values that stand under a parameter.
struct ParameterValues {
  std::vector<std::string> values;  ///< empty for draws
  bool drawn = false;
  Distribution distribution;
  std::string unit;  ///< unit of what is drawn, empty for plain numbers
};
/// Reads {values: [...]}, {grid: {...}}, {uniform: {...}}, {log_uniform: {...}} or {normal: {...}}. @throws SceneError
ParameterValues read_values(const Value& value);

/// "1.25 MPa"
std::string quantity_text(double number, const std::string& unit);

}  // namespace mpm::sweep
