// Heat between deformable bodies that touch. Cost: 3 s.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm::test {
namespace transport_pairs_test {

Simulation run_of(const char* scene, std::vector<std::string> changes, double end) {
  Simulation run(parse_scene(scene, "transport.yaml", std::move(changes)), {1});
  while (static_cast<double>(run.time()) < 1e9 * end) run.advance();
  return run;
}

const char* const kPair = R"yaml(geometry: plane_strain
gravity: [0, -9.81]
grid: {cell: 0.05, min: [0, 0], max: [1, 1.2]}
time: {end: 1, sync: 0.01}
materials: [{name: m, law: neo_hookean, density: 1000, young: 1 MPa, poisson: 0.3, heat_capacity: 1000, conductivity: 1e5}]
bodies:
  - {name: low, material: m, shape: {box: {min: [0, 0], max: [1, 0.4]}}}
  - {name: top, material: m, shape: {box: {min: [0, 0.4], max: [1, 0.7]}}}
contact: {pairs: [{between: [low, top], friction: 0.3}]}
boundaries: {z_min: fixed, x_min: slip, x_max: slip}
method: {damping: {grid: 50}}
transport:
  temperature: {initial: {low: 300, top: 400}, compression_heat: "off", pairs: [{bodies: [low, top], conductance: 2000}]}
)yaml";

// Bodies that conduct so well that each has one temperature; their difference falls with (1/C_low + 1/C_top) h A. The
// area A is what contact says of itself, 3 % less than the 1 m^2 of the faces. Mean rate from 0.4 s to 0.6 s.
TEST(TransportPairs, ConductByTheirConductanceOnceTheyTouch) {
  double area = 0.0;
  const auto warmed = [&](std::vector<std::string> changes, double end) {
    Simulation run = run_of(kPair, std::move(changes), end);
    std::vector<double> temperature;
    run.particle_field("temperature_carried", temperature);
    area = run.take_pairs().front().area;
    const auto [first, last] = run.body_ids("low");
    double heat = 0.0;
    for (std::uint64_t p = first; p < last; ++p) heat += 1000.0 * 1000.0 * 0.025 * 0.025 * (temperature[p] - 300.0);
    return heat;
  };
  EXPECT_NEAR(warmed({"bodies.top.shape.box.min=[0, 0.6]", "bodies.top.shape.box.max=[1, 0.9]"}, 0.05), 0.0, 1e-6);
  // Contact bounces at first; from then on it holds all the time.
  const double rate = (warmed({}, 0.6) - warmed({}, 0.4)) / 0.2;
  EXPECT_NEAR(area, 1.0, 0.04);
  const double conducts = 2000.0 * area;
  const double expected = conducts * 100.0 * std::exp(-conducts * (1.0 / 4e5 + 1.0 / 3e5) * 0.5);
  EXPECT_NEAR(rate, expected, 0.01 * expected);
}

}  // namespace transport_pairs_test
}  // namespace mpm::test
