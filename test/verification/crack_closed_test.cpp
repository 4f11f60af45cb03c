// A closed crack at 45 degrees in compression, smooth and with friction: K_I = 0, and K_II = s sqrt(pi a)
// (sin b cos b - mu sin^2 b), 0.5 and at mu = 0.3 0.35 of s sqrt(pi a); slips are in the same proportion.
// Source: Horii and Nemat-Nasser (1985), J. Geophys. Res. 90, 3105-3125; crack reference 7.11.
//
// With a = 8 cells in a plate 14 a wide the reference's own model of the method, solved at rest, has J 5 to 11 % and
// K_II 1 to 4 % above the exact ones: the crack acts as one that is longer by a part of a cell.
#include <fmt/core.h>

#include "page.hpp"
#include "scene_run.hpp"

namespace verification {
namespace crack_closed_test {

constexpr double kLoad = 1e5, kHalf = 8e-3, kModulus = 2.5e9 / (1.0 - 0.33 * 0.33);  // [Pa], [m], E'
constexpr double kOffset = 0.24e-3;                                                  // z - x on the crack [m]

const char* const kScene = R"yaml(
name: closed_crack
geometry: plane_strain
thickness: 1 mm
grid: {cell: 1 mm, min: [-60 mm, -60 mm], max: [60 mm, 60 mm]}
time: {end: 0.7 ms, cfl: 0.6, sync: 0.1 ms}
method: {damping: {grid: 9e4 1/s}}
materials: [{name: polymer, law: linear_elastic, density: 1000, young: 2500 MPa, poisson: 0.33}]
bodies: [{name: plate, material: polymer, shape: {box: {min: [-56 mm, -56 mm], max: [56 mm, 56 mm]}}}]
loads:
  - {traction: {body: plate, edge: z_max, traction: [0, "-1e5*(t<5e-4 ? (t/5e-4)^2*(3-t/2.5e-4) : 1)"]}}
  - {traction: {body: plate, edge: z_min, traction: [0, "1e5*(t<5e-4 ? (t/5e-4)^2*(3-t/2.5e-4) : 1)"]}}
cracks:
  list:
    - name: crack
      points: [[-5.526854 mm, -5.286854 mm], [5.786854 mm, 6.026854 mm]]
      start: tip
      end: tip
)yaml";

struct Closed {
  double j[2], k_one[2], k_two[2];  ///< at the start and the end
  double slip;                      ///< in the middle of the crack [m]
};

Closed press(const std::string& faces) {
  mpm::Simulation simulation(mpm::build(mpm::parse_scene(kScene + ("      faces: " + faces + "\n"), "closed", {})),
                             {1});
  const Numbers x0 = field(simulation, "x"), z0 = field(simulation, "z");
  run_until(simulation, 0.7e-3);
  const Numbers x = field(simulation, "x"), z = field(simulation, "z");
  Closed run{};
  int tip = 0;
  for (const std::string end : {"start", "end"}) {
    run.j[tip] = number(simulation, "crack 1 " + end + " j");
    run.k_one[tip] = number(simulation, "crack 1 " + end + " k_one");
    run.k_two[tip++] = number(simulation, "crack 1 " + end + " k_two");
  }
  // Along the crack, of particles up to 1 and from 1 to 2 mm away, carried on to the faces.
  double sum[2][2] = {}, count[2][2] = {};
  for (std::size_t p = 0; p < x0.size(); ++p) {
    const double along = (x0[p] + z0[p] - 0.5e-3) / std::sqrt(2.0), away = (z0[p] - x0[p] - kOffset) / std::sqrt(2.0);
    if (std::abs(along) > 2e-3 || std::abs(away) > 2e-3) continue;
    const int band = std::abs(away) > 1e-3 ? 1 : 0, side = away > 0.0 ? 1 : 0;
    sum[band][side] += (x[p] - x0[p] + z[p] - z0[p]) / std::sqrt(2.0);
    ++count[band][side];
  }
  const auto jump = [&](int band) { return sum[band][1] / count[band][1] - sum[band][0] / count[band][0]; };
  run.slip = 1.5 * jump(0) - 0.5 * jump(1);
  return run;
}

double exact_k(double friction) { return kLoad * std::sqrt(3.14159265358979 * kHalf) * 0.5 * (1.0 - friction); }

TEST(CrackClosed, SmoothAndWithFriction) {
  Page page("crack", "crack_closed", "A closed crack in compression");
  page.problem(
          "A plate 112 mm wide with a crack of half-length a = 8 mm at 45°, E = 2500 MPa, ν = 0.33, pressed together "
          "by "
          "σ = 0.1 MPa, in cells of 1 mm. The load rises slowly, without an overshoot, whose "
          "slip friction would keep.")
      .exact("K_I = 0, K_II = σ √(πa) (sin β cos β - μ sin² β), J = K_II²/E'. The slip is less by 1 - μ with friction.",
             "Horii and Nemat-Nasser, J. Geophys. Res. 90 (1985) 3105")
      .meaning(
          "Without friction J and K_II are too large by what a crack longer by a quarter of a cell has, as expected of "
          "8 cells. Friction holds back the part of the slip that it should.");
  const Closed smooth = press("{friction: 0}"), rough = press("{friction: 0.3}"),
               placed = press("{friction: 0, detection: positions}");
  for (int tip = 0; tip < 2; ++tip) {
    const std::string end = tip == 0 ? "start" : "end";
    const double k = exact_k(0.0), j = k * k / kModulus;
    // The reference's bounds, with 1 % to either side for the tip's place in its cell.
    page.near("K_II, exact + 2.5 %, " + end, std::abs(smooth.k_two[tip]), 1.025 * k, 0.025, "Pa √m");
    page.near("J, exact + 8 %, " + end, smooth.j[tip], 1.08 * j, 0.04, "J/m²");
    page.near("K_II, contact by positions, over that by displacements, " + end, placed.k_two[tip] / smooth.k_two[tip],
              1.0, 0.03, "");
  }
  // Both runs have the same grid and effective length; 3 % is asked of K_II with friction.
  page.near("slip with μ = 0.3, over that without friction", rough.slip / smooth.slip, 0.7, 0.03, "");
  // 4 (sin b cos b) s a / E' in the middle; longer by a quarter of a cell, and carried on from a millimetre away.
  page.near("slip without friction", std::abs(smooth.slip), 2.0 * kLoad * kHalf / kModulus, 0.06, "m");
}

// 3 % is asked of K_II. J has what a crack longer by up to a quarter of a cell has, as without friction.
TEST(CrackClosed, StressIntensityWithFriction) {
  Page page("crack", "crack_closed_friction", "A closed crack with friction");
  page.problem(
          "The plate above, with μ = 0.3 between the faces. The work of friction from the contour to the tip is taken "
          "off J, and its shear off the interaction integral, which is that of free faces.")
      .exact("K_II = σ √(πa) (sin β cos β - μ sin² β) = 0.35 σ √(πa), J = K_II²/E'.",
             "Horii and Nemat-Nasser, J. Geophys. Res. 90 (1985) 3105")
      .meaning("K_II is that of the slip which friction leaves; J is larger as in the run without friction.");
  const Closed rough = press("{friction: 0.3}");
  for (int tip = 0; tip < 2; ++tip) {
    const std::string end = tip == 0 ? "start" : "end";
    const double k = exact_k(0.3);
    page.near("K_II, " + end, std::abs(rough.k_two[tip]), k, 0.03, "Pa √m");
    page.near("J, exact + 5 %, " + end, rough.j[tip], 1.05 * k * k / kModulus, 0.05, "J/m²");
    EXPECT_EQ(rough.k_one[tip], 0.0);
  }
}

}  // namespace crack_closed_test
}  // namespace verification
