// Checkpoints: a run that loads one continues to the bit like a run that was never stopped, at whatever sync point it
// was saved, for every stage, method and law.
#include "mpm/checkpoint/checkpoint.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "checkpoint_run.hpp"

namespace mpm::test {
namespace checkpoint_test {

constexpr int kPeriods = 12;
constexpr int kOfOther = 5;  ///< sync periods of a simulation that runs before it loads a checkpoint

const char* const kTool = R"yaml(
geometry: plane_strain
grid: {cell: 0.1, min: [0, 0], max: [1.6, 1.6]}
time: {end: 1, sync: 5 ms, cfl: 0.4}
method: {shape: ugimp}
gravity: [0, -9.81]
materials: [{name: rubber, density: 1000, law: neo_hookean, young: 100 kPa, poisson: 0.3}]
bodies: [{name: block, material: rubber, shape: {box: {min: [0.3, 0], max: [1.1, 0.5]}}}]
rigid_bodies:
  - {name: press, shape: {box: {size: [0.5, 0.4]}}, pose: {position: [0.7, 0.71]},
     motion: {velocity: ["0.6*sin(60*t)", -1.2], rotation_rate: "2*t"}, friction: 0.3}
  - {name: rod, shape: {sphere: {radius: 0.2}}, pose: {position: [0.05, 0.3]}, motion: {velocity: [1.5, 0]}}
boundaries: {z_min: slip}
)yaml";

const char* const kRings = R"yaml(
geometry: axisymmetric
grid: {cell: 0.1, min: [0, 0], max: [1.6, 1.6]}
time: {end: 1, sync: 5 ms, cfl: 0.4}
method: {shape: ugimp}
materials: [{name: rubber, density: 1000, law: neo_hookean, young: 100 kPa, poisson: 0.3}]
bodies: [{name: disk, material: rubber, shape: {box: {min: [0, 0.4], max: [0.6, 0.8]}}, initial: {velocity: [0, "-3"]}}]
rigid_bodies:
  - {name: ball, shape: {sphere: {radius: 0.3}}, pose: {position: [0, 1.15]}, motion: {velocity: [0, -5]}, friction: 0.2}
  - {name: iris, shape: {ring: {inner: 0.7, outer: 0.9, height: 0.6}}, pose: {position: [0, 0.4]}, motion: {velocity: [-2, 0]}}
boundaries: {z_min: slip}
)yaml";

const char* const kLine = R"yaml(
geometry: line
grid: {cell: 0.1, min: 0, max: 3.2}
time: {end: 1, sync: 5 ms, cfl: 0.4}
method: {shape: ugimp}
materials: [{name: rubber, density: 1000, law: neo_hookean, young: 100 kPa, poisson: 0.3}]
bodies: [{name: bar, material: rubber, shape: {box: {min: 0.5, max: 1.5}}, initial: {velocity: "5*x"}}]
)yaml";

const char* const kSolid = R"yaml(
grid: {cell: 0.1, min: [0, 0, 0], max: [0.8, 0.8, 0.8]}
time: {end: 1, sync: 5 ms, cfl: 0.4}
method: {shape: ugimp}
gravity: [0, 0, -9.81]
materials: [{name: rubber, density: 1000, law: neo_hookean, young: 100 kPa, poisson: 0.3}]
bodies: [{name: block, material: rubber, shape: {box: {min: [0.2, 0.2, 0], max: [0.5, 0.5, 0.3]}}, initial: {velocity: ["4+z", 2, 0]}}]
rigid_bodies:
  - {name: ball, shape: {sphere: {radius: 0.15}}, pose: {position: [0.4, 0.4, 0.46]}, motion: {velocity: [3, 0, -2]}, friction: 0.3}
boundaries: {z_min: {friction: 0.2}}
)yaml";

/// A change of kPlane: another law for its rubber.
std::string law(const std::string& text) { return "materials.rubber=" + text; }

// Most of the bed is asleep; the rod, which comes down at its left end, wakes some of it.
const char* const kAsleep = R"yaml(
geometry: plane_strain
grid: {cell: 0.05, min: [0, 0], max: [2.4, 1]}
time: {end: 1, sync: 5 ms, cfl: 0.4}
gravity: [0, -9.81]
materials: [{name: sand, density: 1600, law: drucker_prager, young: 500 kPa, poisson: 0.3, friction_angle: 30 deg}]
bodies: [{name: bed, material: sand, shape: {box: {min: [0, 0], max: [2.4, 0.4]}}, initial: geostatic}]
rigid_bodies:
  - {name: rod, shape: {sphere: {radius: 0.2}}, pose: {position: [0.3, 0.62]}, motion: {velocity: [0.5, -1.5]}}
