// Soil that consolidates after a load: a column that drains at its top, and a cylinder that drains at its surface,
// whose pressure goes on rising inside.
//
// Column (K. Terzaghi): p = p0 sum 2/N sin(N z / H) exp(-N^2 T), N = (2 m + 1) pi / 2, T = c t / H^2, z from the drain,
// p0 = alpha Q s0 / (M + alpha^2 Q), c = k / (1/Q + alpha^2 / M); degree of consolidation 1 - sum 2/N^2 exp(-N^2 T),
// 0.50409 at T = 0.2. Source: exact-solutions 23.
//
// Cylinder in plane strain (the problem of J. de Leeuw, 1965), derived here. Equilibrium is M de/dr = alpha dp/dr, so M
// e = alpha p + f(t) with e the change of volume; with u(R) R = integral of e r dr, the load gives f (1 - g) = -s0 + g
// alpha m, g = G / M and m the mean of p. With water kept, (1/Q) dp/dt + alpha de/dt = k lap p:
//   dp/dt = c lap p - b dm/dt,   b = alpha^2 g / (M (1 - g) (1/Q + alpha^2 / M)),   p(R) = 0.
// Its modes are J0(z r/R) - J0(z) with z J0(z) = 2 d J1(z), d = b / (1 + b), and decay as exp(-z^2 c t / R^2). As
// w = p + b m obeys lap and w(R) = d mean(w), they are orthogonal with weight r inside and -R^2 / (2 d) on the surface,
// so that p0 = alpha Q s0 / (M - G + alpha^2 Q) has the factors 2 p0 (J1/z) / (J0^2 + J1^2 - J0^2 / d).
//
// Loads rise over a short while: solutions are summed over the steps of the load (Duhamel). Cost: 8 s.
#include <fmt/core.h>

#include "mpm/math/constants.hpp"
#include "page.hpp"
#include "transport_run.hpp"

