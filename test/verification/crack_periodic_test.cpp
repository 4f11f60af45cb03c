// Cracks in a body that goes around a periodic axis: where the domain's faces lie changes nothing, and a crack that
// comes near them is refused.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mpm/scene/scene.hpp"
#include "scene_run.hpp"

namespace verification {
namespace crack_periodic_test {

constexpr double kPeriod = 6.0;  // along x [m]

/// A plate that fills the period, with a crack from its lower edge at x = `crack`; its motion is that of a plate whose
/// crack is at 1.5625, moved along. Lengths that binary numbers hold exactly. `drift`: velocity along x [m/s].
std::string plate(double crack, double drift = 0.0) {
  return fmt::format(
      "geometry: plane_strain\ngrid: {{cell: 0.125, min: [0, -0.75], max: [{0}, 2.25]}}\n"
      "time: {{end: 2, sync: 5 ms, cfl: 0.4}}\nmethod: {{shape: ugimp, update: usavg, transfer: flip}}\n"
      "materials: [{{name: rubber, density: 1000, law: linear_elastic, young: 100 kPa, poisson: 0.3}}]\n"
      "bodies: [{{name: plate, material: rubber, shape: {{box: {{min: [0, 0], max: [{0}, 1.5]}}}}, initial: "
      "{{velocity: "
      "[\"{2}+0.02*sin(2*pi*(x-{1})/{0})\", \"0.01*cos(2*pi*(x-{1})/{0})\"]}}}}]\nboundaries: {{x: periodic}}\n"
      "cracks: {{list: [{{name: notch, line: {{from: [{1}, 0.04], to: [{1}, 0.77]}}, start: exterior, end: tip}}]}}\n",
      kPeriod, crack, drift);
}

mpm::Simulation simulation_of(const std::string& scene) {
  return mpm::Simulation(mpm::parse_scene(scene, "plate.yaml"), {2});
}

/// A field by the particles' places at the start, `x` of them moved back by `shift` [m] into the period.
std::map<std::pair<double, double>, double> by_place(const mpm::Simulation& run, const std::vector<double>& x,
                                                     const std::vector<double>& z, const char* name, double shift) {
  const std::vector<double> values = field(run, name);
  std::map<std::pair<double, double>, double> found;
  for (std::size_t p = 0; p < values.size(); ++p) {
    const double back = x[p] - shift;
    found[{back < 0.0 ? back + kPeriod : back, z[p]}] = values[p];
  }
  return found;
}

// Twins that are half a period apart: what one has in the middle of the domain the other has at its faces. Strains are
// 1e-3, stresses 1e2 Pa. About 4 s.
TEST(CrackPeriodic, TheDomainsFacesDoNotMatter) {
  mpm::Simulation one = simulation_of(plate(1.5625)), twin = simulation_of(plate(1.5625 + kPeriod / 2));
  const std::vector<double> x = field(one, "x"), z = field(one, "z"), other_x = field(twin, "x"),
                            other_z = field(twin, "z");
  run_until(one, 0.2);
  run_until(twin, 0.2);
  const double j = number(one, "crack 1 end j");
  EXPECT_GT(j, 1e-4);
  EXPECT_NEAR(number(twin, "crack 1 end j") / j, 1.0, 1e-8);
  EXPECT_NEAR(number(twin, "crack 1 end opening") / number(one, "crack 1 end opening"), 1.0, 1e-8);
  for (const char* name : {"vx", "vz", "sxx", "sxz"}) {
    const auto values = by_place(one, x, z, name, 0.0), others = by_place(twin, other_x, other_z, name, kPeriod / 2);
    double most = 0.0, scale = 0.0;
    for (const auto& [place, value] : values) {
      most = std::max(most, std::abs(value - others.at(place)));
      scale = std::max(scale, std::abs(value));
    }
    EXPECT_LT(most, 1e-9 * scale) << name;
  }
}

/// Error of a scene that does not begin, or of a run that ends early.
std::string fault_of(const std::string& scene, double end) {
  try {
    mpm::Simulation run = simulation_of(scene);
    run_until(run, end);
  } catch (const mpm::Error& error) {
    return error.what();
  }
  return "no error";
}

// Contours are 3 cells wide, and 4 cells more are what particles at the face reach: 7 cells, 0.875 m. About 1 s.
TEST(CrackPeriodic, ACrackThatComesToAFaceIsRefused) {
  const std::string near = fault_of(plate(0.8125), 0.01);
  EXPECT_NE(near.find("crack 'notch': the contour of its tip at (0.8125, 0.77) m is nearer than 7 cells to x_min"),
            std::string::npos)
      << near;
  EXPECT_EQ(fault_of(plate(0.9375), 0.01), "no error");
  const std::string drifts = fault_of(plate(5.0, 2.0), 0.2);
  EXPECT_NE(drifts.find("is nearer than 7 cells to x_max, which is periodic"), std::string::npos) << drifts;
}

}  // namespace crack_periodic_test
}  // namespace verification
