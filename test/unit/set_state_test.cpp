// States of rigid bodies that are set between two steps: what is put where, what is booked, forgotten and refused.
// Cost: 6 s.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "mpm/checkpoint/checkpoint.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm/simulation/state_set.hpp"

namespace set_state_test {

using namespace mpm;

/// A bed of clay 0.2 m deep under a free block and a prescribed plate.
std::string bed(const std::string& more = {}) {
  return R"(
name: bed
geometry: plane_strain
gravity: [0, -9.81]
grid: {cell: 0.02, min: [-0.4, -0.2], max: [0.4, 0.6]}
time: {end: 1, cfl: 0.5, sync: 0.002}
materials: [{name: clay, law: j2_plasticity, density: 1800, young: 2 MPa, poisson: 0.4, yield_stress: 10 kPa}]
bodies: [{name: bed, material: clay, shape: {box: {min: [-0.4, -0.2], max: [0.4, 0]}}}]
boundaries: {all: slip, z_max: none}
rigid_bodies:
  - {name: block, shape: {box: {size: [0.1, 0.1]}}, pose: {position: [-0.2, 0.052]}, friction: 0.3, free: {mass: 20 kg}}
  - {name: plate, shape: {box: {size: [0.1, 0.1]}}, pose: {position: [0.2, 0.3]}, friction: 0.3}
)" + more;
}

Simulation run_of(const std::string& text) { return Simulation(build(parse_scene(text, "bed.yaml")), {1}); }

void advance(Simulation& run, int periods) {
  for (int k = 0; k < periods; ++k) run.advance();
}

StateSet state(const std::string& name, const Vec3& position, const Twist& twist = {}) {
  StateSet set;
  set.name = name;
  set.pose = Pose{position, Quat::Identity()};
  set.twist = twist;
  return set;
}

std::string refusal(Simulation& run, const StateSet& set) {
  const std::uint64_t before = run.memory_hash();
  std::string reason;
  try {
    run.set_state(set);
  } catch (const RigidError& error) {
    reason = error.what();
  }
  EXPECT_EQ(run.memory_hash(), before) << reason;
  return reason;
}

// Momentum and energy that are given are those of 20 kg, by hand; then the account of the body's momentum still closes.
TEST(SetState, AFreeBodyIsPutAndWhatItGainsIsBooked) {
  Simulation run = run_of(bed());
  advance(run, 50);
  const FreeBodyReport before = run.free_bodies()[0];
  const Vec3 velocity = before.momentum.linear / 20.0;
  const double spin = run.bodies()[0].twist.angular.y();
  const Twist twist{Vec3(0.2, 0.0, -0.5), Vec3(0.0, spin, 0.0)};
  run.set_state(state("block", {-0.1, 0.0, 0.25}, twist));
  const BodyState now = run.bodies()[0];
  EXPECT_EQ(now.pose.position, Vec3(-0.1, 0.0, 0.25));
  EXPECT_EQ(now.twist.linear, twist.linear);
  FreeBodyReport after = run.free_bodies()[0];
  const Vec3 given = 20.0 * (twist.linear - velocity);
  EXPECT_LT((after.set.linear - given).norm(), 1e-12 * given.norm());
  const double work =
      10.0 * (twist.linear.squaredNorm() - velocity.squaredNorm()) + 20.0 * 9.81 * (0.25 - before.centre.z());
  EXPECT_NEAR(after.set_work, work, 1e-12 * std::abs(work));
  EXPECT_NEAR(run.state().energy.of("free_set"), work, 1e-12 * std::abs(work));
  // Falls freely for a period: half a step's fall more than g t^2 / 2, and no contact.
  const Vec3 contact = after.contact.linear;
  run.advance();
  after = run.free_bodies()[0];
  EXPECT_EQ(after.contact.linear, contact);
  EXPECT_NEAR(after.momentum.linear.z() / 20.0, -0.5 - 9.81 * 0.002, 1e-12);
  advance(run, 150);  // onto the clay
  after = run.free_bodies()[0];
  EXPECT_GT(after.contact.linear.z(), contact.z() + 10.0);
  const Vec3 sum = after.initial_momentum.linear + after.contact.linear + after.gravity.linear + after.set.linear;
  EXPECT_LT((after.momentum.linear - sum).norm(), 1e-10 * (after.contact.linear.norm() + after.gravity.linear.norm()));
}