namespace verification {
namespace consolidation_test {

using mpm::kPi;

/// Response to a load that rises as (1 - cos)/2 over `rise` seconds, from the response to a sudden one.
template <class Response>
double after_rise(double t, double rise, Response response) {
  double sum = 0.0;
  constexpr int kSteps = 200;
  for (int i = 0; i < kSteps; ++i) {
    const double from = rise * i / kSteps, to = rise * (i + 1) / kSteps;
    const double part = 0.5 * (std::cos(kPi * from / rise) - std::cos(kPi * to / rise));
    sum += part * response(std::max(0.0, t - 0.5 * (from + to)));
  }
  return sum;
}

/// Over p0, at `z` of the height below the drain.
double terzaghi(double z, double time_factor) {
  double sum = 0.0;
  for (int m = 0; m < 200; ++m) {
    const double n = (2 * m + 1) * kPi / 2.0;
    sum += 2.0 / n * std::sin(n * z) * std::exp(-n * n * time_factor);
  }
  return sum;
}
/// Degree of consolidation of what lies more than `z` of the height below the drain: 1 less the mean of p / p0 there.
double degree(double time_factor, double z = 0.0) {
  double sum = 0.0;
  for (int m = 0; m < 200; ++m) {
    const double n = (2 * m + 1) * kPi / 2.0;
    sum += 2.0 / (n * n) * std::cos(n * z) * std::exp(-n * n * time_factor);
  }
  return 1.0 - sum / (1.0 - z);
}

// Numbers of terzaghi_column, but for the permeability, ten times as much: T = 0.5 t.
constexpr double kYoung = 1e7, kPoisson = 0.2, kStorage = 1e-8, kLoad = 1e4, kRise = 0.04;
constexpr double kModulus = kYoung * (1.0 - kPoisson) / ((1.0 + kPoisson) * (1.0 - 2.0 * kPoisson));
constexpr double kStart = kLoad / (1.0 + kModulus * kStorage);
constexpr double kConsolidation = 5e-11 / 1e-3 / (kStorage + 1.0 / kModulus);

mpm::Simulation column(const std::string& shape, const std::string& permeability) {
  // Damping holds waves down while the load rises; later it would hold up the settlement.
  return start(
      "terzaghi_column",
      {"method.shape=" + shape, "materials.soil.permeability=" + permeability, "method.damping.grid='50*(t < 0.15)'"},
      1);
}

TEST(Consolidation, Column) {
  EXPECT_NEAR(degree(0.2), 0.50409, 1e-5);  // the reference's figure
  Page page("transport", "terzaghi_column", "A column of wet soil that drains at its top");
  page.problem(
          "A column 1 m high in 40 cells of 2 particles between smooth walls, E = 10 MPa, ν = 0.2, α = 1, 1/Q = "
          "1e-8/Pa, "
          "k = 5e-8 m²/(Pa s), is loaded by 10 kPa within T = 0.02.")
      .exact(
          "p = p0 Σ 2/N sin(Nz/H) exp(-N²T), p0 = αQs0/(M + α²Q), U = 1 - Σ 2/N² exp(-N²T); of the load as it rises.",
          "Terzaghi (1943), Biot (1941)")
      .scene("terzaghi_column");
  for (const std::string shape : {"ugimp", "cpdi"}) {
    mpm::Simulation simulation = column(shape, "5e-11");
    const Numbers place = field(simulation, "x");
    Panel* panel = nullptr;
    if (shape == "cpdi") panel = &page.figure().panel("Column, CPDI", "p / p0", "height [m]");
    for (const double factor : {0.1, 0.2, 0.5, 1.0}) {
      run_until(simulation, factor / kConsolidation);
      const double t = seconds(simulation);
      expect_balance(simulation, "pore_pressure");
      const Numbers p = field(simulation, "pore_pressure"), x = field(simulation, "x");
      const auto exact = [&](double height) {
        return kStart * after_rise(t, kRise, [&](double s) { return terzaghi(1.0 - height, kConsolidation * s); });
      };
      const std::string at = fmt::format(" at T = {:.1f}, {}", factor, shape);
      page.near("pressure at the base" + at, 1e-3 * p.front(), 1e-3 * exact(place.front()), 0.01, "kPa");
      const std::size_t middle = 60;  // three quarters up
      page.near("pressure at 3/4 of the height" + at, 1e-3 * p[middle], 1e-3 * exact(place[middle]), 0.01, "kPa");
      // The top particle settles from (s0 - alpha p0) / M of its height to s0 / M.
      const double settled = (place.back() - x.back()) / place.back() * kModulus / kLoad;
      const double undrained = 1.0 - kStart / kLoad;
      page.near("degree of consolidation" + at, (settled - undrained) / (1.0 - undrained),
                after_rise(t, kRise, [&](double s) { return degree(kConsolidation * s, 1.0 - place.back()); }), 0.01,
                "");
      if (panel == nullptr) continue;
      Numbers height, line, points;
      for (int i = 0; i <= 50; ++i) height.push_back(0.02 * i), line.push_back(exact(height.back()) / kStart);
      for (const double value : p) points.push_back(value / kStart);
      panel->exact(factor == 0.1 ? "series" : "", line, height).points(fmt::format("T = {}", factor), points, x);
    }
  }
  page.meaning("A pressure that conducts like heat and pushes the skeleton apart: both ways of the coupling.");
}

// Without permeability the water carries its part of the load for good, and nothing flows on the grid.
TEST(Consolidation, Undrained) {
  Page page("transport", "undrained_column", "Undrained soil under a load");
  page.problem("The column above without permeability, 0.1 s after the load.")
      .exact("p0 = αQs0/(M + α²Q), strain -(s0 - αp0)/M.", "Biot (1941)")
      .scene("terzaghi_column");
  for (const std::string shape : {"ugimp", "cpdi"}) {
    for (const double biot : {1.0, 0.8}) {
      mpm::Simulation simulation =
          start("terzaghi_column",
                {"method.shape=" + shape, "materials.soil.permeability=0", "transport.pore_pressure.values=[]",
                 fmt::format("materials.soil.biot={}", biot), "method.damping.grid=200"},
                1);
      const Numbers x0 = field(simulation, "x");
      run_until(simulation, 0.14);
      expect_balance(simulation, "pore_pressure");
      const double start_pressure = biot / kStorage * kLoad / (kModulus + biot * biot / kStorage);
      const Numbers p = field(simulation, "pore_pressure"), x = field(simulation, "x");
      const Misfit all = misfit(p, [&](std::size_t) { return start_pressure; });
      const std::string name = fmt::format(", α = {}, {}", biot, shape);
      page.near("start pressure in the middle" + name, 1e-3 * p[40], 1e-3 * start_pressure, 0.005, "kPa");
      page.below("largest error of a particle" + name, 100.0 * all.most / start_pressure, 0.5, "%");
      const double strain = (x.back() - x.front()) / (x0.back() - x0.front()) - 1.0;
      page.near("strain" + name, 1e3 * strain, -1e3 * (kLoad - biot * start_pressure) / kModulus, 0.005, "1e-3");
    }
  }
  page.meaning("Undrained soil is a pressure that each particle keeps to itself.");
}

// Numbers of consolidating_cylinder.
constexpr double kSoft = 1e7, kRing = 1e3, kRingRise = 0.03, kRingStorage = 2e-8, kFlow = 6e-8;
constexpr double kRingModulus = kSoft, kShear = 0.5 * kSoft;  // Poisson's ratio 0
constexpr double kRingStart = kRing / (1.0 + (kRingModulus - kShear) * kRingStorage);
constexpr double kRingConsolidation = kFlow / (kRingStorage + 1.0 / kRingModulus);

struct Ring {
  double z, factor;
};
/// Modes of p over p0.
std::vector<Ring> ring_modes() {
  const double g = kShear / kRingModulus, b = g / (kRingModulus * (1.0 - g) * (kRingStorage + 1.0 / kRingModulus));
  const double d = b / (1.0 + b);
  const auto left = [&](double z) { return z * std::cyl_bessel_j(0, z) - 2.0 * d * std::cyl_bessel_j(1, z); };
  std::vector<Ring> modes;
  double before = 0.05;
  for (double z = 0.1; modes.size() < 60; z += 0.05) {
    if (left(before) * left(z) < 0.0) {
      double low = before, high = z;
      for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (left(low) * left(middle) < 0.0 ? high : low) = middle;
      }
      const double j0 = std::cyl_bessel_j(0, low), j1 = std::cyl_bessel_j(1, low);
      modes.push_back({low, 2.0 * j1 / low / (j0 * j0 + j1 * j1 - j0 * j0 / d)});
    }
    before = z;
  }
  return modes;
}
double ring(const std::vector<Ring>& modes, double r, double time_factor) {
  double sum = 0.0;
  for (const Ring& mode : modes) {
    sum += mode.factor * (std::cyl_bessel_j(0, mode.z * r) - std::cyl_bessel_j(0, mode.z)) *
           std::exp(-mode.z * mode.z * time_factor);
  }
  return sum;
}

TEST(Consolidation, CylinderOvershoots) {
  const std::vector<Ring> modes = ring_modes();
  // Early the rim drains like a half space, so w stays what it was inside: p = 1 + d 4 sqrt(T / pi), d = 0.4545, to the
  // order of T.
  for (const double r : {0.0, 0.5}) EXPECT_NEAR(ring(modes, r, 2e-4), 1.0 + 0.4545 * 4.0 * std::sqrt(2e-4 / kPi), 5e-4);
  Page page("transport", "consolidating_cylinder", "A cylinder of wet soil, pressed all around");
  page.problem(
          "A long cylinder of 1 m radius in 20 cells, plane strain along its axis, E = 10 MPa, ν = 0, α = 1, 1/Q = "
          "2e-8/Pa, drains at its surface under a pressure of 1 kPa. The rim drains first and shrinks; it squeezes the "
          "core, whose pressure rises above that of the start (the effect of Mandel and Cryer).")
      .exact("p = p0 Σ A (J0(zr/R) - J0(z)) exp(-z²ct/R²), zJ0(z) = 2dJ1(z); of the load as it rises.",
             "the problem of de Leeuw (1965), derived in the test from Biot's equations")
      .scene("consolidating_cylinder");
  for (const std::string shape : {"ugimp", "cpdi"}) {
    mpm::Simulation simulation = start("consolidating_cylinder", {"method.shape=" + shape}, 1);
    const Numbers place = field(simulation, "x");
    const auto inner = std::min_element(place.begin(), place.end()) - place.begin();
    const auto middle = std::min_element(place.begin(), place.end(),
                                         [](double a, double b) { return std::abs(a - 0.5) < std::abs(b - 0.5); }) -
                        place.begin();
    Numbers times, axis, exact, half, exact_half;
    double most = 0.0, exact_most = 0.0, worst = 0.0;
    while (seconds(simulation) < 0.3 - 1e-9) {
      simulation.advance();
      const double t = seconds(simulation);
      const Numbers p = field(simulation, "pore_pressure");
      const auto of = [&](double r) {
        return after_rise(t, kRingRise,
                          [&](double s) { return s > 0.0 ? ring(modes, r, kRingConsolidation * s) : 0.0; });
      };
      times.push_back(kRingConsolidation * t);
      axis.push_back(p[inner] / kRingStart);
      exact.push_back(of(place[inner]));
      half.push_back(p[middle] / kRingStart);
      exact_half.push_back(of(place[middle]));
      most = std::max(most, axis.back());
      exact_most = std::max(exact_most, exact.back());
      if (t > 0.06)
        worst = std::max({worst, std::abs(axis.back() - exact.back()), std::abs(half.back() - exact_half.back())});
    }
    expect_balance(simulation, "pore_pressure");
    page.near("largest pressure on the axis over that of the start, " + shape, most, exact_most, 0.01, "");
    page.near_absolute("largest error on the axis and at half of the radius, T > 0.03, " + shape, 100.0 * worst, 0.0,
                       1.0, "% of p0");
    if (shape == "ugimp") continue;
    page.figure()
        .panel("Cylinder, CPDI", "T = ct/R²", "p / p0")
        .exact("series", times, exact)
        .exact("", times, exact_half)
        .points("axis", times, axis)
        .points("half of the radius", times, half);
  }
  page.meaning("Pressure and skeleton act on each other: conduction alone would never rise above the start.");
}

}  // namespace consolidation_test
}  // namespace verification
