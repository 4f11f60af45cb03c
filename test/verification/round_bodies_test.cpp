// Round elastic bodies between two smooth rigid plates, ten cells on their radius, by the force that they need.
//
// They touch over 1.1 and 1.4 cells to either side, so that the force depends on where contact sees the surface: filled
// by whole places of the lattice, a disk has flats of 36 mm where it is to touch over 18 mm, and needs 1.46 times the
// force, and a sphere 2.1 times. With particles that follow the surface (building/cut_cells.hpp) what is left comes
// from the cells, and differs with the place of the body between the nodes; several places are run.
//
// Sources: the approach of two plates that press a cylinder by P a length is, from either side,
//   P (1 - nu^2) / (pi E) (2 ln(4 R / a) - 1) with a^2 = 4 P R (1 - nu^2) / (pi E),
// Johnson, Contact Mechanics (1985) 5.6, eq. (5.56) with (4.43) for rigid plates. For the sphere Hertz's pressure (4.2)
// acts on both caps of a whole sphere, whose displacement at the pole is summed over Legendre polynomials: a sphere of
// radius 1 under the radial traction P_n has, with the solutions r^(n+1) and r^(n-1) of Navier's equations (Lur'e,
// Three-Dimensional Problems of the Theory of Elasticity (1964) 6.2) and no shear, the displacement of pole() below. In
// the limit of a small contact that is Hertz's approach, less what the body's other half adds: 6 % of the force here.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "page.hpp"
#include "rigid_contact_cases.hpp"
#include "scene_run.hpp"

namespace verification {
namespace round_bodies_test {

// Numbers of the scenes [m], [Pa].
constexpr double kRadius = 0.08, kYoung = 7e5, kPoisson = 0.35, kPressed = 0.0032;
constexpr double kPlane = (1.0 - kPoisson * kPoisson) / kYoung;
constexpr int kThreads = 1;  // tests run side by side

/// The argument at which a function that grows reaches a value.
template <class Function>
double where(double value, double low, double high, Function&& at) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (at(middle) < value ? low : high) = middle;
  }
  return low;
}

/// [N/m]
double force_of_disk(double pressed) {
  return where(pressed, 1.0, 1e5, [](double force) {
    const double half_width = std::sqrt(4.0 * force * kRadius * kPlane / kPi);
    return 2.0 * force * kPlane / kPi * (2.0 * std::log(4.0 * kRadius / half_width) - 1.0);
  });
}

double hertz_force(double contact) { return 4.0 / 3.0 * std::pow(contact, 3) / (kRadius * kPlane); }

/// Approach of the poles of a sphere to its centre under Hertz's pressure on both caps [m].
double pole(double contact) {
  constexpr int kPieces = 400;
  const double shear = 0.5 * kYoung / (1.0 + kPoisson), rim = std::asin(contact / kRadius), nu = kPoisson;
  const double highest = 1.5 * hertz_force(contact) / (kPi * contact * contact);
  Numbers cosine, before(kPieces, 1.0), now, pressure;  // pressure: times the sine and the width of a piece
  for (int i = 0; i < kPieces; ++i) {
    const double angle = (i + 0.5) / kPieces * rim;
    const double across = kRadius * std::sin(angle) / contact;
    cosine.push_back(std::cos(angle));
    pressure.push_back(highest * std::sqrt(1.0 - across * across) * std::sin(angle) * rim / kPieces);
  }
  now = cosine;
  double sum = 0.0;
  const int terms = static_cast<int>(40.0 * kRadius / contact);
  for (int n = 0; n <= terms; ++n) {
    if (n >= 2) {
      for (int i = 0; i < kPieces; ++i) {
        const double next = ((2 * n - 1) * cosine[i] * now[i] - (n - 1) * before[i]) / n;
        before[i] = now[i];
        now[i] = next;
      }
    }
    if (n % 2 == 1) continue;  // both caps alike
    const Numbers& of_n = n == 0 ? before : now;
    double part = 0.0;
    for (int i = 0; i < kPieces; ++i) part += (2 * n + 1) * pressure[i] * of_n[i];
    if (n == 0) {
      sum += part * kRadius * (1.0 - 2.0 * nu) / (2.0 * shear * (1.0 + nu));
      continue;
    }
    const double inner = n * (n * n + 2.0 * n - 1.0 + 2.0 * nu) / (n - 1.0);
    const double traction = 4.0 * shear * (n * n + n + 1.0 + nu * (2.0 * n + 1.0));
    sum += part * kRadius * (inner - (n + 1.0) * (n - 2.0 + 4.0 * nu)) / traction;
  }
  return sum;
}

/// [N]
double force_of_sphere(double pressed) {
  return hertz_force(where(0.5 * pressed, 0.01 * kRadius, 0.5 * kRadius, [](double contact) { return pole(contact); }));
}

/// Force on the upper plate at rest, with the grid moved by `x` and `z` [m].
double pressed_force(const std::string& scene, double x, double z) {
  const bool round = scene == "pressed_sphere";
  mpm::Simulation simulation = start(scene,
                                     {fmt::format("grid.min=[{}, {}]", (round ? 0.0 : -0.168) + x, -0.088 + z),
                                      fmt::format("grid.max=[{}, {}]", (round ? 0.16 : 0.176) + x, 0.248 + z)},
                                     kThreads);
  run_until(simulation, 1.1);
  simulation.take_contact(1);
  run_until(simulation, 1.2);
  return simulation.take_contact(1).mean.force.z();
}

TEST(RoundBodies, DiskBetweenPlates) {
  Page page("contact", "pressed_disk", "A disk between plates");
  page.problem(
          "A disk of 10 cells of radius, pressed by 2 % of its diameter: it touches over 1.1 cells to either side.")
      .exact("Line contact of the whole disk", "Johnson, Contact Mechanics (1985) 5.6")
      .scene("pressed_disk");
  const double exact = force_of_disk(kPressed);
  for (const auto& [x, z] :
       {std::pair{0.0, 0.0}, std::pair{0.0, 0.002}, std::pair{0.004, 0.004}, std::pair{0.003, 0.0}}) {
    page.near(fmt::format("force, grid moved by {:g} and {:g} cells", x / 0.008, z / 0.008),
              pressed_force("pressed_disk", x, z), exact, 0.05, "N/m");
  }
}

TEST(RoundBodies, SphereBetweenPlates) {
  // The limit of a small contact is Hertz's.
  EXPECT_NEAR(pole(0.001), 0.001 * 0.001 / kRadius, 0.01 * 0.001 * 0.001 / kRadius);
  Page page("contact", "pressed_sphere", "A sphere between plates");
  page.problem(
          "A sphere of 10 cells of radius about its axis, pressed by 2 % of its diameter: it touches over 1.4 cells.")
      .exact("Hertz's pressure on both caps of a whole sphere, summed over Legendre polynomials",
             "Johnson, Contact Mechanics (1985) 4.2; Lur'e (1964) 6.2")
      .scene("pressed_sphere");
  const double exact = force_of_sphere(kPressed);
  double mean = 0.0;
  for (const double z : {0.0, 0.002, 0.004, 0.006}) {
    const double force = pressed_force("pressed_sphere", 0.0, z);
    // A contact of 1.4 cells about the axis has two rings of nodes: a tenth.
    page.near(fmt::format("force, grid moved by {:g} cells", z / 0.008), force, exact, 0.1, "N");
    mean += 0.25 * force;
  }
  page.near("force, mean of these", mean, exact, 0.05, "N");
}

}  // namespace round_bodies_test
}  // namespace verification
