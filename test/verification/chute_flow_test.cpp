// Grain of the law mu(I) in a steady flow down a chute, against Bagnold's profile.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "mpm/math/constants.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace chute_flow_test {

// Glass beads: tan 20.9 and tan 32.76 degrees, I_0 0.279 (Jop, Forterre & Pouliquen 2006).
constexpr double kStatic = 0.3819, kLimiting = 0.6435, kReference = 0.279, kGrain = 2500.0;

// A layer of depth h on a rough slope of 26 degrees, endless along it, in steady flow: the friction is tan(slope) at
// every depth, so that the inertial number is one and the rate follows the root of the pressure (Bagnold's profile),
//   v(z) = 2/3 (I / d) sqrt(g cos(slope) rho / rho_s) (h^1.5 - (h - z)^1.5),
//   I = I_0 (tan(slope) - mu_s) / (mu_2 - tan(slope)).
// 16 cells on the depth of 0.1 m; from a profile a tenth too fast, for 4 s (half of that is left after 1 s). 2 % of the
// speed at the surface: friction within 0.2 %, by the elastic strain and that of the grid, is 3 % of I. APIC, since
// FLIP of 0.998 adds a viscosity of 5 % of the flow's. 2 s.
TEST(ChuteFlow, OfMuIHasBagnoldsProfile) {
  constexpr double kSlope = 26.0 * kPi / 180.0, kDepth = 0.1, kBead = 0.01, kDensity = 1500.0, kGravity = 9.81;
  const double tangent = std::tan(kSlope);
  const double inertial = kReference * (tangent - kStatic) / (kLimiting - tangent);
  const double factor = 2.0 / 3.0 * inertial / kBead * std::sqrt(kGravity * std::cos(kSlope) * kDensity / kGrain);
  const auto text = [](double value) { return std::to_string(value); };
  const std::string profile = text(1.1 * factor) + "*(0.1^1.5-max(0.1-z,0)^1.5)";
  const Scene scene =
      parse_scene("geometry: plane_strain\nthickness: 1\ngravity: [" + text(kGravity * std::sin(kSlope)) + ", " +
                      text(-kGravity * std::cos(kSlope)) +
                      "]\ngrid: {cell: 0.00625, min: [0, 0], max: [0.05, 0.125]}\n"
                      "time: {end: 4, sync: 10 ms}\nmethod: {transfer: apic}\n"
                      "materials:\n  - {name: beads, density: 1500, law: mu_i, young: 1 MPa, poisson: 0.3, mu_s: " +
                      text(kStatic) + ", mu_2: " + text(kLimiting) +
                      ", I_0: 0.279, grain_diameter: 10 mm, grain_density: 2500}\n"
                      "bodies:\n  - {name: layer, material: beads, initial: {velocity: [\"" +
                      profile +
                      "\", 0], stress: {xx: \"-13225*(0.1-z)\", yy: \"-13225*(0.1-z)\", zz: \"-13225*(0.1-z)\"}}, "
                      "shape: {box: {min: [0, 0], max: [0.05, 0.1]}}}\n"
                      "boundaries: {x: periodic, z_min: fixed}\n",
                  "chute.yaml", {});
  Simulation simulation(build(scene), {1});
  while (simulation.time() < 4'000'000'000) simulation.advance();
  std::vector<double> z, v;
  simulation.particle_field("z", z);
  simulation.particle_field("vx", v);
  const double fastest = factor * std::pow(kDepth, 1.5);
  for (std::size_t p = 0; p < z.size(); ++p) {
    if (z[p] < 0.0125) continue;  // two cells at the foot, across which the velocity is a straight line
    const double exact = factor * (std::pow(kDepth, 1.5) - std::pow(std::max(kDepth - z[p], 0.0), 1.5));
    EXPECT_NEAR(v[p], exact, 0.02 * fastest) << z[p];
  }
}

}  // namespace chute_flow_test
}  // namespace mpm
