// The shipped cone penetrometer: its tip resistance against depth, beside the bearing capacity of a strip.
//
// No exact solution is known for a cone in this sand. N_q = e^(pi tan phi) tan^2(45 + phi/2), times the vertical stress
// beside the tip, is exact for a strip on weightless soil with associated flow (Prandtl; Reissner (1924)). A round
// footing bears more than a strip, by a factor of 1 + tan phi after De Beer (1970). A footing of width B at a depth
// D > B bears more than one on the surface, by 1 + 2 tan phi (1 - sin phi)^2 arctan(D / B) after Brinch Hansen (1970).
// All of these assume that the soil dilates by its friction angle; soil without dilation, as here, bears less. With the
// reduced friction of Davis (1968), tan phi* = sin phi, they give the usual estimate of it. Asked: between the two.
#include <fmt/core.h>

#include <cmath>
#include <string>
#include <vector>

#include "mpm/math/constants.hpp"
#include "page.hpp"
#include "scene_run.hpp"
#include "study/limit_loads.hpp"

namespace verification {
namespace cone_penetrometer_test {

using mpm::kPi;
// Numbers of the scene.
constexpr double kRadius = 0.01784, kFriction = 34.0 * kPi / 180.0, kUnitWeight = 1417.0 * 9.81;  // [m], [], [N/m^3]
constexpr double kSurface = 0.44;                                                                 // [m]
const double kStrip = mpm::study::bearing_surcharge_factor(kFriction);

constexpr double kFrom = 0.2;  ///< depth from which the resistance is compared [m]
/// Resistance of a round footing at a depth [m] over the vertical stress there.
double round_footing(double friction, double depth) {
  const double shape = 1.0 + std::tan(friction);
  const double deep =
      2.0 * std::tan(friction) * std::pow(1.0 - std::sin(friction), 2) * std::atan(depth / (2.0 * kRadius));
  return mpm::study::bearing_surcharge_factor(friction) * shape * (1.0 + deep);
}

/// Resistance over the cone's area, as means over each centimetre of depth.
struct Sounding {
  Numbers depth, resistance;  ///< [m], [kPa]
  Numbers r, z, speed;        ///< at the particles, at the end [m], [m/s]
  /// Mean ratio of the resistance to the initial vertical stress, at depths from `least` on [m].
  double factor(double least) const {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < depth.size(); ++i) {
      if (depth[i] >= least) sum += 1e3 * resistance[i] / (kUnitWeight * depth[i]), count += 1.0;
    }
    return sum / count;
  }
};

Sounding push(const std::vector<std::string>& overrides) {
  mpm::Simulation simulation = start("cone_penetrometer", overrides, 1);
  Sounding sounding;
  const double end = 0.5;  // before it slows down [s]
  while (seconds(simulation) < end - 1e-12) {
    run_until(simulation, seconds(simulation) + 0.02);
    sounding.depth.push_back(kSurface - simulation.rigid_body(0).pose().position.z() - 0.005);
    sounding.resistance.push_back(1e-3 * simulation.take_contact(0).mean.force.z() / (kPi * kRadius * kRadius));
  }
  sounding.r = field(simulation, "x");
  sounding.z = field(simulation, "z");
  sounding.speed = field(simulation, "speed");
  return sounding;
}

/// Runs the scene with cells of `cell` [m]; `rough`: rod and cone have friction.
void sound(const std::string& name, double cell, bool rough) {
  Page page("axisymmetric", name, "Cone penetrometer in loose sand");
  page.problem(
          fmt::format("A cone of 60 degrees and 10 cm2 is driven a quarter of a metre into loose sand (Drucker-Prager, "
                      "34 degrees, no dilation) at rest, at 0.5 m/s. Cells of {:.0f} mm.",
                      1e3 * cell))
      .exact(
          "none is known; above, the bearing capacity of a round footing at the tip's depth in sand that dilates: that "
          "of "
          "a strip, N_q times the vertical stress there, with De Beer's factor of shape and Brinch Hansen's of depth; "
          "below, the same with Davis's reduced friction of sand that does not dilate. Drawn are N_q and De Beer's "
          "factor alone.",
          "Reissner (1924); E. E. De Beer (1970), Geotechnique 20(4), 387-411; J. Brinch Hansen (1970), Danish "
          "Geotechnical Institute, Bulletin 28; E. H. Davis (1968), in Soil Mechanics: Selected Topics")
      .scene("cone_penetrometer");
  const std::string cells = fmt::format("grid.cell={}", cell);
  const Sounding smooth = push({cells});
  const double factor = smooth.factor(kFrom), shape = 1.0 + std::tan(kFriction);
  const double middle = 0.5 * (kFrom + smooth.depth.back());
  page.above("tip resistance over vertical stress, smooth, below 0.2 m: Davis's friction", factor,
             round_footing(mpm::study::davis_friction(kFriction, 0.0), middle), "");
  page.below("the same: sand that dilates", factor, round_footing(kFriction, middle), "");
  page.beside("the same, beside N_q of a strip", factor, kStrip, "");
  page.beside("the same, beside N_q with De Beer's factor", factor, shape * kStrip, "");
  page.report("tip resistance at the end", smooth.resistance.back(), "kPa");
  Numbers millimetres, strip, round;
  for (const double depth : smooth.depth) {
    millimetres.push_back(1e3 * depth);
    strip.push_back(1e-3 * kStrip * kUnitWeight * depth);
    round.push_back(shape * strip.back());
  }
  Panel& panel = page.figure()
                     .panel("Tip resistance", "depth of the tip [mm]", "force / area of the cone [kPa]")
                     .line("N_q, strip", millimetres, strip)
                     .line("N_q, round (De Beer)", millimetres, round)
                     .points("smooth", millimetres, smooth.resistance);
  if (rough) {
    const Sounding rubbing = push({cells, "rigid_bodies.cone.friction=0.4"});
    page.report("the same with friction of 0.4 on cone and rod", rubbing.resistance.back(), "kPa");
    panel.points("friction 0.4, with the rod", millimetres, rubbing.resistance);
  }
  page.figure().panel("Speed at 0.245 m", "r [m]", "z [m]").particles("speed [m/s]", smooth.r, smooth.z, smooth.speed);
  page.meaning(
      "The resistance grows with depth and comes to a multiple of the vertical stress that hardly changes from ten "
      "radii on, and hardly from cells of 8 mm, two to the cone's radius, to cells of half of that. It lies between "
      "the two estimates, nearer to that of sand which does not dilate. Real cones in loose sand meet more, for deeper "
      "sand is stiffer. With friction the force is that on cone and rod together.");
}

TEST(ConePenetrometer, BearsMoreThanAStrip) { sound("cone_penetrometer", 0.008, false); }
TEST(FullConePenetrometer, BearsMoreThanAStrip) { sound("cone_penetrometer", 0.004, true); }

}  // namespace cone_penetrometer_test
}  // namespace verification