boundaries: {x_min: slip, x_max: slip, z_min: slip}
sleep: {speed: 20 mm/s, from_start: true, after: 10 ms}
)yaml";

std::vector<Case> cases() {
  std::vector<Case> list;
  const auto add = [&](const char* scene, const std::string& name, std::vector<std::string> changes) {
    list.push_back({name, scene, std::move(changes)});
  };
  // Shape functions with update schemes and transfers, each at least once.
  add(kPlane, "dirac_usf_flip", {"method.shape=dirac", "method.update=usf", "method.transfer={flip: 0.99}"});
  add(kTool, "usf_slip_wall", {"method.update=usf"});
  add(kPlane, "ugimp_usl_pic", {"method.update=usl", "method.transfer=pic"});
  add(kPlane, "ugimp_usavg_xpic", {"method.transfer={xpic: 3}"});
  add(kPlane, "stretch_usf_fmpm", {"method.shape=ugimp_stretch", "method.update=usf", "method.transfer={fmpm: 2}"});
  add(kPlane, "cpdi_usavg_apic", {"method.shape=cpdi", "method.transfer=apic"});
  add(kPlane, "cpdi_usl_flip", {"method.shape=cpdi", "method.update=usl"});
  add(kPlane, "qcpdi_usf", {"method.shape=qcpdi", "method.update=usf"});
  add(kPlane, "bspline2_usl", {"method.shape=bspline2", "method.update=usl"});
  add(kPlane, "bspline3_apic", {"method.shape=bspline3", "method.transfer=apic"});
  add(kPlane, "averaged", {"method.average_dilatation=true"});
  add(kPlane, "single", {"method.precision=single", "method.transfer=apic"});
  add(kPlane, "plane_stress", {"geometry=plane_stress", "method.shape=cpdi"});
  // Damping.
  add(kPlane, "feedback", {"method.damping={feedback: {gain: 100, limit: 50}}"});
  add(kPlane, "damping", {"method.damping={grid: 5, particle: \"5*(z<0.5)\", pic: 0.01}"});
  // Laws with a history.
  add(kPlane, "viscoelastic",
      {law("{name: rubber, density: 1000, law: viscoelastic, young: 100 kPa, poisson: 0.3, branch_modulus: 20 kPa, "
           "relaxation_time: 20 ms}")});
  add(kPlane, "j2",
      {law("{name: rubber, density: 1000, law: j2_plasticity, young: 100 kPa, poisson: 0.3, "
           "yield_stress: 1 kPa, hardening_modulus: 5 kPa}")});
  add(kPlane, "drucker_prager",
      {law("{name: rubber, density: 1000, law: drucker_prager, young: 100 kPa, poisson: 0.3, "
           "friction_angle: 30 deg, cohesion: 100 Pa}")});
  add(kPlane, "mohr_coulomb",
      {law("{name: rubber, density: 1000, law: mohr_coulomb, young: 100 kPa, poisson: 0.3, "
           "friction_angle: 30 deg, cohesion: 100 Pa}")});
  add(kPlane, "fluid", {law("{name: rubber, density: 1000, law: newtonian_fluid, sound_speed: 12, viscosity: 1}")});
  add(kPlane, "gas",
      {law("{name: rubber, density: 100, law: ideal_gas, pressure: 10 kPa, temperature: 293, "
           "ambient_pressure: 10 kPa}")});
  // Boundaries and conditions.
  add(kPlane, "absorbing",
      {"bodies.block.initial.velocity=[0.5, 0]", "bodies.block.shape={box: {min: [0, 0], max: [1.6, 0.7]}}",
       "boundaries={z_min: {absorbing: {hold: start}}, x_max: absorbing, x_min: absorbing}"});
  add(kPlane, "periodic", {"boundaries={x: periodic, z_min: slip}", "bodies.block.initial.velocity=[20, 0]"});
  add(kPlane, "leaving",
      {"grid.leave={limit: 1000}", "boundaries={}", "bodies.block.initial.velocity=[0, \"-8-3*x\"]"});
  add(kPlane, "conditions",
      {"boundaries={z_min: slip, conditions: [{name: grip, region: {box: {min: [0.3, 0.55], max: [0.8, 0.85]}}, "
       "motion: {velocity: [3, 0]}, direction: x}, {name: lift, region: {box: {min: [0.2, 0.2], max: [0.5, 0.45]}}, "
       "direction: z, velocity: \"0.3*sin(50*t)\"}]}"});
  // Transport.
  add(kTool, "heat",
      {"transport={temperature: {initial: \"300+10*x\", tools: [{body: press, conductance: 5000, temperature: 500, "
       "heat_capacity: 50}], values: [{region: {box: {min: [0, 0], max: [1.6, 0.05]}}, value: \"300+t\"}]}}",
       "boundaries={z_min: {friction: 0.3}}", "materials.rubber.heat_capacity=1000", "materials.rubber.conductivity=40",
       "materials.rubber.thermal_expansion=1e-4"});
  add(kPlane, "heat_of_flow",
      {law("{name: rubber, density: 1000, law: j2_plasticity, young: 100 kPa, poisson: 0.3, yield_stress: 1 kPa, "
           "heat_capacity: 1, conductivity: 1e-3}"),
       "transport={temperature: {method: particle_capacity}}"});
  add(kPlane, "moist_and_wet",
      {law("{name: rubber, density: 1000, law: drucker_prager, young: 100 kPa, poisson: 0.3, friction_angle: 30 deg, "
           "cohesion: 100 Pa, storage: 1e-6, permeability: 1e-10, fluid_density: 1000, diffusivity: [1e-2, 1e-2, "
           "2e-2], "
           "solvent_expansion: 0.01}"),
       "transport={concentration: {initial: \"x\"}, pore_pressure: {}}"});
  // Loads.
  add(kPlane, "loads",
      {"loads=[{body_force: {acceleration: [\"3*sin(30*t)\", \"X\"]}}, {particle_force: {force: [5, 0], "
       "body: block}}, {pressure: {body: block, edge: x_max, value: \"1000*t\"}}]",
       "method.shape=cpdi"});
  // Tools.
  add(kTool, "points", {});
  add(kTool, "points_adhere", {"contact={static_friction: 0.6, friction: 0.2, adhesion: 500 Pa}", "method.shape=cpdi"});
  add(kTool, "volumes",
      {"volumes=[{name: pit, shape: {box: {size: [0.5, 0.6]}}, pose: {position: [0.8, 0.3]}}, "
       "{name: under, of: press, shape: {box: {size: [0.4, 0.2]}}, pose: {position: [0, -0.3]}}]"});
  add(kTool, "points_xpic", {"method.transfer={xpic: 2}"});
  add(kTool, "nodes", {"contact={method: nodes, friction: 0.2}"});
  add(kTool, "particles", {"rigid_bodies.press.normals=particles", "contact={adhesion: 200 Pa}"});
  add(kTool, "thin",
      {"rigid_bodies.press.shape={box: {size: [0.06, 0.5]}}", "rigid_bodies.press.pose={position: [0.7, 0.6]}",
       "rigid_bodies.press.motion={velocity: [2, -0.5]}", "bodies.block.cut_out=all"});
  add(kTool, "wire",
      {"rigid_bodies.rod.shape={sphere: {radius: 0.08}}", "rigid_bodies.rod.motion={velocity: [4, \"60*t\"]}"});
  add(kTool, "free",
      {"rigid_bodies.press.motion={velocity: [0, 0]}",
       "rigid_bodies.press.free={mass: 20, velocity: [0.5, -1.2], rotation_rate: 2, force: [3, 0]}"});
  add(kTool, "free_along_z",
      {"rigid_bodies.press.motion={velocity: [\"0.6*sin(60*t)\", 0]}", "rigid_bodies.press.free={mass: 20, axes: [z]}",
       "method.transfer={fmpm: 2}"});
  // Deformable bodies against each other.
  add(kPair, "coulomb", {"contact={law: coulomb, friction: 0.3, adhesion: 200 Pa}"});
  add(kPair, "own_normals", {"contact={law: stick, normals: own}"});
  add(kPair, "interface", {"contact={law: interface, opened: 1 MPa/m, tangential: 500 kPa/m}"});
  add(kPair, "touching_start", {"contact={law: coulomb, friction: 0.1, detection: displacements}"});
  // Geometries.
  add(kRings, "rings", {});
  add(kRings, "rings_nodes", {"contact={method: nodes}", "method.shape=cpdi"});
  add(kRings, "rings_massless_nodes", {"method.shape=qcpdi"});
  add(kLine, "line", {"method.transfer=apic"});
  add(kSolid, "solid", {});
  // Sleep.
  add(kAsleep, "asleep", {});
  add(kAsleep, "asleep_damped_xpic", {"sleep.damping=0.3", "method.transfer={xpic: 2}", "method.update=usl"});
  add(kAsleep, "asleep_single_apic", {"method.precision=single", "method.transfer=apic"});
  add(kSolid, "solid_single_cpdi", {"method.shape=cpdi", "method.precision=single"});
  return list;
}

