// The section `transport` of a scene, the constants of materials for it, and what both refuse.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm::test {
namespace scene_transport_test {

const char* const kScene = R"yaml(geometry: plane_strain
grid: {cell: 0.1, min: [0, 0], max: [1.6, 1.6]}
time: {end: 1, sync: 5 ms}
materials: [{name: wax, density: 900, law: linear_elastic, young: 1 MPa, poisson: 0.3}]
bodies: [{name: block, material: wax, shape: {box: {min: [0.2, 0.2], max: [1, 0.6]}}}]
)yaml";
const char* const kHeat = "transport={temperature: {}}";
const char* const kPores = "transport={pore_pressure: {}}";

/// Message of building the run of the scene with these changes; empty: nothing.
std::string fault_of(std::vector<std::string> changes) {
  try {
    Simulation run(parse_scene(kScene, "transport.yaml", changes), {1});
    run.advance();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void expect_fault(const std::vector<std::string>& changes, const std::string& part) {
  const std::string fault = fault_of(changes);
  EXPECT_NE(fault.find(part), std::string::npos) << "said: '" << fault << "'";
}

std::vector<std::string> heat(const std::vector<std::string>& more) {
  std::vector<std::string> changes = {kHeat, "materials.wax.heat_capacity=2000", "materials.wax.conductivity=0.2"};
  changes.insert(changes.end(), more.begin(), more.end());
  return changes;
}

std::vector<std::string> pores(const std::vector<std::string>& more) {
  std::vector<std::string> changes = {kPores, "materials.wax.storage=1e-9"};
  changes.insert(changes.end(), more.begin(), more.end());
  return changes;
}

TEST(SceneTransport, DefaultsAreThoseOfTheManual) {
  const Scene scene = parse_scene(kScene, "transport.yaml", heat({}));
  ASSERT_EQ(scene.definition.transport.quantities.size(), 1u);
  const QuantityDefinition& quantity = scene.definition.transport.quantities[0];
  EXPECT_EQ(quantity.quantity, Transported::temperature);
  EXPECT_EQ(quantity.reference, 293.0);
  EXPECT_EQ(quantity.method, RateMethod::nodal_capacity);
  EXPECT_EQ(quantity.order, 2);
  EXPECT_EQ(quantity.materials[0].capacity(300.0), 2000.0);
  EXPECT_EQ(quantity.materials[0].heat_fraction, 0.9);
  EXPECT_EQ(parse_scene(kScene, "transport.yaml", heat({"transport.temperature.initial=350"}))
                .definition.transport.quantities[0]
                .reference,
            350.0);
  EXPECT_EQ(fault_of(heat({})), "");
  EXPECT_EQ(fault_of(pores({"materials.wax.permeability=1e-12"})), "");
}

TEST(SceneTransport, ATableIsStraightBetweenItsPointsAndFlatBeyond) {
  const Scene scene =
      parse_scene(kScene, "transport.yaml", heat({"materials.wax.conductivity={table: [[300, 0.2], [400, 0.4]]}"}));
  const Property& conductivity = scene.definition.transport.quantities[0].materials[0].conductivity;
  EXPECT_EQ(conductivity(200.0), 0.2);
  EXPECT_NEAR(conductivity(325.0), 0.25, 1e-15);
  EXPECT_EQ(conductivity(500.0), 0.4);
  EXPECT_EQ(conductivity.most(), 0.4);
}

TEST(SceneTransport, RefusesConstantsThatNoMaterialHas) {
  expect_fault({kHeat}, "materials.wax: the key 'heat_capacity' is missing");
  expect_fault(heat({"materials.wax.heat_capacity=0"}), "materials.wax.heat_capacity");
  expect_fault(heat({"materials.wax.heat_capacity=-1"}), "materials.wax.heat_capacity");
  expect_fault(heat({"materials.wax.conductivity=-1"}), "materials.wax.conductivity");
  expect_fault(heat({"materials.wax.conductivity=[1, 1, 1, 0, 2, 0]"}), "positive in every direction");
  expect_fault(heat({"materials.wax.conductivity={table: [[400, 1], [300, 1]]}"}), "have to rise");
  expect_fault(heat({"materials.wax.heat_fraction=1.1"}), "heat_fraction");
  expect_fault(pores({"materials.wax.biot=1.2"}), "materials.wax.biot: Biot's coefficient is 1 at most");
  expect_fault({kPores}, "storage");
  expect_fault(pores({"materials.wax.storage=0"}), "materials.wax.storage");
  expect_fault(
      {"materials=[{name: wax, density: 1, law: ideal_gas, pressure: 1e5, temperature: 293, storage: 1e-9}]", kPores},
      "ideal_gas has no pores");
  expect_fault(pores({"materials.wax.biot=[0.9, 0.9, 0.9, 0, 0, 0.5]"}), "Biot's coefficient is 1 at most");
  expect_fault({"materials.wax.conductivity=1"}, "materials.wax.conductivity: it is a constant of temperature");
  expect_fault({"materials.wax.biot=1"}, "add transport: {pore_pressure");
}

TEST(SceneTransport, RefusesConditionsThatCannotHold) {
  expect_fault({"transport={}"}, "names no quantity");
  expect_fault({"transport={heat: {}}"}, "temperature");
  expect_fault(heat({"transport.temperature.initial={}"}), "names no body");
  expect_fault(pores({"geometry=plane_stress"}), "plane stress");
  expect_fault(pores({"boundaries={z_min: absorbing}"}),
               "absorbing faces (z_min) and water in pores do not go together");
  expect_fault(pores({"gravity=[0, -9.81]", "bodies.block.initial=geostatic", "materials.wax.fluid_density=1000",
                      "transport.pore_pressure.initial={hydrostatic: {water_table: 2}}"}),
               "more than the weight above");
  expect_fault(heat({"transport.temperature.initial=-3"}), "below the absolute zero");
  expect_fault(heat({"transport.temperature.values=[{region: {box: {min: [0, 0], max: [1, 1]}}, value: -1}]"}),
               "below the absolute zero");
  const std::string flux = "transport.temperature.fluxes=[{body: block, edge: ";
  EXPECT_EQ(fault_of(heat({flux + "z_max, flux: 100}]"})), "");
  expect_fault(heat({flux + "z_max, flux: 100, region: {box: {min: [0.2, 0.2], max: [1, 0.4]}}}]"}), "is inside body");
  expect_fault(heat({flux + "y_max, flux: 100}]"}), "y_max");
  expect_fault(heat({flux + "z_max}]"}), "write one of flux");
  expect_fault(heat({flux + "z_max, radiation: {emissivity: 2, ambient: 300}}]"}), "emissivity is 1 at most");
  expect_fault(
      heat({"transport.temperature.values=[{name: hot, region: {box: {min: [0, 0], max: [0.5, 1]}}, value: 400}, "
            "{name: cold, region: {box: {min: [0.4, 0], max: [1, 1]}}, value: 300}]"}),
      "'hot' and 'cold' disagree");
  expect_fault(pores({"gravity=[0, -9.81]", "materials.wax.permeability=1e-12"}), "add fluid_density");
  expect_fault(heat({"sleep={speed: 1 mm/s}", "gravity=[0, -9.81]"}), "sleep");
  expect_fault(heat({"transport.temperature.tools=[{body: iron, conductance: 1, temperature: 400}]"}), "no rigid body");
  expect_fault(heat({"transport.temperature.method=particle_capacity", "transport.temperature.order=2"}), "order 1");
  expect_fault(heat({"transport.temperature.pairs=[{bodies: [block, block], conductance: 1}]"}), "share one velocity");
}

TEST(SceneTransport, ATemperatureOutOfItsRangeEndsTheRun) {
  expect_fault(heat({"transport.temperature.sources=[{body: block, rate: -1e12}]"}), "below the absolute zero");
  expect_fault(heat({"transport.temperature.sources=[{body: block, rate: \"1/(t-0.0025)*0\"}]"}), "source on 'block'");
}

}  // namespace scene_transport_test
}  // namespace mpm::test
