// Imposed rotation: particles lie on a lattice and get the velocity of a rigid rotation before every step. The change
// of their volume in a step then comes from the truncated exponential alone: det of the sum of (theta W)^j / j! up to
// k, which is 1 + theta^2 for k = 1 and 1 + theta^4 / 4 for k = 2. Source: method reference 7; for k = 3 and 4 from the
// real and imaginary part of the truncated exp(i theta).
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <complex>

#include "methods.hpp"
#include "page.hpp"
#include "probe.hpp"
#include "scenes.hpp"

namespace stability {
namespace rotation_test {

using verification::Map;
using verification::Numbers;
using verification::Outcome;
using verification::Page;

constexpr double kCentre = 16.0;   // centre of rotation: a node, about which the lattice is symmetric [cells]
constexpr double kHalfEdge = 5.0;  // half edge of the block, so that the centre is deep inside [cells]
constexpr double kDt = 1e-3;       // [s]
constexpr int kSteps = 20;
constexpr double kSwollen = 0.01;  // change of volume in a turn that counts as broken

/// Change of volume of one step, det exp_k(theta W).
double growth(int terms, double theta) {
  std::complex<double> sum = 1.0, term = 1.0;
  for (int j = 1; j <= terms; ++j) sum += term *= std::complex<double>(0.0, theta / j);
  return std::norm(sum);
}
double theory(const mpm::MethodDefinition& method, double theta) {
  // USAVG updates strain twice per step, by half of it.
  return method.update == mpm::UpdateScheme::usavg ? std::pow(growth(method.gradient_terms, 0.5 * theta), 2.0)
                                                   : growth(method.gradient_terms, theta);
}

mpm::SimulationDefinition block(const mpm::MethodDefinition& method) {
  mpm::SimulationDefinition d = domain(method, Vec3::Zero(), {2 * kCentre, 0.0, 2 * kCentre}, 1e-3);
  const double low = kCentre - kHalfEdge, high = kCentre + kHalfEdge;
  // The material is so soft that stress moves nothing: waves travel 1e-8 of a cell per step.
  add_body(d, "block", {low, 0.0, low}, {high, 0.0, high}, neo_hookean(0.3, 1e-8 * kCell / kDt));
  return d;
}

/// Mean over steps of ln J next to the centre, per step of rotation by `theta`.
double measured(const mpm::SimulationDefinition& d, double theta, int steps = kSteps) {
  Probe probe(d);
  mpm::ParticleSet& set = probe.set();
  const std::vector<double> x = field(probe.simulation(), "x"), z = field(probe.simulation(), "z");
  const double centre = kCell * kCentre, rate = theta / kDt;
  for (int step = 0; step < steps; ++step) {
    for (int p = 0; p < set.size(); ++p) {
      const std::uint32_t id = set.id[p];
      set.x[0][p] = x[id];
      set.x[1][p] = z[id];
      set.v[0].set(p, rate * (z[id] - centre));
      set.v[1].set(p, -rate * (x[id] - centre));
    }
    probe.sort();
    probe.step(kDt);
  }
  const std::vector<double> j = field(probe.simulation(), "j");
  double worst = 0.0;
  for (std::size_t p = 0; p < j.size(); ++p) {
    if (std::hypot(x[p] - centre, z[p] - centre) > 0.5 * kCell) continue;
    if (std::abs(std::log(j[p])) > std::abs(worst)) worst = std::log(j[p]);
  }
  return worst / steps;
}

/// |J - 1| after a turn in steps that each change ln J by `rate`.
double turn(double rate, double theta) { return std::abs(std::expm1(rate * 2.0 * kPi / theta)); }

TEST(Rotation, ChangesVolumeByTheTermsOfTheExponential) {
  Page page("rotation", "rotation", "Rotation changes the volume");
  page.problem(
          "Particles on a lattice are given the velocity of a rigid rotation before every step, so that nothing else "
          "changes the deformation gradient. Its increment is exp(∇v Δt) cut off after k terms "
          "(`method.gradient_terms`). Broken: J has changed by a hundredth in a turn.")
      .exact(
          "A step that turns by θ multiplies J by 1 + θ² (k = 1), 1 + θ⁴/4 (k = 2), 1 - θ⁴/12 + θ⁶/36 (k = 3), 1 - "
          "θ⁶/72 "
          "+ θ⁸/576 (k = 4); USAVG does two steps of half the angle.",
          "Nairn, GIMP notes (2.2); |1 + iθ + … + (iθ)ᵏ/k!|²")
      .meaning(
          "With one term every rotating body swells: at 0.1° a step a full turn adds 1.1 % of volume. Two terms, the "
          "default, allow 10° a step, with USAVG 21°. A step is at most the time in which a wave crosses a cell, and "
          "bodies rotate more slowly than waves travel: where a step turns by a degree more terms have no benefit.");
  const Numbers degrees = {0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0, 15.0, 20.0, 30.0};
  Map map("rotation a step [°]", degrees);
  const double per_degree = kPi / 180.0;
  for (const mpm::UpdateScheme update : {mpm::UpdateScheme::usf, mpm::UpdateScheme::usavg}) {
    for (const int terms : {1, 2, 3, 4}) {
      mpm::MethodDefinition method;
      method.update = update;
      method.gradient_terms = terms;
      const mpm::SimulationDefinition d = block(method);
      const std::string label = fmt::format("k = {}, {}", terms, mpm::kUpdateNames[static_cast<int>(update)]);
      std::vector<Outcome> cells;
      for (const double degree : degrees) {
        const double theta = per_degree * degree, rate = measured(d, theta);
        // Round-off of sums of velocities at a distance of ten cells, per step: 1e-13.
        EXPECT_NEAR(rate, std::log(theory(method, theta)), 1e-13) << label << " at " << degree;
        cells.push_back(turn(rate, theta) < kSwollen ? Outcome::stable : Outcome::fails);
      }
      const auto breaks = [&](const auto& rate) {
        return breaking_point(0.01, 90.0, 1e-4, [&](double degree) {
          return turn(rate(per_degree * degree), per_degree * degree) < kSwollen;
        });
      };
      const double found = breaks([&](double theta) { return measured(d, theta); });
      const double expected = breaks([&](double theta) { return std::log(theory(method, theta)); });
      // 1e-3: ten times the accuracy of bisection.
      page.near("rotation a step at which a turn changes J by 1 %, " + label, found, expected, 1e-3, "°");
      map.column(label, cells).breaks_at(found).theory(expected);
    }
  }
  page.figure().panel("A turn changes J by less than 1 %", "", "").map(map);
}

// Volume grows alike with every shape function, since gradients reproduce a linear velocity on any domain. Only for a
// few steps: domains at the block's edge deform differently, because their nodes see one side of the rotation only, and
// where domains follow the deformation this spreads inwards by some cells per step.
TEST(Rotation, IsTheSameForEveryShapeFunction) {
  for (Method method : shapes(mpm::UpdateScheme::usf)) {
    const mpm::SimulationDefinition d = block(method.definition);
    if (!possible(d, method.definition)) continue;
    const double theta = 0.1;
    EXPECT_NEAR(measured(d, theta, 2), std::log(theory(method.definition, theta)), 1e-13) << method.name;
  }
}

}  // namespace rotation_test
}  // namespace stability
