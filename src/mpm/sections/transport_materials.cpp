// The constants of materials for what is transported, which stand among the other constants of a material.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "mpm/material/law.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

constexpr Dimension kConductivity{1, 1, -3, 0, -1};
constexpr Dimension kDiffusivity{2, 0, -1, 0, 0};
constexpr double kWaterViscosity = 1e-3;  // [Pa s] at 20 C

/// A number, or {table: [[quantity, number], ...]}.
Property read_property(const Value& value, const Dimension& dimension, Transported quantity, bool may_be_zero) {
  const auto number = [&](const Value& of) {
    return may_be_zero ? of.non_negative(dimension) : of.positive(dimension);
  };
  if (!value.is_map()) return {number(value)};
  const Value table = Map(value, {"table"}).at("table");
  std::vector<std::array<double, 2>> points;
  for (const Value& row : table.elements()) {
    const std::vector<Value> pair = row.elements();
    if (pair.size() != 2) row.fail("write a pair: the quantity, and the number that holds there");
    points.push_back({pair[0].number(value_dimension(quantity)), number(pair[1])});
    if (points.size() > 1 && !(points.back()[0] > points[points.size() - 2][0])) {
      row.fail("the first numbers of a table have to rise from line to line");
    }
  }
  if (points.empty()) table.fail("a table has at least one pair");
  return Property(std::move(points));
}

double largest_principal(const Symmetric3<double>& s) {
  Eigen::Matrix3d m;
  m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m).eigenvalues().maxCoeff();
}

/// Three principal values along the axes, or six components xx, yy, zz, yz, xz, xy. @throws SceneError unless positive
Symmetric3<double> read_tensor(const Value& value, const Dimension& dimension) {
  const std::vector<Value> parts = value.elements();
  if (parts.size() != 3 && parts.size() != 6) {
    value.fail("write one number, three along x, y and z, or six: xx, yy, zz, yz, xz, xy");
  }
  std::array<double, 6> c{};
  for (std::size_t i = 0; i < parts.size(); ++i) c[i] = parts[i].number(dimension);
  Eigen::Matrix3d m;
  m << c[0], c[5], c[4], c[5], c[1], c[3], c[4], c[3], c[2];
  const Eigen::Vector3d principal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m).eigenvalues();
  if (!(principal.minCoeff() > 0.0)) {
    value.fail(
        fmt::format("its smallest principal value is {:g}; a tensor that conducts is positive in every direction",
                    principal.minCoeff()));
  }
  return {c[0], c[1], c[2], c[3], c[4], c[5]};
}

/// A conductivity, its directions apart.
void read_conductivity(const Value& value, const Dimension& dimension, Transported quantity,
                       TransportMaterial& material) {
  if (!value.is_list()) {
    material.conductivity = read_property(value, dimension, quantity, true);
    return;
  }
  material.anisotropy = read_tensor(value, dimension);
  material.conductivity = 1.0;
}

void read_heat(const Map& map, const MaterialDefinition& material, Scene& scene, TransportMaterial& heat) {
  const bool own_temperature = traits_of(material).own_temperature;
  if (own_temperature) {
    heat.capacity = std::visit([](const auto& law) { return law.heat_capacity(); }, make_law(material));
  } else {
    heat.capacity = read_property(map.at("heat_capacity"), kHeatCapacity, Transported::temperature, false);
    if (const auto part = map.find("heat_fraction")) {
      heat.heat_fraction = part->non_negative(kPlain);
      if (heat.heat_fraction > 1.0) part->fail("more heat than plastic work; write a part of 1");
    }
  }
  if (const auto conductivity = map.find("conductivity")) {
    read_conductivity(*conductivity, kConductivity, Transported::temperature, heat);
  } else {
    scene.choices.emplace_back(map.value().path() + ".conductivity", "0: heat stays where it arises");
  }
  if (const auto expansion = map.find("thermal_expansion")) {
    if (own_temperature) {
      expansion->fail(
          fmt::format("{} has an equation of state, which expands with heat; leave it out", law_name(material.law)));
    }
    heat.expansion = expansion->number(kPerKelvin);
  }
}

