// Order of convergence of each method on the suites of the work-precision study (mpm/study): the manufactured problem
// along the axes, with the displacement's RMS error over all particles and directions, the largest value of one period,
// and a time step that is divided by four when the cell is halved, so that errors in time and space decrease equally.
//
// In theory, shape functions that reproduce linear fields are of second order on smooth problems of small strain; the
// project requires 1.8. At a strain of 0.16 boxes of fixed size overlap or leave gaps, and uGIMP stalls, while domains
// that follow the deformation continue to converge: method reference 15 has the figures of a one-dimensional trial, at
// a fixed Courant number and with another neo-Hookean law.
#include <fmt/core.h>

#include <algorithm>

#include "page.hpp"
#include "study/problems.hpp"
#include "study/runner.hpp"

namespace verification {
namespace method_order_test {

using mpm::ShapeKind;
using mpm::Transfer;
using mpm::TransferKind;
using mpm::UpdateScheme;

constexpr double kAsked = 1.8;

struct Errors {
  std::string label;
  std::vector<int> cells;
  Numbers error;
  double order(std::size_t i) const { return std::log2(error[i - 1] / error[i]); }
};

/// Errors on grids that are refined by two.
Errors measure(const std::string& suite, ShapeKind shape, const Transfer& transfer, const std::vector<int>& cells) {
  const mpm::choice::MethodChoice choice = mpm::choice::choose(shape, UpdateScheme::usavg, transfer);
  Errors found = {choice.label, cells, {}};
  for (const int count : cells) {
    mpm::study::Discretisation discretisation = {count, 0.9, 2, 0.04 * 64.0 / (count * count)};
    const mpm::study::Suite& problem = mpm::study::find_suite(suite);
    mpm::Simulation simulation(problem.definition(choice.method, discretisation), mpm::SimulationOptions{1});
    const auto measured = problem.measure();
    measured->look(simulation);
    const auto end = static_cast<std::int64_t>(std::llround(1e9 * simulation.definition().time.end));
    while (simulation.time() < end) {
      simulation.advance();
      measured->look(simulation);
    }
    found.error.push_back(measured->error());
  }
  return found;
}

void show(Page& page, Panel& panel, const Errors& found) {
  Numbers cell;
  for (std::size_t i = 0; i < found.cells.size(); ++i) {
    cell.push_back(1.0 / found.cells[i]);
    page.report(fmt::format("{}, {} cells: RMS error over A", found.label, found.cells[i]), found.error[i], "");
  }
  panel.points(found.label, cell, found.error);
}

/// Checks that the order between each grid and the next reaches the required one.
void expect_order(Page& page, const Errors& found) {
  for (std::size_t i = 1; i < found.cells.size(); ++i) {
    page.above(fmt::format("{}: order, {} to {} cells", found.label, found.cells[i - 1], found.cells[i]),
               found.order(i), kAsked, "");
  }
}

const char* const kExact = "u = ± A sin(πX) sin(πt) along each axis; the body force follows from ρ₀ü = Div P + ρ₀b.";

TEST(MethodOrder, SecondOrderAtSmallStrain) {
  Page page("waves", "method_order", "Order of convergence by shape function");
  page.problem(
          "The manufactured problem in the plane, A = 0.001: a unit square between smooth walls is driven along its "
          "axes for one period. USAVG, FLIP, 2 × 2 particles a cell, a time step of 2.56 s (h/m)².")
      .exact(kExact, "the kind of problem that Wallstedt and Guilkey use")
      .meaning("Each of these shape functions is of second order where strain is small.");
  Panel& panel = page.figure().panel("A = 0.001", "cell [m]", "largest RMS error over A").log_x().log_y().order(2.0);
  for (const ShapeKind shape : {ShapeKind::ugimp, ShapeKind::cpdi, ShapeKind::bspline2, ShapeKind::bspline3}) {
    const Errors found = measure("square_small", shape, {}, {8, 16, 32});
    show(page, panel, found);
    expect_order(page, found);
  }
}

TEST(MethodOrder, DomainsThatFollowTheDeformationKeepItAtLargeStrain) {
  Page page("waves", "method_order_large", "The same at large strain");
  page.problem(
          "The manufactured problem along a bar of unit length, A = 0.05: strain reaches 0.16, and particles cross "
          "cells on the finer grids. USAVG, FLIP, 2 particles a cell along the bar, a time step of 2.56 s (h/m)².")
      .exact(kExact, "the kind of problem that Wallstedt and Guilkey use")
      .meaning(
          "uGIMP's boxes keep their size, so they overlap where material is compressed and leave gaps where it is "
          "stretched: its error stops falling. With boxes and parallelograms that follow the deformation it "
          "continues to fall.");
  Panel& panel = page.figure().panel("A = 0.05", "cell [m]", "largest RMS error over A").log_x().log_y().order(2.0);
  const std::vector<int> cells = {8, 16, 32, 64};
  const Errors fixed = measure("bar_crossing", ShapeKind::ugimp, {}, cells);
  show(page, panel, fixed);
  for (const ShapeKind shape : {ShapeKind::ugimp_stretch, ShapeKind::cpdi}) {
    const Errors found = measure("bar_crossing", shape, {}, cells);
    show(page, panel, found);
    expect_order(page, found);
    // On the finest grid one method stalls and the other does not. No theory states by how much; a factor of two is
    // clear.
    page.below(fmt::format("{}: error over that of uGIMP, 64 cells", found.label), found.error[3] / fixed.error[3], 0.5,
               "");
  }
  // An independent code in one dimension had 1.9, 1.5 and 0.9 on these grids: an order below 1.5 is not second order.
  page.below("ugimp: order, 32 to 64 cells", fixed.order(3), 1.5, "");
  page.beside("ugimp/usavg/flip: order, 32 to 64 cells, beside an independent code's in one dimension", fixed.order(3),
              0.9, "");
}

TEST(MethodOrder, SecondOrderFmpmIsNoWorseThanFlip) {
  Page page("waves", "method_order_fmpm", "FMPM(2) against FLIP");
  page.problem("The bar of the section before, with boxes that follow the deformation: FLIP, and FMPM of order 2.")
      .exact(kExact, "the kind of problem that Wallstedt and Guilkey use")
      .meaning("FMPM(2) filters motion that the grid does not resolve, without a loss of accuracy.");
  Panel& panel = page.figure().panel("A = 0.05", "cell [m]", "largest RMS error over A").log_x().log_y().order(2.0);
  const Errors flip = measure("bar_crossing", ShapeKind::ugimp_stretch, {}, {8, 16, 32, 64});
  const Errors fmpm = measure("bar_crossing", ShapeKind::ugimp_stretch, {TransferKind::fmpm, 1.0, 2}, {8, 16, 32, 64});
  show(page, panel, flip);
  show(page, panel, fmpm);
  for (std::size_t i = 0; i < flip.cells.size(); ++i) {
    page.below(fmt::format("error of FMPM(2) over that of FLIP, {} cells", flip.cells[i]),
               fmpm.error[i] / flip.error[i], 1.0, "");
  }
}

}  // namespace method_order_test
}  // namespace verification
