#include "mpm/crack/tool_cuts.hpp"

namespace mpm {
namespace {

constexpr double kBefore = 1e-6;  ///< thicknesses of a tool before its face

Vec3 world(const Vec2& place) { return {place[0], 0.0, place[1]}; }

/// The place, or where that is in the tool the one before its nearest face.
Vec3 before_face(const ThinTool& tool, const Vec2& place) {
  const Pose& pose = tool.body().pose();
  const Surface& surface = tool.body().surface();
  const SurfacePoint nearest = surface.at(pose.to_body(world(place)));
  if (nearest.distance > 0.0) return world(place);
  return world(place) + (kBefore * surface.thickness() - nearest.distance) * (pose.orientation * nearest.normal);
}

}  // namespace

bool ToolCuts::within(const Cut& cut, const Vec2& middle, double radius) {
  SurfacePoint found;
  return cut.tool->within(world(middle), radius, found);
}

bool ToolCuts::meet(const Vec2& low, const Vec2& high) const {
  for (const Cut& cut : cuts_) {
    if (within(cut, 0.5 * (low + high), 0.5 * (high - low).norm())) return true;
  }
  return false;
}

bool ToolCuts::above(int cut, const Vec2& place) const { return cuts_[cut].tool->side(world(place)) == 0; }

bool ToolCuts::crosses(int cut, const Vec2& from, const Vec2& to) const {
  if (!within(cuts_[cut], 0.5 * (from + to), 0.5 * (to - from).norm())) return false;
  const ThinTool& tool = *cuts_[cut].tool;
  const Vec3 first = before_face(tool, from), last = before_face(tool, to);
  return tool.side(first) != tool.side(last) && tool.between(first, last);
}

bool ToolCuts::parts(int cut, const Vec2& low, const Vec2& high) const {
  const std::array<Vec2, 4> corners = {low, Vec2(low[0], high[1]), high, Vec2(high[0], low[1])};
  bool any = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (above(cut, corners[i]) == above(cut, corners[k])) continue;
      if (!crosses(cut, corners[i], corners[k])) return false;
      any = true;
    }
  }
  return any;
}

}  // namespace mpm
