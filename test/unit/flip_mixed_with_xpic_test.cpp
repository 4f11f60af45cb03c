// FLIP mixed with XPIC: what waves lose in a step against the exact loss, at mirrors and across a periodic axis too;
// momentum, energy and bits for any number of threads. 0.5 s.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "mpm/math/constants.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace flip_mixed_with_xpic_test {

constexpr int kCells = 8;
constexpr double kCell = 1.0 / kCells;

struct Wave {
  const char* boundaries;
  std::string x, z;  ///< velocity [m/s]
  /// Half waves along each axis of the square of 1 m, which it fills.
  int along_x, along_z;
};

/// A square of dust, too soft for waves of stress, that moves by transfers alone.
Simulation dust(const Wave& wave, const std::string& method, int threads = 1) {
  const Scene scene = parse_scene(
      "geometry: plane_strain\ngrid: {cell: 0.125, min: [0, 0], max: [1, 1]}\ntime: {end: 1, sync: 1 ms, step: 1 ms}\n"
      "materials: [{name: dust, density: 1000, law: linear_elastic, young: 1e-9, poisson: 0}]\n"
      "bodies: [{name: dust, material: dust, initial: {velocity: ['" +
          wave.x + "', '" + wave.z +
          "']}, shape: {box: {min: [0, 0], max: [1, 1]}}}]\n"
          "method: " +
          method + "\nboundaries: " + wave.boundaries + "\n",
      "dust.yaml", {});
  return Simulation(build(scene), {threads});
}

std::vector<double> field(Simulation& simulation, const char* name) {
  std::vector<double> values;
  simulation.particle_field(name, values);
  return values;
}

/// The factor by which a step multiplies the velocities once they are those of a wave on the grid, of which a pure PIC
/// leaves nothing else.
double factor_of_step(const Wave& wave, const std::string& method) {
  Simulation simulation = dust(wave, method);
  simulation.advance();
  simulation.advance();
  const char* name = wave.x == "0" ? "vz" : "vx";
  const std::vector<double> before = field(simulation, name);
  simulation.advance();
  const std::vector<double> after = field(simulation, name);
  double sum = 0.0, squares = 0.0, rest = 0.0;
  for (std::size_t p = 0; p < after.size(); ++p) {
    sum += before[p] * after[p];
    squares += before[p] * before[p];
  }
  for (std::size_t p = 0; p < after.size(); ++p) rest += std::pow(after[p] - sum / squares * before[p], 2);
  EXPECT_LT(std::sqrt(rest / squares), 1e-6);  // one wave, everywhere
  return sum / squares;
}

const char* const kSlip = "{x_min: slip, x_max: slip, z_min: slip, z_max: slip}";
const Wave kWaves[] = {
    {"{x_min: slip, x_max: slip, z: periodic}", "0", "1e-6*cos(3.14159265358979*2*x)", 2, 0},  // along mirrors
    {kSlip, "1e-6*sin(3.14159265358979*3*x)", "0", 3, 0},                                      // across them
    {"{x: periodic, z: periodic}", "0", "1e-6*sin(3.14159265358979*2*x)", 2, 0},
    {kSlip, "1e-6*sin(3.14159265358979*2*x)*cos(3.14159265358979*2*z)", "0", 2, 2},  // oblique
};

// Two particles along an edge of a cell, at rest: S+ S multiplies the wave by G = (1 - c l_x)(1 - c l_z), with c = 3/16
// of the linear shapes and l = 2 (1 - cos k h). PIC leaves that, XPIC(m) leaves 1 - (1 - G)^m.
TEST(FlipMixedWithXpic, LosesOfWavesWhatXpicDoes) {
  for (const Wave& wave : kWaves) {
    SCOPED_TRACE(wave.x + ", " + wave.z);
    const auto smoothed = [](int half_waves) { return 3.0 / 16.0 * 2.0 * (1.0 - std::cos(kPi * half_waves * kCell)); };
    const double once = (1.0 - smoothed(wave.along_x)) * (1.0 - smoothed(wave.along_z));
    for (const char* shape : {"ugimp", "cpdi", "dirac"}) {
      for (const int order : {1, 2, 3}) {
        const std::string method = fmt::format("{{shape: {}, transfer: {{flip: 0, xpic: {}}}}}", shape, order);
        EXPECT_NEAR(factor_of_step(wave, method), 1.0 - std::pow(1.0 - once, order), 1e-6) << method;
      }
    }
  }
}

