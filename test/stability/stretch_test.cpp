// Numerical fracture: how far a bar can be stretched before neighbouring particles share no node any more, although its
// material has no law of failure; and how far it can be compressed.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "bar_load.hpp"
#include "methods.hpp"
#include "page.hpp"

namespace stability {
namespace stretch_test {

using verification::Map;
using verification::Numbers;
using verification::Outcome;
using verification::Page;

constexpr double kPressSpeed = 0.02;  // speed of the bar's end over the wave speed
constexpr double kSwing = 0.5;
constexpr double kFast = 0.08;  // that of a bar that is pulled fast

/// The stretch s above which particles that touched at the start may share no node; infinite where domains follow the
/// stretch. Below it a node is in reach of both wherever they are in their cells: their distance s h / n is at most the
/// width of a support less one cell.
double parted(mpm::ShapeKind shape, int ppc) {
  const double n = ppc;
  switch (shape) {
    case mpm::ShapeKind::dirac:
      return n;
    case mpm::ShapeKind::ugimp:
      return n * (1.0 + 1.0 / n);
    case mpm::ShapeKind::bspline2:
      return 2.0 * n;
    case mpm::ShapeKind::bspline3:
      return 3.0 * n;
    default:
      return kInfinity;
  }
}

std::vector<Outcome> outcomes(const Map& map, const BarRun& run, double sign) {
  std::vector<Outcome> cells;
  for (const double row : map.rows()) {
    cells.push_back(sign * (row - run.reached) <= 0.006 ? Outcome::stable : Outcome::fails);
  }
  return cells;
}

TEST(Stretch, UntilTheBarParts) {
  Page page("strain", "stretch", "Numerical fracture in stretch");
  constexpr double kEnd = 5.0;
  page.problem(
          "A bar of 24 × 2 cells, neo-Hookean, ν = 0.3, confined sideways, is pulled by a load on its last third that "
          "balances the uniform stress of the rest; its end moves at 1 and at 8 % of the wave speed. 4 particles a "
          "cell, USAVG, FLIP. Broken: in the half away from the load neighbouring columns are twice as far apart as "
          "they should be or J is off by half, or the run ended with an error.")
      .exact(
          "x = s(t) X, J = s. Theory, an upper bound: from the stretch at which particles that touched at the start "
          "may share no node the bar cannot hold (Dirac 2, uGIMP 3, splines 4 and 6; none for domains that stretch). "
          "It is far above the stretch that is reached, so it is shown without a check. Asked: uGIMP breaks near 50 "
          "%, as is said of it, and CPDI bears 50 % as in Nairn & Guilkey's end-loaded cylinder, both pulled fast.",
          "equilibrium of uniform stress; supports of the shape functions; Nairn & Guilkey (2015) section 4.2")
      .meaning(
          "uGIMP is said to fail near 50 % of tension and CPDI beyond 200 %. When the bar is pulled fast, uGIMP "
          "fails at 62 % and CPDI at 130 %. Pulled slowly all fail near 30 %, including CPDI, far below the stretch "
          "at which supports part and although a uniform stress accelerates none of CPDI's particles (next section). "
          "Under tension small displacements of particles grow on the grid, and a slow pull gives them time: it is "
          "an instability, not a gap. XPIC and FMPM, which damp resolved motion least, fail first; a hundredth of "
          "PIC or APIC helps CPDI. Where material is stretched by more than a quarter, check that its columns of "
          "particles stay together.");
  Map map("stretch", {1.1, 1.2, 1.3, 1.4, 1.5, 1.75, 2.0, 2.5, 3.0, 4.0, 5.0});
  for (const double speed : {0.01, kFast}) {
    for (const Method& method : shapes()) {
      const std::string label = fmt::format("{}, {} %", method.name, 100.0 * speed);
      const mpm::SimulationDefinition d = loaded_bar(method.definition, speed, kEnd);
      if (!possible(d, method.definition)) {
        map.impossible(label);
        continue;
      }
      const BarRun run = run_bar(d, speed, kEnd, kSwing);
      const double limit = parted(method.definition.shape, method.definition.particles_per_direction);
      verification::MapColumn& column = map.column(label, outcomes(map, run, 1.0));
      if (run.broke()) column.breaks_at(run.reached);
      if (std::isfinite(limit)) {
        column.theory(limit);
        page.beside("stretch reached, " + label + run.end() + ", beside that at which supports part", run.reached,
                    limit, "");
      } else {
        page.report("stretch reached, " + label + run.end(), run.reached, "");
      }
      if (speed < kFast) continue;
      if (method.definition.shape == mpm::ShapeKind::ugimp) {
        page.near("uGIMP, pulled fast, beside the 50 % of the literature", run.reached, 1.5, 0.15, "");
      } else if (method.definition.shape == mpm::ShapeKind::cpdi) {
        page.above("CPDI, pulled fast: the stretch that the paper's cylinder was drawn to", run.reached, 1.5, "");
      }
    }
  }
  page.figure().panel("Shape functions: the bar holds together", "", "").map(map);

  Map others("stretch", map.rows());
  for (const auto shape : {mpm::ShapeKind::ugimp, mpm::ShapeKind::cpdi}) {
    for (const Method& method : transfers(shape)) {
      const std::string label = fmt::format("{}, {}", method.name, mpm::shape_name(shape));
      const mpm::SimulationDefinition d = loaded_bar(method.definition, kFast, kEnd);
      if (!possible(d, method.definition)) {
        others.impossible(label);
        continue;
      }
      const BarRun run = run_bar(d, kFast, kEnd, kSwing);
      verification::MapColumn& column = others.column(label, outcomes(others, run, 1.0));
      if (run.broke()) column.breaks_at(run.reached);
      page.report("stretch reached at 8 %, " + label + run.end(), run.reached, "");
    }
  }
  page.figure().panel("Transfers, at 8 % of the wave speed", "", "").map(others);
}

TEST(Compression, DownToATwelfthOfTheLength) {
  Page page("strain", "compression", "Compression");
  constexpr double kEnd = 0.08;
  page.problem(
          "The same bar is compressed at a fiftieth of the wave speed by a load on its last third. Broken: columns "
          "are twice as far apart as they should be, J is off by half, or the run ended with an error.")
      .exact("x = s(t) X, J = s.", "equilibrium of uniform stress")
      .meaning(
          "Nairn & Guilkey (2015) 4.1 compress a disk along its radius; there uGIMP works to 84 % of volume and "
          "breaks at 88 %, and CPDI works to about 93 %. That is an axisymmetric problem with its axis; the numbers "
          "show the order of magnitude. Here splines hold to a twelfth of the length. With FLIP, domains hold to a "
          "third, whether they follow the deformation or not; CPDI with XPIC(2), FMPM(2) or APIC also holds to a "
          "twelfth. PIC does not help, and high orders of XPIC and FMPM are worse than FLIP.");
  Map map("stretch", {0.08, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9});
  for (const int ppc : {2, 3}) {
    for (Method method : shapes()) {
      method.definition.particles_per_direction = ppc;
      const std::string label = fmt::format("{}, {}", method.name, ppc * ppc);
      const mpm::SimulationDefinition d = loaded_bar(method.definition, -kPressSpeed, 1.0);
      if (!possible(d, method.definition)) {
        map.impossible(label);
        continue;
      }
      const BarRun run = run_bar(d, -kPressSpeed, kEnd, kSwing);
      verification::MapColumn& column = map.column(label, outcomes(map, run, -1.0));
      if (run.broke()) column.breaks_at(run.reached);
      if (method.definition.shape == mpm::ShapeKind::dirac) {
        page.report("stretch reached, " + label + run.end(), run.reached, "");
      } else {
        // Half of the length, far from the 0.16 that Nairn & Guilkey reached with uGIMP.
        page.below("stretch reached, " + label + run.end(), run.reached, 0.5, "");
      }
    }
  }
  page.figure().panel("Shape functions: the bar stays sound", "", "").map(map);

  Map others("stretch", map.rows());
  for (const auto shape : {mpm::ShapeKind::ugimp, mpm::ShapeKind::cpdi}) {
    for (const Method& method : transfers(shape)) {
      const std::string label = fmt::format("{}, {}", method.name, mpm::shape_name(shape));
      const mpm::SimulationDefinition d = loaded_bar(method.definition, -kPressSpeed, 1.0);
      if (!possible(d, method.definition)) {
        others.impossible(label);
        continue;
      }
      const BarRun run = run_bar(d, -kPressSpeed, kEnd, kSwing);
      verification::MapColumn& column = others.column(label, outcomes(others, run, -1.0));
      if (run.broke()) column.breaks_at(run.reached);
      page.report("stretch reached, " + label + run.end(), run.reached, "");
    }
  }
  page.figure().panel("Transfers", "", "").map(others);
}

}  // namespace stretch_test
}  // namespace stability
