// A blade digs a ditch and lifts out: what is missing below the old surface is heaped above it, by masses in volumes
// and by maps of the ground. 1 s.
#include <gtest/gtest.h>

#include <algorithm>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm/terrain/ground_map.hpp"

namespace mpm {
namespace ditch_balance_test {

constexpr double kSurface = 0.32;  ///< surface of the bed before [m]

const char* const kDitch = R"yaml(
geometry: plane_strain
grid: {cell: 0.04, min: [0, 0], max: [2, 0.8]}
time: {end: 1.6, sync: 0.01}
gravity: [0, -9.81]
materials:
  - {name: sand, law: drucker_prager, density: 1600, young: 0.5 MPa, poisson: 0.3, friction_angle: 32 deg,
     dilation_angle: 0, cohesion: 200}
bodies:
  - {name: soil, material: sand, shape: {box: {min: [0, 0], max: [2, 0.32]}}, initial: geostatic}
rigid_bodies:
  - {name: blade, friction: 0.3, sides: one, shape: {box: {size: [0.12, 0.4]}}, pose: {position: [0.6, 0.54]},
     motion: {velocity: ["t < 0.4 ? 0 : (t < 1.2 ? 0.6 : 0)", "t < 0.4 ? -0.4 : (t < 1.2 ? 0 : 1)"]}}
boundaries: {x_min: slip, x_max: slip, z_min: fixed}
volumes:
  - {name: below, shape: {box: {size: [4, 0.32]}}, pose: {position: [1, 0.16]}}
  - {name: above, shape: {box: {size: [4, 0.48]}}, pose: {position: [1, 0.56]}}
metrics: {volume: {sum: volume}}
)yaml";

TEST(DitchBalance, WhatIsDugIsHeaped) {
  Simulation simulation(parse_scene(kDitch, "ditch.yaml"));
  const double before = simulation.metrics().front().second;
  while (simulation.time() < nanoseconds_of(1.6)) simulation.advance();
  const std::vector<VolumeReport> volumes = simulation.volumes();
  const VolumeReport &below = volumes.at(0), &above = volumes.at(1);
  const double dug = below.mass_out - below.mass_in;
  EXPECT_GT(dug, 80.0);  // a twelfth of the bed's 1024 kg: there is a ditch
  // A particle is in one of them, so what leaves one enters the other: round-off of a thousand masses.
  EXPECT_NEAR(above.mass, dug, 1e-9);
  EXPECT_NEAR(above.mass_in - above.mass_out, dug, 1e-9);
  EXPECT_NEAR(below.mass + above.mass, 1024.0, 1e-9);

  const GridDefinition& grid = simulation.definition().grid;
  GroundMap map(simulation, "");
  const HeightGrid& ground =
      map.read(simulation, ground_raster(grid, GeometryKind::plane_strain, ground_resolution(grid)));
  double heap = 0.0, ditch = 0.0;  // [m^3], 1 m deep
  for (int i = 0; i < ground.columns; ++i) {
    const double width = i == 0 || i + 1 == ground.columns ? 0.02 : 0.04, rise = ground.heights[i] - kSurface;
    heap += width * std::max(rise, 0.0);
    ditch += width * std::max(-rise, 0.0);
  }
  // The law has no dilation, but particles that part from each other swell a little.
  const double swollen = simulation.metrics().front().second - before;
  EXPECT_LT(swollen, 0.1 * ditch);
  EXPECT_NEAR((heap - swollen) / ditch, 1.0, 0.01);  // asked for; 0.006 were found
}

}  // namespace ditch_balance_test
}  // namespace mpm
