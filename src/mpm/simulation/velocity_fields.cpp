#include "velocity_fields.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "mpm/contact/thin_tool.hpp"
#include "mpm/definition/definition.hpp"
#include "mpm/definition/layout.hpp"
#include "mpm/math/dimension.hpp"

namespace mpm {
namespace {

bool divided_by(const RigidBodyDefinition& tool, const std::string& body, const SimulationDefinition& definition) {
  return divides(tool, body) && has_sides(tool, definition.geometry, definition.smallest_cell());
}

int tools_that_divide(const std::string& body, const SimulationDefinition& definition) {
  const auto& tools = definition.rigid_bodies;
  return static_cast<int>(std::count_if(
      tools.begin(), tools.end(), [&](const RigidBodyDefinition& tool) { return divided_by(tool, body, definition); }));
}

// Number of fields across cracks of each body, and across thin tools where a crack divides it: one where one of them
// does; three where several may meet at a node.
std::vector<int> fields_across(const SimulationDefinition& definition) {
  std::vector<int> across;
  for (const DeformableBody& body : definition.bodies) {
    const auto& cracks = definition.cracks.list;
    const auto count = std::count_if(cracks.begin(), cracks.end(), [&](const CrackDefinition& crack) {
      return definition.cracks.divides(crack, body.name);
    });
    const auto all = count == 0 ? 0 : count + tools_that_divide(body.name, definition);
    across.push_back(all == 0 ? 0 : all == 1 ? 1 : 3);
  }
  return across;
}

}  // namespace

GridLayout layout_of(const SimulationDefinition& definition) {
  GridLayout layout(dimensions(definition.geometry), definition.grid.cell, definition.grid.min, definition.grid.max);
  for (int k = 0; k < layout.dim(); ++k) {
    if (definition.walls[2 * layout.axis(k)].kind == WallKind::periodic) layout.make_periodic(k);
  }
  return layout;
}

// A tool may come to any body, so a thin one divides all of them unless it names those that it divides. Where cracks
// divide a body its particles choose their fields, and a tool divides it by that choice (crack/tool_cuts.hpp).
FieldMap field_map(const SimulationDefinition& definition) {
  const std::vector<int> across = fields_across(definition);
  std::vector<int> groups;
  std::vector<bool> divided;
  for (const DeformableBody& body : definition.bodies) {
    if (body.field < 0) {
      throw DefinitionError(fmt::format("body '{}': its velocity field is {}", body.name, body.field));
    }
    divided.push_back(across[groups.size()] == 0 && tools_that_divide(body.name, definition) > 0);
    groups.push_back(body.field);
  }
  return {groups, divided, across};
}

std::unique_ptr<NodeChoice> make_choice(const FieldMap& map, Fields& fields) {
  const std::vector<int> chosen = map.chosen();
  if (chosen.empty()) return nullptr;
  check_field_count(fields.front()->layout, map.count() + 1);  // patches have a number beside the fields'
  return std::make_unique<NodeChoice>(fields, chosen);
}

Fields make_fields(const SimulationDefinition& definition, int count) {
  const GridLayout layout = layout_of(definition);
  Fields fields = make_fields(layout, count);
  for (auto& grid : fields) {
    grid->wall_layers = traits_of(definition.method.shape).wall_layers();
    for (int face = 0; face < 2 * layout.dim(); ++face) {
      const WallKind kind = definition.walls[2 * layout.axis(face / 2) + face % 2].kind;
      grid->has_wall[face] = kind != WallKind::none && kind != WallKind::periodic;
      grid->mirrors[face] =
          grid->has_wall[face] || (axisymmetric(definition.geometry) && face == 0 && layout.origin(0) == 0.0);
    }
  }
  return fields;
}

}  // namespace mpm
