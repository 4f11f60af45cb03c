#include "mpm/transport/transport_keys.hpp"

namespace mpm {

const KeyTable<QuantityDefinition>& quantity_keys() {
  using Quantity = QuantityDefinition;
  static const auto keys =
      KeyTable<Quantity>("transport")
          .rows({other<Quantity>(
                     "initial",
                     "function of place, or a map from bodies to such functions; of `pore_pressure` also "
                     "`{hydrostatic: {water_table, fluid_density}}`",
                     {"293 K; 0",
                      "value at the start. Bodies that the map leaves out have the `reference`. Of `johnson_cook` and "
                      "`ideal_gas` it is that of the law, which `initial: {temperature}` of a body changes. "
                      "`hydrostatic`: the pressure of water at rest below that height, 0 above it, with a "
                      "`fluid_density` of 1000 kg/m³ unless it is written; gravity has to be along an axis",
                      "{hot: 400, cold: 293}"}),
                 other<Quantity>("reference", "number",
                                 {"`initial`, if that is one constant; else 293 K, 0",
                                  "value at which nothing has expanded", "293"}),
                 other<Quantity>("values", "list, below", {"none", "prescribed values in regions"}),
                 other<Quantity>("fluxes", "list, below", {"none", "what flows in through faces of bodies"}),
                 other<Quantity>("sources", "list, below", {"none", "what arises in a volume"}),
                 word("method", &Quantity::method, {"nodal_capacity", "particle_capacity"},
                      {"",
                       "how a change of the nodes becomes one of the particles: by the content that a node can take "
                       "(notes, 6.22), or by the volume at the node and each particle's own capacity (6.24). The two "
                       "are the same in one material",
                       "particle_capacity"}),
                 plain("order", &Quantity::order,
                       {"2; 1 with `particle_capacity`",
                        "2 adds once what is lost on the way from nodes to particles, see [below](#how-it-works)", "1"},
                       from_to(1.0, 2.0))});
  return keys;
}

const KeyTable<QuantityDefinition>& heat_keys() {
  using Quantity = QuantityDefinition;
  static const auto keys =
      KeyTable<Quantity>("transport.temperature")
          .rows({word("compression_heat", &Quantity::compression_heat, {"off", "on"},
                      {"", "whether a change of volume changes the temperature of a material that expands with heat",
                       "off"}),
                 other<Quantity>(
                     "tools", "list, below",
                     {"none", "rigid bodies that exchange heat with what they touch; others let no heat through"}),
                 other<Quantity>(
                     "pairs", "list of `{bodies, conductance}`",
                     {"none",
                      "deformable bodies with a law of contact that conduct where they touch; `conductance` in W/(m² "
                      "K). A body twice: the closed faces of its [cracks](cracks.md#heat-and-moisture)",
                      "[{bodies: [billet, die], conductance: 5e3}]"})});
  return keys;
}

const KeyTable<ToolHeatDefinition>& tool_heat_keys() {
  using Tool = ToolHeatDefinition;
  constexpr Dimension kConductance{0, 1, -3, 0, -1}, kBodyCapacity{2, 1, -2, 0, -1};
  static const auto keys =
      KeyTable<Tool>("transport.temperature.tools")
          .rows({other<Tool>("body", "name of a rigid body", {kRequired, "", "iron"}),
                 number("conductance", &Tool::conductance, kConductance, kPositive,
                        {kRequired, "heat flux over the difference of temperatures across the surface", "2000"}),
                 number("temperature", &Tool::temperature, kTemperature, kNotNegative,
                        {kRequired, "of the tool, of `t` alone; with a `heat_capacity` the one at the start", "333"}),
                 number("heat_capacity", &Tool::capacity, kBodyCapacity, or_unset(0.0, kPositive),
                        {"none: the temperature is given",
                         "of the whole tool, which then has one temperature that follows what it gives and takes. In "
                         "planar scenes it is that of the scene's `thickness`",
                         "12 J/K"}),
                 number("friction_part", &Tool::friction_part, kPlain, kPart,
                        {"`0.5`", "part of the heat of friction that goes to the material; the tool takes the rest",
                         "0.7", "0.5: tool and material share the heat of friction"})});
  return keys;
}

}  // namespace mpm
