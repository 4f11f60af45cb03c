// The largest stable time step, as a Courant number c dt / h with c the speed of pressure waves. A free block gets
// small random velocities: it is unstable if the sum of v^2 grows a millionfold, velocity a thousandfold, within 300
// steps. Theory: the one-step matrix of linear_step.hpp. A simulation itself refuses a Courant number above 1.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <random>

#include "linear_step.hpp"
#include "methods.hpp"
#include "page.hpp"
#include "probe.hpp"
#include "scenes.hpp"

namespace stability {
namespace time_step_test {

using verification::Map;
using verification::Numbers;
using verification::Outcome;
using verification::Page;

constexpr double kPoisson = 0.3;
constexpr int kEdge = 3;        // cells along an edge of the block
constexpr double kStart = 4.0;  // position of its corner when aligned with the grid [cells]
constexpr int kHeldEdge = 5;    // cells along an edge of a block between walls
constexpr int kSteps = 300;
constexpr double kGrowth = 1e6;
constexpr double kSearch = 0.004;  // relative accuracy of bisection
constexpr double kLargest = 6.0;   // largest Courant number that is tried

/// A block of `edge` cells whose lower corner lies at kStart + `shift` along x and z [cells], in random motion.
mpm::SimulationDefinition block(const mpm::MethodDefinition& method, double shift, int edge = kEdge) {
  mpm::SimulationDefinition d = domain(method, Vec3::Zero(), {12.0, 0.0, 12.0}, 1e-3);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  // The block is so slow that nothing moves by more than 1e-6 of a cell while velocities grow a thousandfold.
  const double speed = 1e-11 * kWaveSpeed;
  const double low = kStart + shift;
  add_body(d, "block", {low, 0.0, low}, {low + edge, 0.0, low + edge}, linear_elastic(kPoisson),
           [&](const Vec3&) { return Vec3(speed * u(random), 0.0, speed * u(random)); });
  return d;
}

/// A block that fills a domain with fixed walls.
mpm::SimulationDefinition held_block(const mpm::MethodDefinition& method) {
  mpm::SimulationDefinition d = block(method, 0.0, kHeldEdge);
  d.grid.min = Vec3::Constant(kCell * kStart);
  d.grid.max = Vec3::Constant(kCell * (kStart + kHeldEdge));
  wall(d, {"x_min", "x_max", "z_min", "z_max"}, mpm::WallKind::fixed);
  return d;
}

std::vector<LinearStep::Place> places(const mpm::SimulationDefinition& d) {
  std::vector<LinearStep::Place> list;
  for (const Vec3& x : d.bodies[0].positions) list.push_back({x.x() / kCell, x.z() / kCell});
  return list;
}

bool stable(const mpm::SimulationDefinition& d, double courant) {
  Probe probe(d);
  const double start = probe.motion();
  try {
    for (int i = 0; i < kSteps; ++i) {
      probe.step(courant * kCell / kWaveSpeed);
      if (!(probe.motion() < kGrowth * start)) return false;
    }
  } catch (const mpm::PhysicsError&) {
    return false;
  }
  return true;
}

double measured(const mpm::SimulationDefinition& d) {
  return breaking_point(0.05, kLargest, kSearch, [&](double courant) { return stable(d, courant); });
}

/// True if the one-step matrix is stable: a random motion is stepped as often.
bool stable(const LinearStep& step, double dt) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Eigen::VectorXd state = Eigen::VectorXd::Zero(step.states());
  const Eigen::Index velocities = 2 * step.particles();
  for (Eigen::Index i = 0; i < velocities; ++i) state[i] = u(random);
  const double start = state.squaredNorm();
  for (int i = 0; i < kSteps; ++i) {
    state = step.one_step(state, dt);
    if (!(state.head(velocities).squaredNorm() < kGrowth * start)) return false;
  }
  return true;
}

double theory(const mpm::SimulationDefinition& d) {
  const bool walls = d.walls[0].kind == mpm::WallKind::fixed;
  const LinearStep step(d.method, places(d), kPoisson,
                        walls ? std::array{kStart, kStart + kHeldEdge} : LinearStep::kFree);
  const mpm::Transfer& transfer = d.method.transfer;
  if (!walls && transfer.kind == mpm::TransferKind::flip && transfer.flip == 1.0) return step.flip_limit();
  return breaking_point(0.05, kLargest, kSearch, [&](double dt) { return stable(step, dt); });
}

std::vector<Outcome> outcomes(const Map& map, const mpm::SimulationDefinition& d) {
  std::vector<Outcome> cells;
  for (const double courant : map.rows()) {
    cells.push_back(stable(d, courant) ? Outcome::stable : Outcome::fails);
  }
  return cells;
}

/// A column of the map, checked against theory: 1 %, twice the accuracy of both bisections plus the effect of the
/// growth criterion near the limit.
void compare(Page& page, Map& map, const std::string& label, const mpm::SimulationDefinition& d) {
  if (!possible(d, d.method)) {
    map.impossible(label);
    return;
  }
  const double found = measured(d), expected = theory(d);
  map.column(label, outcomes(map, d)).breaks_at(found).theory(expected);
  page.near("critical Courant number, " + label, found, expected, 0.01, "");
}

const Numbers kRows = {0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0, 2.5};

TEST(TimeStep, OfShapesAndParticlesInACell) {
  Page page("time_step", "time_step_shapes", "The largest stable time step: shape functions");
  page.problem(
          "A free block of 3 × 3 cells, and one of 5 × 5 cells between walls that hold it, linear elastic, ν = 0.3, "
          "plane "
          "strain, lattice aligned with the grid, gets random velocities of 1e-11 of the wave speed. Broken: "
          "velocities "
          "grow a thousandfold in 300 steps. 1, 4 and 9 particles a cell, USAVG and FLIP.")
      .exact(
          "dt = 2/ω with ω² the largest eigenvalue of M⁻¹CM⁻¹K, M the lumped and C the consistent mass of the grid, "
          "K its stiffness. Between walls, which also stop the momentum of their nodes, the one-step matrix is "
          "applied once for each step.",
          "derived in test/stability/linear_step.hpp from the passes of a step")
      .meaning(
          "Averaging over particles softens the fastest modes, so that FLIP is stable up to 1.3 cells a step with "
          "any shape function, and up to two with splines. A row of nodes at the surface costs a tenth.");
  Map free("Courant number c Δt / h", kRows), held("Courant number c Δt / h", kRows);
  for (Method method : shapes()) {
    for (const int ppc : {1, 2, 3}) {
      method.definition.particles_per_direction = ppc;
      const std::string label = fmt::format("{}, {}", method.name, ppc * ppc);
      compare(page, free, label, block(method.definition, 0.0));
      compare(page, held, label + ", between walls", held_block(method.definition));
    }
  }
  page.figure().panel("A free block: its surface is in it", "", "").map(free);
  page.figure().panel("Between walls: the inside alone", "", "").map(held);
}

TEST(TimeStep, OfUpdatesAndTransfers) {
  Page page("time_step", "time_step_transfers", "The largest stable time step: updates and transfers");
  page.problem("The block of the section before, 4 particles a cell, uGIMP.")
      .exact(
          "The three updates apply the same two changes, of stress and of velocity, in another order: their one-step "
          "matrices are similar, and they have one limit. For transfers: the time step at which an eigenvalue of the "
          "one-step matrix leaves the circle that is stable by the criterion.",
          "derived in test/stability/linear_step.hpp from the passes of a step")
      .meaning(
          "The update does not affect the largest time step. PIC and its relatives have lower limits than FLIP: 1.4 "
          "for PIC, 1.2 for FMPM(2), and less the higher the order of FMPM.");
  Map map("Courant number c Δt / h", kRows);
  for (const Method& method : updates()) compare(page, map, "FLIP, " + method.name, block(method.definition, 0.0));
  for (const auto update : {mpm::UpdateScheme::usf, mpm::UpdateScheme::usl, mpm::UpdateScheme::usavg}) {
    for (const Method& method : transfers(mpm::ShapeKind::ugimp, update)) {
      if (method.name == "FLIP") continue;
      const std::string label = method.name + ", " + mpm::kUpdateNames[static_cast<int>(update)];
      compare(page, map, label, block(method.definition, 0.0));
    }
  }
  page.figure().panel("Updates and transfers", "", "").map(map);
}

// A block whose edge lies slightly beyond a row of nodes gives them hardly any mass.
TEST(TimeStep, OfABlockAboutToLeaveItsCells) {
  Page page("time_step", "time_step_offset", "The largest stable time step: nodes with little mass");
  page.problem(
          "The free block is moved over the grid along x and z: the outermost nodes that it reaches have a mass that "
          "goes down to 1e-6 of a particle's. USAVG; FLIP with 4 particles a cell, FMPM(5) and APIC with 4 and 9.")
      .exact("As in the first section, for each place.", "derived in test/stability/linear_step.hpp")
      .meaning(
          "Little mass at a node does not lower the limit of FLIP: a node's velocity is a mean of its particles' "
          "velocities, however small its mass, and its acceleration reaches particles with an equally small weight. "
          "This holds for strain from velocities gathered anew (modified USL); original USL, which takes the strain "
          "from the updated nodes, is not offered. APIC extrapolates velocities to nodes beyond the block by their "
          "gradient and has a lower limit: three quarters of a cell a step with uGIMP and 9 particles a cell, below "
          "the Courant number of 1 that the solver's own check allows. Stay at `time.cfl` 0.7 or less with it.");
  std::vector<Method> list = shapes();
  for (const int ppc : {2, 3}) {
    for (Method method : transfers()) {
      if (method.name != "FMPM(5)" && method.name != "APIC") continue;
      method.definition.particles_per_direction = ppc;
      method.name = fmt::format("{}, ugimp, {}", method.name, ppc * ppc);
      list.push_back(method);
    }
  }
  verification::Panel& panel =
      page.figure().panel("Marks: measured", "the block's place in the cells", "critical Courant number");
  const Numbers offsets = {0.0, 0.1, 0.2, 0.249, 0.251, 0.3, 0.4, 0.5, 0.6, 0.7, 0.749, 0.751, 0.8, 0.9, 0.999};
  for (const Method& method : list) {
    if (!possible(block(method.definition, 0.0), method.definition)) continue;
    Numbers found, expected;
    for (const double offset : offsets) {
      const mpm::SimulationDefinition d = block(method.definition, offset);
      found.push_back(measured(d));
      expected.push_back(theory(d));
      EXPECT_NEAR(found.back(), expected.back(), 0.01 * expected.back()) << method.name << " at " << offset;
    }
    panel.exact(&method == &list.front() ? "theory" : "_", offsets, expected).points(method.name, offsets, found);
    page.near("lowest critical Courant number, " + method.name, *std::min_element(found.begin(), found.end()),
              *std::min_element(expected.begin(), expected.end()), 0.01, "");
  }
}

}  // namespace time_step_test
}  // namespace stability