// A pose command ends where the body is set, and contact is over for a plate that is set above the clay.
TEST(SetState, APrescribedBodyStaysWhereItIsPut) {
  Simulation run = run_of(bed());
  run.command_pose(1, Pose{Vec3(0.2, 0.0, 0.2), Quat::Identity()}, 10'000'000);
  run.advance();
  run.set_state(state("plate", {0.1, 0.0, 0.15}));
  advance(run, 20);
  EXPECT_EQ(run.bodies()[1].pose.position, Vec3(0.1, 0.0, 0.15));  // the pose command is over
  run.command_velocity(1, {Vec3(0.0, 0.0, -0.5), Vec3::Zero()});
  advance(run, 120);  // 2 cm into the clay
  EXPECT_GT(run.take_contact(1).impulse.z(), 1.0);
  run.command_velocity(1, {});
  run.set_state(state("plate", {0.1, 0.0, 0.3}));
  const double before = run.take_contact(1).impulse.z();
  advance(run, 10);
  EXPECT_EQ(run.take_contact(1).impulse.z(), before);  // nothing pulls at it
}

// Clay holds an adhesive plate that is drawn off it; a plate that was set a quarter of a cell higher is not held,
// though the points that knew it are near.
TEST(SetState, NoPointRemembersABodyThatWasPutElsewhere) {
  for (const bool put : {false, true}) {
    std::string text = bed("contact: {friction: 0.3, adhesion: 5 kPa}\n");
    const std::string own = "[0.2, 0.3]}, friction: 0.3";  // a law of its own, without adhesion
    text.replace(text.find(own), own.size(), "[0.2, 0.06]}");
    Simulation run = run_of(text);
    run.command_pose(1, Pose{Vec3(0.2, 0.0, 0.048), Quat::Identity()}, 40'000'000);
    advance(run, 22);
    const double pressed = run.take_contact(1).impulse.z();
    EXPECT_GT(pressed, 0.0);
    if (put) run.set_state(state("plate", {0.2, 0.0, 0.055}));
    run.command_velocity(1, {Vec3(0.0, 0.0, 0.2), Vec3::Zero()});
    advance(run, 5);
    const double after = run.take_contact(1).impulse.z();
    if (put) {
      EXPECT_EQ(after, pressed);
    } else {
      EXPECT_LT(after, pressed - 0.1);
    }
  }
}

TEST(SetState, WhatCannotBeIsRefusedAndChangesNothing) {
  Simulation run = run_of(bed());
  advance(run, 5);
  const auto expect = [&](const StateSet& set, const char* words) {
    const std::string reason = refusal(run, set);
    EXPECT_NE(reason.find(words), std::string::npos) << reason;
    EXPECT_EQ(reason.find('\n'), std::string::npos) << reason;
  };
  expect(state("blok", {0.0, 0.0, 0.3}), "block");
  expect(state("block", {0.0, 0.0, 0.02}), "more than half a cell");  // 3 cm deep
  expect(state("plate", {0.2, 0.0, 0.3}, {Vec3(0.1, 0.0, 0.0), Vec3::Zero()}), "prescribed");
  expect(state("block", {0.0, 0.0, std::nan("")}), "finite");
  StateSet without;
  without.name = "block";
  expect(without, "no pose");
  without.joints = {"boom"};
  expect(without, "no joints");
  StateSet turned = state("block", {0.0, 0.0, 0.3});
  turned.pose->orientation.coeffs() *= 1.1;
  expect(turned, "quaternion");
  // A centimetre of clay is half a cell: as deep as particles of a scene may lie in a body when it begins.
  run.set_state(state("block", {0.0, 0.0, 0.045}));
}

// All of the bed is asleep, since nothing is near it; where the block is put it wakes before the next step.
TEST(SetState, MaterialAsleepWakesWhereABodyIsPut) {
  std::string text = bed("sleep: {speed: 20 mm/s, from_start: true, after: 10 ms}\n");
  const std::string at = "position: [-0.2, 0.052]";
  text.replace(text.find(at), at.size(), "position: [-0.2, 0.45]");
  const std::string loaded = "material: clay,";
  text.replace(text.find(loaded), loaded.size(), loaded + " initial: geostatic,");
  Simulation run = run_of(text);
  advance(run, 5);
  const auto asleep = [&] {
    for (const NamedNumber& number : run.numbers()) {
      if (number.name == "asleep") return number.value;
    }
    return -1.0;
  };
  const double before = asleep();
  ASSERT_GT(before, 0.9 * static_cast<double>(run.particles()));
  run.set_state(state("block", {0.0, 0.0, 0.055}));
  EXPECT_LT(asleep(), before);
}

// A checkpoint has what is set, with its accounts.
TEST(SetState, ACheckpointGoesOnToTheBit) {
  const std::string text = bed(), file = testing::TempDir() + "set_state.h5";
  Simulation whole = run_of(text), again = run_of(text);
  advance(whole, 10);
  whole.set_state(state("block", {-0.1, 0.0, 0.06}, {Vec3(0.1, 0.0, -0.4), Vec3::Zero()}));
  save_checkpoint(file, whole, {"bed.yaml", text, {}});
  load_checkpoint(file, again, text);
  advance(whole, 30);
  advance(again, 30);
  EXPECT_EQ(again.memory_hash(), whole.memory_hash());
}

}  // namespace set_state_test
