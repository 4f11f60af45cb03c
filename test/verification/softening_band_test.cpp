// Soil whose strength falls over a slip: a shear band on two grids.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "mpm/math/constants.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace softening_band_test {

constexpr double kDegree = kPi / 180.0;

/// Half of the way that the lid of a sheared specimen moves while its strength falls, beyond that to the peak [m].
/// Specimen: 0.4 m high, under 100 kPa on all sides, its top and bottom held at their height, endless along x; a row of
/// cells in its middle is weaker by 2 %, where the band begins.
struct Fallen {
  double peak, residual;  ///< shear stress [Pa]
  double way;             ///< way of the lid at half of the fall [m]
};
Fallen sheared(const std::string& law, double cell) {
  const std::string h = std::to_string(cell);
  const auto soil = [&](const std::string& name, double friction, const std::string& more) {
    return "  - {name: " + name + ", density: 2000, law: " + law +
           ", young: 60 MPa, poisson: 0.2, friction_angle: " + std::to_string(friction) +
           " deg, residual_friction_angle: 20 deg, softening_slip: 20 mm" + more + "}\n";
  };
  const auto body = [&](const std::string& name, const std::string& material, double from, double to) {
    return "  - {name: " + name + ", material: " + material +
           ", initial: {stress: {xx: -100 kPa, yy: -100 kPa, zz: -100 kPa}}, shape: {box: {min: [0, " +
           std::to_string(from) + "], max: [0.4, " + std::to_string(to) + "]}}}\n";
  };
  const Scene scene = parse_scene(
      "geometry: plane_strain\nthickness: 1\ngrid: {cell: " + h +
          ", min: [0, -0.2], max: [0.4, 0.6]}\n"
          "time: {end: 1, sync: 5 ms}\nmethod: {transfer: {flip: 0.95}}\n"
          "materials:\n" +
          soil("soil", 30.0, "") + soil("weak", 29.4, "") + "bodies:\n" + body("below", "soil", 0.0, 0.2) +
          body("band", "weak", 0.2, 0.2 + cell) + body("above", "soil", 0.2 + cell, 0.4) +
          "boundaries:\n  x: periodic\n  conditions:\n"
          "    - {region: {box: {min: [-1, -1], max: [1, 0.001]}}, direction: x, velocity: 0}\n"
          "    - {region: {box: {min: [-1, -1], max: [1, 0.001]}}, direction: z, velocity: 0}\n"
          "    - {region: {box: {min: [-1, 0.399], max: [1, 1]}}, direction: x, velocity: \"0.04*min(1, 10*t)\"}\n"
          "    - {region: {box: {min: [-1, 0.399], max: [1, 1]}}, direction: z, velocity: 0}\n",
      "shear.yaml", {});
  Simulation simulation(build(scene), {1});
  std::vector<double> sxz, way, stress;
  while (simulation.time() < 1'000'000'000) {
    simulation.advance();
    simulation.particle_field("sxz", sxz);
    double sum = 0.0;
    for (const double s : sxz) sum += s;
    const double t = 1e-9 * static_cast<double>(simulation.time());
    way.push_back(0.04 * (t < 0.1 ? 5.0 * t * t : t - 0.05));
    stress.push_back(sum / static_cast<double>(sxz.size()));
  }
  std::size_t k = 0;
  for (std::size_t i = 0; i < stress.size(); ++i) {
    if (stress[i] > stress[k]) k = i;
  }
  Fallen fallen{stress[k], stress.back(), 0.0};
  const double half = 0.5 * (fallen.peak + fallen.residual);
  while (stress[k] > half) ++k;
  fallen.way = way[k - 1] + (way[k] - way[k - 1]) * (stress[k - 1] - half) / (stress[k - 1] - stress[k]);
  return fallen;
}

// The specimen's strength p sin(phi) goes from 29.4 degrees to 20 over a slip of 20 mm in one row of cells; at half of
// the fall the lid has moved by half of the slip and by the elastic shear of the height. The two grids give that way to
// 2 %, where a fall tied to strain would halve the slip from one to the other. 2 s in all.
TEST(SofteningBand, TakesTheSameSlipOnTwoGrids) {
  const double peak = 100e3 * std::sin(29.4 * kDegree), residual = 100e3 * std::sin(20.0 * kDegree);
  const double half = 0.5 * (peak + residual), way = 0.5 * 0.02 + half / Elasticity{60e6, 0.2}.shear() * 0.4;
  for (const char* law : {"drucker_prager", "mohr_coulomb"}) {
    for (const double cell : {0.05, 0.025}) {
      const Fallen fallen = sheared(law, cell);
      EXPECT_NEAR(fallen.peak, peak, 0.02 * peak) << law << ' ' << cell;
      EXPECT_NEAR(fallen.residual, residual, 0.02 * residual) << law << ' ' << cell;
      EXPECT_NEAR(fallen.way, way, 0.02 * way) << law << ' ' << cell;
    }
  }
}

}  // namespace softening_band_test
}  // namespace mpm
