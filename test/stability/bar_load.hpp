// A bar whose stretch is known for any strain: confined along z by slip walls, fixed at x = 0, and pulled or pressed by
// a load, spread over its last third, that balances the uniform stress of the rest. It starts with the velocity of a
// steady rate and keeps it: x = s(t) X, J = s, s = 1 + rate t, in the unloaded part. Neo-Hookean, uniaxial strain:
// sigma = K/2 (s - 1/s) + 2/3 G (s^2 - 1) s^(-5/3), Nairn & Guilkey (2015) eq. (65) with F = diag(s, 1, 1); the area
// does not change, so the load per area is sigma too.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "scenes.hpp"

namespace stability {

constexpr double kBarLength = 24.0, kBarHeight = 2.0;  // [cells]
constexpr double kBarLoaded = 8.0;                     // length of the loaded part [cells]
constexpr double kBarPoisson = 0.3;

inline double bar_stress(double s) {
  const mpm::Elasticity e{young_of(kBarPoisson), kBarPoisson};
  return 0.5 * e.bulk() * (s - 1.0 / s) + 2.0 / 3.0 * e.shear() * (s * s - 1.0) * std::pow(s, -5.0 / 3.0);
}

/// `end_speed`: speed of the bar's end over the wave speed, positive to pull. `longest`: largest stretch.
inline mpm::SimulationDefinition loaded_bar(const mpm::MethodDefinition& method, double end_speed, double longest) {
  const double rate = end_speed * kWaveSpeed / (kBarLength * kCell);  // [1/s]
  // One sync point per 0.5 % of stretch.
  mpm::SimulationDefinition d =
      domain(method, Vec3::Zero(), {std::ceil(kBarLength * longest) + 4.0, 0.0, kBarHeight}, 0.005 / std::abs(rate));
  d.time.cfl = 0.4;
  add_body(d, "bar", Vec3::Zero(), {kBarLength, 0.0, kBarHeight}, neo_hookean(kBarPoisson),
           [rate](const Vec3& x) { return Vec3(rate * x.x(), 0.0, 0.0); });
  wall(d, {"x_min", "z_min", "z_max"}, mpm::WallKind::slip);
  const mpm::Elasticity e{young_of(kBarPoisson), kBarPoisson};
  const double mass = kDensity * kBarLoaded * kCell;  // mass of the loaded part per area
  const std::string s = fmt::format("(1+{:.17g}*t)", rate);
  mpm::BodyForceDefinition load;
  load.acceleration[0] = mpm::Function::parse(
      fmt::format("(X>{:.17g})*({:.17g}*({s}-1/{s})+{:.17g}*({s}^2-1)*{s}^(-5/3))", kCell * (kBarLength - kBarLoaded),
                  0.5 * e.bulk() / mass, 2.0 / 3.0 * e.shear() / mass, fmt::arg("s", s)),
      {}, mpm::FunctionPlaces::present_and_start);
  d.body_forces = {load};
  return d;
}

struct BarRun {
  double reached = 1.0;  // stretch up to which the bar remained intact
  std::string why;       // cause of the failure
  bool broke() const { return !why.empty(); }
  std::string end() const { return broke() ? ": " + why : " (to the end)"; }
};

/// Runs to the stretch `end`, or until the bar breaks: columns that started side by side are apart by more than twice
/// the exact distance, J is off by `swing` somewhere in the half away from the load, or the solver fails.
inline BarRun run_bar(const mpm::SimulationDefinition& d, double end_speed, double end, double swing) {
  BarRun run;
  const double rate = end_speed * kWaveSpeed / (kBarLength * kCell);
  try {
    mpm::Simulation simulation(d, {1});
    const std::vector<double> start = field(simulation, "x");
    std::vector<std::size_t> order;  // particles of the half away from the load, along the bar
    for (std::size_t p = 0; p < start.size(); ++p) {
      if (start[p] < kBarLength * kCell / 2.0 && field(simulation, "z")[p] < kCell / d.method.particles_per_direction) {
        order.push_back(p);
      }
    }
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return start[a] < start[b]; });
    for (double s = 1.0; (end - s) * rate > 0.0;) {
      simulation.advance();
      s = 1.0 + rate * seconds(simulation);
      const std::vector<double> x = field(simulation, "x"), j = field(simulation, "j");
      double gap = 0.0, error = 0.0;
      for (std::size_t i = 0; i < order.size(); ++i) {
        error = std::max(error, std::abs(j[order[i]] / s - 1.0));
        if (i > 0) gap = std::max(gap, (x[order[i]] - x[order[i - 1]]) / (s * (start[order[i]] - start[order[i - 1]])));
      }
      if (!(gap < 2.0)) run.why = "columns part";
      if (!(error < swing)) run.why = "volume swings";
      if (!run.why.empty()) return run;
      run.reached = s;
    }
  } catch (const mpm::PhysicsError& physics) {
    const std::string text = physics.what();
    run.why = text.substr(0, text.find(':'));  // without the particle and the advice
  }
  return run;
}

}  // namespace stability
