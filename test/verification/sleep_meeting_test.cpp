// Sleep beside loads, conditions, what is transported, and cracks: what is asleep bears a load that stays, wakes when
// one changes, when a condition moves it and when a front of heat or pressure arrives, and leaves the answer what it is
// without sleep. Costs 13 s.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "scene_run.hpp"
#include "transport_run.hpp"

namespace verification {
namespace sleep_meeting_test {

mpm::Simulation of_text(const std::string& text, const std::vector<std::string>& changes = {}, int threads = 1) {
  return mpm::Simulation(mpm::build(mpm::parse_scene(text, "sleep.yaml", changes)), {threads});
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double asleep(const mpm::Simulation& run) { return number(run, "asleep") / static_cast<double>(run.particles()); }

/// Round-off of what was exchanged.
void expect_audit_closes(const mpm::Simulation& run) { EXPECT_LT(run.state().audit.residual, 1e-10); }

mpm::Vec3 impulse(const mpm::Simulation& run, const std::string& account) {
  for (const auto& one : run.state().audit.impulses) {
    if (one.name == account) return one.impulse;
  }
  ADD_FAILURE() << "no account " << account;
  return mpm::Vec3::Zero();
}

/// Mean of a field over the particles within a range of x [m].
double mean_within(const mpm::Simulation& run, const std::string& name, double from, double to) {
  const std::vector<double> x = field(run, "x"), values = field(run, name);
  double sum = 0.0, count = 0.0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    if (x[p] < from || x[p] > to) continue;
    sum += values[p];
    count += 1.0;
  }
  return sum / count;
}

const char* const kBed = R"yaml(
geometry: plane_strain
grid: {cell: 0.05, min: [0, 0], max: [6.4, 1.0]}
time: {end: 1, sync: 5 ms, cfl: 0.5}
gravity: [0, -9.81]
method: {damping: {grid: 40 1/s}}
materials: [{name: clay, law: neo_hookean, density: 1800, young: 2 MPa, poisson: 0.3}]
bodies: [{name: bed, material: clay, shape: {box: {min: [0, 0], max: [6.4, 0.8]}}, initial: geostatic}]
boundaries: {x_min: slip, x_max: slip, z_min: fixed}
sleep: {from_start: true}
)yaml";

// A strip of 0.8 m on a bed that sleeps bears 5 kPa after a fifth of a second: it settles as without sleep. Blocks wake
// when a tenth of the force on them is new, so that much of what reaches far blocks may be missed; the settlement is
// that of the near ones.
TEST(SleepMeets, AFootingLoadedAfterRest) {
  const std::string footing = std::string(kBed) +
                              "loads:\n  - traction: {body: bed, edge: z_max, region: {box: {min: [2.8, 0.776], max: "
                              "[3.6, 0.9]}}, traction: [0, \"-5000*min(1, max(0, (t-0.2)/0.2))\"]}\n";
  mpm::Simulation with = of_text(footing), without = of_text(footing, {"sleep=off"});
  const double high = mean_within(with, "z", 2.9, 3.5);
  run_until(with, 0.2);
  EXPECT_EQ(asleep(with), 1.0);
  run_until(with, 0.8);
  run_until(without, 0.8);
  const double settled = high - mean_within(without, "z", 2.9, 3.5);
  EXPECT_GT(settled, 3e-4);  // order of q b / E = 2 mm
  EXPECT_NEAR(high - mean_within(with, "z", 2.9, 3.5), settled, 0.05 * settled);
  EXPECT_GT(asleep(with), 0.3);
  expect_audit_closes(with);
}

// A surcharge that stays is part of the balance: beside a blade that ploughs, what bears it sleeps on.
TEST(SleepMeets, ASurchargeThatStaysIsBorneAsleep) {
  const std::string loaded =
      std::string(kBed) +
      "loads:\n  - traction: {body: bed, edge: z_max, traction: [0, -20 kPa]}\n"
      "rigid_bodies:\n  - {name: plate, shape: {box: {size: [0.4, 0.2]}}, pose: {position: [0.6, 0.9]}, friction: 0, "
      "motion: {velocity: [0, \"-0.1*(t<0.1)\"]}}\n";
  const std::string stress =
      "bodies.0.initial={stress: {zz: \"-20000-1800*9.81*(0.8-z)\", xx: \"-(20000+1800*9.81*(0.8-z))*3/7\"}}";
  mpm::Simulation run = of_text(loaded, {stress, "materials.0.law=linear_elastic"});
  for (const double t : {0.02, 0.1, 0.2, 0.4}) {
    run_until(run, t);
    EXPECT_GT(asleep(run), 0.4) << t;
    EXPECT_LT(asleep(run), 0.97) << t;
  }
  expect_audit_closes(run);
}

// Nodes of a strip are held, and pressed down from 0.2 s on: the force is that of a bed without sleep.
TEST(SleepMeets, AConditionThatBeginsToMove) {
  const std::string pressed = std::string(kBed).replace(std::string(kBed).find("z_min: fixed"), 12,
                                                        "z_min: fixed, conditions: [{name: plate, region: {box: {min: "
                                                        "[2.8, 0.79], max: [3.6, 0.9]}}, direction: z, velocity: "
                                                        "\"-0.02*min(1, max(0, (t-0.2)/0.05))\"}]");
  const std::string slow = "sleep={from_start: true, speed: 2 mm/s}";
  mpm::Simulation with = of_text(pressed, {slow}), without = of_text(pressed, {"sleep=off"});
  run_until(with, 0.15);
  run_until(without, 0.15);
  EXPECT_EQ(asleep(with), 1.0);
  const double at_rest = impulse(without, "condition/plate").z(), rested = impulse(with, "condition/plate").z();
  run_until(with, 0.3);
  EXPECT_GT(asleep(with), 0.3);
  run_until(with, 0.5);
  run_until(without, 0.5);
  const double pressed_by = impulse(without, "condition/plate").z() - at_rest;
  EXPECT_LT(pressed_by, -100.0);
  EXPECT_NEAR(impulse(with, "condition/plate").z() - rested, pressed_by, 0.05 * std::abs(pressed_by));
  expect_audit_closes(with);
}

// A bed of nearly incompressible clay with averaged volume changes: what sleeps beside a footing keeps its share in the
// means of the nodes at its border, so that it wakes no more than it does without them, and the footing settles as it
// does in a bed of which nothing sleeps.
TEST(SleepMeets, AveragedDilatation) {
  const std::string clay = std::string(kBed) +
                           "loads:\n  - traction: {body: bed, edge: z_max, region: {box: {min: [2.8, 0.776], max: "
                           "[3.6, 0.9]}}, traction: [0, "
                           "\"-5000*min(1, max(0, (t-0.2)/0.2))\"]}\n";
  const std::vector<std::string> changes = {"materials.0.poisson=0.45", "method.average_dilatation=true"};
  std::vector<std::string> off = changes;
  off.emplace_back("sleep=off");
  mpm::Simulation with = of_text(clay, changes), without = of_text(clay, off);
  const double high = mean_within(with, "z", 2.9, 3.5);
  run_until(with, 0.2);
  EXPECT_GT(asleep(with), 0.9);
  run_until(with, 0.8);
  run_until(without, 0.8);
  const double settled = high - mean_within(without, "z", 2.9, 3.5);
  EXPECT_GT(settled, 2e-4);
  EXPECT_NEAR(high - mean_within(with, "z", 2.9, 3.5), settled, 0.05 * settled);
  EXPECT_GT(asleep(with), 0.3);
  expect_audit_closes(with);
}

const char* const kSlab = R"yaml(
geometry: plane_strain
grid: {cell: 0.05, min: [0, 0], max: [3.2, 0.2]}
time: {end: 4, sync: 20 ms, cfl: 0.5}
materials: [{name: rock, law: linear_elastic, density: 1000, young: 0.1 MPa, poisson: 0.2, heat_capacity: 1000, conductivity: 1e4}]
bodies: [{name: slab, material: rock, shape: {box: {min: [0, 0], max: [3.2, 0.2]}}}]
boundaries: {all: slip}
sleep: {speed: 1 mm/s, after: 0.1 s}
transport:
  temperature:
    initial: 300
    values: [{name: hot, region: {box: {min: [-1, -1], max: [0, 1]}}, value: 400}]
)yaml";

