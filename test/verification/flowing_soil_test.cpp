// Soil that flows evenly for thousands of steps has one stress in a cell (mechanics/stress_average.hpp). A cell with
// one stress does not resist motions that leave its mean strain alone: does such a motion grow?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "page.hpp"
#include "scene_run.hpp"

namespace flowing_soil_test {

using verification::Numbers;

constexpr double kCell = 0.05, kSpacing = 0.5 * kCell;  // [m]

struct Places {
  explicit Places(const mpm::Simulation& simulation)
      : x(verification::field(simulation, "x")), z(verification::field(simulation, "z")) {}
  Numbers x, z;
};

/// Amplitude in cells of the displacement that is opposite from one particle to the next along both axes, in groups of
/// two by two, in the mean over those that begin with an even (0) or odd (1) particle.
double hourglass(const Places& start, const Places& now, int first) {
  std::map<std::pair<long, long>, std::size_t> at;
  for (std::size_t p = 0; p < start.x.size(); ++p) {
    at[{std::lround(start.x[p] / kSpacing - 0.5), std::lround(start.z[p] / kSpacing - 0.5)}] = p;
  }
  double squares = 0.0;
  int count = 0;
  for (const auto& [place, p] : at) {
    const auto [i, j] = place;
    if (i % 2 != first || j % 2 != first) continue;
    const auto right = at.find({i + 1, j}), above = at.find({i, j + 1}), across = at.find({i + 1, j + 1});
    if (right == at.end() || above == at.end() || across == at.end()) continue;
    for (const Numbers Places::*axis : {&Places::x, &Places::z}) {
      const auto moved = [&](std::size_t q) { return (now.*axis)[q] - (start.*axis)[q]; };
      squares += std::pow(0.25 * (moved(p) - moved(right->second) - moved(above->second) + moved(across->second)), 2);
    }
    ++count;
  }
  return std::sqrt(squares / count) / kCell;
}

// About 5,600 steps, a second.
TEST(FlowingSoil, NoMotionThatACellDoesNotSeeGrows) {
  verification::Page page("soil", "flowing_soil", "Sand that flows evenly for 5,600 steps: no spurious motion");
  page.problem(
          "Sand (φ = 30°, ψ = 10°, E = 4 MPa, ν = 0.1) in an oedometer of 8 by 8 cells yields from the start. Its "
          "velocity "
          "begins with a ripple of 1 cm/s, two and a half times the plate's speed, that changes its sign from node to "
          "node, which a cell with one stress does not see. The amplitude of this motion in the displacement is "
          "measured "
          "within the cells and around the nodes.")
      .exact("The even flow is unique, for sand between walls cannot go aside: the motion must not grow.",
             "Uniqueness of the confined problem")
      .scene("flowing_soil.yaml");
  mpm::Simulation run = verification::start("flowing_soil");
  const Places start(run);
  verification::run_until(run, 0.23);
  const Places early(run);
  verification::run_until(run, 2.3);
  const Places late(run);
  for (const int first : {0, 1}) {
    const std::string where = first == 0 ? "in cells" : "around nodes";
    const double then = hourglass(start, early, first), now = hourglass(start, late, first);
    page.beside("amplitude " + where + " at 0.23 s, beside that at 2.3 s", 1e6 * then, 1e6 * now, "1e-6 cells");
    // Round-off of the ratio of two small numbers is no matter: 1e-5 cells are the strain of 0.1 kPa.
    EXPECT_LT(now, 1.5 * then + 1e-6) << where;
  }
  // It has flowed: plastic strain of the order of the strain of the plate, 2.3 %.
  double least = 1.0;
  for (const double strain : verification::field(run, "ep")) least = std::min(least, strain);
  page.above("least plastic strain", least, 0.01, "1");
}

}  // namespace flowing_soil_test
