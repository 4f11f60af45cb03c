// Transport in parts: the stages that take a step longer than is stable, and the heat of surfaces, whose account is
// that of contact.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "mpm/math/constants.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm/transport/stages.hpp"

namespace mpm::test {
namespace transport_test {

// --- stages ---------------------------------------------------------------------------------------------------------

constexpr int kNodes = 64;

/// A ring of nodes of capacity 1, whose flow is the second difference: c dT/dt = T(i-1) - 2 T(i) + T(i+1). A wave of q
/// radians a node decays with 2 - 2 cos(q) [1/s]; one explicit step is stable up to 1/2 s.
double decay_of_wave(int waves, double dt, int steps, int stages) {
  const double q = 2.0 * kPi * waves / kNodes;
  NodalField start(1, kNodes), capacity(1, kNodes), content(1, kNodes);
  for (NodalField* field : {&start, &capacity, &content}) field->resize(1);
  for (int i = 0; i < kNodes; ++i) {
    start.at(0, 0, i) = std::cos(q * i);
    capacity.at(0, 0, i) = 1.0;
  }
  const auto flow = [](const NodalField& value, NodalField& to) {
    to.resize(1);
    for (int i = 0; i < kNodes; ++i) {
      to.at(0, 0, i) =
          value.at(0, 0, (i + kNodes - 1) % kNodes) - 2.0 * value.at(0, 0, i) + value.at(0, 0, (i + 1) % kNodes);
    }
  };
  Stages method(kNodes);
  for (int n = 0; n < steps; ++n) {
    method.advance(
        1, 1, dt, stages, start, capacity, 0.0, flow, [](NodalField&, double) {}, content);
    for (int i = 0; i < kNodes; ++i) start.at(0, 0, i) += content.at(0, 0, i);
  }
  return start.at(0, 0, 0);
}

TEST(TransportStages, AreAsManyAsTheStepNeeds) {
  EXPECT_EQ(stages_for(0.25), 1);
  EXPECT_EQ(stages_for(1.0), 3);
  EXPECT_EQ(stages_for(2.5), 3);  // (9 + 3 - 2) / 4
  EXPECT_EQ(stages_for(2.6), 5);
  EXPECT_EQ(stages_for(7.0), 5);  // (25 + 5 - 2) / 4
  EXPECT_EQ(stages_for(22.0), 9);
}

// Stable at the length that the source states, for the shortest wave, and of second order for a long one.
TEST(TransportStages, AreStableAndOfSecondOrder) {
  for (const int stages : {3, 5, 9, 15}) {
    const double longest = 0.5 * (stages * stages + stages - 2) / 4.0;
    EXPECT_LT(std::abs(decay_of_wave(kNodes / 2, longest, 20, stages)), 1.0) << stages;
    EXPECT_GT(std::abs(decay_of_wave(kNodes / 2, 1.2 * longest, 20, stages)), 1.0) << stages;
  }
  const double rate = 2.0 - 2.0 * std::cos(2.0 * kPi * 6 / kNodes), time = 4.0;
  double before = 0.0;
  for (const int steps : {4, 8, 16}) {
    const double error = std::abs(decay_of_wave(6, time / steps, steps, 5) - std::exp(-rate * time));
    if (before > 0.0) {
      EXPECT_NEAR(std::log2(before / error), 2.0, 0.15);
    }
    before = error;
  }
}

double number_of(const Simulation& run, const std::string& name) {
  const SolverState state = run.state();
  for (const NamedNumber& number : state.numbers) {
    if (number.name == name) return number.value;
  }
  ADD_FAILURE() << "no number '" << name << "'";
  return 0.0;
}

// --- particles of several materials ---------------------------------------------------------------------------------

// Sets bring different numbers of their own (sand remembers more than steel, and has plastic heat), before and after
// those of transport; each quantity finds its own in every set, and heat of friction arrives where nothing conducts.
TEST(TransportSets, KeepTheirNumbersApart) {
  const char* const kTwo = R"yaml(geometry: plane_strain
gravity: [0, -9.81]
grid: {cell: 0.05, min: [0, 0], max: [1, 0.8]}
time: {end: 1, sync: 0.01}
materials:
  - {name: sand, law: drucker_prager, density: 1600, young: 1 MPa, poisson: 0.3, friction_angle: 30 deg, heat_capacity: 800,
     diffusivity: 0}
  - {name: steel, law: linear_elastic, density: 3000, young: 5 MPa, poisson: 0.3, heat_capacity: 450,
     thermal_expansion: 1e-5, diffusivity: 0}
bodies:
  - {name: bed, material: sand, shape: {box: {min: [0, 0], max: [1, 0.2]}}}
  - {name: block, material: steel, shape: {box: {min: [0.3, 0.2], max: [0.7, 0.4]}}, initial: {velocity: [0.5, 0]}}
boundaries: {x_min: slip, x_max: slip, z_min: {friction: 0.5}}
transport: {temperature: {initial: {bed: 280, block: 400}}, concentration: {initial: {bed: 0.25, block: 0.75}}}
)yaml";
  for (const bool turned : {false, true}) {
    Scene scene = parse_scene(kTwo, "two.yaml", {});
    if (turned) std::swap(scene.bodies[0], scene.bodies[1]);
    Simulation run(scene, {1});
    for (int n = 0; n < 5; ++n) run.advance();
    const auto range = [&](const std::string& field, const std::string& body) {
      std::vector<double> values;
      run.particle_field(field, values);
      const auto [first, last] = run.body_ids(body);
      const auto pair = std::minmax_element(values.begin() + first, values.begin() + last);
      return std::pair<double, double>(*pair.first, *pair.second);
    };
    EXPECT_NEAR(range("concentration", "bed").first, 0.25, 1e-12);
    EXPECT_NEAR(range("concentration", "block").second, 0.75, 1e-12);
    EXPECT_NEAR(range("temperature_carried", "bed").first, 280.0, 0.1);
    EXPECT_NEAR(range("temperature_carried", "block").second, 400.0, 0.1);
    for (const char* quantity : {"temperature", "concentration"}) {
      EXPECT_LT(number_of(run, std::string(quantity) + " budget error"), 1e-10) << quantity;
    }
    const double friction = run.state().energy.of("wall_friction");
    EXPECT_GT(friction, 0.0);
    const double heat = number_of(run, "temperature by friction") + number_of(run, "heat of friction in the next step");
    EXPECT_NEAR(heat, friction, 1e-10 * friction);
  }
}

// --- heat of surfaces -----------------------------------------------------------------------------------------------

Simulation run_of(const char* scene, std::vector<std::string> changes, double end) {
  Simulation run(parse_scene(scene, "transport.yaml", std::move(changes)), {1});
  while (static_cast<double>(run.time()) < 1e9 * end) run.advance();
  return run;
}

const char* const kSliding = R"yaml(geometry: plane_strain
gravity: [0, -9.81]
grid: {cell: 0.05, min: [0, 0], max: [2, 0.8]}
time: {end: 1, sync: 0.01}
materials: [{name: m, law: neo_hookean, density: 1000, young: 1 MPa, poisson: 0.3, heat_capacity: 1000, conductivity: 20}]
bodies: [{name: block, material: m, shape: {box: {min: [0.2, 0], max: [0.8, 0.3]}}, initial: {velocity: [1, 0]}}]
boundaries: {z_min: {friction: 0.3}}
transport: {temperature: {initial: 300, compression_heat: "off"}}
)yaml";

