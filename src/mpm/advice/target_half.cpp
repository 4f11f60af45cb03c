#include "mpm/advice/target_half.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mpm/scene/scene_parts.hpp"

namespace mpm {
namespace {

constexpr double kFar = 1e3;  ///< [m] beyond the ends of any tool, in place of infinity

/// "[0 m, 0.1 m]": components along the scene's axes.
std::string vector_text(const Scene& scene, const Vec3& vector) {
  std::string text;
  for (const int axis : axes_of(scene)) text += fmt::format("{}{:.15g} m", text.empty() ? "[" : ", ", vector[axis]);
  return text + "]";
}

double middle(const Scene& scene, int axis) {
  const GridDefinition& grid = scene.definition.grid;
  return 0.5 * (grid.min[axis] + grid.max[axis]);
}

bool same_law(const FrictionLaw& a, const FrictionLaw& b) {
  return a.stick == b.stick && a.coefficient == b.coefficient && a.at_rest() == b.at_rest() && a.adhesion == b.adhesion;
}

template <std::size_t N>
bool constant(const std::array<Function, N>& functions) {
  return std::all_of(functions.begin(), functions.end(), [](const Function& one) { return one.is_constant(); });
}

std::string asymmetry_of_body(const BodyDefinition& body, double plane, double tolerance, int axis) {
  const auto says = [&](const char* what) {
    return fmt::format("body '{}' {}; model the half by hand, with a face `symmetry`", body.name, what);
  };
  const Box& box = body.region.box;
  if (body.region.kind != Region::Kind::box || std::abs(box.min[axis] + box.max[axis] - 2.0 * plane) > tolerance)
    return says("is no box whose middle lies on that plane");
  if (body.jitter != 0.0) return says("has random places of particles, jitter");
  if (body.cut_out_all || !body.cut_out.empty()) return says("leaves out what is inside rigid bodies, cut_out");
  if (!body.velocity[static_cast<std::size_t>(axis)].is_zero()) return says("moves across that plane at the start");
  if (!constant(body.velocity)) return says("starts with a velocity that is a function of place");
  if (body.stress) {
    if (!constant(*body.stress)) return says("starts with a stress that is a function of place");
    for (std::size_t other = 0; other < 3; ++other) {  // yz, xz, xy
      if (static_cast<int>(other) != axis && !(*body.stress)[3 + other].is_zero())
        return says("starts with a shear stress on that plane");
    }
  }
  if (body.temperature && !body.temperature->is_constant())
    return says("starts with a temperature that is a function of place");
  return {};
}

/// True if an axis is one of a tensor's own.
bool along_axis(const Symmetric3<double>& tensor, int axis) {
  const std::array<double, 3> off = {tensor.yz, tensor.xz, tensor.xy};  // component that each axis is not in
  for (int other = 0; other < 3; ++other) {
    if (other != axis && off[static_cast<std::size_t>(other)] != 0.0) return false;
  }
  return true;
}

/// True if the corners of a tool's bounds, in its pose, are their own mirror image.
bool corners_mirrored(const RigidBodyDefinition& body, double plane, double tolerance, int axis) {
  const Box bounds = body.surface->bounds();
  std::array<Vec3, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    Vec3 corner;
    for (int k = 0; k < 3; ++k) corner[k] = std::clamp((i >> k) % 2 == 0 ? bounds.min[k] : bounds.max[k], -kFar, kFar);
    corners[i] = body.pose.to_world(corner);
  }
  return std::all_of(corners.begin(), corners.end(), [&](Vec3 mirrored) {
    mirrored[axis] = 2.0 * plane - mirrored[axis];
    return std::any_of(corners.begin(), corners.end(),
                       [&](const Vec3& corner) { return (corner - mirrored).cwiseAbs().maxCoeff() <= tolerance; });
  });
}

std::string asymmetry_of_tool(const RigidBodyDefinition& body, double plane, double tolerance, int axis) {
  const auto says = [&](const char* what) { return fmt::format("rigid body '{}' {}", body.name, what); };
  if (body.free) return says("is free, and half of it would have half the mass and load; prescribe its motion");
  if (body.particles) return says("is made of particles, of which half would be modelled; leave out particles");
  if (std::abs(body.pose.position[axis] - plane) > tolerance) return says("does not lie on that plane; move it there");
  if (!body.velocity[static_cast<std::size_t>(axis)].is_zero()) return says("moves across that plane");
  for (int other = 0; other < 3; ++other) {
    if (other != axis && !body.rotation_rate[static_cast<std::size_t>(other)].is_zero())
      return says("turns out of that plane");
  }
  if (!corners_mirrored(body, plane, tolerance, axis))
    return says("reaches further on one side of that plane, or is turned against it");
  return {};
}

/// Asymmetry of one quantity that particles carry, in words. Each condition has to be its own mirror image; one on
/// either side is not seen to be that of the other.
std::string asymmetry_of_quantity(const QuantityDefinition& quantity, const Scene& scene, double plane,
                                  double tolerance, int axis) {
  const std::string start = fmt::format("transport.{}: ", traits_of(quantity.quantity).name);
  const std::string by_hand = "; model the half by hand, with a face `symmetry`";
  for (const auto& [body, initial] : quantity.initial) {
    if (initial.uses_place(axis)) return start + "its start differs on the two sides" + by_hand;
  }
  for (const ValueDefinition& value : quantity.values) {
    if (value.value.uses_place(axis))
      return start + fmt::format("the value '{}' differs on the two sides", value.name) + by_hand;
    if (!corners_mirrored(value.region, plane, tolerance, axis))
      return start + fmt::format("the region of the value '{}' lies on one side", value.name) + by_hand;
    const auto& turns = value.region.rotation_rate;
    if (!value.region.velocity[static_cast<std::size_t>(axis)].is_zero() ||
        !std::all_of(turns.begin(), turns.end(), [](const Function& rate) { return rate.is_zero(); }))
      return start + fmt::format("the region of the value '{}' moves across that plane", value.name) + by_hand;
  }
  const std::vector<LoadRegion>& regions = scene.flux_regions[static_cast<std::size_t>(quantity.quantity)];
  for (std::size_t i = 0; i < quantity.fluxes.size(); ++i) {
    const FluxDefinition& flux = quantity.fluxes[i];
    const auto says = [&](const char* what) {
      return start + fmt::format("the flux '{}' {}", flux.name, what) + by_hand;
    };
    if (flux.face / 2 == axis) return says("is through a face on one side");
    if (flux.value.uses_place(axis)) return says("differs on the two sides");
    if (i < regions.size() && regions[i].region) {
      const Box bounds = regions[i].region->bounds();
      if (!(std::abs(bounds.min[axis] + bounds.max[axis] - 2.0 * plane) <= tolerance))
        return says("has a region on one side");
    }
  }
  for (const SourceDefinition& source : quantity.sources) {
    if (source.value.uses_place(axis)) return start + "a source differs on the two sides" + by_hand;
  }
  for (const ToolHeatDefinition& tool : quantity.tools) {
    if (tool.capacity > 0.0) {
      return start +
             fmt::format("the heat capacity of '{}' is that of the whole body, which half the material would heat",
                         tool.body) +
             by_hand;
    }
  }
  for (const TransportMaterial& material : quantity.materials) {
    if (!along_axis(material.anisotropy.value_or(Symmetric3<double>{}), axis) || !along_axis(material.biot, axis))
      return start + "a material's axes are oblique to that plane" + by_hand;
  }
  return {};
}

}  // namespace

