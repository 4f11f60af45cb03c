#include "mpm/crack/periodic_reach.hpp"

#include <fmt/core.h>

namespace mpm {
namespace {

std::string fault_of(const Crack& crack, const char* what, const Vec2& place, const GridLayout& layout, double reach) {
  for (int k = 0; k < 2; ++k) {
    if (!layout.periodic(k)) continue;
    const double cells = layout.in_cells(k, place[k]);
    const bool low = cells < reach;
    if (!low && cells <= layout.last_node(k) - reach) continue;
    const char axis = "xyz"[layout.axis(k)];
    return fmt::format(
        "crack '{}': {} at ({:.6g}, {:.6g}) m is nearer than {:g} cells to {}_{}, which is periodic, and cracks do not "
        "go around; make the domain longer along {}, or write faces such as {}_min: slip",
        crack.definition.name, what, place[0], place[1], reach, axis, low ? "min" : "max", axis, axis);
  }
  return {};
}

}  // namespace

std::string periodic_fault(const std::vector<Crack>& cracks, const GridLayout& layout, int contour) {
  if (!layout.any_periodic()) return {};
  for (const Crack& crack : cracks) {
    if (!crack.felt) continue;
    for (const Vec2& place : crack.chain.line()) {
      const std::string fault = fault_of(crack, "its line", place, layout, kLineFromPeriodicFace);
      if (!fault.empty()) return fault;
    }
    for (int end = 0; end < 2; ++end) {
      if (crack.chain.end(end) != CrackEnd::tip) continue;
      const Vec2& tip = crack.chain.points()[crack.chain.point_at(end)].place;
      const std::string fault = fault_of(crack, "the contour of its tip", tip, layout, kLineFromPeriodicFace + contour);
      if (!fault.empty()) return fault;
    }
  }
  return {};
}

}  // namespace mpm