// Heat diffuses into a half space whose face is 100 K hotter, by 0.01 m^2/s: T = 300 + 100 erfc(x / sqrt(4 D t)). It
// wakes a block when it has changed a node of it by 0.1 K, so erfc(z) = 1e-3, z = 2.327: x = 4.65 sqrt(D t).
TEST(SleepMeets, AFrontOfHeatWakesWhatItReaches) {
  mpm::Simulation with = of_text(kSlab), without = of_text(kSlab, {"sleep=off"});
  const double cell = 0.05, block = 4 * cell, length = 3.2;
  for (const double t : {1.0, 2.0, 4.0}) {
    run_until(with, t);
    run_until(without, t);
    const double front = 4.65 * std::sqrt(0.01 * t);
    // Blocks are at most one beyond the front, and one behind it since a block wakes by its nearest node.
    EXPECT_NEAR((1.0 - asleep(with)) * length, front, 1.5 * block) << t;
    const auto exact = [&](double x) { return 300.0 + 100.0 * std::erfc(x / std::sqrt(0.04 * t)); };
    const std::vector<double> x = field(with, "x"), warm = field(with, "temperature"),
                              same = field(without, "temperature");
    double from_exact = 0.0, from_same = 0.0;
    for (std::size_t p = 0; p < x.size(); ++p) {
      from_exact = std::max(from_exact, std::abs(warm[p] - exact(x[p])));
      from_same = std::max(from_same, std::abs(warm[p] - same[p]));
    }
    EXPECT_LT(from_same, 0.2) << t;  // twice what wakes
    EXPECT_LT(from_exact, 1.0) << t;
  }
  expect_balance(with, "temperature");
  EXPECT_NEAR(reported(with, "temperature content"), reported(without, "temperature content"),
              1e-3 * reported(without, "temperature content"));
}

