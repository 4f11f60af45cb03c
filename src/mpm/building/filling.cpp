#include "filling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/definition/tool_size.hpp"
#include "mpm/math/nearest.hpp"
#include "mpm/scene/scene_parts.hpp"
#include "mpm/shape/ring.hpp"

namespace mpm {
namespace {

constexpr int kPartsOfPlace = 4;       ///< parts of a spacing, for what is cut out of places that it does not fill
constexpr double kSameVolume = 1e-8;   ///< round-off of a sum over all particles
constexpr double kSameCutOut = 0.002;  ///< part: what is cut out evens out over many places, and is found about as well

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

bool StandingTool::may_hold(const Vec3& place, double reach) const {
  return bounds_.intersects({place.array() - reach, place.array() + reach});
}

Filling::Filling(const BodyDefinition& body, const Scene& scene, const std::function<bool()>& interrupt)
    : check_stop_(interrupt, "the bodies were filled with particles"),
      body_(&body),
      scene_(&scene),
      axes_(axes_of(scene)),
      lattices_(body_lattice(body, scene)) {
  for (const int axis : axes_) volume_ *= lattices_[axis].spacing;
  volume_ *= scene.definition.across();
  if (!(body.jitter > 0.0)) cut_ = CutCells(body.region, scene, lattices_, check_stop_);
  each_place([this](const FilledPlace&) { ++places_; });
  if (places_ == 0) {
    throw SceneError(
        fmt::format("{}: body '{}' holds no particle; make it larger or grid.cell smaller", body.where, body.name));
  }
  cut_out_ = cut_outs(body, scene);
  share_volume();
}

std::optional<ParticleLattice> Filling::lattice() const {
  if (std::none_of(lattices_.begin(), lattices_.end(), [](const Lattice& along) { return along.own; })) return {};
  ParticleLattice own;
  for (const int axis : axes_) {
    own.origin[axis] = lattices_[axis].origin;
    own.spacing[axis] = lattices_[axis].spacing;
  }
  return own;
}

std::string Filling::text() const {
  std::string text;
  for (const int axis : axes_) {
    const Lattice& along = lattices_[axis];
    if (!along.own) continue;
    text += fmt::format("{}{:.4g} m along {} for the grid's {:.4g} m", text.empty() ? "particles " : ", ",
                        along.spacing, axis_name(axis), particle_spacing(*scene_, axis));
  }
  if (!text.empty()) text += ", so that they end at the body's faces, which do not lie on the grid's lattice";
  if (scale_ == 1.0) return text;
  return text + fmt::format("{}particles of {:.4g} times the volume of their places, which add up to that of the body",
                            text.empty() ? "" : "; ", scale_);
}

double Filling::turn(double x) const { return axisymmetric(scene_->definition.geometry) ? kTurn * x : 1.0; }

double Filling::cut_out_volume() const {
  double reach = 0.0;
  std::array<int, 3> parts{1, 1, 1};
  for (const int axis : axes_) {
    reach = std::max(reach, 0.5 * lattices_[axis].spacing);
    parts[axis] = kPartsOfPlace;
  }
  const double share = volume_ / (parts[0] * parts[1] * parts[2]);
  double sum = 0.0;
  const Lattice &x = lattices_[0], &y = lattices_[1], &z = lattices_[2];
  const auto at = [](const Lattice& along, std::int64_t i, int k, int of) {
    return along.origin + (static_cast<double>(i) + (k + 0.5) / of) * along.spacing;
  };
  for (std::int64_t k = z.first; k <= z.last; ++k) {
    for (std::int64_t j = y.first; j <= y.last; ++j) {
      for (std::int64_t i = x.first; i <= x.last; ++i) {
        check_stop_();
        const Vec3 middle(x.center(i), y.center(j), z.center(k));
        if (std::none_of(cut_out_.begin(), cut_out_.end(),
                         [&](const StandingTool& tool) { return tool.may_hold(middle, reach); }))
          continue;
        for (int part = 0; part < parts[0] * parts[1] * parts[2]; ++part) {
          const Vec3 place(at(x, i, part % parts[0], parts[0]), at(y, j, part / parts[0] % parts[1], parts[1]),
                           at(z, k, part / (parts[0] * parts[1]), parts[2]));
          if (body_->region.contains(place) && is_cut_out(place)) sum += share * turn(place.x());
        }
      }
    }
  }
  return sum;
}

void Filling::share_volume() {
  double wanted = body_volume(body_->region, *scene_, lattices_), filled = 0.0;
  if (!cut_out_.empty()) wanted -= cut_out_volume();
  const bool rings = axisymmetric(scene_->definition.geometry);
  const bool whole = scene_->definition.method.axis.domains == AxisDomains::whole;
  const double half = 0.5 * lattices_[0].spacing;
  if (rings || cuts() || !cut_out_.empty()) {
    each([&](const FilledPlace& place) {
      filled += place.part * (rings ? ring_length(place.centre.x(), half, whole) : 1.0);
    });
  } else {
    filled = static_cast<double>(places_);
  }
  filled *= volume_;
  const double same = cut_out_.empty() ? kSameVolume : kSameCutOut;
  if (!(filled > 0.0 && wanted > 0.0) || std::abs(wanted / filled - 1.0) < same) return;
  scale_ = wanted / filled;
  volume_ *= scale_;
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
  std::array<std::int64_t, 3> numbers{};
  for (int k = 0; k < 3; ++k) {
    const Lattice& along = lattices_[k];
    const bool flat = !(along.spacing > 0.0);
    auto number =
        flat ? std::int64_t{0} : static_cast<std::int64_t>(std::floor((place[k] - along.origin) / along.spacing));
    if (k == axis) number += above ? 1 : -1;
    if (number < along.first || number > along.last) return false;
    beside[k] = along.center(number);
    numbers[k] = number;
  }
  const auto [i, j, k] = numbers;
  return (cut_.holds(i, j, k) || body_->region.contains(beside)) && !is_cut_out(cut_.at(beside, i, j, k).centre);
}

FillingChecks::FillingChecks(const BodyDefinition& body, const Scene& scene, double half_spacing)
    : body_(&body), half_spacing_(half_spacing) {
  // A particle of this body that lies in another has the room of particles there.
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
        fmt::format("{}: bodies '{}' and '{}' overlap: both hold {} of the particles of the first, one at ({:.6g}, "
                    "{:.6g}, {:.6g}) m; move one of them",
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