// Each account is summed where it arises: friction by the wall at its nodes, heat by the particles.
TEST(TransportFriction, HeatsByExactlyWhatItTakes) {
  for (const char* update : {"usf", "usl", "usavg"}) {
    const Simulation run = run_of(kSliding, {std::string("method.update=") + update}, 0.1);
    const double taken = run.state().energy.of("wall_friction");
    EXPECT_GT(taken, 10.0) << update;
    const double heat = number_of(run, "temperature content") + number_of(run, "heat of friction in the next step");
    EXPECT_NEAR(heat, taken, 1e-10 * taken) << update;
    EXPECT_LT(number_of(run, "temperature budget error"), 1e-10) << update;
  }
}

const char* const kTool = R"yaml(geometry: plane_strain
grid: {cell: 0.05, min: [0, 0], max: [2, 1.2]}
time: {end: 1, sync: 0.01}
materials: [{name: m, law: neo_hookean, density: 1000, young: 1 MPa, poisson: 0.3, heat_capacity: 1000, conductivity: 20}]
bodies: [{name: block, material: m, shape: {box: {min: [0.2, 0], max: [1.8, 0.4]}}}]
rigid_bodies:
  - {name: iron, shape: {sphere: {radius: 0.2}}, pose: {position: [1, 0.62]}, motion: {velocity: ["0.5", -0.3]}}
contact: {friction: 0.4}
boundaries: {z_min: fixed, x_min: slip, x_max: slip}
transport:
  temperature:
    initial: 300
    compression_heat: "off"
    tools: [{body: iron, conductance: 5000, temperature: 500, heat_capacity: 50, friction_part: 0.25}]
)yaml";

// Nothing before they touch; then what leaves the tool is in the material, and friction is shared as asked.
TEST(TransportTools, ConductWhereTheyTouchAndKeepWhatIsTheirs) {
  const Simulation apart = run_of(kTool, {}, 0.05);
  EXPECT_NEAR(number_of(apart, "temperature content"), 0.0, 1e-20);  // round-off
  const Simulation run = run_of(kTool, {"method.update=usf"}, 0.2);
  const double friction = run.state().energy.of("friction");
  EXPECT_GT(friction, 1.0);
  EXPECT_NEAR(number_of(run, "temperature by friction"), 0.25 * friction, 1e-10 * friction);
  const double conducted = number_of(run, "heat from iron");
  EXPECT_GT(conducted, 100.0);
  EXPECT_NEAR(number_of(run, "temperature content"), conducted + 0.25 * friction, 1e-10 * conducted);
  EXPECT_NEAR(50.0 * (number_of(run, "temperature of iron") - 500.0), 0.75 * friction - conducted, 1e-9 * conducted);
}

}  // namespace transport_test
}  // namespace mpm::test
