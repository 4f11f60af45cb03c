// Periodic axes in simulations whose steps a device takes, as on the processor. Cost: 1 s.
#include <gtest/gtest.h>

#include "gpu_runs.hpp"
#include "gpu_scenes.hpp"

namespace gpu_periodic_test {

using namespace gpu_runs;
using mpm::Vec3;

constexpr double kPi = 3.14159265358979323846;

SimulationDefinition around_x(SimulationDefinition d, int cells) {
  d.grid.max.x() = cells * d.grid.cell.x();
  d.walls[0].kind = d.walls[1].kind = mpm::WallKind::periodic;
  d.gravity = {3.0, 0.0, -9.0};  // downhill along the periodic axis
  return d;
}
/// A solid block flies through the face and falls on the floor behind it.
SimulationDefinition flying_block(mpm::Precision precision) {
  SimulationDefinition d = around_x(gpu_scenes::falling_block(precision), 16);
  d.bodies.front() = gpu_scenes::block(d, "block", {12.0, 3.0, 0.1}, {15.9, 7.0, 4.1}, {6.0, 0.3, -2.0});
  return d;
}
/// A layer of sand fills two blocks of nodes from face to face and flows down a floor with strain in halves.
SimulationDefinition flowing_layer(mpm::Precision precision) {
  SimulationDefinition d = around_x(gpu_scenes::column_usavg(precision), 8);
  d.bodies.front() = gpu_scenes::block(d, "sand", {0.0, 0.0, 0.0}, {8.0, 0.0, 6.0}, {8.0, 0.0, 0.0});
  for (std::size_t p = 0; p < d.bodies.front().velocities.size(); ++p) {
    d.bodies.front().velocities[p].x() *= d.bodies.front().positions[p].z();
  }
  return d;
}
SimulationDefinition flowing_with_mean_stresses(mpm::Precision precision) {
  SimulationDefinition d = flowing_layer(precision);
  d.method.average_stress = true;
  return d;
}
SimulationDefinition flowing_with_cubic_splines(mpm::Precision precision) {
  SimulationDefinition d = flowing_layer(precision);
  d.method.shape = mpm::ShapeKind::bspline3;
  d.method.transfer = {mpm::TransferKind::apic, 0.0, 1};
  return d;
}

/// Largest distance of particles along x, on a circle of the domain's length [m].
double distance_around(const Simulation& a, const Simulation& b, double length) {
  const std::vector<double> one = field(a, "x"), other = field(b, "x");
  double most = 0.0;
  for (std::size_t p = 0; p < one.size(); ++p) {
    most = std::max(most, std::abs(std::remainder(one[p] - other[p], length)));
  }
  return most;
}

void expect_around_alike(SimulationDefinition (*of)(mpm::Precision)) {
  const SimulationDefinition d = scene(of);
  const double length = d.grid.max.x();
  Simulation here(d, options(false)), there(d, options(true));
  for (Simulation* one : {&here, &there}) {
    one->keep_start();
    advance(*one, kPeriods);
  }
  expect_sums_alike(here, there);
  EXPECT_LT(distance_around(here, there, length), kRoundOff);
  for (const char* name : {"z", "vx", "vz", "j", "szz", "ux"})
    EXPECT_LT(difference(here, there, name), kRoundOff) << name;
  EXPECT_GT(there.state().energy.of("around"), 0.0);  // some have gone around
  there.state_hash();                                 // reading changes nothing
  for (Simulation* one : {&here, &there}) advance(*one, 2);
  EXPECT_LT(difference(here, there, "ux"), kRoundOff);
}

TEST(GpuPeriodic, BlockGoesAround) { expect_around_alike(flying_block); }
TEST(GpuPeriodic, LayerGoesAround) { expect_around_alike(flowing_layer); }
TEST(GpuPeriodic, LayerGoesAroundWithMeanStresses) { expect_around_alike(flowing_with_mean_stresses); }
TEST(GpuPeriodic, LayerGoesAroundWithCubicSplines) { expect_around_alike(flowing_with_cubic_splines); }

// A run that goes on from a checkpoint ends with the same bits, also of displacements of what has gone around.
TEST(GpuPeriodic, ResumesToTheBit) {
  expect_resumes(
      scene(flying_block), [](Simulation& run) { run.keep_start(); },
      [](Simulation& whole, Simulation& second) { EXPECT_EQ(field(whole, "ux"), field(second, "ux")); });
}
}  // namespace gpu_periodic_test
