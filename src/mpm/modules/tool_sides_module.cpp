// Thin tools of a definition: what becomes of the material on their two sides. Mass centres of nodes, which tools
// beside cracks ask for too, are found here for both.
#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "mpm/contact/tool_sides.hpp"
#include "mpm/definition/tool_size.hpp"
#include "mpm/mechanics/mass_places.hpp"
#include "mpm/modules/shipped_modules.hpp"

namespace mpm {
namespace {

constexpr double kDistinguished = 0.9;  ///< part of a thin tool's faces: less is worth a warning

/// Says what becomes of the two sides of a body, and adds it to `sides` if they have a field each.
void look_at(const RigidBody& body, RunParts& parts, ToolSides* sides) {
  const double cell = parts.layout().smallest_cell();
  const GeometryKind geometry = parts.definition.geometry;
  const std::string start = fmt::format("rigid body '{}' is {:.2g} cells thick where it is thinnest: ", body.name(),
                                        body.surface().thickness() / cell);
  if (has_sides(body.definition(), geometry, cell)) {
    parts.notes.push_back(start + "the material on its two sides has a velocity field each");
    const ThinTool& tool = sides->add(body, geometry);
    if (tool.distinguished() >= kDistinguished) return;
    parts.warnings.push_back(fmt::format(
        "rigid body '{}' is thinner than 3 cells, and on {:.0f} % of its area its two sides cannot be told apart: "
        "material on both sides moves as one there. Divide it into flat or evenly curved bodies, use a finer "
        "grid.cell, or write sides: one",
        body.name(), 100.0 * (1.0 - tool.distinguished())));
  } else if (body.definition().sides == Sides::one && is_thin(body.definition(), geometry, cell)) {
    parts.notes.push_back(start + "with sides: one the material on its two sides shares nodes");
  } else if (is_thin(body.definition(), geometry, cell)) {
    parts.warnings.push_back(
        start +
        "material on its two sides shares nodes and feels each other when it is thinner than 3; write sides: two, use "
        "a finer grid.cell or a thicker body");
  }
}

/// Tools that material beside cracks meets at nodes, by the normal at a node's mass centre.
std::vector<const RigidBody*> met_beside_cracks(const RunParts& parts) {
  std::vector<const RigidBody*> met;
  const SimulationDefinition& definition = parts.definition;
  if (parts.choice == nullptr || definition.contact.method != ContactMethod::nodes) return met;
  for (const RigidBody& body : parts.bodies) {
    if (!body.definition().particles) met.push_back(&body);
  }
  return met;
}

/// Finds mass centres of nodes near thin tools whose sides are glued, if `sides` is not null, and near these.
void add_mass_places(RunParts& parts, const ToolSides* sides, std::vector<const RigidBody*> tools) {
  const double cell = parts.layout().smallest_cell();
  const auto near = [sides, tools = std::move(tools), cell](const Vec3& middle, double radius) {
    return (sides != nullptr && sides->near(middle, radius)) ||
           std::any_of(tools.begin(), tools.end(), [&](const RigidBody* tool) {
             return Box{middle, middle}.grown(radius + tool->reach() * cell).intersects(tool->world_bounds());
           });
  };
  const ShapeKind shape = parts.definition.method.shape;
  parts.modules.add(make_mass_places(parts.make_transfer(shape), parts.fields, parts.sets, near));
}

}  // namespace

void add_tool_sides(RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  const double cell = parts.layout().smallest_cell();
  ToolSides* sides = nullptr;
  if (std::any_of(parts.bodies.begin(), parts.bodies.end(),
                  [&](const RigidBody& body) { return has_sides(body.definition(), definition.geometry, cell); })) {
    sides = &parts.modules.add(std::make_unique<ToolSides>(parts.layout(), parts.map, parts.sets, parts.threads));
  }
  for (const RigidBody& body : parts.bodies) {
    if (std::string doubt = size_doubt(body.definition(), definition); !doubt.empty())
      parts.warnings.push_back(std::move(doubt));
    look_at(body, parts, sides);
  }
  parts.sides = sides;
  const bool glues = !parts.map.divisions().empty();
  if (glues) parts.modules.add(std::make_unique<SideGlue>(*sides, parts.fields));
  std::vector<const RigidBody*> tools = met_beside_cracks(parts);
  if (glues || !tools.empty()) add_mass_places(parts, glues ? sides : nullptr, std::move(tools));
}

}  // namespace mpm
