// Limit load of a thick cylinder in plane strain, of metal without hardening (von Mises). The load is a radial body
// force in its inner part that grows slowly. For any radial load q(r) per volume on smooth rims, equilibrium over the
// thickness requires  integral of q dr = integral of (sigma_theta - sigma_r) / r dr,  and fully plastic metal has
// sigma_theta - sigma_r = 2 / sqrt(3) yield, so the limit is the one of a pressure inside:
//   p = 2 / sqrt(3) yield ln(b / a).
// Source: Hill (1950), The Mathematical Theory of Plasticity, chapter 5, for a pressure; the body force derived here.
// The resistance of the cylinder is found from the load minus mass times acceleration, by virtual work with the
// velocity field of an incompressible cylinder, 1 / r: no quasi-static run is needed.
#include <algorithm>
#include <cmath>

#include "mpm/math/constants.hpp"
#include "page.hpp"
#include "scene_run.hpp"

namespace verification {
namespace thick_cylinder_test {

using mpm::kPi;
constexpr double kInner = 0.1, kOuter = 0.2, kBand = 0.02;           // radii, thickness of the loaded part [m]
constexpr double kYoung = 200e9, kYield = 250e6, kDensity = 7800.0;  // [Pa], [kg/m^3]
constexpr double kRamp = 250e6 / 2e-3;                               // growth of the load [Pa/s]
const double kLimit = 2.0 / std::sqrt(3.0) * kYield * std::log(kOuter / kInner);  // 200.1 MPa

mpm::SimulationDefinition quarter(double cell) {
  mpm::SimulationDefinition d;
  d.name = "thick cylinder";
  d.geometry = mpm::GeometryKind::plane_strain;
  d.grid = {mpm::Vec3::Constant(cell), mpm::Vec3::Zero(), mpm::Vec3::Constant(0.24)};
  d.time.sync = 20'000;
  d.materials = {{"metal", kDensity, mpm::J2PlasticityDefinition{{kYoung, 0.3}, kYield, 0.0, 0.0, 0.0}}};
  mpm::DeformableBody body;
  body.name = "cylinder";
  body.material = "metal";
  const double spacing = 0.5 * cell;
  for (double x = 0.5 * spacing; x < kOuter; x += spacing) {
    for (double z = 0.5 * spacing; z < kOuter; z += spacing) {
      const double r = std::hypot(x, z);
      if (r > kInner && r < kOuter) body.positions.emplace_back(x, 0.0, z);
    }
  }
  body.particle_volume = spacing * spacing;
  d.bodies = {body};
  d.walls[0].kind = d.walls[4].kind = mpm::WallKind::slip;
  const std::string load = "(X*X + Z*Z < " + std::to_string((kInner + kBand) * (kInner + kBand)) + " ? " +
                           std::to_string(kRamp / (kDensity * kBand)) + "*t/sqrt(X*X + Z*Z) : 0)";
  const auto along = [&](const char* axis) {
    return mpm::Function::parse(load + "*" + axis, {}, mpm::FunctionPlaces::present_and_start);
  };
  d.body_forces = {{"", {along("X"), mpm::Function(), along("Z")}}};
  return d;
}

TEST(Metal, ThickCylinderReachesItsLimitLoad) {
  Page page("metal", "thick_cylinder", "Limit load of a thick cylinder");
  page.problem(
      "A cylinder of metal without hardening, 100 mm inside and 200 mm outside in radius, in plane strain (E = 200 "
      "GPa, "
      "nu = 0.3, yield stress 250 MPa), is pushed outwards by a radial body force in its innermost 20 mm that grows by "
      "250 MPa (times the loaded thickness) in 2 ms. A quarter of it, cells of 5 mm, uGIMP, USAVG.");
  page.exact(
      "the limit load of fully plastic metal is that of an inner pressure, 2/sqrt(3) yield ln(b/a) = 200.1 MPa; it "
      "does not depend on where the load acts.",
      "Hill (1950), The Mathematical Theory of Plasticity, ch. 5; for the body force by equilibrium, derived in the "
      "test");
  const mpm::SimulationDefinition definition = quarter(0.005);
  mpm::Simulation simulation(definition);
  std::vector<double> start_r;
  for (const mpm::Vec3& p : definition.bodies[0].positions) start_r.push_back(std::hypot(p.x(), p.z()));
  const double mass = kDensity * definition.bodies[0].particle_volume;
  // Virtual work of the load at time 1 s, and of inertia, with the velocity (1 / r) radially, over a right angle,
  // normalised so that a pressure p at the inner rim gives p.
  double load = 0.0;
  std::size_t inner = 0;
  for (std::size_t p = 0; p < start_r.size(); ++p) {
    if (start_r[p] < kInner + kBand) load += mass * kRamp / (kDensity * kBand) / start_r[p] / (0.5 * kPi);
    if (start_r[p] < start_r[inner]) inner = p;
  }
  const auto momentum = [&] {
    const std::vector<double> x = field(simulation, "x"), z = field(simulation, "z"), vx = field(simulation, "vx"),
                              vz = field(simulation, "vz");
    double sum = 0.0;
    for (std::size_t p = 0; p < x.size(); ++p) {
      sum += mass * (vx[p] * x[p] + vz[p] * z[p]) / (x[p] * x[p] + z[p] * z[p]) / (0.5 * kPi);
    }
    return sum;
  };
  Numbers opening, applied, resisted, yielded;
  double before = momentum(), earlier = 0.0;
  while (opening.empty() || opening.back() < 1.0) {
    for (int i = 0; i < 5; ++i) simulation.advance();  // inertia over 0.1 ms
    const double t = seconds(simulation), now = momentum();
    const double inertia = (now - before) / (t - earlier);
    const std::vector<double> x = field(simulation, "x"), z = field(simulation, "z"), ep = field(simulation, "ep");
    opening.push_back(100.0 * (std::hypot(x[inner], z[inner]) / start_r[inner] - 1.0));
    applied.push_back(load * t / 1e6);
    resisted.push_back((load * 0.5 * (t + earlier) - inertia) / 1e6);
    yielded.push_back(static_cast<double>(std::count_if(ep.begin(), ep.end(), [](double e) { return e > 0.0; })) /
                      static_cast<double>(ep.size()));
    before = now;
    earlier = t;
    ASSERT_LT(t, 4e-3) << "no limit was found";
  }
  double plateau = 0.0, count = 0.0;
  for (std::size_t i = 0; i < opening.size(); ++i) {
    if (opening[i] < 0.4) continue;
    plateau += resisted[i];
    count += 1.0;
  }
  page.near("resistance once the bore has opened by 0.4 %", plateau / count, kLimit / 1e6, 0.03, "MPa");
  page.report("part of the particles that has yielded then", 100.0 * yielded.back(), "%");
  page.figure()
      .panel("Load and resistance", "opening of the bore [%]", "load as a pressure inside [MPa]")
      .exact("limit", {0.0, 1.0}, {kLimit / 1e6, kLimit / 1e6})
      .line("applied", opening, applied)
      .points("resisted", opening, resisted);
  const std::vector<double> x = field(simulation, "x"), z = field(simulation, "z");
  std::vector<double> percent = field(simulation, "ep");
  for (double& e : percent) e *= 100.0;
  page.figure().panel("Plastic strain at the end", "x [m]", "z [m]").particles("plastic strain [%]", x, z, percent);
  page.meaning(
      "Metal that yields everywhere carries its limit load and no more: locking of the linear shape functions, which "
      "raises such loads on coarse grids, stays within the tolerance.");
}

}  // namespace thick_cylinder_test
}  // namespace verification
