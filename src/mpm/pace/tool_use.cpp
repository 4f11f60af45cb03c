#include "mpm/pace/tool_use.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mpm/pace/step_cost.hpp"

namespace mpm::pace {

namespace {

constexpr int kPlaces = 24;  ///< along each axis, at which a tool is looked for in the ground
constexpr int kLooksAhead = 40, kStepsOfLook = 10;
constexpr double kRolls = 0.5;  ///< way of the rim over that of the origin from which on a tool rolls
constexpr double kNoGround = -std::numeric_limits<double>::infinity();

}  // namespace

double ToolAtWork::length(std::optional<ToolUse> in_use) const {
  if (!in_use) return std::min(depth, width);
  return *in_use == ToolUse::plate && std::isfinite(width) ? width : depth;
}

ToolsInGround::ToolsInGround(const Simulation& simulation) {
  const SimulationDefinition& definition = simulation.definition();
  axes_ = axes_of(definition.geometry);
  // Without gravity, or in a line, ground lies below its tool along the last axis.
  up_ = axes_.back();
  for (const int axis : axes_) {
    if (std::abs(definition.gravity[axis]) > std::abs(definition.gravity[up_])) up_ = axis;
  }
  if (definition.gravity[up_] > 0.0) sense_ = -1.0;
  for (const int axis : axes_) {
    if (axis != up_) level_.push_back(axis);
  }
  low_ = definition.grid.min;
  cell_ = definition.grid.cell;
  std::size_t count = 1;
  for (const int axis : level_) {
    columns_[axis] = std::max(1, static_cast<int>(std::lround((definition.grid.max[axis] - low_[axis]) / cell_[axis])));
    count *= static_cast<std::size_t>(columns_[axis]);
  }
  heights_.assign(count, kNoGround);
  std::array<std::vector<double>, 3> places;
  constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
  for (const int axis : axes_) simulation.particle_field(kNames[axis], places[axis]);
  const double half = 0.5 * cell_[up_] / std::max(1, definition.method.particles_per_direction);
  for (std::size_t p = 0; p < places[up_].size(); ++p) {
    std::size_t column = 0;
    for (const int axis : level_) {
      const int index = static_cast<int>(std::floor((places[axis][p] - low_[axis]) / cell_[axis]));
      column = column * columns_[axis] + static_cast<std::size_t>(std::clamp(index, 0, columns_[axis] - 1));
    }
    heights_[column] = std::max(heights_[column], sense_ * places[up_][p] + half);
  }
  const std::size_t bodies = simulation.bodies().size();
  for (std::size_t b = 0; b < bodies; ++b) {
    ways_.emplace_back();
    ways_.back().before = simulation.rigid_body(static_cast<int>(b)).pose();
  }
  look(simulation);
}

std::optional<double> ToolsInGround::ground_at(const Vec3& point) const {
  std::size_t column = 0;
  for (const int axis : level_) {
    const double index = std::floor((point[axis] - low_[axis]) / cell_[axis]);
    if (!(index >= 0.0 && index < columns_[axis])) return std::nullopt;
    column = column * columns_[axis] + static_cast<std::size_t>(index);
  }
  if (heights_[column] == kNoGround) return std::nullopt;
  return heights_[column];
}

double ToolsInGround::depth_of(const Surface& surface, const Pose& pose) const {
  const Box bounds = world_bounds(pose, surface.bounds());
  const double bottom = sense_ > 0.0 ? bounds.min[up_] : -bounds.max[up_];
  const double top = sense_ > 0.0 ? bounds.max[up_] : -bounds.min[up_];
  if (!std::isfinite(top - bottom)) return 0.0;
  Vec3 from = Vec3::Zero(), step = Vec3::Zero();
  std::array<int, 3> count{1, 1, 1}, n{};
  for (const int axis : level_) {
    from[axis] = std::max(bounds.min[axis], low_[axis]);
    step[axis] = (std::min(bounds.max[axis], low_[axis] + columns_[axis] * cell_[axis]) - from[axis]) / kPlaces;
    if (!(step[axis] > 0.0)) return 0.0;
    count[axis] = kPlaces;
  }
  double deepest = 0.0;
  for (n[0] = 0; n[0] < count[0]; ++n[0]) {
    for (n[1] = 0; n[1] < count[1]; ++n[1]) {
      for (n[2] = 0; n[2] < count[2]; ++n[2]) {
        Vec3 point = Vec3::Zero();
        for (const int axis : level_) point[axis] = from[axis] + (n[axis] + 0.5) * step[axis];
        const std::optional<double> ground = ground_at(point);
        if (!ground) continue;
        const auto inside = [&](double height) {
          point[up_] = sense_ * height;
          return surface.at(pose.to_body(point)).distance < 0.0;
        };
        // From below: the first place inside, and between it and the one before where the surface lies.
        const double rise = (std::min(top, *ground) - bottom) / kPlaces;
        for (int k = 0; k <= kPlaces && rise > 0.0; ++k) {
          if (!inside(bottom + k * rise)) continue;
          double out = bottom + (k - 1) * rise, in = bottom + k * rise;
          for (int halving = 0; halving < 8; ++halving) (inside(0.5 * (out + in)) ? in : out) = 0.5 * (out + in);
          deepest = std::max(deepest, *ground - in);
          break;
        }
      }
    }
  }
  return deepest;
}

void ToolsInGround::look_at(Way& way, const Surface& surface, const Pose& pose, double turned) const {
  const Pose before = std::exchange(way.before, pose);
  const double depth = depth_of(surface, pose);
  if (!(depth > 0.0)) return;
  way.depth = std::max(way.depth, depth);
  const Box bounds = world_bounds(pose, surface.bounds()), own = surface.bounds();
  way.width = std::numeric_limits<double>::infinity();
  double radius = 0.0;
  for (const int axis : level_) way.width = std::min(way.width, bounds.max[axis] - bounds.min[axis]);
  for (const int axis : axes_) {
    if (std::isfinite(own.max[axis] - own.min[axis])) radius = std::max(radius, 0.5 * (own.max[axis] - own.min[axis]));
  }
  const Vec3 moved = pose.position - before.position;
  double across = 0.0;
  for (const int axis : level_) across += moved[axis] * moved[axis];
  way.across += std::sqrt(across);
  way.along += std::abs(moved[up_]);
  way.rim += radius * turned;
}

void ToolsInGround::look(const Simulation& simulation) {
  const double now = seconds_of(simulation.time()), passed = now - std::exchange(last_, now);
  for (std::size_t b = 0; b < ways_.size(); ++b) {
    const RigidBody& body = simulation.rigid_body(static_cast<int>(b));
    look_at(ways_[b], body.surface(), body.pose(), body.twist().angular.norm() * passed);
  }
}

void ToolsInGround::look_ahead(const Simulation& simulation, double end) {
  const double from = seconds_of(simulation.time()), step = (end - from) / (kLooksAhead * kStepsOfLook);
  for (std::size_t b = 0; step > 0.0 && b < ways_.size(); ++b) {
    const RigidBody& body = simulation.rigid_body(static_cast<int>(b));
    if (body.free_motion() != nullptr) continue;
    RigidBody ahead = body;
    for (int i = 0; i < kLooksAhead; ++i) {
      double turned = 0.0;
      for (int k = 0; k < kStepsOfLook; ++k) {
        ahead.begin_step(from + step * (i * kStepsOfLook + k), step);
        ahead.end_step(step);
        turned += ahead.twist().angular.norm() * step;
      }
      look_at(ways_[b], ahead.surface(), ahead.pose(), turned);
    }
  }
}

std::vector<ToolAtWork> ToolsInGround::found() const {
  std::vector<ToolAtWork> tools;
  for (std::size_t b = 0; b < ways_.size(); ++b) {
    const Way& way = ways_[b];
    if (!(way.depth > 0.0)) continue;
    ToolAtWork tool;
    tool.body = static_cast<int>(b);
    const double origin = std::hypot(way.along, way.across);
    if (way.rim > 0.0 && way.rim >= kRolls * origin) {
      tool.use = ToolUse::wheel;
    } else if (origin > 0.0) {
      tool.use = way.along > way.across ? ToolUse::plate : ToolUse::blade;
    }
    tool.depth = way.depth;
    tool.width = way.width;
    tools.push_back(tool);
  }
  return tools;
}

}  // namespace mpm::pace
