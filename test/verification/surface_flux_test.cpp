// Content that faces take: a given flux, a sudden temperature, convection, radiation; and sources inside. A slab along
// a line.
//
// Exact: flux q into a half space raises its surface by 2 q sqrt(D t / pi) / k, and at depth x by that times
// sqrt(pi) ierfc(x / (2 sqrt(D t))); a sudden step of its surface spreads as erfc(x / (2 sqrt(D t))). Source:
// exact-solutions 20; H. S. Carslaw, J. C. Jaeger (1959), Conduction of Heat in Solids, 2.9, 2.5. The rest is at its
// test. Cost: 3 s.
#include <fmt/core.h>

#include "mpm/math/constants.hpp"
#include "page.hpp"
#include "transport_run.hpp"

namespace verification {
namespace surface_flux_test {

using mpm::kPi;
constexpr double kLength = 0.1, kConductivity = 100.0, kCapacity = 1e6, kDiffusivity = 1e-4;  // numbers of heated_slab
constexpr double kStefanBoltzmann = 5.670374419e-8;  // [W/(m^2 K^4)], CODATA 2018

mpm::Simulation heated(const std::vector<std::string>& overrides) { return start("heated_slab", overrides, 1); }

/// Temperature of the node at x = 0: temperatures are linear over the first cell, which has two particles.
double at_face(const mpm::Simulation& simulation) {
  const Numbers t = field(simulation, "temperature");
  return 1.5 * t[0] - 0.5 * t[1];
}

TEST(SurfaceFlux, IntoAHalfSpace) {
  Page page("transport", "half_space", "A half space that is heated");
  page.problem(
          "A slab 20 cells thick, whose far side feels nothing yet: at 300 K it takes 10 kW/m² through its face; or "
          "its "
          "face jumps to 310 K. After 4 s, when sqrt(D t) is 4 cells.")
      .exact("Flux: the surface rises by 2q√(Dt/π)/k. Step: erfc(x/(2√(Dt))).",
             "Carslaw and Jaeger, Conduction of Heat in Solids (1959), sections 2.9 and 2.5")
      .scene("heated_slab");
  const double q = 1e4, t = 4.0, depth = 2.0 * std::sqrt(kDiffusivity * t);
  const double rise = 2.0 * q * std::sqrt(kDiffusivity * t / kPi) / kConductivity;
  Numbers mm, flux_line, step_line;
  for (int i = 0; i <= 100; ++i) {
    const double x = kLength * i / 100, s = x / depth;
    mm.push_back(1e3 * x);
    flux_line.push_back(rise * std::exp(-s * s) - q * x / kConductivity * std::erfc(s));
    step_line.push_back(10.0 * std::erfc(s));
  }
  Panel& panel = page.figure().panel("Rise after 4 s, CPDI", "depth [mm]", "rise [K]");
  panel.exact("exact", mm, flux_line).exact("", mm, step_line);
  for (const std::string shape : {"ugimp", "cpdi"}) {
    mpm::Simulation simulation =
        heated({"method.shape=" + shape, "transport.temperature.fluxes=[{body: slab, edge: x_min, flux: 10000}]"});
    run_until(simulation, t);
    expect_balance(simulation, "temperature");
    EXPECT_NEAR(reported(simulation, "temperature by flux_0"), q * t, 1e-10 * q * t);  // [J], over 1 m^2
    const Numbers x = field(simulation, "x");
    Numbers seen = field(simulation, "temperature"), at;
    const Misfit all = misfit(seen, [&](std::size_t p) {
      const double s = x[p] / depth;
      return 300.0 + rise * std::exp(-s * s) - q * x[p] / kConductivity * std::erfc(s);
    });
    // Nodes a cell apart lag behind by cell^2 / (16 D t), 0.4 %: from the transform of the difference equation.
    page.near("flux: rise of the surface, " + shape, at_face(simulation) - 300.0, rise, 0.005, "K");
    page.near_absolute("flux: root mean square error, " + shape, 100.0 * all.rms / rise, 0.0, 0.5, "% of the rise");
    mpm::Simulation step = heated(
        {"method.shape=" + shape, "transport.temperature.values=[{region: {box: {min: -0.02, max: 0}}, value: 310}]"});
    run_until(step, t);
    expect_balance(step, "temperature");
    Numbers spread = field(step, "temperature");
    const Misfit of = misfit(spread, [&](std::size_t p) { return 300.0 + 10.0 * std::erfc(x[p] / depth); });
    page.near_absolute("step: root mean square error, " + shape, 10.0 * of.rms, 0.0, 0.5, "% of the step");
    page.report("step: largest error, " + shape, 10.0 * of.most, "% of the step");
    if (shape == "ugimp") continue;
    for (std::size_t p = 0; p < x.size(); ++p) at.push_back(1e3 * x[p]), seen[p] -= 300.0, spread[p] -= 300.0;
    panel.points("flux", at, seen).points("step", at, spread);
  }
  page.meaning("A flux through the faces of the outermost particles is all that it is said to be.");
}

// Convection at both faces of a slab 2 l thick that starts 1 above its surroundings: with Bi = h l / k,
// T = sum C exp(-z^2 F) cos(z x / l), z tan z = Bi, C = 4 sin z / (2 z + sin 2 z), F = D t / l^2. Source: Carslaw and
// Jaeger (1959), 3.11. Bi = 1 here: inside and outside resist alike.
TEST(SurfaceFlux, Convection) {
  Page page("transport", "convection", "A slab in a stream of air");
  page.problem(
          "A slab at 400 K between streams at 300 K that take h = k/l from each face, l half of its thickness; 20 "
          "cells, until D t / l² = 0.4.")
      .exact("T = Σ C exp(-z²F) cos(zx/l), z tan z = hl/k, C = 4 sin z/(2z + sin 2z).",
             "Carslaw and Jaeger (1959), section 3.11")
      .scene("heated_slab");
  const double l = 0.5 * kLength, time = 0.4 * l * l / kDiffusivity;
  const auto series = [&](double x) {
    double sum = 0.0;
    for (int n = 0; n < 30; ++n) {
      double low = n * kPi, high = (n + 0.5) * kPi;
      for (int k = 0; k < 60; ++k) {
        const double z = 0.5 * (low + high);
        (z * std::sin(z) < std::cos(z)) == (n % 2 == 0) ? low = z : high = z;
      }
      const double z = low;
      sum += 4.0 * std::sin(z) / (2.0 * z + std::sin(2.0 * z)) * std::exp(-z * z * 0.4) * std::cos(z * x / l);
    }
    return sum;
  };
  // First root and factor of Bi = 1: 0.8603 and 1.1191 (F. P. Incropera et al., Fundamentals of Heat and Mass Transfer,
  // table 5.1); one term is enough at F = 0.4, to 0.1 %.
  EXPECT_NEAR(series(0.0), 1.1191 * std::exp(-0.8603 * 0.8603 * 0.4), 0.002);
  for (const std::string shape : {"ugimp", "cpdi"}) {
    mpm::Simulation simulation = heated(
        {"method.shape=" + shape, "transport.temperature.initial=400",
         "transport.temperature.fluxes=[{body: slab, edge: x_min, convection: {coefficient: 2000, ambient: 300}},"
         " {body: slab, edge: x_max, convection: {coefficient: 2000, ambient: 300}}]"});
    run_until(simulation, time);
    expect_balance(simulation, "temperature");
    const Numbers x = field(simulation, "x"), t = field(simulation, "temperature");
    const Misfit all = misfit(t, [&](std::size_t p) { return 300.0 + 100.0 * series(x[p] - l); });
    page.near("surface above the surroundings, " + shape, at_face(simulation) - 300.0, 100.0 * series(l), 0.005, "K");
    page.near_absolute("root mean square error, " + shape, all.rms, 0.0, 0.5, "% of the start");
    if (shape == "ugimp") continue;
    Numbers mm, line, at;
    for (int i = 0; i <= 50; ++i) mm.push_back(2.0 * i), line.push_back(300.0 + 100.0 * series(1e-3 * mm.back() - l));
    for (const double one : x) at.push_back(1e3 * one);
    page.figure()
        .panel("Slab at F = 0.4, CPDI", "x [mm]", "T [K]")
        .exact("series", mm, line)
        .points("particles", at, t);
  }
  page.meaning("Convection takes the temperature of the nodes at the face, at the start of each update.");
}

// A slab that conducts so well that it is at one temperature radiates to surroundings at 0 K: with the emissivity e on
// one face, d T / d t = -e s T^4 / (rho C L), so T^-3 = T0^-3 + 3 e s t / (rho C L). And one that takes a flux q on one
// face and radiates from the other comes to rest with its surface at (Ta^4 + q / (e s))^1/4, and the slope q / k.
TEST(SurfaceFlux, Radiation) {
  Page page("transport", "radiation", "A slab that radiates");
  page.problem(
          "A slab 20 cells thick at 1000 K that radiates from one face to 0 K, emissivity 0.8, and conducts well; "
          "and one that takes 20 kW/m² on one face and radiates to 300 K from the other, until nothing changes.")
      .exact("1/T³ = 1/T0³ + 3εσt/(ρCL); surface at (Ta⁴ + q/(εσ))^(1/4).", "heat balance of the slab")
      .scene("heated_slab");
  mpm::Simulation cooling = heated(
      {"materials.metal.conductivity=1e5", "materials.metal.heat_capacity=5", "transport.temperature.initial=1000",
       "transport.temperature.fluxes=[{body: slab, edge: x_min, radiation: {emissivity: 0.8, ambient: 0}}]"});
  run_until(cooling, 5.0);
  expect_balance(cooling, "temperature");
  const double cube = 1e-9 + 3.0 * 0.8 * kStefanBoltzmann * 5.0 / (2000.0 * 5.0 * kLength);
  page.near("temperature after 5 s", at_face(cooling), std::pow(cube, -1.0 / 3.0), 0.001, "K");
  mpm::Simulation balance =
      heated({"materials.metal.heat_capacity=0.5", "transport.temperature.initial=800", "time.step=0.01",
              "materials.metal.young=1",
              "transport.temperature.fluxes=[{body: slab, edge: x_max, flux: 20000}, {body: slab, edge: x_min, "
              "radiation: {emissivity: 0.8, ambient: 300}}]"});
  run_until(balance, 20.0);
  expect_balance(balance, "temperature");
  const double surface = std::pow(std::pow(300.0, 4) + 2e4 / (0.8 * kStefanBoltzmann), 0.25);
  const Numbers t = field(balance, "temperature"), x = field(balance, "x");
  page.near("surface at rest", at_face(balance), surface, 0.001, "K");
  page.near("difference between the faces at rest", (t.back() - t.front()) / (x.back() - x.front()) * kLength,
            2e4 * kLength / kConductivity, 0.005, "K");
  page.meaning("The balance of radiation is met at the temperature of the face.");
}

// Between faces at 300 K a source s by volume comes to the parabola s x (L - x) / (2 k), and each face takes half of
// it; a ramp takes all particles along.
TEST(SurfaceFlux, Sources) {
  mpm::Simulation simulation =
      heated({"materials.metal.heat_capacity=5", "time.step=0.01", "materials.metal.young=1",
              "transport.temperature.sources=[{rate: 1e6}]",
              "transport.temperature.values=[{region: {box: {min: -0.02, max: 0}}, value: 300}, {region: {box: {min: "
              "0.1, max: 0.12}}, value: 300}]"});
  run_until(simulation, 2.0);
  expect_balance(simulation, "temperature");
  const double before = reported(simulation, "temperature by prescribed values");
  run_until(simulation, 3.0);
  const Numbers x = field(simulation, "x"), t = field(simulation, "temperature");
  const double top = 1e6 * kLength * kLength / (8.0 * kConductivity);
  for (std::size_t p = 0; p < x.size(); ++p) {
    EXPECT_NEAR(t[p] - 300.0, 1e6 * x[p] * (kLength - x[p]) / (2.0 * kConductivity), 0.005 * top);
  }
  const double taken = before - reported(simulation, "temperature by prescribed values");
  EXPECT_NEAR(taken, 1e6 * kLength, 0.001 * 1e6 * kLength);  // [J] in a second, over 1 m^2
  mpm::Simulation ramp = heated({"transport.temperature.sources=[{ramp: '300 + 20*t'}]"});
  run_until(ramp, 2.0);
  expect_balance(ramp, "temperature");
  for (const double value : field(ramp, "temperature_carried")) EXPECT_NEAR(value, 340.0, 1e-9);
}

// All at once, on two threads: the same bits, and the balance.
TEST(SurfaceFlux, SameBitsForAnyThreads) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2}) {
    mpm::Simulation simulation = start(
        "heated_slab",
        {"bodies.slab.initial={velocity: '0.01*sin(30*x)'}", "grid.cell=0.0005", "time.step=0.0003",
         "materials.metal.thermal_expansion=1e-5", "materials.metal.conductivity={table: [[300, 80], [500, 120]]}",
         "materials.metal.heat_capacity={table: [[300, 5], [500, 7]]}",
         "transport.temperature.fluxes=[{body: slab, edge: x_max, flux: 20000}, {body: slab, edge: x_min, "
         "radiation: {emissivity: 0.8, ambient: 900}}, {body: slab, edge: x_min, convection: {coefficient: 1000, "
         "ambient: 200}}]",
         "transport.temperature.sources=[{rate: '1e6*t'}, {ramp: '300 + 20*t'}]",
         "transport.temperature.values=[{region: {box: {min: 0.09, max: 0.12}}, value: '300 + 10*t'}]"},
        threads);
    run_until(simulation, 0.1);
    expect_balance(simulation, "temperature");
    hashes.push_back(simulation.state_hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace surface_flux_test
}  // namespace verification
