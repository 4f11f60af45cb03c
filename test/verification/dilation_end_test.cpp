// Soil whose dilation ends where a shear band has gained a thickness: a band in a shear box, and a blade, on grids of
// several cells. Cost: 6 s.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "mpm/math/constants.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"
#include "study/tool_force/run.hpp"

namespace mpm {
namespace dilation_end_test {

constexpr double kDegree = kPi / 180.0;

/// Rise of a band in a shear box at its end, and the way of the lid at which half of it is gained [m]. Specimen: 0.4 m
/// high, under 100 kPa on all sides, its foot held and its lid free to rise, 8 cells long and endless; a row of cells
/// in its middle is weaker by 2 %, where the band begins.
struct Risen {
  double rise = 0.0, half = 0.0;
};
Risen sheared(const std::string& law, double cell) {
  const std::string h = std::to_string(cell), length = std::to_string(8.0 * cell);
  const auto soil = [&](const std::string& name, double friction) {
    return "  - {name: " + name + ", density: 2000, law: " + law +
           ", young: 30 MPa, poisson: 0.2, friction_angle: " + std::to_string(friction) +
           " deg, dilation_angle: 15 deg, dilation_limit: none, dilation_rise: 5 mm}\n";
  };
  const auto body = [&](const std::string& name, const std::string& material, double from, double to) {
    return "  - {name: " + name + ", material: " + material +
           ", initial: {stress: {xx: -100 kPa, yy: -100 kPa, zz: -100 kPa}}, shape: {box: {min: [0, " +
           std::to_string(from) + "], max: [" + length + ", " + std::to_string(to) + "]}}}\n";
  };
  const Scene scene = parse_scene(
      "geometry: plane_strain\nthickness: 1\ngrid: {cell: " + h + ", min: [0, -0.2], max: [" + length +
          ", 0.6]}\n"
          "time: {end: 0.7, sync: 5 ms}\nmethod: {transfer: {flip: 0.95}}\n"
          "materials:\n" +
          soil("soil", 30.0) + soil("weak", 29.4) + "bodies:\n" + body("below", "soil", 0.0, 0.2) +
          body("band", "weak", 0.2, 0.2 + cell) + body("above", "soil", 0.2 + cell, 0.4) +
          "loads:\n  - {traction: {body: above, edge: z_max, traction: [0, -100e3]}}\n"
          "boundaries:\n  x: periodic\n  conditions:\n"
          "    - {region: {box: {min: [-1, -1], max: [1, 0.001]}}, direction: x, velocity: 0}\n"
          "    - {region: {box: {min: [-1, -1], max: [1, 0.001]}}, direction: z, velocity: 0}\n"
          "    - {region: {box: {min: [-1, 0.399], max: [1, 1]}}, direction: x, velocity: \"0.06*min(1, 10*t)\"}\n",
      "shear.yaml", {});
  Simulation simulation(build(scene), {1});
  std::vector<double> z, j, way, height;
  simulation.particle_field("z", z);
  while (simulation.time() < 700'000'000) {
    simulation.advance();
    simulation.particle_field("j", j);
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < z.size(); ++i) {
      if (z[i] < 0.2 || z[i] > 0.2 + cell) continue;  // at the start
      sum += j[i] - 1.0;
      count += 1.0;
    }
    const double t = 1e-9 * static_cast<double>(simulation.time());
    way.push_back(0.06 * (t < 0.1 ? 5.0 * t * t : t - 0.05));
    height.push_back(cell * sum / count);
  }
  Risen risen{height.back(), 0.0};
  std::size_t k = 0;
  while (height[k] < 0.5 * risen.rise) ++k;
  risen.half = way[k - 1] + (way[k] - way[k - 1]) * (0.5 * risen.rise - height[k - 1]) / (height[k] - height[k - 1]);
  return risen;
}

// The band gains the thickness of the scene on both grids, in its row of cells; an end at a strain would halve it from
// one to the other. 1 %: elastic strain and the end of an exponential. On the way to half of it the lid moves by half
// of the rise / tan(psi) and by what the specimen above and below shears before the band has formed, 4 to 5 mm: so the
// two ways agree to 5 %. 5 s.
TEST(DilationEnd, ABandRisesByTheSameOnTwoGrids) {
  constexpr double kRise = 5e-3;
  for (const char* law : {"drucker_prager", "mohr_coulomb"}) {
    const Risen coarse = sheared(law, 0.05), fine = sheared(law, 0.025);
    for (const Risen& risen : {coarse, fine}) {
      EXPECT_NEAR(risen.rise, kRise, 0.01 * kRise) << law;
      EXPECT_GT(risen.half, 0.5 * kRise / std::tan(15.0 * kDegree)) << law;
    }
    EXPECT_NEAR(fine.half / coarse.half, 1.0, 0.05) << law;
  }
}

// A blade as rough as its sand, 30 degrees of friction and of dilation, after a travel of 6 to 14 % of its depth of 0.2
// m. Once the bands before it have risen, the sand is as strong as one of Davis's (1968) reduced friction, an estimate:
// with that the force lies between Lancellotta's bound and the log spiral's, 0.67 and 0.77 of the force while sand
// dilates on. Measured are 0.72, 0.73 and 0.72 with 4, 8 and 12 cells and a rise of 1 mm, 0.72, 0.76 and 0.76 with 2
// mm; asked for are 3 % beyond these bounds, and from 8 cells to 12. An end at a strain of 0.1 meets 0.77 and 0.71. 5
// s.
TEST(DilationEnd, RoughBladeMeetsTheSameForceOnTwoGrids) {
  const double friction = 30.0 * kDegree, reduced = study::davis_friction(friction, 0.0), travel = 0.1;
  const auto grown = [travel](double angle) { return 1.0 + travel * study::swept_soil_growth(angle, true); };
  const double whole = study::rough_wall_coefficient(friction).upper * grown(friction);
  const study::Bounds end = study::rough_wall_coefficient(reduced);
  const double least = end.lower * grown(reduced) / whole, most = end.upper * grown(reduced) / whole;
  const auto& problem = study::tool_force::find_problem("blade_rough");
  const std::vector<std::vector<std::string>> ends = {{"materials.soil.dilation_limit=0.1"},  // and a rise of 1 mm
                                                      {"materials.soil.dilation_rise=2 mm"}};
  for (const auto& keys : ends) {
    std::vector<double> forces;
    for (const double cells : {4.0, 8.0, 12.0}) {
      const auto row = study::tool_force::run_row(problem, cells, keys);
      ASSERT_EQ(row.status, "ok") << row.message;
      EXPECT_GT(row.over_exact, 0.97 * least) << keys[0] << ' ' << cells;
      EXPECT_LT(row.over_exact, 1.03 * most) << keys[0] << ' ' << cells;
      forces.push_back(row.over_exact);
    }
    EXPECT_NEAR(forces[2] / forces[1], 1.0, 0.03) << keys[0];
  }
}

}  // namespace dilation_end_test
}  // namespace mpm
