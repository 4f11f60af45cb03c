// A column between smooth walls, at rest under its own weight: uniaxial strain. The weight above a section of the
// material does not change as it sinks, nor does the section's area, so at initial height Z, for any law and strain,
//   sigma_zz = -rho0 g (H - Z);
// and while the strain is small, with the modulus M = K + 4 G / 3, u = -(rho0 g / M) (H Z - Z^2 / 2).
// Source: exact-solutions 9.
#include <fmt/core.h>

#include <algorithm>

#include "page.hpp"
#include "scene_run.hpp"

namespace verification {
namespace self_weight_test {

constexpr double kHeight = 1.0, kBaseStress = 1000.0 * 10.0 * 1.0;  // rho0 g H [Pa]

/// One column of particles at rest, from the bottom up.
struct Rest {
  Numbers height;        // Z [m]
  Numbers stress;        // [Pa]
  Numbers displacement;  // [m]
  double kinetic = 0.0;  // kinetic over elastic energy
};

Rest settle(const std::vector<std::string>& overrides) {
  mpm::Simulation simulation = start("self_weight", overrides);
  const std::vector<double> x = field(simulation, "x"), initial = field(simulation, "z");
  run_until(simulation, 1.0);
  const std::vector<double> z = field(simulation, "z"), stress = field(simulation, "szz");
  const double nearest = *std::min_element(x.begin(), x.end()) + 1e-9;
  std::vector<std::size_t> order;
  for (std::size_t p = 0; p < x.size(); ++p) {
    if (x[p] < nearest) order.push_back(p);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return initial[a] < initial[b]; });
  Rest rest;
  for (const std::size_t p : order) {
    rest.height.push_back(initial[p]);
    rest.stress.push_back(stress[p]);
    rest.displacement.push_back(z[p] - initial[p]);
  }
  rest.kinetic = simulation.state().energy.of("kinetic") / simulation.state().energy.of("elastic");
  return rest;
}

/// Largest difference from the exact stress, over the stress at the base, of means over `group` neighbours.
double stress_error(const Rest& rest, std::size_t group) {
  double worst = 0.0;
  for (std::size_t p = 0; p + group <= rest.height.size(); p += group) {
    double difference = 0.0;
    for (std::size_t q = p; q < p + group; ++q) {
      difference += rest.stress[q] + kBaseStress * (1.0 - rest.height[q] / kHeight);
    }
    worst = std::max(worst, std::abs(difference) / static_cast<double>(group) / kBaseStress);
  }
  return worst;
}

TEST(SelfWeight, StressAndSinking) {
  Page page("waves", "self_weight", "A column at rest under its own weight");
  page.problem(
          "A column of height H = 1 m, 40 cells, stands on a smooth floor between smooth walls. Density 1000 kg/m³, g "
          "= "
          "10 m/s², neo-Hookean, E = 1 MPa, Poisson's ratio 0.3; gravity acts from the start, and grid damping brings "
          "the column to rest within a second. The softer columns (100 kPa, 50 kPa) sink by 4 % and 7 %.")
      .exact(
          "σzz = -ρ₀g(H - Z) at the initial height Z, for any law and strain. For small strain the displacement is "
          "u = -(ρ₀g/M)(HZ - Z²/2) with M = K + 4G/3.",
          "equilibrium in uniaxial strain, where neither the weight above a section nor its area changes")
      .meaning(
          "Strain is constant over a cell for particles whose boxes do not extend over its edge, so stress is a "
          "staircase: a quarter of a cell's weight above and below the line, which the mean over a cell removes. A "
          "particle's box does not follow its deformation: the more a column is compressed, the more neighbours "
          "overlap, and the larger is the error of stress.")
      .scene("self_weight");
  const double young = 1e6, poisson = 0.3;
  const double modulus = young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
  const auto exact_displacement = [&](double z) {
    return -kBaseStress / kHeight / modulus * (kHeight * z - 0.5 * z * z);
  };

  const Rest rest = settle({});
  double sinking_error = 0.0;
  for (std::size_t p = 0; p < rest.height.size(); ++p) {
    sinking_error = std::max(sinking_error, std::abs(rest.displacement[p] - exact_displacement(rest.height[p])) /
                                                std::abs(exact_displacement(kHeight)));
  }
  // 1 % is required. The steps of stress between cells are h / 4 H = 0.6 % of it.
  page.below("largest error of any particle's stress", 100.0 * stress_error(rest, 1), 1.0, "% of the base's stress");
  page.report("the same for the mean over a cell", 100.0 * stress_error(rest, 2), "% of the base's stress");
  page.below("largest error of a displacement", 100.0 * sinking_error, 1.0, "% of the top's");
  page.below("kinetic energy left over", rest.kinetic, 1e-6, "of the elastic energy");

  Numbers line_z, line_stress, line_u;
  for (int i = 0; i <= 40; ++i) {
    const double z = kHeight * i / 40.0;
    line_z.push_back(z);
    line_stress.push_back(-1e-3 * kBaseStress * (1.0 - z / kHeight));
    line_u.push_back(1e3 * exact_displacement(z));
  }
  const auto scaled = [](Numbers values, double factor) {
    for (double& value : values) value *= factor;
    return values;
  };
  Panel& stress = page.figure().panel("Stress", "σzz [kPa]", "initial height [m]");
  stress.exact("exact", line_stress, line_z).points("E = 1 MPa", scaled(rest.stress, 1e-3), rest.height);
  page.figure()
      .panel("Displacement", "u [mm]", "initial height [m]")
      .exact("exact, small strain", line_u, line_z)
      .points("E = 1 MPa", scaled(rest.displacement, 1e3), rest.height);

  const Rest usf = settle({"method.update=usf"}), rate = settle({"materials.rubber.law=linear_elastic"});
  page.below("largest error of any particle's stress, USF", 100.0 * stress_error(usf, 1), 1.0,
             "% of the base's stress");
  page.below("largest error of any particle's stress, law linear_elastic", 100.0 * stress_error(rate, 1), 1.0,
             "% of the base's stress");
  for (const int kilopascal : {100, 50}) {
    // Critical damping is proportional to the wave speed.
    const Rest soft = settle({fmt::format("materials.rubber.young={} kPa", kilopascal),
                              fmt::format("method.damping={}", 100.0 * std::sqrt(kilopascal / 1000.0))});
    page.report(fmt::format("largest error of any particle's stress, E = {} kPa", kilopascal),
                100.0 * stress_error(soft, 1), "% of the base's stress");
    page.report(fmt::format("the same for the mean over a cell, E = {} kPa", kilopascal), 100.0 * stress_error(soft, 2),
                "% of the base's stress");
    if (kilopascal == 50) stress.points("E = 50 kPa", scaled(soft.stress, 1e-3), soft.height);
  }
}

}  // namespace self_weight_test
}  // namespace verification
