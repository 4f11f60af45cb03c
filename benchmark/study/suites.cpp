#include <fmt/format.h>

#include "study/problems.hpp"

namespace mpm::study {

const std::vector<Suite>& suites() {
  static const std::vector<Suite> list = {
      vibrating_bar(),
      manufactured("bar_crossing", GeometryKind::line, 0.05),
      manufactured("square_small", GeometryKind::plane_strain, 0.001),
      manufactured("square_large", GeometryKind::plane_strain, 0.05),
      manufactured("cube_small", GeometryKind::solid, 0.001),
      manufactured("cube_large", GeometryKind::solid, 0.05),
      vortex("vortex", 0.25),
      rotation(),
      colliding_disks(),
      plate_compression(),
      sliding_block(),
  };
  return list;
}

const Suite& find_suite(const std::string& name) {
  std::string names;
  for (const Suite& suite : suites()) {
    if (suite.name == name) return suite;
    names += (names.empty() ? "" : ", ") + suite.name;
  }
  if (name == "tool_force") throw StudyError("the suite tool_force has options and tables of its own; run it alone");
  throw StudyError(
      fmt::format("no suite is called '{}'; there are {}, and tool_force, which is run alone", name, names));
}

std::vector<Discretisation> grids(const std::vector<int>& cells, int varied) {
  std::vector<Discretisation> list;
  for (const int count : cells) list.push_back({count, 0.5, 2});
  list.push_back({varied, 0.2, 2});
  list.push_back({varied, 0.8, 2});
  list.push_back({varied, 0.5, 3});
  return list;
}

}  // namespace mpm::study
