// transport: quantities that particles carry beside their motion (doc/transport.md), and what holds and feeds them.
#include <fmt/format.h>

#include <algorithm>

#include "mpm/math/nearest.hpp"
#include "mpm/rules/geometry_rules.hpp"
#include "mpm/sections/sections.hpp"
#include "mpm/transport/transport_keys.hpp"

namespace mpm {
namespace {

constexpr Dimension kHeatFlux{0, 1, -3, 0, 0};
constexpr Dimension kHeatSource{-1, 1, -3, 0, 0};
constexpr Dimension kConductance{0, 1, -3, 0, -1};
constexpr double kRoom = 293.0;  // [K]

Dimension flux_dimension(Transported quantity) { return quantity == Transported::temperature ? kHeatFlux : kVelocity; }
Dimension source_dimension(Transported quantity) { return quantity == Transported::temperature ? kHeatSource : kRate; }

/// A value of the quantity; a constant temperature is absolute.
Function read_value(const Value& value, Transported quantity) {
  Function function = value.function(value_dimension(quantity));
  if (quantity == Transported::temperature && function.is_constant() && !(function(0.0) >= 0.0)) {
    value.fail(fmt::format("{:g} K is below the absolute zero; temperatures are absolute, in kelvins", function(0.0)));
  }
  return function;
}

/// p = rho g (table - height), not below zero.
Function read_hydrostatic(const Value& value, const Scene& scene) {
  const Map map(value, {"water_table", "fluid_density"});
  const Vec3& gravity = scene.definition.gravity;
  int axis = 0;
  if (!(gravity.cwiseAbs().maxCoeff(&axis) > 0.0) || gravity.norm() > gravity.cwiseAbs().maxCoeff() * (1.0 + 1e-12)) {
    value.fail("needs gravity along an axis, such as gravity: [0, 0, -9.81]");
  }
  const double density = map.find("fluid_density") ? map.at("fluid_density").positive(kDensity) : 1000.0;
  const double table = map.at("water_table").number(kLength);
  return Function::parse(
      fmt::format("max(0, {:.17g} * ({} - ({:.17g})))", density * gravity[axis], axis_name(axis), table));
}

void read_initial_values(const Value& value, Scene& scene, QuantityDefinition& quantity) {
  const auto one = [&](const Value& of) {
    if (quantity.quantity == Transported::pore_pressure && of.is_map()) {
      return read_hydrostatic(only_key(of, {"hydrostatic"}).second, scene);
    }
    return read_value(of, quantity.quantity);
  };
  const bool whole =
      !value.is_map() || (quantity.quantity == Transported::pore_pressure && value.node()["hydrostatic"]);
  if (whole) {
    quantity.initial.emplace_back("", one(value));
    return;
  }
  if (value.node().size() == 0) value.fail("names no body; write a value, or one for each body");
  for (const auto& entry : value.node()) {
    const std::string body = read_body(value.child(entry.first, entry.first.Scalar()), scene);
    quantity.initial.emplace_back(body, one(value.child(entry.second, body)));
  }
}

void read_prescribed(const Value& value, Scene& scene, QuantityDefinition& quantity) {
  const Map map(value, {"name", "region", "shape", "pose", "value"});
  ValueDefinition prescribed;
  const auto name = map.find("name");
  prescribed.region.name = prescribed.name = name ? name->name() : fmt::format("value_{}", quantity.values.size());
  prescribed.where = value.where();
  read_region_or_shape(map, scene, prescribed.region);
  prescribed.value = read_value(map.at("value"), quantity.quantity);
  quantity.values.push_back(std::move(prescribed));
}

void read_flux(const Value& value, Scene& scene, QuantityDefinition& quantity) {
  const Map map(value, {"name", "body", "edge", "region", "flux", "convection", "radiation"});
  FluxDefinition flux;
  flux.body = read_body(map.at("body"), scene);
  flux.face = read_edge(map.at("edge"), scene);
  const auto name = map.find("name");
  flux.name = name ? name->name() : fmt::format("flux_{}", quantity.fluxes.size());
  const auto given = map.find("flux"), convection = map.find("convection"), radiation = map.find("radiation");
  if (given.has_value() + convection.has_value() + radiation.has_value() != 1) {
    value.fail("write one of flux, which is counted into the body, convection and radiation");
  }
  if (quantity.quantity != Transported::temperature && (convection || radiation)) {
    value.fail("convection and radiation carry heat; write flux");
  }
  if (given) flux.value = given->function(flux_dimension(quantity.quantity));
  if (convection) {
    const Map parts(*convection, {"coefficient", "ambient"});
    flux.kind = FluxDefinition::Kind::convection;
    flux.coefficient = parts.at("coefficient").positive(kConductance);
    flux.value = read_value(parts.at("ambient"), Transported::temperature);
  }
  if (radiation) {
    const Map parts(*radiation, {"emissivity", "ambient"});
    flux.kind = FluxDefinition::Kind::radiation;
    flux.coefficient = parts.at("emissivity").positive(kPlain);
    if (flux.coefficient > 1.0) parts.at("emissivity").fail("an emissivity is 1 at most");
    flux.value = read_value(parts.at("ambient"), Transported::temperature);
  }
  quantity.fluxes.push_back(std::move(flux));
  scene.flux_regions[static_cast<std::size_t>(quantity.quantity)].push_back(read_load_region(map, scene));
}

void read_source(const Value& value, Scene& scene, QuantityDefinition& quantity) {
  const Map map(value, {"body", "rate", "ramp"});
  SourceDefinition source;
  if (const auto body = map.find("body"); body && body->text() != "all") source.body = read_body(*body, scene);
  const auto rate = map.find("rate"), ramp = map.find("ramp");
  if (rate.has_value() == ramp.has_value())
    value.fail("write rate, by volume and time, or ramp, whose changes the body follows");
  source.ramp = ramp.has_value();
  source.value = rate ? rate->function(source_dimension(quantity.quantity)) : read_value(*ramp, quantity.quantity);
  quantity.sources.push_back(std::move(source));
}

void read_tool_heat(const Value& value, Scene& scene, QuantityDefinition& quantity) {
  ToolHeatDefinition tool;
  tool.friction_part = 0.5;
  const Map map = read_keys(value, tool_heat_keys(), tool);
  tell_defaults(map, tool_heat_keys(), scene);
  std::vector<std::string> tools;
  for (const RigidBodyDefinition& body : scene.definition.rigid_bodies) tools.push_back(body.name);
  tool.body = map.at("body").text();
  if (std::find(tools.begin(), tools.end(), tool.body) == tools.end()) {
    map.at("body").fail(fmt::format("no rigid body '{}'; {}", tool.body, suggest(tool.body, tools)));
  }
  for (const ToolHeatDefinition& other : quantity.tools) {
    if (other.body == tool.body) value.fail(fmt::format("a second entry of '{}'; write one", tool.body));
  }
  if (tool.temperature.uses_place()) map.at("temperature").fail("a tool has one temperature; write a function of t");
  quantity.tools.push_back(std::move(tool));
}

void read_pair_heat(const Value& value, Scene& scene, QuantityDefinition& quantity) {
  const Map map(value, {"bodies", "conductance"});
  const std::vector<Value> bodies = map.at("bodies").elements();
  if (bodies.size() != 2) map.at("bodies").fail("name two bodies, as in [billet, die]");
  quantity.pairs.push_back(
      {read_body(bodies[0], scene), read_body(bodies[1], scene), map.at("conductance").positive(kConductance)});
}

void read_quantity(const Value& value, const Map& root, Transported kind, Scene& scene) {
  const bool heat = kind == Transported::temperature;
  std::vector<std::string> keys = quantity_keys().names();
  for (const std::string& key : heat_keys().names()) {
    if (heat) keys.push_back(key);
  }
  const Map map(value, keys);
  QuantityDefinition quantity;
  quantity.quantity = kind;
  read_keys(map, quantity_keys(), quantity);
  if (heat) read_keys(map, heat_keys(), quantity);
  if (heat) quantity.reference = kRoom;
  if (const auto initial = map.find("initial")) {
    read_initial_values(*initial, scene, quantity);
    const Function& first = quantity.initial.front().second;
    if (quantity.initial.front().first.empty() && first.is_constant()) quantity.reference = first(0.0);
  } else {
    scene.choices.emplace_back(value.path() + ".initial", kind == Transported::temperature ? "293 K: a room" : "0");
  }
  if (const auto reference = map.find("reference")) {
    quantity.reference = kind == Transported::temperature ? reference->non_negative(kTemperature)
                                                          : reference->number(value_dimension(kind));
  }
  if (map.find("order") && quantity.order == 2 && quantity.method == RateMethod::particle_capacity) {
    map.at("order").fail("particle_capacity is of order 1; leave it out");
  }
  const auto each = [&](const char* key, void (*read)(const Value&, Scene&, QuantityDefinition&)) {
    if (const auto list = map.find(key)) {
      for (const Value& one : list->elements()) read(one, scene, quantity);
    }
  };
  each("values", read_prescribed);
  each("fluxes", read_flux);
  each("sources", read_source);
  if (kind == Transported::temperature) {
    each("tools", read_tool_heat);
    each("pairs", read_pair_heat);
  }
  const std::vector<Value> materials = root.at("materials").elements();
  for (std::size_t m = 0; m < materials.size(); ++m) {
    quantity.materials.push_back(read_transport_constants(material_map(materials[m], root), kind, m, scene));
  }
  scene.definition.transport.quantities.push_back(std::move(quantity));
}

}  // namespace

void read_transport(const Map& root, Scene& scene) {
  const auto section = root.find("transport");
  if (!section) return;
  std::vector<std::string> names;
  for (const TransportedTraits& one : kTransported) names.emplace_back(one.name);
  const Map map(*section, names);
  for (int q = 0; q < kQuantities; ++q) {
    if (const auto quantity = map.find(kTransported[q].name)) {
      read_quantity(*quantity, root, static_cast<Transported>(q), scene);
    }
  }
  if (scene.definition.transport.quantities.empty()) {
    section->fail("names no quantity; write temperature, concentration or pore_pressure");
  }
}

}  // namespace mpm
