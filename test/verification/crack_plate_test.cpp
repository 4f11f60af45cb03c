// A plate in tension with a crack in its middle: across the load, inclined to it, and as it grows from there.
//
// Across: K_I = F sigma sqrt(pi a), F = 1.0246 at a/W = 0.2 (half the plate's width over W) by finite elements, Tada's
// formula 1.0245. Inclined by beta from the load, in an infinite plate: K_I = sigma sqrt(pi a) sin^2 beta,
// K_II = sigma sqrt(pi a) sin beta cos beta. Largest hoop stress: the first kink is at -+53.130 degrees for K_I = K_II.
// Source: crack reference 7.5, 7.6, 7.7, 5.2; F. Erdogan, G. C. Sih (1963), J. Basic Engng 85, 519-525.
#include "crack_case.hpp"
#include "page.hpp"

namespace verification {
namespace crack_plate_test {

using namespace crack_case;

constexpr double kCell = 1e-3, kStress = 1e4;  // [m], [Pa]

struct Plate {
  double angle = 90.0;           ///< between load and crack [degrees]
  int half_crack = 8;            ///< [cells]
  int half_width = 56;           ///< [cells]
  int half_height = 56;          ///< [cells]
  int size = 3;                  ///< size of the contour
  double ramp = 0.6, end = 2.0;  ///< periods of the plate's slowest stretching
  double damping = 0.9;          ///< part of the rate of that stretching; at 2 it is critical
  std::string split = "interaction", growth, fracture, limit;