constexpr char kBlobs[] =
    "geometry: plane_strain\ngrid: {cell: 0.1, min: [-1, -1], max: [3, 2]}\ntime: {end: 1, sync: 5 ms}\n"
    "materials: [{name: rubber, density: 1000, law: neo_hookean, young: 1e5, poisson: 0.3}]\n"
    "bodies:\n"
    "  - {name: left, material: rubber, initial: {velocity: [1, '1.5*(x-0.5)']}, shape: {sphere: {center: [0.5, 0.5], "
    "radius: 0.27}}}\n"
    "  - {name: right, material: rubber, initial: {velocity: [-1, 'x-1.2']}, shape: {sphere: {center: [1.23, "
    "0.45], "
    "radius: 0.33}}}\n";

// Two blobs that meet and part: their momentum stays, and what the transfer takes, less what order 2 gives back, closes
// the balance of energy.
TEST(FlipMixedWithXpic, KeepsMomentumAndCountsItsEnergy) {
  struct Outcome {
    double momentum = 0.0, energy = 0.0, transfer = 0.0;
    std::uint64_t hash = 0;
  };
  const auto run = [](const std::string& transfer, int threads) {
    Simulation simulation(build(parse_scene(kBlobs + ("method: {transfer: " + transfer + "}\n"), "blobs.yaml", {})),
                          {threads});
    const double before = simulation.state().energy.balance();
    while (simulation.time() < 500'000'000) simulation.advance();
    const SolverState after = simulation.state();
    return Outcome{(after.audit.momentum - after.audit.initial_momentum).norm(), after.energy.balance() - before,
                   after.energy.of("transfer"), simulation.state_hash()};
  };
  const Outcome first = run("{flip: 0.99}", 1), second = run("{flip: 0.99, xpic: 2}", 1);
  const Outcome three = run("{flip: 0.99, xpic: 2}", 3);
  EXPECT_LT(second.momentum, 1e-10);
  EXPECT_GT(second.transfer, 0.0);
  EXPECT_LT(second.transfer, first.transfer);
  EXPECT_LT(std::abs(second.energy), 0.02 * first.transfer);
  EXPECT_EQ(three.hash, second.hash);
}

// With `every: 3` the first two steps are FLIP's to the bit, and the third is not.
TEST(FlipMixedWithXpic, ActsInOneOfSoManySteps) {
  const auto start = [](const std::string& transfer) { return dust(kWaves[1], "{transfer: " + transfer + "}"); };
  Simulation mixed = start("{flip: 0.6, xpic: 2, every: 3}"), flip = start("flip");
  for (int step = 1; step <= 3; ++step) {
    mixed.advance();
    flip.advance();
    EXPECT_EQ(field(mixed, "vx") == field(flip, "vx"), step < 3) << step;
  }
}

// The text that a run records reads as the same transfer.
TEST(FlipMixedWithXpic, IsRecordedAsItWasRead) {
  const Scene scene = parse_scene(
      kBlobs + std::string("method: {auto: {}, transfer: {flip: 0.6, xpic: 2, every: 5}}\n"), "blobs.yaml", {});
  const Transfer again = parse_scene(scene.text, "again.yaml", {}).definition.method.transfer;
  EXPECT_EQ(again.flip, 0.6);
  EXPECT_EQ(again.mixed, 2);
  EXPECT_EQ(again.every, 5);
}

}  // namespace flip_mixed_with_xpic_test
}  // namespace mpm
