#include "filling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/math/nearest.hpp"
#include "mpm/scene/sections.hpp"
#include "mpm/simulation/tool_size.hpp"

namespace mpm {
namespace {

Lattice lattice(const Scene& scene, const Box& bounds, int axis) {
  const GridDefinition& grid = scene.definition.grid;
  const double spacing = particle_spacing(scene, axis);
  const double all = std::round((grid.max[axis] - grid.min[axis]) / spacing);
  // One position more on either side; Region::contains() decides.
  const double first = std::floor((bounds.min[axis] - grid.min[axis]) / spacing) - 1.0;
  const double last = std::ceil((bounds.max[axis] - grid.min[axis]) / spacing) + 1.0;
  return {grid.min[axis], spacing, static_cast<std::int64_t>(std::max(0.0, first)),
          static_cast<std::int64_t>(std::min(all - 1.0, last))};
}

Box world_bounds(const RigidBodyDefinition& rigid) {
  const Box local = rigid.surface->bounds();
  Box world;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 point((corner & 1) != 0 ? local.max.x() : local.min.x(),
                     (corner & 2) != 0 ? local.max.y() : local.min.y(),
                     (corner & 4) != 0 ? local.max.z() : local.min.z());
    // Infinite extents become 1e9 m. When the body is turned, this rounds its other extents by less than a micrometre;
    // a body that is infinite along y only turns about y and is not affected.
    const Vec3 finite = point.unaryExpr([](double c) { return std::isfinite(c) ? c : std::copysign(1e9, c); });
    world.add(rigid.pose.to_world(finite));
  }
  return world;
}

/// The rigid bodies inside which a body has no particles. @throws SceneError for a name that is none of theirs
std::vector<StandingTool> cut_outs(const BodyDefinition& body, const Scene& scene) {
  std::vector<std::string> names;
  for (const RigidBodyDefinition& rigid : scene.definition.rigid_bodies) names.push_back(rigid.name);
  for (const std::string& name : body.cut_out) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    throw SceneError(fmt::format("{}: no rigid body '{}'; {}", body.cut_out_where, name,
                                 names.empty() ? "the scene has none" : suggest(name, names)));
  }
  std::vector<StandingTool> tools;
  for (const RigidBodyDefinition& rigid : scene.definition.rigid_bodies) {
    const bool named = std::find(body.cut_out.begin(), body.cut_out.end(), rigid.name) != body.cut_out.end();
    if (body.cut_out_all || named) tools.emplace_back(rigid);
  }
  return tools;
}

}  // namespace

StandingTool::StandingTool(const RigidBodyDefinition& rigid) : rigid_(&rigid), bounds_(world_bounds(rigid)) {}

bool StandingTool::holds(const Vec3& place, double depth, double& deep) const {
  SurfacePoint surface;
  if (!bounds_.contains(place) || !rigid_->surface->within(rigid_->pose.to_body(place), -depth, surface)) return false;
  deep = -surface.distance;
  return true;
}

Filling::Filling(const BodyDefinition& body, const Scene& scene) : body_(&body), scene_(&scene), axes_(axes_of(scene)) {
  lattices_.fill({0.0, 0.0, 0, 0});
  const Box bounds = body.region.bounds();
  for (const int axis : axes_) {
    lattices_[axis] = lattice(scene, bounds, axis);
    volume_ *= lattices_[axis].spacing;
  }
  volume_ *= scene.definition.across();
  each_place([this](const Vec3&) { ++places_; });
  if (places_ == 0) {
    throw SceneError(
        fmt::format("{}: body '{}' holds no particle; make it larger or grid.cell smaller", body.where, body.name));
  }
  cut_out_ = cut_outs(body, scene);
}

void Filling::check_left(std::uint64_t particles) const {
  if (particles > 0) return;
  for (const RigidBodyDefinition& rigid : scene_->definition.rigid_bodies) {
    if (const std::string doubt = size_doubt(rigid, scene_->definition); !doubt.empty())
      throw SceneError(fmt::format("{}: {}; nothing is left of body '{}'", body_->cut_out_where, doubt, body_->name));
  }
  throw SceneError(fmt::format("{}: nothing is left of body '{}': all of it lies inside rigid bodies; move one of them",
                               body_->cut_out_where, body_->name));
}