// A slab with a steady slope of temperature sleeps, and its slope stays though nothing flows within it: the flow that
// its particles gave goes on at its border, which is kept awake by a value that will change.
TEST(SleepMeets, ASteadyFlowOfHeatGoesOn) {
  const std::vector<std::string> changes = {
      "transport.temperature.initial=\"400-100*x/3.2\"",
      "transport.temperature.values=[{name: hot, region: {box: {min: [-1, -1], max: [0, 1]}}, value: \"400+0*t\"}, "
      "{name: cold, region: {box: {min: [3.2, -1], max: [4, 1]}}, value: 300}]"};
  mpm::Simulation run = of_text(kSlab, changes);
  run_until(run, 4.0);
  EXPECT_GT(asleep(run), 0.8);
  EXPECT_LT(asleep(run), 1.0);
  const std::vector<double> x = field(run, "x"), warm = field(run, "temperature");
  double most = 0.0;
  for (std::size_t p = 0; p < x.size(); ++p) most = std::max(most, std::abs(warm[p] - (400.0 - 100.0 * x[p] / 3.2)));
  EXPECT_LT(most, 0.1);  // change that would wake a block
  expect_balance(run, "temperature");
}

// A deep column of wet soil under 10 kPa, which its water bears, drains at its top: p = p0 erf(z / sqrt(4 c t)) at the
// depth z, with c = k/mu / (1/Q + 1/M) = 0.0909 m^2/s, and the top settles by 2 p0/M sqrt(c t / pi). It sleeps where
// the front has not come.
TEST(SleepMeets, AFrontOfPressureWakesWetSoil) {
  const char* const kColumn = R"yaml(
geometry: line
area: 1 m^2
grid: {cell: 0.05, min: [-0.2], max: [8.2]}
time: {end: 2, sync: 10 ms, cfl: 0.5}
method: {damping: {grid: 50}}
materials: [{name: soil, law: linear_elastic, density: 2000, young: 10 MPa, poisson: 0, biot: 1, storage: 1e-8, permeability: 1e-11, viscosity: 1e-3}]
bodies: [{name: column, material: soil, shape: {box: {min: [0], max: [8]}}}]
boundaries: {conditions: [{name: base, region: {box: {min: [-0.2], max: [0]}}, direction: x, velocity: 0}]}
loads: [{pressure: {body: column, edge: x_max, value: 10 kPa}}]
sleep: {speed: 0.2 mm/s, after: 0.05 s, pore_pressure: 20 Pa}
transport: {pore_pressure: {initial: 10000, values: [{name: drain, region: {box: {min: [8], max: [8.2]}}, value: 0}]}}
)yaml";
  mpm::Simulation with = of_text(kColumn), without = of_text(kColumn, {"sleep=off"});
  const double c = 1e-8 / (1e-8 + 1e-7), end = 2.0;
  run_until(with, end);
  run_until(without, end);
  const std::vector<double> x = field(with, "x"), p = field(with, "pore_pressure"),
                            same = field(without, "pore_pressure");
  double most = 0.0, from_same = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    most = std::max(most, std::abs(p[i] - 1e4 * std::erf((8.0 - x[i]) / std::sqrt(4.0 * c * end))));
    from_same = std::max(from_same, std::abs(p[i] - same[i]));
  }
  EXPECT_LT(most, 200.0);
  EXPECT_LT(from_same, 40.0);  // twice what wakes
  EXPECT_GT(asleep(with), 0.2);
  EXPECT_LT(asleep(with), 0.9);
  expect_balance(with, "pore_pressure");
  expect_audit_closes(with);
}

