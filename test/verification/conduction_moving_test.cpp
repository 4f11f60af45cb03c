// A body that flies and one that spins conduct as one at rest: each particle has the temperature of the same particle
// of the body at rest. Heat is carried by particles, so motion over the grid adds no conduction of its own; how far
// that holds is measured here. A body at rest is itself within 0.5 % of the Gaussian that spreads, T = A / sqrt((1 + 4
// D t / a)(1 + 4 D t / b)) exp(-x^2 / (a + 4 D t) - z^2 / (b + 4 D t)) (Carslaw and Jaeger (1959), 10.3). Cost: 1 s.
#include <fmt/core.h>

#include "page.hpp"
#include "transport_run.hpp"

namespace verification {
namespace conduction_moving_test {

constexpr double kDiffusivity = 0.01;  // diffusivity of warm_block [m^2/s]

mpm::Simulation run(std::vector<std::string> overrides, double end) {
  mpm::Simulation simulation = start("warm_block", overrides, 1);
  run_until(simulation, end);
  EXPECT_LT(reported(simulation, "temperature budget error"), 1e-10);
  return simulation;
}

Numbers above(const mpm::Simulation& simulation, double level) {
  Numbers values = field(simulation, "temperature");
  for (double& value : values) value -= level;
  return values;
}

TEST(ConductionMoving, IsThatOfABodyAtRest) {
  Page page("transport", "conduction_moving", "Conduction in a body that moves");
  page.problem(
          "A square of rubber of 20 by 20 cells with a warm spot at rest; flying by 10 cells along each axis; and "
          "spinning through a whole turn. The spot spreads from 2 and 3 cells to twice its area. Errors are over the "
          "100 K of the spot at the start.")
      .exact("The particles of the body at rest; those near the Gaussian that spreads.",
             "frame indifference; Carslaw and Jaeger (1959), section 10.3")
      .scene("warm_block");
  constexpr double kEnd = 0.5;
  const std::vector<std::string> at_rest;
  mpm::Simulation rest = run(at_rest, kEnd);
  const Numbers reference = above(rest, 300.0), x = field(rest, "x"), z = field(rest, "z");
  const double a = 0.03, b = 0.015, grow = 4.0 * kDiffusivity * kEnd;
  const double top = 100.0 / std::sqrt((1.0 + grow / a) * (1.0 + grow / b));
  const Misfit gauss = misfit(reference, [&](std::size_t p) {
    return top * std::exp(-(x[p] - 0.1) * (x[p] - 0.1) / (a + grow) - z[p] * z[p] / (b + grow));
  });
  page.near_absolute("at rest: root mean square error to the Gaussian", gauss.rms, 0.0, 0.5, "% of the start");
  const std::vector<std::pair<std::string, std::string>> motions = {
      {"flying", "[1, '1']"}, {"spinning", "['-12.566370614*z', '12.566370614*x']"}};
  for (const auto& [name, velocity] : motions) {
    for (const std::string method : {"ugimp", "cpdi"}) {
      mpm::Simulation moving =
          run({"bodies.block.initial={velocity: " + velocity + "}", "method.shape=" + method}, kEnd);
      const Numbers values = above(moving, 300.0);
      const Misfit all = misfit(values, [&](std::size_t p) { return reference[p]; });
      page.near_absolute(name + ", " + method + ": root mean square difference to rest", all.rms, 0.0, 0.5,
                         "% of the start");
      page.report(name + ", " + method + ": largest difference to rest", all.most, "% of the start");
      if (name == "flying" || method == "ugimp") continue;
      page.figure().panel("At rest", "x [m]", "z [m]").particles("T - 300 K", x, z, reference);
      page.figure()
          .panel("After one turn, CPDI", "x [m]", "z [m]")
          .particles("T - 300 K", field(moving, "x"), field(moving, "z"), values);
    }
  }
  page.meaning("Motion over the grid adds no conduction that is to be seen.");
}

// A body that does not conduct keeps what its particles carry to the last bit, however it moves.
TEST(ConductionMoving, NothingFlowsWithoutConductivity) {
  mpm::Simulation simulation =
      start("warm_block", {"bodies.block.initial={velocity: [1, 0.5]}", "materials.rubber.conductivity=0"}, 1);
  const Numbers before = field(simulation, "temperature_carried");
  run_until(simulation, 0.2);
  EXPECT_EQ(field(simulation, "temperature_carried"), before);
}

}  // namespace conduction_moving_test
}  // namespace verification
