// A slab that is warm at first and whose faces are held cold, along a line: the series, the order of convergence, and
// each way to compute it.
//
// Exact, with a start at 1 and faces at 0: T = sum over odd m of 4/(m pi) sin(m pi x / L) exp(-m^2 pi^2 D t / L^2);
// 0.772312 at the centre at D t / L^2 = 0.05. Source: exact-solutions 20; H. S. Carslaw, J. C. Jaeger (1959),
// Conduction of Heat in Solids, 3.3.
#include <fmt/core.h>

#include "mpm/math/constants.hpp"
#include "page.hpp"
#include "transport_run.hpp"

namespace verification {
namespace conduction_test {

using mpm::kPi;
constexpr double kLength = 0.1, kDiffusivity = 1e-4;  // numbers of conduction_slab [m], [m^2/s]
constexpr double kEnd = 0.05 * kLength * kLength / kDiffusivity;

double series(double x, double t) {
  double sum = 0.0;
  for (int m = 1; m < 200; m += 2) {
    sum += 4.0 / (m * kPi) * std::sin(m * kPi * x / kLength) *
           std::exp(-m * m * kPi * kPi * kDiffusivity * t / (kLength * kLength));
  }
  return sum;
}

struct Cooled {
  double centre = 0.0;  ///< mean of the particles beside it [K]
  Misfit all;
  Numbers x, seen, carried;
};

Cooled cool(int cells, std::vector<std::string> overrides = {}) {
  overrides.push_back(fmt::format("grid.cell={:.17g}", kLength / cells));
  overrides.push_back(fmt::format("grid.min=[{:.17g}]", -2.0 * kLength / cells));
  overrides.push_back(fmt::format("grid.max=[{:.17g}]", kLength + 2.0 * kLength / cells));
  mpm::Simulation simulation = start("conduction_slab", overrides, 1);
  run_until(simulation, kEnd);
  expect_balance(simulation, "temperature");
  Cooled slab;
  slab.x = field(simulation, "x");
  slab.seen = field(simulation, "temperature");
  slab.carried = field(simulation, "temperature_carried");
  slab.all = misfit(slab.seen, [&](std::size_t p) { return series(slab.x[p], kEnd); });
  // At the centre itself, which no particle need be at: the series is even about it and flat there to 1e-3.
  double nearest = kLength;
  int count = 0;
  for (const double x : slab.x) nearest = std::min(nearest, std::abs(x - 0.5 * kLength));
  for (std::size_t p = 0; p < slab.x.size(); ++p) {
    if (std::abs(slab.x[p] - 0.5 * kLength) > nearest + 1e-6 * kLength) continue;
    slab.centre += slab.seen[p] - series(slab.x[p], kEnd) + series(0.5 * kLength, kEnd);
    ++count;
  }
  slab.centre /= count;
  return slab;
}

TEST(Conduction, SlabCools) {
  EXPECT_NEAR(series(0.5 * kLength, kEnd), 0.772312, 1e-6);  // the reference's figure
  Page page("transport", "conduction_slab", "A warm slab with cold faces");
  page.problem(
          "A slab of thickness L, 1 K warm, whose faces are held at 0 K from the start, as a line: 10, 20 and 40 cells "
          "of 2 particles, until D t / L² = 0.05. Errors are those of the nodes' temperature at the particles, over "
          "the 1 K of the start.")
      .exact("T = sum over odd m of 4/(mπ) sin(mπx/L) exp(-m²π²Dt/L²); 0.772312 K at the centre.",
             "Carslaw and Jaeger, Conduction of Heat in Solids (1959), section 3.3")
      .meaning(
          "Both shape functions give the same slab, since nothing moves. The temperature that particles carry scatters "
          "within a cell, most at the faces; what laws, properties and reports see does not.")
      .scene("conduction_slab");
  Panel& errors = page.figure().panel("Errors, root mean square", "cell / L", "error [K]").log_x().log_y().order(2.0);
  for (const std::string shape : {"ugimp", "cpdi"}) {
    const std::string name = shape == "ugimp" ? "uGIMP" : "CPDI";
    Numbers sizes, rms;
    std::vector<Cooled> runs;
    for (const int cells : {10, 20, 40}) {
      runs.push_back(cool(cells, {"method.shape=" + shape}));
      sizes.push_back(1.0 / cells);
      rms.push_back(runs.back().all.rms);
    }
    page.near("temperature of the centre, 20 cells, " + name, runs[1].centre, 0.772312, 0.005, "K");
    page.near_absolute("root mean square error, 20 cells, " + name, 100.0 * rms[1], 0.0, 0.5, "% of the start");
    page.report("largest error, 20 cells, " + name, 100.0 * runs[1].all.most, "% of the start");
    // Second order in the cell; a tenth lower because the grids are not yet fine.
    page.above("order of convergence, 10 to 20 cells, " + name, order_of_convergence(rms[0], rms[1]), 1.8, "");
    page.above("order of convergence, 20 to 40 cells, " + name, order_of_convergence(rms[1], rms[2]), 1.8, "");
    errors.points(name, sizes, rms);
    if (shape == "cpdi") continue;
    Numbers x, exact, mm;
    for (int i = 0; i <= 100; ++i) x.push_back(1e3 * kLength * i / 100), exact.push_back(series(1e-3 * x.back(), kEnd));
    for (const double at : runs[1].x) mm.push_back(1e3 * at);
    page.figure()
        .panel("Slab at D t / L² = 0.05, 20 cells", "x [mm]", "T [K]")
        .exact("series", x, exact)
        .points("seen by particles", mm, runs[1].seen)
        .points("carried", mm, runs[1].carried);
  }
}

TEST(Conduction, SlabByEachMethod) {
  Page page("transport", "conduction_methods", "The warm slab by each update and shape function");
  page.problem(
          "The slab above in 20 cells. Irregular particles are moved by up to 0.1 and 0.2 cells from their places.")
      .exact("0.772312 K at the centre at D t / L² = 0.05.", "the series above")
      .meaning(
          "When strains are updated makes no difference where nothing moves. `order: 1` loses more heat to faces that "
          "are held, which draw it from their particles more than once. Particles that are irregular by 0.2 cells "
          "leave "
          "0.6 %, since nodes no longer get the volume that is theirs. With B-splines a value that nodes hold is felt "
          "a "
          "quarter of a cell outside the face, where their sum passes through it: first order in the cell.")
      .scene("conduction_slab");
  Numbers cells, errors;
  const std::vector<std::pair<std::string, std::vector<std::string>>> methods = {
      {"USL", {"method.update=usl"}},
      {"USF", {"method.update=usf"}},
      {"USAVG", {"method.update=usavg"}},
      {"dirac", {"method.shape=dirac"}},
      {"three particles a cell", {"method.particles_per_cell=3"}}};
  for (const auto& [name, overrides] : methods) {
    const Cooled slab = cool(20, overrides);
    page.near("temperature of the centre, " + name, slab.centre, 0.772312, 0.005, "K");
    page.near_absolute("root mean square error, " + name, 100.0 * slab.all.rms, 0.0, 0.5, "% of the start");
  }
  for (const std::string shape : {"ugimp", "cpdi"}) {
    for (const double jitter : {0.1, 0.2}) {
      const Cooled slab = cool(20, {fmt::format("bodies.slab.jitter={}", jitter), "method.shape=" + shape});
      const std::string name = fmt::format("{}, particles up to {} cells off", shape, jitter);
      if (jitter > 0.1) {
        page.report("temperature of the centre, " + name, slab.centre, "K");
        page.report("root mean square error, " + name, 100.0 * slab.all.rms, "% of the start");
        continue;
      }
      page.near("temperature of the centre, " + name, slab.centre, 0.772312, 0.005, "K");
      page.near_absolute("root mean square error, " + name, 100.0 * slab.all.rms, 0.0, 0.5, "% of the start");
    }
  }
  for (const int cells : {20, 40}) {
    const Cooled slab = cool(cells, {"method.shape=bspline2"});
    page.report(fmt::format("root mean square error, quadratic B-splines, {} cells", cells), 100.0 * slab.all.rms, "%");
  }
  const Cooled first = cool(20, {"transport.temperature.order=1"});
  page.report("temperature of the centre, order 1", first.centre, "K");
  page.report("root mean square error, order 1", 100.0 * first.all.rms, "% of the start");
}

// For one material with one capacity, (6.22) and (6.24) are the same sum.
TEST(Conduction, ParticleCapacityIsNodalCapacityOfOrderOne) {
  const Numbers node = cool(20, {"transport.temperature.order=1"}).carried,
                particle = cool(20, {"transport.temperature.order=1", "transport.temperature.method=particle_capacity"})
                               .carried;
  for (std::size_t p = 0; p < node.size(); ++p) EXPECT_NEAR(particle[p], node[p], 1e-12) << p;
}

}  // namespace conduction_test
}  // namespace verification