/// All reported values of a run, as bits.
std::vector<std::uint64_t> said(Simulation& simulation) {
  std::vector<std::uint64_t> bits{simulation.state_hash(), simulation.memory_hash()};
  const auto number = [&](double value) {
    std::uint64_t word = 0;
    std::memcpy(&word, &value, sizeof word);
    bits.push_back(word);
  };
  const auto vector = [&](const Vec3& v) {
    for (int k = 0; k < 3; ++k) number(v[k]);
  };
  const SolverState state = simulation.state();
  for (const double value :
       {state.energy.of("kinetic"), state.energy.of("elastic"), state.energy.of("plastic"),
        state.energy.of("potential"), state.energy.of("contact_work"), state.energy.of("load_work"),
        state.energy.of("pair_friction"), state.energy.of("interface"), state.energy.of("friction"),
        state.audit.exchanged, state.audit.residual, state.step.dt_min, state.step.dt_max, state.step.dt_last,
        state.min_j, static_cast<double>(state.step.steps), state.number("returned")}) {
    number(value);
  }
  bits.push_back(std::hash<std::string>()(state.step.limited_by));
  for (const NamedImpulse& one : state.audit.impulses) vector(one.impulse);
  for (const auto& metric : simulation.metrics()) number(metric.second);
  const std::vector<BodyState> bodies = simulation.bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    vector(bodies[b].pose.position);
    vector(bodies[b].twist.linear);
    const ContactReport report = simulation.take_contact(static_cast<int>(b));
    for (const Vec3& v :
         {report.mean.force, report.mean.torque, report.peak.force, report.impulse, report.friction, report.arm}) {
      vector(v);
    }
    for (const double value : {report.interval, report.area, report.friction_energy, report.pressing}) number(value);
    bits.push_back(static_cast<std::uint64_t>(report.nodes));
  }
  for (const FreeBodyReport& report : simulation.free_bodies()) {
    for (const BodyMomentum& one : {report.momentum, report.contact, report.gravity, report.wrench, report.drive}) {
      vector(one.linear);
      vector(one.angular);
    }
    for (const double value : {report.kinetic, report.wrench_work, report.drive_work, report.contact_loss}) {
      number(value);
    }
  }
  for (const PairReport& report : simulation.take_pairs()) {
    for (const Vec3& v : {report.force, report.friction, report.impulse, report.centre}) vector(v);
    for (const double value : {report.pressing, report.area, report.interval, report.friction_energy}) number(value);
  }
  return bits;
}

