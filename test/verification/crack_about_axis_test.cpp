// Cracks about an axis that are not normal to it, a cone and a cylinder, under pressure on their faces: J along the
// tip's direction in both forms and on contours of three sizes, against the energy that a longer crack releases.
//
// At constant pressure G = dU / dA, U the strain energy and A the area of the crack (Griffith): here the difference of
// two runs, with tips 1 mm shorter and longer. Of the term of the area in J_z, crack reference 4.6.
#include <fmt/core.h>

#include "mpm/math/constants.hpp"
#include "page.hpp"
#include "scene_run.hpp"

namespace verification {
namespace crack_about_axis_test {

using mpm::kPi;

const char* const kScene = R"yaml(
name: crack_about_axis
geometry: axisymmetric
grid: {cell: 1 mm, min: [0, -44 mm], max: [44 mm, 44 mm]}
time: {end: 0.4 ms, cfl: 0.6, sync: 0.1 ms}
method: {damping: {grid: 8e4 1/s}}
materials: [{name: polymer, law: linear_elastic, density: 1000, young: 2500 MPa, poisson: 0.33}]
bodies: [{name: rod, material: polymer, shape: {box: {min: [0, -40 mm], max: [40 mm, 40 mm]}}}]
cracks:
  traction_laws: {gas: {kind: pressure, pressure: "-1e5*min(t/2e-4,1)"}}
  list: )yaml";

/// From the axis to the radius `tip` [mm], rising at 45 degrees.
std::string cone(double tip) {
  return fmt::format("[{{name: cut, points: [[0.25 mm, 0.3 mm], [{} mm, {} mm]], start: exterior, traction: gas}}]\n",
                     tip, tip + 0.05);
}
double cone_area(double tip) { return kPi * std::sqrt(2.0) * 1e-6 * tip * tip; }  // [m^2]

/// Cylinder of the radius 10.5 mm, from -half to half [mm].
std::string cylinder(double half) {
  return fmt::format("[{{name: cut, points: [[10.5 mm, {} mm], [10.5 mm, {} mm]], start: tip, traction: gas}}]\n",
                     -half, half);
}
double cylinder_area(double half) { return 2.0 * kPi * 10.5e-3 * 2e-3 * half; }  // [m^2]

struct Rest {
  double j, j_start, energy;
};

Rest rest(const std::string& crack, const std::vector<std::string>& overrides = {}) {
  mpm::Simulation simulation(mpm::build(mpm::parse_scene(kScene + crack, "crack_about_axis", overrides)), {1});
  run_until(simulation, 0.4e-3);
  return {number(simulation, "crack 1 end j"), number(simulation, "crack 1 start j"),
          simulation.state().energy.of("elastic")};
}

TEST(CrackAboutAxis, ConeAndCylinderReleaseTheirEnergy) {
  Page page("crack", "crack_about_axis", "A conical and a cylindrical crack");
  page.problem(
          "A rod of radius and half-height 40 mm, E = 2500 MPa, ν = 0.33, with a crack whose faces are pressed apart "
          "by "
          "0.1 MPa: a cone of 45° from the axis to the radius 12.25 mm, or a cylinder of radius 10.5 mm and length "
          "20.2 "
          "mm. Cells of 1 mm; the pressure rises slowly and the rod is brought to rest.")
      .exact("G = dU/dA, of runs in which tips lie 1 mm farther back and ahead.", "Griffith (1921)")
      .meaning(
          "J holds for cracks in any direction about an axis, in both forms and on contours of any size. In NairnMPM's "
          "manual (its theory's section on axisymmetry) such cracks are left open.");
  Panel& panel = page.figure().panel("J over dU/dA", "size of the contour [cells]", "J / G");
  panel.exact("dU/dA", {2, 5}, {1, 1});
  const auto look = [&](const std::string& name, const std::string& crack, double released, double tolerance) {
    page.report("dU/dA, " + name, released, "J/m²");
    double least = 1e9, most = 0.0;
    for (const std::string form : {"broberg", "bergkvist_huong"}) {
      Numbers sizes, values;
      for (const int size : {2, 3, 5}) {
        const Rest run = rest(crack, {"cracks.contour.form=" + form, fmt::format("cracks.contour.size={}", size)});
        sizes.push_back(size);
        values.push_back(run.j / released);
        if (name == "cylinder") {
          EXPECT_NEAR(run.j_start / run.j, 1.0, 1e-3);  // its own mirror image
        }
        page.near(fmt::format("J over dU/dA, {}, {}, {} cells", name, form, size), values.back(), 1.0, tolerance, "");
        if (size > 2) least = std::min(least, values.back()), most = std::max(most, values.back());
      }
      panel.points(name + ", " + form, sizes, values);
    }
    // 1 % by which solved fields differ between sizes (crack reference 4.2), and half a per cent of the area's sum.
    page.below("largest over least J, both forms, 3 and 5 cells, " + name, most / least, 1.015, "");
  };
  // dU/dA from a difference of 2 mm errs by (1/24)(2/12)^2 of J'' a^2: 0.1 %. A tip off by 0.3 cells changes J of the
  // cone, which grows as its radius, by 2.5 %; at 2 cells the nodal values add up to 2 %. J of the cylinder hardly
  // depends on its length.
  look("cone", cone(12.25),
       (rest(cone(13.25)).energy - rest(cone(11.25)).energy) / (cone_area(13.25) - cone_area(11.25)), 0.05);
  look("cylinder", cylinder(10.1),
       (rest(cylinder(11.1)).energy - rest(cylinder(9.1)).energy) / (cylinder_area(11.1) - cylinder_area(9.1)), 0.02);
}

}  // namespace crack_about_axis_test
}  // namespace verification
