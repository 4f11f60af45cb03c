// Volumetric locking. A square with slip walls swings in an isochoric mode: velocity
//   (sin kx cos kz, -cos kx sin kz), k = pi / L.
// Its divergence is zero and it causes no shear on the walls, so omega = k sqrt(2 G / rho) for any bulk modulus. It
// solves rho u_tt = G laplace u, div u = 0 with the walls' conditions. On the grid the divergence of the mode is not
// zero within a cell, which stiffens the motion the more, the nearer the material is to incompressible.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "methods.hpp"
#include "page.hpp"
#include "scenes.hpp"

namespace stability {
namespace locking_test {

using verification::Map;
using verification::Numbers;
using verification::Outcome;
using verification::Page;

constexpr double kShearSpeed = 10.0;  // sqrt(G / rho) [m/s]
constexpr double kLocked = 1.1;       // ratio to the method's frequency at ν = 0.3 that counts as locked

mpm::SimulationDefinition square(const mpm::MethodDefinition& method, int cells, double poisson) {
  const double length = cells * kCell, period = std::sqrt(2.0) * length / kShearSpeed;
  mpm::SimulationDefinition d = domain(method, Vec3::Zero(), Vec3(cells, 0.0, cells), period / 400.0);
  const double young = 2.0 * kDensity * kShearSpeed * kShearSpeed * (1.0 + poisson), k = kPi / length;
  const double speed = 1e-5 * kShearSpeed;  // strain stays below 1e-5
  add_body(d, "square", Vec3::Zero(), Vec3(cells, 0.0, cells), mpm::LinearElasticDefinition{{young, poisson}},
           [=](const Vec3& x) -> Vec3 {
             return speed *
                    Vec3(std::sin(k * x.x()) * std::cos(k * x.z()), 0.0, -std::cos(k * x.x()) * std::sin(k * x.z()));
           });
  wall(d, {"x_min", "x_max", "z_min", "z_max"}, mpm::WallKind::slip);
  d.time.cfl = 0.8;
  return d;
}

/// Frequency over the exact one, from the time at which the displacement of the mode returns to zero.
double frequency(const mpm::SimulationDefinition& d, int cells) {
  mpm::Simulation simulation(d, {1});
  const std::vector<double> x0 = field(simulation, "x"), z0 = field(simulation, "z");
  const double k = kPi / (cells * kCell), half_period = 1.0 / (std::sqrt(2.0) * k * kShearSpeed) * kPi;
  double before = 0.0;
  for (int i = 1; i < 1000; ++i) {
    simulation.advance();
    const std::vector<double> x = field(simulation, "x"), z = field(simulation, "z");
    double mode = 0.0;
    for (std::size_t p = 0; p < x.size(); ++p) {
      mode += (x[p] - x0[p]) * std::sin(k * x0[p]) * std::cos(k * z0[p]) -
              (z[p] - z0[p]) * std::cos(k * x0[p]) * std::sin(k * z0[p]);
    }
    if (i > 1 && mode <= 0.0) {
      const double period = 1e-9 * static_cast<double>(simulation.sync_period());
      return half_period / (seconds(simulation) - period * mode / (mode - before));
    }
    before = mode;
  }
  return 0.0;
}

TEST(Locking, OfAnIsochoricMode) {
  Page page("locking", "locking", "Volumetric locking");
  page.problem(
          "A square of 8 × 8 cells between slip walls swings in a mode without change of volume. Linear elastic, "
          "amplitude 1e-5, Poisson's ratio from 0.3 to 0.4999; 4 particles a cell, USAVG, FLIP. Locked: the frequency "
          "is a tenth higher than the same method's at ν = 0.3.")
      .exact("ω = (π/L) √(2G/ρ), whatever the bulk modulus: the mode is free of divergence and of shear on the walls.",
             "ρ u_tt = G Δu with div u = 0")
      .meaning(
          "Hat functions, averaged over whatever domain, give a divergence within a cell to a mode that has none: at "
          "ν = 0.4999 a square of 8 × 8 cells swings five times too fast. Quadratic and cubic splines do not lock "
          "here. `method.average_dilatation` removes locking from all: the frequency does not depend on ν. All are "
          "slightly slow on eight cells.");
  const Numbers ratios = {0.3, 0.45, 0.49, 0.495, 0.499, 0.4995, 0.4999};
  Map map("Poisson's ratio", ratios);
  verification::Panel& panel =
      page.figure().panel("8 × 8 cells", "bulk over shear modulus", "frequency over the exact");
  panel.log_x();
  for (const bool averaged : {false, true}) {
    for (Method method : shapes()) {
      method.definition.average_dilatation = averaged;
      const std::string label = method.name + (averaged ? ", averaged" : "");
      if (!possible(square(method.definition, 8, 0.3), method.definition)) {
        map.impossible(label);
        continue;
      }
      Numbers modulus, reached;
      std::vector<Outcome> cells;
      for (const double ratio : ratios) {
        reached.push_back(frequency(square(method.definition, 8, ratio), 8));
        modulus.push_back(2.0 * (1.0 + ratio) / (3.0 * (1.0 - 2.0 * ratio)));
        cells.push_back(reached.back() < kLocked * reached.front() ? Outcome::stable : Outcome::fails);
      }
      map.column(label, cells);
      panel.line(label, modulus, reached);
      page.report("frequency over the exact one at ν = 0.3, " + label, reached.front(), "");
      if (averaged) {
        page.below("the same at ν = 0.4999, over that at 0.3, " + label, reached.back() / reached.front(), kLocked, "");
      } else {
        page.report("the same at ν = 0.4999, " + label, reached.back(), "");
      }
    }
  }
  page.figure().panel("The frequency does not rise", "", "").map(map);
}

}  // namespace locking_test
}  // namespace stability
