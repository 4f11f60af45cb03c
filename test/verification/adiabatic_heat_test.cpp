// Heat of deformation where nothing flows: compression, the elastic bar's thermoelastic effect, plastic work.
//
// dT = -3 K alpha T0 d(e_v) / (rho C_v) of a volume strain; -alpha T0 d(sigma) / (rho C) of a stress along one axis;
// of plastic work W by volume beta W / (rho C_v). Source: exact-solutions 19; W. Thomson (1853); G. I. Taylor, H.
// Quinney (1934), Proc. R. Soc. A 143, 307-326.
#include <fmt/core.h>

#include "page.hpp"
#include "transport_run.hpp"

namespace verification {
namespace adiabatic_heat_test {

constexpr double kYoung = 1e7, kPoisson = 0.3, kDensity = 1000.0, kCapacity = 100.0, kAlpha = 1e-5;  // strained_block
constexpr double kBulk = kYoung / (3.0 * (1.0 - 2.0 * kPoisson));
constexpr double kStart = 300.0;

/// A block all of whose nodes have the given velocities.
mpm::Simulation strained(const std::string& vx, const std::string& vz, const std::vector<std::string>& more = {}) {
  const std::string box = "region: {box: {min: [-0.75, -0.75], max: [1.75, 1.75]}}";
  std::vector<std::string> overrides = {"bodies.block.initial={velocity: ['" + vx + "', '" + vz + "']}",
                                        "boundaries={conditions: [{" + box + ", direction: x, velocity: '" + vx +
                                            "'}, {" + box + ", direction: z, velocity: '" + vz + "'}]}"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return start("strained_block", overrides, 1);
}

TEST(AdiabaticHeat, Compression) {
  Page page("transport", "compression_heat", "Compression heats");
  page.problem(
          "A block (E = 10 MPa, ν = 0.3, α = 1e-5 /K, ρC = 1e5 J/(m³ K)) at 300 K whose nodes all move so that it "
          "is compressed evenly by 1e-3 along one axis or two, and by 20 % along one.")
      .exact("ΔT = -3KαT Δε/(ρC): T0 (exp(-3Kα(J - 1)/(ρC)) - 1) at any strain.", "Thomson (1853)")
      .scene("strained_block");
  // USL strains after heat has been taken and USAVG half, which has that heat a step later (GIMP notes (6.28)-(6.30)).
  const double step = 2.5e-4, unit = 3.0 * kBulk * kAlpha * kStart / (kDensity * kCapacity);
  const std::vector<std::pair<std::string, double>> updates = {{"usl", 1.0}, {"usf", 0.0}, {"usavg", 0.5}};
  for (const std::string law : {"linear_elastic", "neo_hookean", "j2_plasticity"}) {
    for (const auto& [update, late] : updates) {
      std::vector<std::string> more = {"materials.block.law=" + law, "method.update=" + update,
                                       fmt::format("time.step={}", step)};
      if (law == "j2_plasticity") more.emplace_back("materials.block.yield_stress=1e9");
      mpm::Simulation one = strained("-0.01*x", "0", more);
      run_until(one, 0.1);
      expect_balance(one, "temperature");
      const double strain = std::exp(-1e-3) - 1.0;  // strain of nodes whose velocity goes with their place
      const Misfit all = misfit(field(one, "temperature"), [&](std::size_t) { return kStart; });
      page.near(fmt::format("rise, one axis, {}, {}", law, update), 1e3 * all.rms,
                -1e3 * unit * strain * (1.0 - late * step / 0.1), 1e-3, "mK");
    }
  }
  mpm::Simulation both = strained("-0.01*x", "-0.01*z", {"method.update=usf"});
  run_until(both, 0.1);
  page.near("rise, two axes", 1e3 * (field(both, "temperature").front() - kStart), 1e3 * unit * (1.0 - std::exp(-2e-3)),
            1e-3, "mK");
  mpm::Simulation large = strained("-2*x/(1 - 2*t)", "0", {"materials.block.law=neo_hookean", "method.update=usf"});
  run_until(large, 0.1);
  const double j = field(large, "j").front();
  EXPECT_NEAR(j, 0.8, 2e-3);
  page.near("rise, 20 %", field(large, "temperature").front() - kStart,
            kStart * std::expm1(-3.0 * kBulk * kAlpha * (j - 1.0) / (kDensity * kCapacity)), 1e-3, "K");
  page.meaning("Every particle warms as its own volume shrinks, whenever strains are updated.");
}

// A bar that is drawn slowly. It cools, and what it then shrinks is part of the answer: C is that at constant stress,
// C_v + 9 K alpha^2 T0 / rho, which differs by 3e-5 of itself here.
TEST(AdiabaticHeat, ThermoelasticBar) {
  Page page("transport", "thermoelastic_bar", "A bar that is drawn cools");
  page.problem(
          "A bar of 4 x 2 x 2 cells between a smooth wall and a pull of 1 kPa that rises slowly; E = 1 MPa, α = "
          "1e-5 /K, ρC = 1e6 J/(m³ K), 300 K.")
      .exact("ΔT = -αT0 Δσ/(ρC).", "Thomson (1853)")
      .scene("warm_bar");
  for (const std::string geometry : {"solid", "plane_stress"}) {
    for (const std::string law : {"linear_elastic", "neo_hookean"}) {
      std::vector<std::string> overrides = {
          "materials.bar.law=" + law, "materials.bar.thermal_expansion=1e-5", "transport.temperature={initial: 300}",
          "loads=[{pressure: {body: bar, edge: x_max, value: '-1000*(t < 0.4 ? 0.5 - 0.5*cos(2.5*pi*t) : 1)'}}]"};
      if (geometry == "solid") {
        overrides.insert(overrides.end(), {"grid.min=[0, -0.2, -0.2]", "boundaries={x_min: slip}"});
      } else {
        overrides.insert(overrides.end(),
                         {"geometry=plane_stress", "grid.min=[0, -0.2]", "grid.max=[0.6, 0.4]",
                          "bodies.bar.shape.box={min: [0, 0], max: [0.4, 0.2]}", "boundaries={x_min: slip}"});
      }
      mpm::Simulation simulation = start("warm_bar", overrides, 1);
      run_until(simulation, 0.8);
      expect_balance(simulation, "temperature");
      const Numbers t = field(simulation, "temperature"), s = field(simulation, "sxx");
      double rise = 0.0, stress = 0.0;
      const auto count = static_cast<double>(t.size());
      for (std::size_t p = 0; p < t.size(); ++p) rise += (t[p] - kStart) / count, stress += s[p] / count;
      EXPECT_NEAR(stress, 1000.0, 5.0);
      page.near("change over that of the stress, " + geometry + ", " + law, 1e6 * rise,
                -1e6 * 1e-5 * kStart * stress / 1e6, 1e-3, "µK");
    }
  }
  page.meaning("Half of Thomson's effect would be seen if the compression across the pull were left out.");
}

TEST(AdiabaticHeat, PlasticBar) {
  Page page("transport", "plastic_bar", "Plastic work heats");
  page.problem(
          "A block of a metal that yields at 20 kPa (E = 10 MPa, no hardening) is drawn by 10 % in plane strain at "
          "constant volume; 0.9 of the work becomes heat, ρC = 1e5 J/(m³ K).")
      .exact("ΔT = 0.9 σy (2/√3 ε - σy/(3G))/(ρC), ε the logarithmic strain.",
             "Taylor and Quinney (1934); work of a perfectly plastic solid")
      .scene("strained_block");
  const double yield = 2e4, strain = 0.1, shear = kYoung / (2.0 * (1.0 + kPoisson));
  const double work = yield * (2.0 / std::sqrt(3.0) * strain - yield / (3.0 * shear));
  // The work that is booked in a step is that of its strain; USL and half of USAVG strain after heat has been taken,
  // which then has it a step later (GIMP notes (6.28)-(6.30)).
  const double step = 2e-4, yields_at = 0.5 * std::sqrt(3.0) * yield / (3.0 * shear);
  const std::vector<std::pair<std::string, double>> updates = {{"usl", 1.0}, {"usf", 0.0}, {"usavg", 0.5}};
  for (const auto& [update, late] : updates) {
    for (const double part : {0.9, 0.5}) {
      mpm::Simulation simulation =
          strained("1*x", "-1*z",
                   {"method.update=" + update, "materials.block.law=j2_plasticity",
                    "materials.block.yield_stress=20000", "materials.block.thermal_expansion=0",
                    fmt::format("materials.block.heat_fraction={}", part), fmt::format("time.step={}", step)});
      run_until(simulation, strain);
      expect_balance(simulation, "temperature");
      const Numbers t = field(simulation, "temperature");
      const double booked = part * (1.0 - late * step / (strain - yields_at));
      page.near(fmt::format("rise, {}, part {}", update, part), t.front() - kStart,
                booked * work / (kDensity * kCapacity), 1e-3, "K");
      const double plastic = simulation.state().energy.of("plastic");
      page.near(fmt::format("heat over the plastic energy, {}, part {}", update, part),
                reported(simulation, "temperature by plastic work") / plastic, booked, late > 0.0 ? 1e-4 : 1e-10, "");
    }
  }
  page.meaning("What the law dissipates is what warms, in the part that is asked for.");
}

}  // namespace adiabatic_heat_test
}  // namespace verification