// A strip with an edge crack between smooth walls bears a stress that stays: far from the crack it sleeps, and J is
// that of a strip of which nothing does. J follows the stress, whose balance may be off by a part of what waves of
// `wake` bring: rho c wake = 2700 * 6170 * 3 mm/s = 50 kPa of 10 MPa, which is 1 % of J.
TEST(SleepMeets, ACrackUnderALoadThatStays) {
  const char* const kStrip = R"yaml(
geometry: plane_strain
thickness: 1 mm
grid: {cell: 2 mm, min: [-8 mm, -60 mm], max: [20 mm, 68 mm]}
time: {end: 0.5 ms, cfl: 0.6, sync: 4 us}
method: {damping: {grid: 5e4}}
materials: [{name: aluminium, law: linear_elastic, density: 2700, young: 70 GPa, poisson: 0.33}]
bodies: [{name: strip, material: aluminium, shape: {box: {min: [0, -60 mm], max: [20 mm, 62 mm]}}}]
boundaries: {x_max: slip, z_min: slip}
loads: [{traction: {body: strip, edge: z_max, traction: [0, "1e7*min(t/5e-5, 1)"]}}]
cracks: {list: [{name: notch, points: [[0.6 mm, 1 mm], [8.2 mm, 1 mm]], start: exterior, end: tip}]}
sleep: {speed: 1 mm/s, after: 2e-5}
)yaml";
  mpm::Simulation with = of_text(kStrip), without = of_text(kStrip, {"sleep=off"});
  run_until(with, 0.5e-3);
  run_until(without, 0.5e-3);
  const double j = reported(without, "crack 1 end j");
  EXPECT_GT(j, 0.0);
  EXPECT_NEAR(reported(with, "crack 1 end j"), j, 0.01 * j);
  EXPECT_GT(asleep(with), 0.5);
  expect_audit_closes(with);
}

// A tip that grows by two cells in every step goes through a strip that sleeps as through one that does not: blocks
// ahead of it wake before it is there, though sleep looks in one of eight steps alone. Nothing is strained in the
// strip. A step is 0.25 us, the longest part of a sync period that is less than 0.6 of the 0.52 us in which a wave
// crosses a cell; 10 km/s are more than two cells in it, and a look
// lets a tip grow by one length. Costs 1 s.
TEST(SleepMeets, ACrackThatRunsFasterThanItsLooks) {
  const char* const kStrip = R"yaml(
geometry: plane_strain
thickness: 1 mm
grid: {cell: 1 mm, min: [-8 mm, -20.5 mm], max: [104 mm, 19.5 mm]}
time: {end: 10 us, cfl: 0.6, sync: 1 us}
materials: [{name: polymer, law: linear_elastic, density: 1000, young: 2.5 GPa, poisson: 0.33, fracture: {start_time: 0, speed: 10000}}]
bodies: [{name: strip, material: polymer, shape: {box: {min: [0, -16 mm], max: [96 mm, 16 mm]}}}]
cracks:
  growth: {criterion: steady_state}
  length: 2
  time_factor: 0.4
  list: [{name: cut, points: [[0.3 mm, 0], [6.1 mm, 0]], start: exterior, end: tip}]
sleep: {speed: 1 mm/s, after: 5 us, from_start: true}
)yaml";
  mpm::Simulation with = of_text(kStrip), without = of_text(kStrip, {"sleep=off"});
  run_until(with, 1e-6);
  EXPECT_GT(asleep(with), 0.5);
  run_until(with, 1e-5);
  run_until(without, 1e-5);
  const mpm::CrackTipReport tip = with.crack_tips().at(0);
  EXPECT_FALSE(tip.stopped) << tip.growth;
  // The next look comes a step later, to round-off: it may wait for the step after that.
  EXPECT_GT(tip.place.x(), 6.1e-3 + 30 * 2e-3);
  EXPECT_NEAR(tip.place.x(), without.crack_tips().at(0).place.x(), 1e-9);
  expect_audit_closes(with);
}

}  // namespace sleep_meeting_test
}  // namespace verification
