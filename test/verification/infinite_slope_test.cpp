// A layer of sand on a rough slope: it stays, or slides with a constant acceleration.
//
// Exact (exact-solutions 26): a layer whose foot holds with the shear stress mu times the normal stress has, at every
// depth, the acceleration g (sin theta - mu cos theta), or rests where tan theta <= mu.
// mu of sand that shears without dilating (psi = 0): the rate of plastic strain is a simple shear, so it has no normal
// parts along and across the slope, and neither has the deviatoric stress that it is coaxial with: the normal stresses
// in the plane are equal. Mohr-Coulomb's circle is then centred on the normal stress and mu = sin phi (E. H. Davis,
// 1968, with psi = 0: mu = sin phi cos psi / (1 - sin phi sin psi)). Drucker-Prager's flow is deviatoric, so all three
// normal stresses are equal, p is the normal stress, sqrt(J2) the shear stress, and mu = eta, which is sin phi too for
// both matches that hold in plane strain (exact-solutions 31).
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "page.hpp"
#include "scene_run.hpp"

namespace infinite_slope_test {

using verification::Numbers;

const double kPi = std::acos(-1.0);
constexpr double kGravity = 9.81;         // [m/s^2]
constexpr double kFrom = 0.2, kTo = 0.4;  // [s] where the acceleration is measured
constexpr double kFriction = 0.5;         // sin phi, phi = 30 degrees

struct Slide {
  Numbers time, velocity;     ///< time, and velocity of the upper half of the strip's middle [s], [m/s]
  double acceleration = 0.0;  ///< slope of the straight line through them from kFrom to kTo [m/s^2]
};

Slide slide(double degrees, const std::string& material) {
  const double slope = degrees * kPi / 180.0;
  mpm::Simulation simulation = verification::start(
      "infinite_slope", {fmt::format("gravity=[{}, {}]", kGravity * std::sin(slope), -kGravity * std::cos(slope)),
                         "bodies.layer.material=" + material});
  const Numbers x = verification::field(simulation, "x"), z = verification::field(simulation, "z");
  Slide run;
  double n = 0.0, t1 = 0.0, t2 = 0.0, v1 = 0.0, tv = 0.0;
  while (verification::seconds(simulation) < kTo - 1e-12) {
    simulation.advance();
    const Numbers vx = verification::field(simulation, "vx");
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < vx.size(); ++i) {
      if (x[i] < 11.0 || x[i] > 13.0 || z[i] < 0.2) continue;
      sum += vx[i];
      ++count;
    }
    const double t = verification::seconds(simulation), v = sum / count;
    run.time.push_back(t);
    run.velocity.push_back(v);
    if (t < kFrom) continue;
    n += 1.0, t1 += t, t2 += t * t, v1 += v, tv += t * v;
  }
  run.acceleration = (n * tv - t1 * v1) / (n * t2 - t1 * t1);
  return run;
}

double exact(double degrees, double friction) {
  const double slope = degrees * kPi / 180.0;
  return kGravity * (std::sin(slope) - friction * std::cos(slope));
}

TEST(InfiniteSlope, StaysOrSlidesAsItsFrictionSays) {
  verification::Page page("soil", "infinite_slope",
                          "A layer of sand on a slope stays, or slides with the friction of its law");
  page.problem(
          "A layer of dry sand (φ = 30°, no dilation, 1600 kg/m³) lies 0.4 m deep on a slope that holds its foot "
          "fast, in plane strain: 8 cells of 50 mm, 24 m long, E = 1 MPa, in which waves from the ends do not reach "
          "the middle within the 0.4 s of the run. Its weight acts suddenly. The speed is that of the upper half of "
          "the middle 2 m, the acceleration the slope of the straight line through it from 0.2 s to 0.4 s.")
      .exact(
          "a = g (sin θ - μ cos θ), or rest where tan θ ≤ μ. Sand that shears without dilating has equal normal "
          "stresses along and across the layer, so that μ = sin φ = 0.5.",
          "balance of the layer along the slope; Davis (1968) for μ of sand whose dilation is not its friction")
      .scene("infinite_slope.yaml");
  auto& panel = page.figure().panel("Speed of the layer", "time [s]", "v [m/s]");
  const auto draw = [&](const std::string& label, double degrees, double friction, const Slide& run) {
    panel.line(label, run.time, run.velocity);
    // The line goes through the mean of the measured values, since the initial velocity depends on the shock of sudden
    // loading.
    double mean = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < run.time.size(); ++i) {
      if (run.time[i] < kFrom) continue;
      mean += run.velocity[i];
      ++count;
    }
    mean /= count;
    const double half = 0.5 * (kTo - kFrom) * std::max(exact(degrees, friction), 0.0);
    panel.exact(run.acceleration < 0.1 ? "exact acceleration" : "", {kFrom, kTo}, {mean - half, mean + half});
  };

  // 5 % of the acceleration without friction: the weight acts suddenly, and the layer oscillates on its foot.
  const Slide resting = slide(20.0, "sand");
  const double free = kGravity * std::sin(20.0 * kPi / 180.0);
  page.near_absolute("20°, Drucker-Prager: acceleration over g sin θ", resting.acceleration / free, 0.0, 0.05, "-");
  page.report("20°, Drucker-Prager: speed at the end over g sin θ t", resting.velocity.back() / (free * kTo), "-");
  draw("20°, Drucker-Prager", 20.0, kFriction, resting);
  const struct {
    const char* law;
    const char* material;
    double degrees;
  } slides[] = {{"Drucker-Prager", "sand", 30.0},
                {"Drucker-Prager", "sand", 35.0},
                {"Drucker-Prager matched in plane strain", "sand_plane_strain", 35.0},
                {"Mohr-Coulomb", "sand_mohr_coulomb", 35.0}};
  for (const auto& sliding : slides) {
    const Slide run = slide(sliding.degrees, sliding.material);
    const std::string label = fmt::format("{:.0f}°, {}", sliding.degrees, sliding.law);
    const double slope = sliding.degrees * kPi / 180.0;
    const double friction = (std::sin(slope) - run.acceleration / kGravity) / std::cos(slope);
    // 1 %: the sand starts with other stresses along the layer than across, and shears until they are equal.
    page.near(label + ": friction", friction, kFriction, 0.01, "-");
    page.beside(label + ": acceleration", run.acceleration, exact(sliding.degrees, kFriction), "m/s²");
    draw(label, sliding.degrees, kFriction, run);
  }
  page.meaning(
      "The friction angle of a law is not the angle of its slope. Sand that shears without dilating slides where tan "
      "θ > μ: 26.6° for φ = 30°. For layers that should hold up to 30°, choose φ so that sin φ = tan 30°: 35.3°.");
}

}  // namespace infinite_slope_test