  double infinite() const { return kStress * std::sqrt(kHalfTurn * half_crack * kCell); }  ///< [Pa m^0.5]
  double one() const { return infinite() * std::pow(std::sin(angle * kDegree), 2); }
  double two() const { return infinite() * std::sin(angle * kDegree) * std::cos(angle * kDegree); }
};

double period_of(const Plate& plate) { return 4.0 * plate.half_height * kCell / kBarSpeed; }

/// The middle is a tenth of a cell beyond a node, midway between grid lines.
mpm::Simulation pull(const Plate& plate) {
  const double h = kCell, x = plate.half_width * h, z = plate.half_height * h, period = period_of(plate);
  const double sync = sync_of(plate.end * period, 40), end = 40 * sync;
  const double along = std::cos(plate.angle * kDegree), across = std::sin(plate.angle * kDegree);
  const double a = plate.half_crack * h;
  std::string text = head(h, {-x - 4 * h, -z - 4 * h, x + 4 * h, z + 5 * h}, end, sync,
                          plate.damping * 2 * kHalfTurn / period, plate.fracture) +
                     body(-x, -z, x, z + h);
  text += "loads:\n" + traction("z_max", ramped(kStress, plate.ramp * period)) +
          traction("z_min", ramped(-kStress, plate.ramp * period));
  text += fmt::format(
      "cracks:\n  contour: {{size: {}}}\n  split: {}\n{}  list: [{{name: slit, points: [[{:.17g}, {:.17g}], [{:.17g}, "
      "{:.17g}]], start: tip, end: tip{}}}]\n",
      plate.size, plate.split, plate.growth, 0.1 * h - a * across, 0.5 * h - a * along, 0.1 * h + a * across,
      0.5 * h + a * along, plate.limit);
  mpm::Simulation simulation = made(text);
  run_until(simulation, end);
  return simulation;
}

// About 2 s.
TEST(CrackPlate, Centre) {
  Page page("crack", "crack_centre", "A plate with a crack in its middle");
  page.problem(
          "A plate 80 mm wide and 121 mm high is pulled at its ends by 10 kPa; a crack of 16 mm lies across its "
          "middle. "
          "Cells of 1 mm, 4 particles each; E = 2500 MPa, ν = 0.33, plane strain.")
      .exact("K_I = 1.0246 σ √(πa), K_II = 0; J = K²/E'.", "finite elements converged to 1e-4; Tada's formula 1.0245")
      .meaning("Both tips have the K of finite elements.");
  Plate plate;
  plate.half_width = 40;
  plate.half_height = 60;
  const mpm::Simulation simulation = pull(plate);
  const double exact = 1.0246 * plate.infinite();
  for (const std::string end : {"start", "end"}) {
    const Tip found = tip(simulation, end);
    // Tips lie 0.1 cells beyond a node at one end, 0.1 before one at the other: 0.15 cells of 8 are 1 % of K.
    page.near("K_I, " + end, found.one, exact, 0.02, "Pa √m");
    page.near("J, " + end, found.j, exact * exact / kPlane, 0.04, "J/m²");
    page.near_absolute("K_II / K_I, " + end, found.two / found.one, 0.0, 0.002, "");
  }
}

// About 9 s.
TEST(CrackPlate, Inclined) {
  Page page("crack", "crack_inclined", "A plate with an inclined crack");
  page.problem(
          "A plate 112 mm wide and 113 mm high is pulled by 10 kPa; a crack of 16 mm in its middle is inclined to the "
          "load by β. Cells of 1 mm, 4 particles each.")
      .exact("K_I = σ √(πa) sin²β, K_II = σ √(πa) sin β cos β; the phase atan(K_II/K_I) is 90° - β.",
             "the infinite plate; the plate's width adds 1 % to K")
      .meaning(
          "The interaction integral finds the phase to 0.3°, and K to the part of a cell by which a tip acts longer "
          "than it is. The plate has to be at rest: at 30° a stress of 1 % across the load, left of its vibration, is "
          "3 % of K_I and 0.7° of phase. J of the contour is higher by up to 6 % where the crack runs askew to the "
          "grid.");
  Numbers angles, exact, integral;
  for (const double angle : {75.0, 60.0, 45.0, 30.0}) {
    Plate plate;
    plate.angle = angle;
    plate.damping = 1.8;  // leaves exp(-0.9 * 2 pi * 1.4), 0.04 %, of vibrations
    const mpm::Simulation simulation = pull(plate);
    for (const std::string end : {"start", "end"}) {
      const Tip found = tip(simulation, end);
      const std::string name = fmt::format(", β = {}°, {}", angle, end);
      page.near_absolute("phase" + name, found.phase(), 90.0 - angle, 0.5, "degrees");  // asked
      // 1.2 % of width, and a tip's 0.41 cells at most: 2.6 % of K.
      page.near("K_I" + name, found.one, 1.012 * plate.one(), 0.03, "Pa √m");
      page.near("|K_II|" + name, std::abs(found.two), 1.012 * plate.two(), 0.03, "Pa √m");
      const double j = (plate.one() * plate.one() + plate.two() * plate.two()) / kPlane;
      // Reference 7.6: 4 to 9 % more; here from 2 %.
      page.near_absolute("J / that of the infinite plate" + name, found.j / j, 1.055, 0.04, "");
      angles.push_back(90.0 - angle), exact.push_back(90.0 - angle), integral.push_back(found.phase());
    }
  }
  page.figure()
      .panel("Phase", "90° - β [degrees]", "atan(K_II / K_I) [degrees]")
      .exact("infinite plate", angles, exact)
      .points("interaction integral", angles, integral);
}

// About 5 s.
TEST(CrackPlate, InclinedByOpenings) {
  Page page("crack", "crack_inclined_openings", "An inclined crack by its openings");
  page.problem("The plate above with the split of J by the openings behind the tip.")
      .exact("as above", "as above")
      .meaning("The openings, a cell behind the tip, give the phase to several degrees: use the interaction integral.");
  for (const double angle : {60.0, 45.0}) {
    Plate plate;
    plate.angle = angle;
    plate.split = "openings";
    const mpm::Simulation simulation = pull(plate);
    for (const std::string end : {"start", "end"}) {
      const Tip found = tip(simulation, end);
      // Reference 4.7: off by 0 to 9 degrees.
      page.near_absolute(fmt::format("phase, β = {}°, {}", angle, end), found.phase(), 90.0 - angle, 9.0, "degrees");
    }
  }
}

/// Largest hoop stress at this K_II / K_I, crack reference 5.2 [degrees].
double hoop_angle(double one, double two) {
  return -std::acos((3 * two * two + one * std::sqrt(one * one + 8 * two * two)) / (one * one + 9 * two * two)) /
         kDegree;
}

// The load grows so slowly that waves have left when the crack begins to grow. About 5 s.
TEST(CrackPlate, KinkAndPath) {
  EXPECT_NEAR(hoop_angle(1, 1), -53.130, 0.001);  // the reference's table 5.2
  EXPECT_NEAR(hoop_angle(1, 0.5), -40.208, 0.001);
  Page page("crack", "crack_kink", "An inclined crack that grows");
  page.problem(
          "The plate with the crack at 45° to its load, which grows to the full one in three periods of its "
          "stretching; "
          "the "
          "tips grow by `hoop_stress` at 97 % of the toughness that the full load reaches.")
      .exact("First kink ∓53.13°; then the path turns normal to the load.", "Erdogan and Sih (1963); K_I = K_II")
      .meaning(
          "The first kink is that of the K of the standing crack. Afterwards the crack runs at once, by half a cell at "
          "a "
          "time at the speed of waves, under a load that stays.");
  Plate plate;
  plate.angle = 45.0;
  plate.ramp = 3.0;
  plate.end = 3.6;
  plate.growth = "  growth: {criterion: hoop_stress}\n";
  // K_eq of the infinite plate, 1.2649 of K (table 5.2), and 1.2 % for the width.
  plate.fracture =
      fmt::format(", fracture: {{k_ic: {:.9g}}}", 0.97 * 1.012 * 1.2649 * plate.infinite() * std::sqrt(0.5));
  plate.limit = ", longest: 0.026";
  const mpm::Simulation simulation = pull(plate);
  const auto tips = simulation.crack_tips();
  ASSERT_EQ(tips.size(), 2u);
  const mpm::CrackReport crack = simulation.cracks().front();
  for (const std::string end : {"start", "end"}) {
    const double kink = number(simulation, "crack 1 " + end + " kink_angle") / kDegree;
    page.near_absolute("first kink, " + end, std::abs(kink), 53.13, 1.0, "degrees");
    const std::size_t last = end == "end" ? crack.points.size() - 1 : 0, before = end == "end" ? last - 8 : 8;
    const mpm::Vec3 way = crack.points[last] - crack.points[before];
    page.near_absolute("way of the last 4 cells from the normal of the load, " + end,
                       std::atan(way.z() / way.x()) / kDegree, 0.0, 15.0, "degrees");
  }
  Numbers x, z;
  for (const mpm::Vec3& point : crack.points) x.push_back(1e3 * point.x()), z.push_back(1e3 * point.z());
  page.figure().panel("Path", "x [mm]", "z [mm]").line("crack", x, z);
}

}  // namespace crack_plate_test
}  // namespace verification
