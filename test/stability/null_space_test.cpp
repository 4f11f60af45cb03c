// Motion of particles that the grid cannot see: velocities that alternate from particle to particle have almost no mean
// at any node. FLIP preserves them, PIC and related transfers remove them. Theory: the one-step matrix of
// linear_step.hpp, which contains only the equations of the method, applied as often as the solver steps.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "linear_step.hpp"
#include "methods.hpp"
#include "page.hpp"
#include "probe.hpp"
#include "scenes.hpp"

namespace stability {
namespace null_space_test {

using verification::Map;
using verification::Numbers;
using verification::Outcome;
using verification::Page;

constexpr double kPoisson = 0.3;
constexpr double kCourant = 0.5;
constexpr double kLow = 4.0, kEdge = 4.0;  // corner and edge of the block [cells]
constexpr double kGone = 0.1;              // part of the motion below which it counts as gone
const double kSpeed = 1e-11 * kWaveSpeed;

// +1 and -1 alternating along x and z.
double sign(const Vec3& place) {
  const auto row = [](double x) { return std::lround(2.0 * (x / kCell - kLow) - 0.5); };
  return (row(place.x()) + row(place.z())) % 2 == 0 ? 1.0 : -1.0;
}

mpm::SimulationDefinition block(const mpm::MethodDefinition& method) {
  mpm::SimulationDefinition d = domain(method, Vec3::Zero(), {12.0, 0.0, 12.0}, 1e-3);
  add_body(d, "block", {kLow, 0.0, kLow}, {kLow + kEdge, 0.0, kLow + kEdge}, linear_elastic(kPoisson),
           [](const Vec3& x) -> Vec3 { return kSpeed * sign(x) * Vec3::UnitX(); });
  return d;
}

/// Remaining part of the alternating motion after each number of steps, in the solver and in theory.
struct Left {
  Numbers solver, theory;
};
Left ring(const mpm::SimulationDefinition& d, const std::vector<int>& steps) {
  const std::vector<Vec3>& places = d.bodies[0].positions;
  const Eigen::Index n = static_cast<Eigen::Index>(places.size());
  std::vector<LinearStep::Place> in_cells;
  Eigen::VectorXd pattern(n);
  for (Eigen::Index p = 0; p < n; ++p) {
    in_cells.push_back({places[p].x() / kCell, places[p].z() / kCell});
    pattern[p] = sign(places[p]);
  }
  const LinearStep theory(d.method, in_cells, kPoisson);
  Eigen::VectorXd state = Eigen::VectorXd::Zero(theory.states());
  state.head(n) = pattern;
  Probe probe(d);
  Left left;
  int done = 0;
  for (const int until : steps) {
    for (; done < until; ++done) {
      probe.step(kCourant * kCell / kWaveSpeed);
      state = theory.one_step(state, kCourant);
    }
    const std::vector<double> v = field(probe.simulation(), "vx");
    double sum = 0.0;
    for (Eigen::Index p = 0; p < n; ++p) sum += pattern[p] * v[p] / kSpeed;
    left.solver.push_back(sum / static_cast<double>(n));
    left.theory.push_back(pattern.dot(state.head(n)) / static_cast<double>(n));
  }
  return left;
}

TEST(NullSpace, IsKeptByFlipAlone) {
  Page page("ringing", "null_space", "Motion that the grid does not see");
  page.problem(
          "A free block of 4 × 4 cells, 4 particles a cell, whose neighbouring particles move in opposite "
          "directions, which the grid hardly resolves. The Courant number is a half. Cells: a tenth or less is left.")
      .exact("The one-step matrix, applied once for each step.",
             "PIC: Nairn, GIMP notes (2.17)-(2.22); XPIC: Hammerquist and Nairn (2017); FMPM: Nairn and Hammerquist "
             "(2021)")
      .meaning(
          "The grid cannot stop motion that it does not resolve: with FLIP this noise stays, and it affects "
          "positions and stresses of particles. PIC removes it in the first step, together with a part of the real "
          "motion. XPIC and FMPM remove it in the first step, too, and keep more of the real motion the higher their "
          "order.");
  const std::vector<int> steps = {1, 2, 5, 10, 20, 50, 100};
  Map map("steps", Numbers(steps.begin(), steps.end()));
  for (const auto shape : {mpm::ShapeKind::ugimp, mpm::ShapeKind::bspline2}) {
    for (const Method& method : transfers(shape)) {
      const std::string label = fmt::format("{}, {}", method.name, mpm::shape_name(shape));
      const mpm::SimulationDefinition d = block(method.definition);
      if (!possible(d, method.definition)) {
        map.impossible(label);
        continue;
      }
      const Left left = ring(d, steps);
      std::vector<Outcome> cells;
      for (std::size_t i = 0; i < steps.size(); ++i) {
        // Velocities are 1e-11 of the wave speed: motion in 100 steps changes weights by 1e-9.
        EXPECT_NEAR(left.solver[i], left.theory[i], 1e-8) << label << " after " << steps[i];
        cells.push_back(std::abs(left.solver[i]) < kGone ? Outcome::stable : Outcome::fails);
      }
      map.column(label, cells);
      page.near_absolute("left after 100 steps, " + label, left.solver.back(), left.theory.back(), 1e-8, "");
    }
  }
  page.figure().panel("The unseen motion has gone", "", "").map(map);
}

}  // namespace null_space_test
}  // namespace stability
