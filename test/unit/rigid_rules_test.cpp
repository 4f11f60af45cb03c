// Refusals of what does not go together with a rigid body: each rule alone, in a definition that is else taken.
#include "mpm/rules/rigid_rules.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "mpm/rules/feature_rules.hpp"
#include "mpm/simulation/simulation.hpp"
#include "particle_block.hpp"

namespace mpm {
namespace rigid_rules_test {

/// A free ball above a block, in contact at points.
SimulationDefinition ball_over_block(GeometryKind geometry) {
  SimulationDefinition d;
  d.geometry = geometry;
  d.time.sync = 1'000'000;
  d.grid = {Vec3::Constant(0.1), Vec3::Zero(), Vec3::Constant(2.0)};
  d.materials = {{"rubber", 1000.0, NeoHookeanDefinition{{1e5, 0.3}}}};
  DeformableBody block;
  block.name = "block";
  block.material = "rubber";
  block.particle_volume = 0.05 * 0.05;
  block.positions = particle_block(geometry, Vec3::Constant(0.4), {4, 4, 4}, 0.05);
  d.bodies = {block};
  RigidBodyDefinition ball;
  ball.name = "ball";
  ball.surface = make_sphere(0.1);
  ball.pose.position = {geometry == GeometryKind::axisymmetric ? 0.0 : 0.5, 0.0, 1.2};
  ball.free = FreeDefinition{};
  ball.free->mass = 1.0;
  ball.free->inertia = 0.1 * Mat3::Identity();
  d.rigid_bodies = {ball};
  return d;
}

void expect_refused(const std::string& text, const std::function<void(SimulationDefinition&)>& change,
                    GeometryKind geometry = GeometryKind::plane_strain) {
  SimulationDefinition definition = ball_over_block(geometry);
  EXPECT_EQ(rigid_fault(definition, definition.rigid_bodies[0]), "");
  change(definition);
  const std::string fault = rigid_fault(definition, definition.rigid_bodies[0]);
  EXPECT_EQ(fault.substr(0, text.size()), text);
  try {
    Simulation(std::move(definition), {1});
    FAIL() << "taken: " << text;
  } catch (const DefinitionError& error) {
    EXPECT_EQ(error.what(), "rigid body 'ball': " + fault);
  }
}

TEST(RigidRules, WhatAFreeBodyCanBe) {
  EXPECT_NO_THROW(Simulation(ball_over_block(GeometryKind::plane_strain), {1}));
  expect_refused("free: no velocity is free", [](auto& d) { d.rigid_bodies[0].free->axes = {}; });
  expect_refused("free: the centre of mass is off the body's origin", [](auto& d) {
    d.rigid_bodies[0].free->axes[0] = false;
    d.rigid_bodies[0].free->centre = {0.01, 0.0, 0.0};
  });
}

TEST(RigidRules, WhatABodyAboutAnAxisCanDo) {
  const GeometryKind ring = GeometryKind::axisymmetric;
  expect_refused(
      "it moves along r, off the axis", [](auto& d) { d.rigid_bodies[0].velocity[0] = 1.0; }, ring);
}

TEST(RigidRules, WhatIsThickDividesNothing) {
  const auto dividing = [](double radius, Sides sides) {
    return [radius, sides](SimulationDefinition& d) {
      d.rigid_bodies[0].surface = make_sphere(radius);
      d.rigid_bodies[0].divides = {"block"};
      d.rigid_bodies[0].sides = sides;
    };
  };
  expect_refused("divides: it is too thick", dividing(0.2, Sides::automatic));
  SimulationDefinition thin = ball_over_block(GeometryKind::plane_strain), asked = thin;
  dividing(0.1, Sides::automatic)(thin);
  dividing(0.2, Sides::two)(asked);
  EXPECT_EQ(rigid_fault(thin, thin.rigid_bodies[0]), "");
  EXPECT_EQ(rigid_fault(asked, asked.rigid_bodies[0]), "");
}

// More than one constant friction, which contact at nodes does not have (feature_rules.hpp).
TEST(RigidRules, LawsOfATool) {
  const SimulationDefinition plain = ball_over_block(GeometryKind::plane_strain);
  const auto has_law = [&](const std::function<void(SimulationDefinition&)>& change) {
    SimulationDefinition d = plain;
    change(d);
    return find_feature(Feature::tool_laws, d).has_value();
  };
  EXPECT_FALSE(has_law([](auto&) {}));
  EXPECT_TRUE(has_law([](auto& d) { d.rigid_bodies[0].friction.static_coefficient = 0.2; }));
  EXPECT_TRUE(has_law([](auto& d) { d.rigid_bodies[0].friction.adhesion = 1.0; }));
  EXPECT_TRUE(has_law([](auto& d) { d.contact.pairs = {{"block", "ball", ContactLaw()}}; }));
}

// A law belongs to a velocity field there. The second body is drawn into the first one's field by its definition.
TEST(RigidRules, BodiesOfOneFieldHaveOneLawWithRigidParticles) {
  SimulationDefinition d = ball_over_block(GeometryKind::plane_strain);
  d.rigid_bodies[0].free.reset();
  d.rigid_bodies[0].friction.coefficient = 0.2;
  DeformableBody second = d.bodies[0];
  second.name = "stone";
  for (Vec3& place : second.positions) place.x() += 0.4;
  d.bodies.push_back(second);
  ContactLaw law;
  law.friction = 0.3;
  d.contact.pairs = {{"stone", "ball", law}};
  EXPECT_EQ(rigid_fault(d, d.rigid_bodies[0]), "") << "contact at points has a law for each body";
  d.rigid_bodies[0].particles = true;
  const std::string fault = rigid_fault(d, d.rigid_bodies[0]);
  EXPECT_EQ(fault.find("normals: particles: 'block' and 'stone' have different laws with it"), 0u) << fault;
  try {
    Simulation(d, {1});
    FAIL() << "taken";
  } catch (const DefinitionError& error) {
    EXPECT_EQ(error.what(), "rigid body 'ball': " + fault);
  }
  const auto fault_with = [&](const std::function<void(ContactLaw&)>& change) {
    SimulationDefinition other = d;
    other.contact.pairs[0].law.friction = 0.2;
    change(other.contact.pairs[0].law);
    return rigid_fault(other, other.rigid_bodies[0]);
  };
  EXPECT_EQ(fault_with([](ContactLaw&) {}), "") << "the same law by two names";
  EXPECT_EQ(fault_with([](ContactLaw& one) { one.static_friction = 0.4; }), fault);
  EXPECT_EQ(fault_with([](ContactLaw& one) { one.adhesion = 1.0; }), fault);
  EXPECT_EQ(fault_with([](ContactLaw& one) { one.kind = ContactLaw::Kind::stick; }), fault);
  EXPECT_EQ(fault_with([](ContactLaw& one) { one.friction = Function::parse("0.2 + 0*t"); }), fault);
  d.bodies[1].field = 1;
  EXPECT_EQ(rigid_fault(d, d.rigid_bodies[0]), "") << "fields of their own";
  EXPECT_NO_THROW(Simulation(d, {1}));
}

}  // namespace rigid_rules_test
}  // namespace mpm
