// Combinations that implicit steps allow (rules/implicit_rules.hpp): each refusal names its key. 0.1 s.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace implicit_rules_test {

constexpr const char* kScene = R"(
geometry: plane_strain
gravity: [0, -9.81]
grid: {cell: 0.05, min: [0, 0], max: [0.4, 0.4]}
time: {end: 0.1, sync: 0.01}
method: {update: implicit}
materials: [{name: sand, law: drucker_prager, density: 1600, young: 1 MPa, poisson: 0.3, friction_angle: 30 deg}]
bodies: [{name: bed, material: sand, shape: {box: {min: [0, 0], max: [0.4, 0.2]}}}]
rigid_bodies: [{name: tool, shape: {box: {size: [0.15, 0.1]}}, pose: {position: [0.2, 0.3]}, friction: 0.3}]
boundaries: {all: slip}
)";

std::string refusal(const std::vector<std::string>& overrides) {
  try {
    mpm::Simulation run(mpm::build(mpm::parse_scene(kScene, "scene", overrides)), {1});
  } catch (const mpm::Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ImplicitRules, AcceptWhatTheyHave) {
  EXPECT_EQ(refusal({}), "accepted");
  EXPECT_EQ(refusal({"method.transfer=apic"}), "accepted");
  EXPECT_EQ(refusal({"sleep={}"}), "accepted");
  EXPECT_EQ(refusal({"target={real_time: 1}"}), "accepted");
  EXPECT_EQ(refusal({"time.budget=8 ms"}), "accepted");
  EXPECT_EQ(refusal({"time.budget=8 ms", "method.sweeps=11"}), "accepted");
  EXPECT_EQ(refusal({"loads=[{body_force: {acceleration: [1, 0]}}]"}), "accepted");
  EXPECT_EQ(refusal({"boundaries={z_min: fixed, conditions: [{name: end, region: {box: {min: [0, 0.1], max: [0.1, "
                     "0.3]}}, direction: x, velocity: 0}]}"}),
            "accepted");
  EXPECT_EQ(refusal({"rigid_bodies.tool.free={mass: 2}"}), "accepted");
  EXPECT_EQ(refusal({"method.transfer=pic", "method.sweeps=20", "method.precision=single"}), "accepted");
  EXPECT_EQ(refusal({"materials.sand.law=mohr_coulomb", "boundaries.z_min={friction: 0.5}"}), "accepted");
}

TEST(ImplicitRules, RefuseByTheKeyWhatTheyDoNotHave) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"method.shape=cpdi"}, "method: shape: "},
      {{"method.transfer={xpic: 2}"}, "method: transfer: "},
      {{"method.transfer={flip: 0.6, xpic: 2, every: 5}"}, "method: transfer: "},
      {{"method.average_stress=true"}, "method.average_stress: "},
      {{"method.average_dilatation=true"}, "method.average_dilatation: "},
      {{"method.damping={grid: 2 1/s}"}, "method.damping: "},
      {{"method.sweeps=0"}, "method.sweeps: 0 is less than 1"},
      {{"method.sweeps=5", "method.update=usavg"}, "method: sweeps: explicit steps have none"},
      {{"boundaries.x_min=absorbing"}, "boundaries: absorbing faces (x_min) and implicit steps do not go together"},
      {{"boundaries={z_min: fixed, conditions: [{name: end, region: {box: {min: [0, 0.1], max: [0.1, 0.3]}}, "
        "direction: [0.6, 0.8], velocity: 0}]}"},
       "boundaries: conditions: "},
      {{"sleep={damping: 0.5}"}, "sleep: damping: "},
      {{"contact={method: nodes}"}, "contact: method: "},
      {{"rigid_bodies.tool.sides=two"},
       "('tool') and implicit steps do not go together: with implicit steps the two sides"},
      {{"rigid_bodies.tool.divides=[bed]"},
       "rigid_bodies: bodies that a tool divides ('tool') and implicit steps do not go together: implicit steps "
       "have one velocity"},
      {{"method.gradient_terms=3"}, "method: gradient_terms: implicit steps have 2 terms"},
      {{"method.average_stress=false"}, "method: average_stress: implicit steps have one stress in a cell as it is"},
      {{"materials=[{name: sand, law: neo_hookean, density: 1000, young: 1 MPa, poisson: 0.3}]"},
       "materials: implicit steps are made for drucker_prager, mohr_coulomb, j2_plasticity and mu_i, not for 'sand' "
       "(neo_hookean)"},
      {{"materials=[{name: sand, law: j2_plasticity, density: 7850, young: 210 GPa, poisson: 0.3, yield_stress: 250 "
        "MPa}]"},
       "materials: 'sand' bears 2.5e+05 kPa, of which 200 sweeps in a step of 10 ms carry "},
      {{"method.sweeps=1001"}, "method.sweeps: 1001 is more than 1000"},
      {{"time.step=0.2"}, "time: step: 0.2 s is too long"},
      {{"time.budget=8 ms", "method.update=usavg"}, "time: budget: explicit steps have no sweeps"},
      {{"time.budget=8 ms", "method.sweeps=10"}, "time: budget: it ends no step before 10 sweeps"},
      {{"time.budget=0"}, "time.budget: "},
      {{"time.budget=8 kg"}, "time.budget: "},
      {{"contact={pairs: [{between: [bed, tool], friction: 0.3, adhesion: 1 kPa}]}"},
       "rigid_bodies.tool: implicit steps have one coefficient"},
      {{"contact={edges: blunt}"}, "contact: edges: "},
      {{"rigid_bodies.tool.shape={plane: {normal: [0, -1]}}"},
       "rigid_bodies: tool: implicit steps meet bodies at points"},
      {{"geometry=plane_stress"}, "geometry: "},
      {{"geometry=axisymmetric", "boundaries={x_max: slip, z_min: slip}", "rigid_bodies=[]",
        "method.axis={domains: whole}"},
       "method: axis: "}};
  for (const auto& [overrides, start] : cases) {
    const std::string text = refusal(overrides);
    EXPECT_NE(text.find(start), std::string::npos) << overrides.front() << ": " << text;
  }
}

}  // namespace implicit_rules_test