void read_solute(const Map& map, Scene&, TransportMaterial& solute) {
  solute.capacity = 1.0;
  double saturation = 1.0;
  if (const auto most = map.find("saturation")) saturation = most->positive(kPlain);
  solute.capacity = saturation;
  const Value diffusivity = map.at("diffusivity");
  read_conductivity(diffusivity, kDiffusivity, Transported::concentration, solute);
  if (solute.conductivity.is_constant()) {
    solute.conductivity = solute.conductivity(0.0) * saturation;
  } else if (saturation != 1.0) {
    diffusivity.fail("a diffusivity by table goes with saturation 1; leave saturation out");
  }
  if (const auto expansion = map.find("solvent_expansion")) solute.expansion = expansion->number(kPlain);
}

void read_pores(const Map& map, const MaterialDefinition& material, Scene& scene, TransportMaterial& pores) {
  if (traits_of(material).fluid()) {
    map.fail(fmt::format("{} has no pores; give water in pores to a solid or a soil", law_name(material.law)));
  }
  pores.capacity = map.at("storage").positive(kPerPascal);
  pores.biot = Symmetric3<double>::isotropic(1.0);
  if (const auto biot = map.find("biot")) {
    pores.biot = biot->is_list() ? read_tensor(*biot, kPlain) : Symmetric3<double>::isotropic(biot->positive(kPlain));
    if (largest_principal(pores.biot) > 1.0 + 1e-12) {
      biot->fail("Biot's coefficient is 1 at most: the skeleton feels no more than the whole pressure");
    }
  } else {
    scene.choices.emplace_back(map.value().path() + ".biot", "1: grains that hardly compress");
  }
  double viscosity = kWaterViscosity;
  if (const auto given = map.find("viscosity")) {
    viscosity = given->positive(kViscosity);
  } else if (map.find("permeability")) {
    scene.choices.emplace_back(map.value().path() + ".viscosity", "1e-3 Pa s: water at 20 C");
  }
  if (const auto permeability = map.find("permeability")) {
    if (permeability->is_list()) {
      read_conductivity(*permeability, kArea, Transported::pore_pressure, pores);
      pores.conductivity = 1.0 / viscosity;
    } else {
      const double constant = permeability->non_negative(kArea);
      pores.conductivity = constant / viscosity;
    }
  } else {
    scene.choices.emplace_back(map.value().path() + ".permeability", "0: undrained, no water moves");
  }
  if (const auto density = map.find("fluid_density")) {
    pores.fluid_density = density->non_negative(kDensity);
  } else if (pores.conductivity.most() > 0.0 && scene.definition.gravity.norm() > 0.0) {
    map.fail(
        "gravity drives the water in its pores; add fluid_density, such as 1000 kg/m3, or 0 for a pressure that is "
        "counted from that at rest");
  }
}

}  // namespace

Dimension value_dimension(Transported quantity) {
  return quantity == Transported::temperature     ? kTemperature
         : quantity == Transported::concentration ? kPlain
                                                  : kPressure;
}

TransportMaterial read_transport_constants(const Map& map, Transported quantity, std::size_t material, Scene& scene) {
  const MaterialDefinition& of = scene.definition.materials[material];
  TransportMaterial read;
  if (quantity == Transported::temperature) read_heat(map, of, scene, read);
  if (quantity == Transported::concentration) read_solute(map, scene, read);
  if (quantity == Transported::pore_pressure) read_pores(map, of, scene, read);
  return read;
}

void add_transport_keys(const Value& material, const Map& root, std::vector<std::string>& keys) {
  static const std::array<std::vector<std::string>, kQuantities> kKeys = {
      std::vector<std::string>{"heat_capacity", "conductivity", "thermal_expansion", "heat_fraction"},
      {"diffusivity", "saturation", "solvent_expansion"},
      {"biot", "storage", "permeability", "viscosity", "fluid_density"}};
  const auto section = root.find("transport");
  for (int q = 0; q < kQuantities; ++q) {
    if (section && section->is_map() && section->node()[kTransported[q].name].IsDefined()) {
      keys.insert(keys.end(), kKeys[q].begin(), kKeys[q].end());
      continue;
    }
    for (const std::string& key : kKeys[q]) {
      const bool of_law = std::find(keys.begin(), keys.end(), key) != keys.end();
      if (of_law || !material.is_map() || !material.node()[key].IsDefined()) continue;
      material.child(material.node()[key], key)
          .fail(
              fmt::format("it is a constant of {}, which the run does not carry; add transport: {{{}: {{}}}}, or leave "
                          "it out",
                          kTransported[q].name, kTransported[q].name));
    }
  }
}

}  // namespace mpm
