// A law that a program adds runs as one of the library: by its name in a scene, with averaged stress, sleep,
// checkpoints and material_driver. Its yield is that of drucker_prager without friction on the cone of compression, so
// both agree.
#include "mpm/material/user_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "checkpoint_run.hpp"
#include "mpm/checkpoint/checkpoint.hpp"
#include "mpm/sections/material_driver.hpp"
#include "putty.hpp"
#include "sleep_run.hpp"

namespace mpm::test {
namespace user_law_test {

const std::string kScene = R"yaml(
geometry: plane_strain
grid: {cell: 0.02, min: [0, 0], max: [1.2, 0.4]}
time: {end: 1, sync: 5 ms, cfl: 0.5}
gravity: [0, -9.81]
sleep: {speed: 5 mm/s}
bodies: [{name: bed, material: clay, shape: {box: {min: [0, 0], max: [1.2, 0.16]}}, initial: {geostatic: {k0: 1}}}]
rigid_bodies:
  - {name: plate, shape: {box: {size: [0.12, 0.1]}}, pose: {position: [0.2, 0.22]}, friction: 0.3,
     motion: {velocity: [0, "-0.1*min(1, max(0, (t-0.1)/0.05))"]}}
boundaries: {x_min: slip, x_max: slip, z_min: {friction: 0.6}}
materials: [{name: clay, density: 1600, young: 1 MPa, poisson: 0.45, )yaml";
const std::string kPutty = kScene + "law: putty, strength: 2 kPa}]";

TEST(UserLaw, RunsAsOneOfTheList) {
  Simulation run = start(kPutty), twin = start(kPutty), apart = start(kPutty, {"method.average_stress=false"});
  Simulation listed =
      start(kScene + "law: drucker_prager, friction_angle: 0, match: compression, cohesion: 1.7320508 kPa}]");
  advance_to(run, 0.1);  // nothing has moved
  EXPECT_GT(number(run, "asleep"), 0.8 * static_cast<double>(run.particles()));
  advance_to(run, 0.25);
  const Folder folder;
  save_checkpoint(folder.file("half.h5"), run, {"", kPutty, {}});
  load_checkpoint(folder.file("half.h5"), twin, kPutty);
  for (Simulation* one : {&run, &twin, &apart, &listed}) advance_to(*one, 0.4);
  EXPECT_EQ(run.state_hash(), twin.state_hash());
  EXPECT_NE(run.state_hash(), apart.state_hash());
  const std::vector<double> height = field(run, "z"), expected = field(listed, "z");
  for (std::size_t p = 0; p < height.size(); ++p)
    EXPECT_NEAR(height[p], expected[p], 1e-6);  // round-off of either return, after 2,000 steps
}

TEST(UserLaw, IsDrivenAlongPaths) {
  MaterialDriverOptions options;
  options.material = "{law: putty, density: 1600, young: 1 MPa, poisson: 0.45, strength: 2 kPa}";
  options.path = "simple_shear";
  options.strain = "0.1";
  std::ostringstream out;
  drive_material(options, out);
  const std::string text = out.str(), last = text.substr(text.rfind('\n', text.size() - 2) + 1);
  std::vector<double> row;
  std::istringstream cells(last);
  for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
  const double xz = row.at(std::count(text.begin(), text.begin() + static_cast<long>(text.find("sxz")), ','));
  EXPECT_NEAR(xz, 2e3, 1.0);  // sqrt(J2) = 2 kPa; normal stresses of the turn are small
}

}  // namespace user_law_test
}  // namespace mpm::test
