// Conduction along a radius: a cylinder that cools at its surface, and the steady state of a tube.
//
// Exact, for a cylinder of radius R that starts at 1 and is held at 0: T = 2 sum J0(b r/R) / (b J1(b)) exp(-b^2 D
// t/R^2) over the zeros b of J0; 0.848355 on the axis at D t / R^2 = 0.1. Of a tube at T1 inside and T2 outside: T = T1
// + (T2 - T1) ln(r/a) / ln(b/a). Source: exact-solutions 21; Carslaw and Jaeger (1959), 7.6 and 7.2.
#include <fmt/core.h>

#include "mpm/math/constants.hpp"
#include "page.hpp"
#include "transport_run.hpp"

namespace verification {
namespace conduction_axis_test {

using mpm::kPi;
constexpr double kRadius = 0.1, kDiffusivity = 1e-4, kEnd = 10.0;  // numbers of conduction_cylinder: D t / R^2 = 0.1

double series(double r) {
  static const std::vector<double> zeros = [] {
    std::vector<double> list;
    for (int n = 1; n <= 40; ++n) {
      double b = (n - 0.25) * kPi;
      for (int k = 0; k < 20; ++k) b += std::cyl_bessel_j(0, b) / std::cyl_bessel_j(1, b);
      list.push_back(b);
    }
    return list;
  }();
  double sum = 0.0;
  for (const double b : zeros) {
    sum += 2.0 * std::cyl_bessel_j(0, b * r / kRadius) / (b * std::cyl_bessel_j(1, b)) *
           std::exp(-b * b * kDiffusivity * kEnd / (kRadius * kRadius));
  }
  return sum;
}

struct Radial {
  double axis = 0.0;  ///< through the particles next to the axis, by the series' own curvature there
  Misfit all;
  Numbers r, t;
};

Radial cool(const std::string& shape, int cells) {
  const double cell = kRadius / cells;
  mpm::Simulation simulation =
      start("conduction_cylinder",
            {"method.shape=" + shape, fmt::format("grid.cell={:.17g}", cell),
             fmt::format("grid.max=[{:.17g}, {:.17g}]", kRadius + 2.0 * cell, 2.0 * cell),
             fmt::format("bodies.cylinder.shape.box.max=[{:.17g}, {:.17g}]", kRadius, 2.0 * cell)},
            1);
  run_until(simulation, kEnd);
  expect_balance(simulation, "temperature");
  Radial result{0.0, {}, field(simulation, "x"), field(simulation, "temperature")};
  result.all = misfit(result.t, [&](std::size_t p) { return series(result.r[p]); });
  const auto inner = std::min_element(result.r.begin(), result.r.end()) - result.r.begin();
  result.axis = result.t[inner] - series(result.r[inner]) + series(0.0);
  return result;
}

TEST(Conduction, CylinderCools) {
  EXPECT_NEAR(series(0.0), 0.848355, 1e-6);  // the reference's figure
  Page page("transport", "conduction_cylinder", "A warm cylinder with a cold surface");
  page.problem(
          "A long cylinder, 1 K warm, whose surface is held at 0 K from the start, about its axis; 20 cells of 4 "
          "particles on the radius, until D t / R² = 0.1.")
      .exact("T = 2 Σ J0(b r/R)/(b J1(b)) exp(-b²Dt/R²) over the zeros b of J0; 0.848355 K on the axis.",
             "Carslaw and Jaeger, Conduction of Heat in Solids (1959), section 7.6")
      .meaning("The functions weighted by r carry heat to the axis with nothing else to be done there.")
      .scene("conduction_cylinder");
  for (const std::string shape : {"ugimp", "cpdi"}) {
    const std::string name = shape == "ugimp" ? "uGIMP" : "CPDI";
    const Radial coarse = cool(shape, 10), fine = cool(shape, 20);
    page.near("temperature at the axis, 20 cells, " + name, fine.axis, 0.848355, 0.005, "K");
    page.near_absolute("root mean square error, 20 cells, " + name, 100.0 * fine.all.rms, 0.0, 0.5, "% of the start");
    page.above("order of convergence, 10 to 20 cells, " + name, order_of_convergence(coarse.all.rms, fine.all.rms), 1.8,
               "");
    if (shape == "ugimp") continue;
    Numbers r, exact, mm;
    for (int i = 0; i <= 100; ++i) r.push_back(1e3 * kRadius * i / 100), exact.push_back(series(1e-3 * r.back()));
    for (const double at : fine.r) mm.push_back(1e3 * at);
    page.figure()
        .panel("Cylinder at D t / R² = 0.1, CPDI", "r [mm]", "T [K]")
        .exact("series", r, exact)
        .points("particles", mm, fine.t);
  }
}

TEST(Conduction, TubeIsLogarithmic) {
  Page page("transport", "conduction_tube", "A tube, hot inside and cold outside");
  page.problem(
          "A long tube from r = 0.1 m to 0.2 m at 400 K inside and 300 K outside, 20 cells across, until nothing "
          "changes.")
      .exact("T = T1 + (T2 - T1) ln(r/a)/ln(b/a).", "Carslaw and Jaeger (1959), section 7.2")
      .scene("conduction_tube");
  for (const std::string shape : {"ugimp", "cpdi"}) {
    const std::string name = shape == "ugimp" ? "uGIMP" : "CPDI";
    mpm::Simulation simulation = start("conduction_tube", {"method.shape=" + shape, "time.step=1"}, 1);
    run_until(simulation, 160.0);
    expect_balance(simulation, "temperature");
    const Numbers r = field(simulation, "x"), t = field(simulation, "temperature");
    const auto exact = [](double at) { return 400.0 - 100.0 * std::log(at / 0.1) / std::log(2.0); };
    const Misfit all = misfit(t, [&](std::size_t p) { return exact(r[p]); });
    page.near_absolute("largest error, " + name, all.most, 0.0, 0.5, "% of the difference");
    if (shape == "ugimp") continue;
    Numbers mm, line, particles;
    for (int i = 0; i <= 100; ++i) mm.push_back(100.0 + i), line.push_back(exact(1e-3 * mm.back()));
    for (const double at : r) particles.push_back(1e3 * at);
    page.figure().panel("Tube, CPDI", "r [mm]", "T [K]").exact("ln r", mm, line).points("particles", particles, t);
  }
  page.meaning("The steady profile is that of the logarithm with both shape functions.");
}

}  // namespace conduction_axis_test
}  // namespace verification
