// A cube of sand squeezed by plates, through the whole solver, along the paths of a soil laboratory, for which the
// exact stress is known.
//
// Exact, for Drucker-Prager matched to Mohr-Coulomb in triaxial compression, no cohesion (exact-solutions 24): at the
// limit the axial stress is Kp = tan^2(45 + phi/2) times the lateral. In the oedometer, yielding from the start, the
// stress stays on the cone, sqrt(J2) = eta p, with the strain eps axial: with d lambda = c d eps,
//   G (2 / sqrt 3 - c) = eta K (1 + eta_bar c),   sigma_v = K (1 + eta_bar c) (1 + 2 eta / sqrt 3) eps,
// as d sqrt(J2) = G (2 / sqrt 3 d eps - d lambda) and dp = K (d eps + eta_bar d lambda). eps is logarithmic, as the law
// integrates the rate of deformation: -ln J here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "page.hpp"
#include "scene_run.hpp"

namespace soil_box_test {

using verification::Numbers;

constexpr double kYoung = 1e6, kPoisson = 0.1, kPassive = 3.0;  // [Pa], [-], tan^2(60 degrees)
constexpr double kBulk = kYoung / (3.0 * (1.0 - 2.0 * kPoisson)), kShear = kYoung / (2.0 * (1.0 + kPoisson));

double slope_of_cone(double degrees) {
  const double s = std::sin(degrees * std::acos(-1.0) / 180.0);
  return 6.0 * s / (std::sqrt(3.0) * (3.0 - s));
}

/// Mean over the particles, and the largest deviation from it.
struct Spread {
  double mean = 0.0, most = 0.0;
};
Spread spread(const mpm::Simulation& simulation, const std::string& name) {
  const Numbers values = verification::field(simulation, name);
  Spread result;
  for (const double value : values) result.mean += value / static_cast<double>(values.size());
  for (const double value : values) result.most = std::max(result.most, std::abs(value - result.mean));
  return result;
}

TEST(SoilBox, OedometerAndTriaxialTestAreExact) {
  verification::Page page("soil", "soil_box", "A cube of sand in the oedometer and the triaxial test");
  page.problem(
          "A cube of dry sand of 0.4 m, 4 cells along an edge, between smooth walls and plates, without weight. "
          "Drucker-Prager that matches triaxial compression, φ = 30°, E = 1 MPa, ν = 0.1. Oedometer, ψ = 10°: the top "
          "plate goes down by 2 % and the sides hold. Triaxial test at constant volume, ψ = 0: all three plates press "
          "by "
          "1 %, then the top goes on and the sides yield half as much each.")
      .exact(
          "At the limit σv/σh = tan²(45° + φ/2) = 3. Oedometer: yielding from the start, since elastic sand would have "
          "σh/σv = ν/(1-ν) = 1/9; σv = K (1 + η' c)(1 + 2η/√3) ε with c = (2G/√3 - ηK)/(G + ηη'K), ε = -ln J, η and η' "
          "the slopes of cone and flow. Triaxial: p keeps the value K ln(1/J) of the first part.",
          "Mohr-Coulomb's criterion; the modulus follows from consistency, derived in the test")
      .scene("soil_box.yaml");

  const double eta = slope_of_cone(30.0), eta_bar = slope_of_cone(10.0);
  const double c = (2.0 * kShear / std::sqrt(3.0) - eta * kBulk) / (kShear + eta * eta_bar * kBulk);
  const double modulus = kBulk * (1.0 + eta_bar * c) * (1.0 + 2.0 * eta / std::sqrt(3.0));
  Numbers strain, vertical, lateral;
  mpm::Simulation oedometer = verification::start("soil_box");
  for (int i = 0; i < 90; ++i) {
    oedometer.advance();
    if (i == 88) oedometer.take_contact(2);
    strain.push_back(-100.0 * std::log(spread(oedometer, "j").mean));
    vertical.push_back(-spread(oedometer, "szz").mean / 1e3);
    lateral.push_back(-spread(oedometer, "sxx").mean / 1e3);
  }
  const double shortening = 0.01 * strain.back();
  // 0.1 %: the plate moves 10 mm/s, and the cube oscillates by the ratio of that to the wave speed, 25 m/s, after a
  // soft start.
  page.near("oedometer: σv", vertical.back(), modulus * shortening / 1e3, 1e-3, "kPa");
  page.near("oedometer: σv/σh", vertical.back() / lateral.back(), kPassive, 1e-3, "-");
  page.report("oedometer: largest departure of a particle's σv from the mean", spread(oedometer, "szz").most / 1e3,
              "kPa");
  // 3 %: virtual work on the grid, whose loaded row of nodes does not move with the plate, gives force times H0 =
  // stress times present volume, so the force is low by the strain, 2 %.
  page.near("oedometer: force on the plate over σv times area",
            oedometer.take_contact(2).mean.force.z() / (vertical.back() * 1e3 * 0.16), 1.0, 0.03, "-");
  // The plate's own row of nodes stays in contact while it moves by a part of a cell: the strain is u/H0, not ln(H0/H).
  page.beside("oedometer: strain, beside ln(H0/H) of the plate", shortening, -std::log(1.0 - 0.008 / 0.4), "-");
  auto& first = page.figure().panel("Oedometer", "vertical strain -ln J [%]", "stress [kPa]");
  const double most = modulus * shortening / 1e3;
  first.exact("exact", {0.0, strain.back()}, {0.0, most}).exact("", {0.0, strain.back()}, {0.0, most / kPassive});
  first.line("vertical", strain, vertical).line("lateral", strain, lateral);

  mpm::Simulation triaxial = verification::start(
      "soil_box", {"materials.sand.dilation_angle=0", "rigid_bodies.z_plate.motion.velocity=[0,0,0]"});
  const auto press = [&](double sides, double top) {
    triaxial.command_velocity(0, {{-sides, 0.0, 0.0}, mpm::Vec3::Zero()});
    triaxial.command_velocity(1, {{0.0, -sides, 0.0}, mpm::Vec3::Zero()});
    triaxial.command_velocity(2, {{0.0, 0.0, -top}, mpm::Vec3::Zero()});
  };
  Numbers ratio, pressure, axial;
  double moved = 0.0;
  press(0.004, 0.004);
  verification::run_until(triaxial, 1.0);
  press(0.0, 0.0);
  verification::run_until(triaxial, 1.3);  // at rest
  const double confining = spread(triaxial, "p").mean;
  page.near("triaxial: p after the first part", confining / 1e3, -kBulk * std::log(spread(triaxial, "j").mean) / 1e3,
            1e-3, "kPa");
  press(-0.002, 0.004);
  for (int i = 0; i < 150; ++i) {
    triaxial.advance();
    moved += 0.004 * 0.01 / 0.4;
    axial.push_back(100.0 * moved);
    ratio.push_back(spread(triaxial, "szz").mean / spread(triaxial, "sxx").mean);
    pressure.push_back(spread(triaxial, "p").mean / confining);
  }
  page.near("triaxial: σ axial / σ lateral", ratio.back(), kPassive, 1e-3, "-");
  page.near("triaxial: p at the end", spread(triaxial, "p").mean / 1e3,
            -kBulk * std::log(spread(triaxial, "j").mean) / 1e3, 1e-3, "kPa");
  page.report("triaxial: p over that of the first part", pressure.back(), "-");
  auto& second = page.figure().panel("Triaxial test at constant volume", "axial strain u/H0 [%]", "ratio [-]");
  second.exact("limit", {0.0, axial.back()}, {kPassive, kPassive});
  second.line("axial over lateral stress", axial, ratio).line("p over p of the first part", axial, pressure);
  page.meaning(
      "A law gives the same results in the solver as alone: uniform deformation stays uniform, walls and plates "
      "without friction do not disturb it, and the force on a plate is the stress under it times its area.");
}

}  // namespace soil_box_test