class Checkpoint : public testing::TestWithParam<Case> {};

// The run is saved at every sync point: some lie before a sort, some after it.
TEST_P(Checkpoint, ResumedRunEqualsUninterruptedBitForBit) {
  const Folder folder;
  Simulation whole(definition_of(GetParam()), {1});
  for (int k = 0; k < kPeriods; ++k) {
    save_checkpoint(folder.file(std::to_string(k)), whole, {});
    run(whole, k, k + 1);
  }
  Simulation other(definition_of(GetParam()), {1});
  run(other, 0, kOfOther);
  const std::vector<std::uint64_t> expected = said(whole);
  const std::uint64_t start = Simulation(definition_of(GetParam()), {1}).state_hash();
  EXPECT_NE(expected[0], start);  // the state has changed
  for (int k = 0; k < kPeriods; ++k) {
    Simulation fresh(definition_of(GetParam()), {2});
    load_checkpoint(folder.file(std::to_string(k)), fresh, "");
    EXPECT_EQ(fresh.time(), k * fresh.sync_period());
    run(fresh, k, kPeriods);
    EXPECT_EQ(said(fresh), expected) << "saved at sync point " << k;
  }
  load_checkpoint(folder.file("2"), other, "");
  run(other, 2, kPeriods);
  EXPECT_EQ(said(other), expected) << "taken on by a run that was elsewhere";
}

INSTANTIATE_TEST_SUITE_P(Scenes, Checkpoint, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

TEST(CheckpointFile, GeostaticStartNeedNotSettleAgain) {
  const Folder folder;
  const Case slope{"slope",
                   kPlane,
                   {law("{name: rubber, density: 1600, law: drucker_prager, young: 1 MPa, poisson: 0.3, "
                        "friction_angle: 35 deg, cohesion: 1 kPa}"),
                    "bodies.block.shape={box: {min: [0, 0], max: [0.8, 0.5]}}", "bodies.block.initial=geostatic"}};
  Simulation whole(definition_of(slope), {1});
  run(whole, 0, 3);
  save_checkpoint(folder.file("slope"), whole, {});
  run(whole, 3, 6);
  SimulationOptions unsettled{1};
  unsettled.settle = false;
  Simulation again(definition_of(slope), unsettled);
  EXPECT_TRUE(again.notes().empty());  // no settling took place
  load_checkpoint(folder.file("slope"), again, "");
  run(again, 3, 6);
  EXPECT_EQ(said(again), said(whole));
}

}  // namespace checkpoint_test
}  // namespace mpm::test
