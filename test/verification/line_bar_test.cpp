// A line: a bar that vibrates along it, the strip between smooth walls that it stands for, and a piston that drives a
// wave into it. With c = sqrt(M / rho), M the modulus of uniaxial strain (E where Poisson's ratio is 0):
//   a bar fixed at x = 0 and free at x = L, started with v0 sin(pi x / 2L), has the period 4 L / c (exact-solutions 1);
//   a piston of velocity v presses with rho c v per area until its wave is back (exact-solutions 10).
#include <fmt/core.h>

#include <algorithm>

#include "mpm/math/constants.hpp"
#include "page.hpp"
#include "scene_run.hpp"

namespace verification {
namespace line_bar_test {

using mpm::kPi;
constexpr double kLength = 1.0, kSpeed = 100.0;  // numbers of vibrating_line.yaml [m], [m/s]
constexpr double kPeriod = 4.0 * kLength / kSpeed;

struct Vibration {
  Numbers time, mode;   // [s], amplitude of sin(pi X / 2L) in the displacement [m]
  double drift = 0.0;   // largest change of kinetic + elastic energy, over the start
  double across = 0.0;  // largest coordinate along y or z
};

/// Ten and a quarter periods.
Vibration vibrate(const std::vector<std::string>& overrides) {
  mpm::Simulation simulation = start("vibrating_line", overrides);
  const std::vector<double> start_x = field(simulation, "x");
  const double energy = simulation.state().energy.total();
  Vibration run;
  while (seconds(simulation) < 10.25 * kPeriod - 1e-9) {
    simulation.advance();
    const std::vector<double> x = field(simulation, "x");
    double with_mode = 0.0, mode_mode = 0.0;
    for (std::size_t p = 0; p < x.size(); ++p) {
      const double shape = std::sin(0.5 * kPi * start_x[p] / kLength);
      with_mode += shape * (x[p] - start_x[p]);
      mode_mode += shape * shape;
    }
    run.time.push_back(seconds(simulation));
    run.mode.push_back(with_mode / mode_mode);
    run.drift = std::max(run.drift, std::abs(simulation.state().energy.total() / energy - 1.0));
    for (const char* beside : {"y", "z", "vy", "vz"}) {
      for (const double value : field(simulation, beside)) run.across = std::max(run.across, std::abs(value));
    }
  }
  return run;
}

/// Mean period from the 20th passage of the mode through zero after the start.
double period(const Vibration& run) {
  int passages = 0;
  for (std::size_t i = 2; i < run.mode.size(); ++i) {
    const double before = run.mode[i - 1], after = run.mode[i];
    if (before * after > 0.0 || ++passages < 20) continue;
    return (run.time[i - 1] + (run.time[i] - run.time[i - 1]) * before / (before - after)) / 10.0;
  }
  return 0.0;
}

TEST(LineBar, KeepsItsPeriodAndAmplitude) {
  Page page("waves", "vibrating_line", "A bar as a line");
  page.problem(
          "A bar of length L = 1 m, 20 cells of 2 particles, is fixed at x = 0 and free at x = L, in one dimension. It "
          "starts with the velocity v0 sin(pi x / 2L), v0 = 1e-4 c, and vibrates freely for ten periods. Linear "
          "elastic, E = 1 MPa, density 100 kg/m³, Poisson's ratio 0.")
      .exact("u(X, t) = v0/(βc) sin(βX) sin(βct) with β = π/2L and c = √(E/ρ) = 100 m/s: the period is 4L/c = 40 ms.",
             "the wave equation ρ u_tt = E u_xx")
      .meaning("The line gives the result of the strip in the section above with a fraction of its particles.")
      .scene("vibrating_line");
  const double exact = 1e-4 * kSpeed / (0.5 * kPi / kLength * kSpeed);
  const Vibration usavg = vibrate({}), usf = vibrate({"method.update=usf"});
  // Waves on the grid are too slow by the square of cell over wave length, (2 pi / 80)^2 / 24 = 0.03 %; the rest comes
  // from the step.
  page.near("period, USAVG", 1e3 * period(usavg), 1e3 * kPeriod, 0.002, "ms");
  page.near("period, USF", 1e3 * period(usf), 1e3 * kPeriod, 0.005, "ms");
  // At 10 1/4 periods the displacement is at its largest; by then a period's error of 0.2 % has turned the phase by 7
  // degrees at most, which is 1 % of the amplitude.
  page.near("amplitude after ten periods, USAVG", 1e6 * usavg.mode.back(), 1e6 * exact, 0.01, "µm");
  page.report("largest drift of the energy, USAVG", 100.0 * usavg.drift, "% of the start");
  page.report("largest drift of the energy, USF", 100.0 * usf.drift, "% of the start");
  EXPECT_EQ(usavg.across, 0.0);  // nothing lies or moves off the line
  Numbers exact_mode, milliseconds, micrometres;
  for (std::size_t i = usavg.time.size() - 250; i < usavg.time.size(); ++i) {
    milliseconds.push_back(1e3 * usavg.time[i]);
    micrometres.push_back(1e6 * usavg.mode[i]);
    exact_mode.push_back(1e6 * exact * std::sin(2.0 * kPi * usavg.time[i] / kPeriod));
  }
  page.figure()
      .panel("The last period: the mode's amplitude", "time [ms]", "displacement [µm]")
      .exact("exact", milliseconds, exact_mode)
      .line("USAVG", milliseconds, micrometres);
}

// The same problem in two dimensions: a strip one cell high between smooth walls, in plane strain. Whatever the law,
// the shape function's weights along z add up to one, so particles move in the same way up to round-off. The tip
// travels by more than a cell.
TEST(LineBar, IsAStripBetweenSmoothWalls) {
  for (const char* law : {"neo_hookean", "linear_elastic"}) {
    const std::vector<std::string> material = {fmt::format("materials.bar.law={}", law), "materials.bar.poisson=0.3"};
    std::vector<std::string> of_line = material, of_strip = material;
    of_line.emplace_back("bodies.bar.initial.velocity=10*sin(pi*x/2)");
    of_strip.emplace_back("bodies.bar.initial.velocity=['10*sin(pi*x/2)', 0]");
    mpm::Simulation line = start("vibrating_line", of_line, 1), strip = start("vibrating_bar", of_strip, 1);
    const std::size_t n = line.particles();
    ASSERT_EQ(strip.particles(), 2 * n);
    const double start_x = field(line, "x").back();
    double travel = 0.0;
    while (seconds(line) < 0.1 - 1e-9) {
      line.advance();
      strip.advance();
      travel = std::max(travel, std::abs(field(line, "x").back() - start_x));
    }
    EXPECT_GT(travel, line.definition().grid.cell.x());
    struct Scale {
      const char* field;
      double size;  // reference for round-off
    };
    for (const auto& [name, size] :
         {Scale{"x", 1.0}, {"vx", 10.0}, {"sxx", 1e5}, {"syy", 1e5}, {"szz", 1e5}, {"j", 1.0}}) {
      const std::vector<double> a = field(line, name), b = field(strip, name);
      for (std::size_t p = 0; p < n; ++p) {
        EXPECT_NEAR(a[p], b[p], 1e-10 * size) << law << ' ' << name << ' ' << p;
        EXPECT_NEAR(a[p], b[p + n], 1e-10 * size) << law << ' ' << name << ' ' << p;
      }
    }
  }
}

TEST(LineBar, APistonDrivesAWaveOfConstantStress) {
  Page page("contact", "piston", "A piston drives a wave into a rod");
  const double young = 1e6, poisson = 0.3, density = 100.0, speed = 0.1, area = 4e-4;  // numbers of the scene
  const double modulus = young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
  const double wave = std::sqrt(modulus / density), force = density * wave * speed * area;
  page.problem(
          "A rod of 4 cm² between smooth walls, 1 m long in 50 cells, is a line. A piston, a rigid box, moves into its "
          "end with 0.1 m/s from the start. Linear elastic, E = 1 MPa, Poisson's ratio 0.3, density 100 kg/m³.")
      .exact(
          "The piston presses with ρcv on the area until the wave is back from the free end, c = √(M/ρ), M = E(1 - "
          "ν)/((1 + ν)(1 - 2ν)): 464 mN.",
          "the wave equation")
      .meaning(
          "Contact in a line is that of the plane: the force is the momentum that the nodes in the piston exchange.")
      .scene("piston");
  mpm::Simulation simulation = start("piston");
  run_until(simulation, 1e-3);
  simulation.take_contact(0);
  run_until(simulation, 15e-3);
  const mpm::ContactReport contact = simulation.take_contact(0);
  // 1 %: the wave's front, four cells wide, rings; over 14 ms of force it is averaged.
  page.near("force on the piston, mean of 1 to 15 ms", 1e3 * contact.mean.force.x(), 1e3 * force, 0.01, "mN");
  EXPECT_EQ(contact.mean.force.y(), 0.0);
  EXPECT_EQ(contact.mean.force.z(), 0.0);
  // The wave is in the free half now, and 0.75 m of rod behind it are compressed by v / c.
  const std::vector<double> sxx = field(simulation, "sxx"), szz = field(simulation, "szz"), x = field(simulation, "x");
  double along = 0.0, beside = 0.0, count = 0.0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    if (x[p] < 0.9 || x[p] > 0.98) continue;
    along += sxx[p], beside += szz[p], count += 1.0;
  }
  ASSERT_GT(count, 5.0);
  page.near("stress behind the piston", -along / count, density * wave * speed, 0.02, "Pa");
  // nu / (1 - nu): uniaxial strain.
  EXPECT_NEAR(beside / along, poisson / (1.0 - poisson), 1e-3);
  page.below("momentum left over by the audit", simulation.state().audit.residual, 1e-10, "of what was exchanged");
}

}  // namespace line_bar_test
}  // namespace verification
