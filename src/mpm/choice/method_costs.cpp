#include "mpm/choice/method_costs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <istream>

#include "mpm/choice/method_choice.hpp"

namespace mpm::choice {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells = {""};
  for (const char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
}

double positive(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(value > 0.0) || !std::isfinite(value)) {
    throw ChoiceError("'" + text + "' is not a number greater than 0");
  }
  return value;
}

/// @throws ChoiceError
void check_suite(const std::string& name) {
  const std::vector<std::string>& names = suite_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw ChoiceError("no suite is called '" + name + "'");
  }
}

}  // namespace

const std::vector<std::string>& suite_names() {
  static const std::vector<std::string> list = {"bar_small",       "bar_crossing",      "square_small", "square_large",
                                                "cube_small",      "cube_large",        "vortex",       "rotation",
                                                "colliding_disks", "plate_compression", "sliding_block"};
  return list;
}

MethodCosts read_method_costs(std::istream& in) {
  std::string line;
  std::getline(in, line);
  if (cells_of(line) != std::vector<std::string>{"suite", "method", "error", "cost"}) {
    throw ChoiceError("line 1: not the header suite,method,error,cost");
  }
  MethodCosts costs;
  for (int number = 2; std::getline(in, line); ++number) {
    const std::vector<std::string> cells = cells_of(line);
    try {
      if (cells.size() != 4) throw ChoiceError(fmt::format("{} cells, not 4", cells.size()));
      check_suite(cells[0]);
      find_method(cells[1]);
      costs[cells[0]][cells[1]].push_back({positive(cells[3]), positive(cells[2])});
    } catch (const ChoiceError& error) {
      const std::string what = error.what();  // without the list of all names that there are
      throw ChoiceError(fmt::format("line {}: {}", number, what.substr(0, what.find(';'))));
    }
  }
  if (costs.empty()) throw ChoiceError("no run");
  for (auto& [suite, methods] : costs) {
    for (auto& [method, points] : methods) points = front(std::move(points));
  }
  return costs;
}

}  // namespace mpm::choice