std::string asymmetry(const Scene& scene, int axis) {
  const SimulationDefinition& definition = scene.definition;
  const GridDefinition& grid = definition.grid;
  const double plane = middle(scene, axis), tolerance = 1e-6 * grid.cell[axis];
  const long cells = std::lround((grid.max[axis] - grid.min[axis]) / grid.cell[axis]);
  if (cells % 2 != 0) return fmt::format("the grid's middle is in a cell, of {}; make their number even", cells);
  const auto face = static_cast<std::size_t>(2 * axis);
  const WallDefinition &low = definition.walls[face], &high = definition.walls[face + 1];
  if (low.kind == WallKind::periodic) return "the grid is periodic along it; leave one of them out";
  if (low.kind != high.kind || low.hold != high.hold || !same_law(low.friction, high.friction))
    return "the two faces of the grid differ; give them the same boundary";
  if (definition.gravity[axis] != 0.0) return "gravity pulls across that plane";
  if (!definition.conditions.empty() || !definition.body_forces.empty() || !definition.particle_forces.empty() ||
      !definition.tractions.empty())
    return "loads and velocity conditions are not halved; model the half by hand, with a face `symmetry`";
  if (!definition.robots.empty()) return "half of a robot would have half the load on its joints; leave symmetric out";
  if (definition.cracks.any()) return "cracks are not halved; model the half by hand, with a face `symmetry`";
  for (const BodyDefinition& body : scene.bodies) {
    if (const std::string why = asymmetry_of_body(body, plane, tolerance, axis); !why.empty()) return why;
  }
  for (std::size_t i = 0; i < definition.rigid_bodies.size(); ++i) {
    const RigidBodyDefinition& body = definition.rigid_bodies[i];
    if (const std::string why = asymmetry_of_tool(body, plane, tolerance, axis); !why.empty()) return why;
    if (i < scene.commands.size() && !scene.commands[i].frame.empty())
      return fmt::format("rigid body '{}' follows a tf frame, which may leave that plane", body.name);
  }
  for (const QuantityDefinition& quantity : definition.transport.quantities) {
    const std::string why = asymmetry_of_quantity(quantity, scene, plane, tolerance, axis);
    if (!why.empty()) return why;
  }
  return {};
}

std::vector<std::string> half_lines(const Scene& scene, int axis) {
  const double plane = middle(scene, axis);
  Vec3 corner = scene.definition.grid.min;
  corner[axis] = plane;
  std::vector<std::string> lines = {"grid.min=" + vector_text(scene, corner),
                                    fmt::format("boundaries.{}_min=symmetry", axis_name(axis))};
  for (const BodyDefinition& body : scene.bodies) {
    corner = body.region.box.min;
    corner[axis] = plane;
    lines.push_back(fmt::format("bodies.{}.shape.box.min={}", body.name, vector_text(scene, corner)));
  }
  return lines;
}

}  // namespace mpm