// By a number of cells drawn evenly from [-jitter, jitter] along each axis, but not out of the body. The draws are the
// same on every machine: the seed is fixed, and only the parts of the standard library are used whose results are
// specified exactly.
Vec3 Filling::jittered(const Vec3& point, std::mt19937_64& random) const {
  constexpr int kMostDraws = 64;  // ample in a body of at least a cell; after that a particle stays in place
  for (int draw = 0; draw < kMostDraws; ++draw) {
    Vec3 moved = point;
    for (const int axis : axes_) {
      const double unit = std::ldexp(static_cast<double>(random() >> 11), -52) - 1.0;  // [-1, 1)
      moved[axis] += unit * body_->jitter * scene_->definition.grid.cell[axis];
    }
    if (body_->region.contains(moved)) return moved;
  }
  return point;
}

bool Filling::is_cut_out(const Vec3& place) const {
  double deep = 0.0;
  return std::any_of(cut_out_.begin(), cut_out_.end(),
                     [&](const StandingTool& tool) { return tool.holds(place, 0.0, deep); });
}

bool Filling::has_neighbour(const Vec3& place, int axis, bool above) const {
  Vec3 beside = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    const Lattice& along = lattices_[k];
    const bool flat = !(along.spacing > 0.0);
    auto number =
        flat ? std::int64_t{0} : static_cast<std::int64_t>(std::floor((place[k] - along.origin) / along.spacing));
    if (k == axis) number += above ? 1 : -1;
    if (number < along.first || number > along.last) return false;
    beside[k] = along.center(number);
  }
  return body_->region.contains(beside) && !is_cut_out(beside);
}

FillingChecks::FillingChecks(const BodyDefinition& body, const Scene& scene, double half_spacing)
    : body_(&body), half_spacing_(half_spacing) {
  // Bodies share one lattice, so they overlap where both contain the same position.
  for (const BodyDefinition& other : scene.bodies) {
    if (&other == &body) break;
    if (other.region.bounds().intersects(body.region.bounds())) overlaps_.push_back({&other});
  }
  for (const RigidBodyDefinition& rigid : scene.definition.rigid_bodies)
    inside_.push_back({StandingTool(rigid), size_doubt(rigid, scene.definition)});
}

void FillingChecks::look(const Vec3& place) {
  for (Overlap& overlap : overlaps_) {
    if (overlap.other->region.contains(place) && overlap.count++ == 0) overlap.place = place;
  }
  for (Inside& inside : inside_) {
    double deep = 0.0;
    if (!inside.tool.holds(place, half_spacing_, deep)) continue;
    ++inside.count;
    inside.deepest = std::max(inside.deepest, deep);
  }
}

void FillingChecks::end() const {
  for (const Overlap& overlap : overlaps_) {
    if (overlap.count == 0) continue;
    throw SceneError(
        fmt::format("{}: bodies '{}' and '{}' overlap: both hold {} of the same particles, one at ({:.6g}, {:.6g}, "
                    "{:.6g}) m; move one of them",
                    body_->where, body_->name, overlap.other->name, overlap.count, overlap.place.x(), overlap.place.y(),
                    overlap.place.z()));
  }
  for (const Inside& inside : inside_) {
    if (inside.count == 0) continue;
    if (!inside.doubt.empty()) {
      throw SceneError(fmt::format("{}: {}; as it is, body '{}' overlaps it at the start: {} particles lie inside it",
                                   body_->where, inside.doubt, body_->name, inside.count));
    }
    throw SceneError(
        fmt::format("{}: body '{}' overlaps rigid body '{}' at the start: {} particles lie inside it by more than "
                    "half their spacing, the deepest by {:.4g} m; move one of them, or leave them out by cut_out: [{}]",
                    body_->where, body_->name, inside.tool.name(), inside.count, inside.deepest, inside.tool.name()));
  }
}

}  // namespace mpm
