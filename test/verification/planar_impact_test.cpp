// Planar impact: tungsten into steel at 1.70 km/s, constants of Nairn & Guilkey (2015), Table I. Two shocks run from
// the face where the bars meet; between them velocity and longitudinal stress are the same in both. Across a shock into
// material at rest with the speed U, u the speed behind it,
//   sigma = rho0 U u      (momentum),   U = C0 + S u   (the Hugoniot)
// so 49.405 GPa at u = 1.10500 km/s (exact-solutions 17), without strength.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "page.hpp"
#include "scene_run.hpp"

namespace verification {
namespace {

constexpr double kSpeed = 1700.0, kFace = 24.0;          // of the scene [m/s], [mm]
constexpr double kInterface = 1105.0, kStress = 49.405;  // [m/s], [GPa]
constexpr double kSteelShock = 5.6956;                   // in the steel at rest [km/s]
constexpr double kTungstenShock = 4.7178;                // relative to the tungsten ahead of it [km/s]

struct Mean {
  double sum = 0.0, squares = 0.0, count = 0.0;
  void add(double value) { sum += value, squares += value * value, count += 1.0; }
  double value() const { return sum / count; }
  double scatter() const { return std::sqrt(std::max(squares / count - value() * value(), 0.0)); }
};

struct Impact {
  Mean velocity, stress;                           // between the shocks [m/s], [GPa]
  Mean tungsten, steel;                            // pressure in either [GPa]
  double force = 0.0;                              // on the steel, the mean of the second half [GPa]
  double steel_shock = 0.0, tungsten_shock = 0.0;  // [km/s]
  double energy = 0.0;                             // kinetic + elastic + plastic, change over the start
  double audit = 0.0;                              // momentum left over, of what was exchanged
  double hottest = 0.0;                            // [K]
  Numbers x, v, p;                                 // [mm], [m/s], [GPa]
};

/// Where the velocity, averaged over three cells, goes through `level`, from the end `from` inwards [mm].
double front(const Numbers& x, const Numbers& v, double level, bool from_right) {
  constexpr int kWindow = 6;  // particles
  const int n = static_cast<int>(x.size());
  const auto average = [&](const Numbers& values, int i) {
    double sum = 0.0;
    for (int k = i; k < i + kWindow; ++k) sum += values[k];
    return sum / kWindow;
  };
  const int first = from_right ? n - kWindow : 0, step = from_right ? -1 : 1;
  const double sign = from_right ? 1.0 : -1.0;  // velocity rises from the right, falls from the left
  for (int i = first; i + step >= 0 && i + step + kWindow <= n; i += step) {
    const double a = sign * (average(v, i) - level), b = sign * (average(v, i + step) - level);
    if (b < 0.0) continue;
    return average(x, i) + (average(x, i + step) - average(x, i)) * a / (a - b);
  }
  return 0.0;
}

Impact hit(const std::vector<std::string>& overrides) {
  mpm::Simulation simulation = start("planar_impact", overrides, 1);
  const mpm::EnergyReport before = simulation.state().energy;
  Impact impact;
  double right = 0.0, left = 0.0, momentum = 0.0;  // at 1 us
  const auto steel_momentum = [&](const Numbers& x, const Numbers& v, const Numbers& body) {
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += body[i] == 1.0 ? v[i] : 0.0;
    return sum * 7850.0 * 0.05e-3;  // two particles in a cell of 0.1 mm, an area of 1 m^2 [N s]
  };
  for (const double end : {1e-6, 2e-6}) {
    run_until(simulation, end);
    Numbers x = field(simulation, "x"), v = field(simulation, "vx");
    for (double& place : x) place *= 1e3;
    const double gained = steel_momentum(x, v, field(simulation, "body"));
    const double to_right = front(x, v, 0.5 * kInterface, true);
    const double to_left = front(x, v, 0.5 * (kInterface + kSpeed), false);
    impact.steel_shock = to_right - right;  // [mm/us]
    impact.tungsten_shock = 1e-3 * kSpeed - (to_left - left);
    impact.force = (gained - momentum) / 1e-6 * 1e-9;
    right = to_right, left = to_left, momentum = gained;
  }
  impact.x = field(simulation, "x");
  impact.v = field(simulation, "vx");
  impact.p = field(simulation, "p");
  const Numbers sxx = field(simulation, "sxx"), heat = field(simulation, "temperature");
  const double face = kFace + 2e-3 * kInterface;
  for (std::size_t i = 0; i < sxx.size(); ++i) {
    const double x = impact.x[i] *= 1e3, p = impact.p[i] *= 1e-9;
    impact.hottest = std::max(impact.hottest, heat[i]);
    // A millimetre, ten cells, from the face and two from the shocks.
    const double past = x - face;
    if (past > -6.2 && past < 7.1) impact.velocity.add(impact.v[i]), impact.stress.add(-1e-9 * sxx[i]);
    if (past > -6.2 && past < -1.0) impact.tungsten.add(p);
    if (past > 1.0 && past < 7.1) impact.steel.add(p);
  }
  const mpm::EnergyReport after = simulation.state().energy;
  impact.energy = (after.total() + after.plastic) / (before.total() + before.plastic) - 1.0;
  impact.audit = simulation.state().audit.residual;
  return impact;
}

TEST(PlanarImpact, DISABLED_Probe) {
  const std::vector<std::string> fluid = {"materials.tungsten.A=1 kPa", "materials.tungsten.B=0",
                                          "materials.steel.A=1 kPa", "materials.steel.B=0"};
  for (const char* method : {"", "method.transfer=flip", "method.update=usf", "method.transfer={flip: 0.99}",
                             "method.transfer=apic", "method.transfer={xpic: 2}", "method.transfer={fmpm: 2}",
                             "method.transfer=pic", "method.shape=bspline2", "time.cfl=0.2"}) {
    for (const bool strength : {false, true}) {
      std::vector<std::string> o = strength ? std::vector<std::string>{} : fluid;
      if (*method != 0) o.emplace_back(method);
      try {
        const Impact i = hit(o);
        fmt::print(
            "{:32} {} v {:.2f} +- {:.1f}  s {:.3f} +- {:.2f}  pW {:.3f} +- {:.2f} pFe {:.3f} +- {:.2f} force {:.3f} Us "
            "{:.4f} {:.4f} E {:.2e} audit {:.1e} T {:.0f}\n",
            method, strength, i.velocity.value(), i.velocity.scatter(), i.stress.value(), i.stress.scatter(),
            i.tungsten.value(), i.tungsten.scatter(), i.steel.value(), i.steel.scatter(), i.force, i.steel_shock,
            i.tungsten_shock, i.energy, i.audit, i.hottest);
      } catch (const std::exception& e) {
        fmt::print("{} {} {}\n", method, strength, e.what());
      }
    }
  }
}

}  // namespace
}  // namespace verification
