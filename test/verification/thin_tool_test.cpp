// Tools thinner than the reach of the shape functions: material on one side does not act on the other, and where the
// tool is not between them the two sides are one body.
//
// Zero is exact here, since material acts only on its own velocity field. Two glued fields equal one field to
// round-off: their sums are grouped by fields, and the difference grows over a few hundred steps.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mpm/rigid/surface.hpp"
#include "mpm/rules/method_rules.hpp"
#include "mpm/simulation/simulation.hpp"
#include "particle_block.hpp"

namespace mpm {
namespace thin_tool_test {

constexpr double kCell = 0.1;
constexpr ContactMethod kContacts[] = {ContactMethod::points, ContactMethod::nodes};
const char* name_of(ContactMethod contact) { return contact == ContactMethod::points ? ", points" : ", nodes"; }
constexpr GeometryKind kGeometries[] = {GeometryKind::plane_strain, GeometryKind::axisymmetric, GeometryKind::solid};

SimulationDefinition empty_scene(GeometryKind geometry) {
  SimulationDefinition d;
  d.geometry = geometry;
  d.grid = {Vec3::Constant(kCell), Vec3::Zero(), Vec3::Constant(4.0)};
  d.time.sync = 10'000'000;
  d.materials = {{"rubber", 1000.0, NeoHookeanDefinition{{1e5, 0.3}}}};
  return d;
}

/// A block of `size` cells with its lower corner at `corner` and two particles along each axis of a cell; about the
/// axis in axisymmetric scenes.
DeformableBody block(GeometryKind geometry, const std::string& name, const Vec3& corner,
                     const std::array<int, 3>& size) {
  DeformableBody body;
  body.name = name;
  body.material = "rubber";
  const double step = 0.5 * kCell;
  const bool solid = geometry == GeometryKind::solid;
  body.particle_volume = solid ? step * step * step : step * step;
  body.positions = particle_block(geometry, corner, {2 * size[0], 2 * size[1], 2 * size[2]}, step);
  return body;
}

RigidBodyDefinition tool(std::unique_ptr<Surface> surface, const Vec3& position, Sides sides) {
  RigidBodyDefinition body;
  body.name = "blade";
  body.surface = std::move(surface);
  body.pose.position = position;
  body.friction.coefficient = 0.3;
  body.sides = sides;
  return body;
}

std::vector<double> field(const Simulation& simulation, const char* name) {
  std::vector<double> values;
  simulation.particle_field(name, values);
  return values;
}

double largest(const Simulation& simulation, const char* name, const std::string& body) {
  const std::vector<double> values = field(simulation, name);
  const auto [first, end] = simulation.body_ids(body);
  double most = 0.0;
  for (std::uint64_t p = first; p < end; ++p) most = std::max(most, std::abs(values[p]));
  return most;
}

template <class Visit>
void each_method(GeometryKind geometry, Visit&& visit) {
  for (const ShapeKind shape : {ShapeKind::dirac, ShapeKind::ugimp, ShapeKind::ugimp_stretch, ShapeKind::cpdi,
                                ShapeKind::qcpdi, ShapeKind::bspline2, ShapeKind::bspline3}) {
    if (geometry == GeometryKind::solid && shape != ShapeKind::ugimp && shape != ShapeKind::bspline2) continue;
    for (const UpdateScheme update : {UpdateScheme::usf, UpdateScheme::usl, UpdateScheme::usavg}) {
      for (const TransferKind kind : {TransferKind::flip, TransferKind::xpic, TransferKind::fmpm, TransferKind::apic}) {
        MethodDefinition method;
        method.shape = shape;
        method.update = update;
        method.transfer = {kind, 1.0, 3};
        if (method_fault(method, geometry)) continue;
        visit(method, std::string(geometry_name(geometry)) + ", " + shape_name(shape) + ", " +
                          kUpdateNames[static_cast<int>(update)] + ", " + kTransferNames[static_cast<int>(kind)]);
      }
    }
  }
}

// ---- the two sides do not act on each other

/// Two blocks on the two faces of a plate that is one cell thick and extends beyond them on all sides. The upper block
/// is a thousandth of a cell away, because contact at points would take round-off for an overlap.
SimulationDefinition sandwich(GeometryKind geometry, Sides sides) {
  SimulationDefinition d = empty_scene(geometry);
  const bool axial = geometry == GeometryKind::axisymmetric;
  const double left = axial ? 0.0 : 1.8;
  d.bodies = {block(geometry, "below", {left, 1.8, 1.55}, {4, 4, 4}),
              block(geometry, "above", {left, 1.8, 2.05 + 1e-3 * kCell}, {4, 4, 4})};
  d.rigid_bodies = {tool(axial ? make_cylinder(1.0, kCell) : make_box({2.0, 2.0, kCell}),
                         {axial ? 0.0 : 2.0, axial ? 0.0 : 2.0, 2.0}, sides)};
  return d;
}

void move(DeformableBody& body, const Vec3& velocity) { body.velocities.assign(body.positions.size(), velocity); }

TEST(ThinTool, WhatIsPressedAgainstOneFaceIsNotFeltAtTheOther) {
  for (const GeometryKind geometry : kGeometries) {
    each_method(geometry, [&](const MethodDefinition& method, const std::string& name) {
      for (const ContactMethod contact : kContacts) {
        SimulationDefinition d = sandwich(geometry, Sides::automatic);
        d.method = method;
        d.contact.method = contact;
        move(d.bodies[0], {0.0, 0.0, 1.0});
        Simulation run(d, {1});
        for (int n = 0; n < 3; ++n) run.advance();
        const std::string all = name + name_of(contact);
        EXPECT_GT(largest(run, "szz", "below"), 100.0) << all;  // it is compressed: rho c v is 11 kPa
        EXPECT_EQ(largest(run, "szz", "above"), 0.0) << all;
        EXPECT_EQ(largest(run, "vz", "above"), 0.0) << all;
        EXPECT_LT(run.state().audit.residual, 1e-10) << all;
      }
    });
  }
  // With one field the blocks do act on each other, so the test can fail.
  SimulationDefinition d = sandwich(GeometryKind::plane_strain, Sides::one);
  d.contact.method = ContactMethod::nodes;
  move(d.bodies[0], {0.0, 0.0, 1.0});
  Simulation run(d, {1});
  for (int n = 0; n < 3; ++n) run.advance();
  EXPECT_GT(largest(run, "vz", "above"), 1e-3);
}

// The plate moves broadside: down, into the lower block and away from the upper one.
TEST(ThinTool, PulledAwayItDrawsNothingAlong) {
  for (const GeometryKind geometry : kGeometries) {
    for (const ContactMethod contact : kContacts) {
      const std::string name = std::string(geometry_name(geometry)) + name_of(contact);
      SimulationDefinition d = sandwich(geometry, Sides::automatic);
      d.contact.method = contact;
      d.rigid_bodies[0].velocity[2] = Function(-1.0);
      Simulation run(d, {1});
      run.take_contact(0);
      for (int n = 0; n < 8; ++n) run.advance();
      EXPECT_EQ(largest(run, "vz", "above"), 0.0) << name;
      EXPECT_EQ(largest(run, "szz", "above"), 0.0) << name;
      EXPECT_GT(largest(run, "vz", "below"), 0.9) << name;
      const SolverState state = run.state();
      EXPECT_LT(state.audit.residual, 1e-10) << name;
      // All momentum comes from the plate.
      const Vec3 given = -run.take_contact(0).impulse;
      EXPECT_NEAR(state.audit.momentum.z(), given.z(), 1e-10 * std::abs(given.z())) << name;
      EXPECT_LT(given.z(), 0.0) << name;
    }
  }
}

// Two bodies with a field each and a contact law between them are not in contact through a tool.
TEST(ThinTool, BodiesOnItsTwoSidesAreNotInContact) {
  for (const ContactMethod contact : kContacts) {
    SimulationDefinition d = sandwich(GeometryKind::plane_strain, Sides::automatic);
    d.contact.method = contact;
    d.bodies[1].field = 1;
    PairDefinition pair;
    pair.first = "below";
    pair.second = "above";
    d.contact.pairs = {pair};
    d.contact.detection.kind = Detection::approach;  // ignores gaps: 0.5 m/s without sides
    move(d.bodies[0], {0.0, 0.0, 1.0});
    Simulation run(d, {1});
    for (int n = 0; n < 3; ++n) run.advance();
    EXPECT_GT(largest(run, "szz", "below"), 100.0) << name_of(contact);
    EXPECT_EQ(largest(run, "vz", "above"), 0.0) << name_of(contact);
  }
}

TEST(ThinTool, ADrawnAwayPlateOfOneFieldDrawsTheMaterialAlong) {
  SimulationDefinition d = sandwich(GeometryKind::plane_strain, Sides::one);
  d.contact.method = ContactMethod::nodes;
  d.rigid_bodies[0].velocity[2] = Function(-1.0);
  Simulation run(d, {1});
  for (int n = 0; n < 8; ++n) run.advance();
  EXPECT_GT(largest(run, "vz", "above"), 1e-3);
}

// Only the bodies that a tool names have a second field: a body that it does not name acts through it, as with one
// field. The third body lies far away.
TEST(ThinTool, DividesTheBodiesThatItNames) {
  const auto speed_above = [](const std::vector<std::string>& divides) {
    SimulationDefinition d = sandwich(GeometryKind::plane_strain, Sides::automatic);
    d.contact.method = ContactMethod::nodes;
    d.bodies.push_back(block(GeometryKind::plane_strain, "far", {0.5, 1.8, 0.5}, {2, 2, 2}));
    d.bodies[2].field = 1;
    d.rigid_bodies[0].divides = divides;
    move(d.bodies[0], {0.0, 0.0, 1.0});
    Simulation run(d, {1});
    for (int n = 0; n < 3; ++n) run.advance();
    EXPECT_GT(largest(run, "szz", "below"), 100.0);
    EXPECT_LT(run.state().audit.residual, 1e-10);
    return largest(run, "vz", "above");
  };
  EXPECT_EQ(speed_above({"below", "above"}), 0.0);
  EXPECT_GT(speed_above({"far"}), 1e-3);
}

// A body that the tool does not divide meets it, from either side, as a tool of one side.
TEST(ThinTool, IsMetFromBothSidesByWhatItDoesNotDivide) {
  const auto impulse = [](const char* moved, double speed, Sides sides) {
    SimulationDefinition d = sandwich(GeometryKind::plane_strain, sides);
    d.contact.method = ContactMethod::nodes;
    d.bodies.push_back(block(GeometryKind::plane_strain, "far", {0.5, 1.8, 0.5}, {2, 2, 2}));
    d.bodies[2].field = 1;
    if (sides != Sides::one) d.rigid_bodies[0].divides = {"far"};
    move(d.bodies[moved == std::string("below") ? 0 : 1], {0.0, 0.0, speed});
    Simulation run(d, {1});
    run.take_contact(0);
    for (int n = 0; n < 30; ++n) run.advance();
    return run.take_contact(0).impulse.z();
  };
  for (const double speed : {1.0, -1.0}) {
    const char* moved = speed > 0.0 ? "below" : "above";
    const double one = impulse(moved, speed, Sides::one);
    EXPECT_GT(std::abs(one), 1.0) << moved;  // [N s]
    EXPECT_NEAR(impulse(moved, speed, Sides::automatic), one, 1e-9 * std::abs(one)) << moved;
  }
}

TEST(ThinTool, ItIsSaidWhatWasChosen) {
  const auto said = [](const std::vector<std::string>& list, const std::string& text) {
    return std::any_of(list.begin(), list.end(),
                       [&](const auto& line) { return line.find(text) != std::string::npos; });
  };
  const Simulation two(sandwich(GeometryKind::plane_strain, Sides::automatic), {1});
  EXPECT_TRUE(said(two.notes(), "'blade' is 1 cells thick"));
  EXPECT_FALSE(said(two.warnings(), "'blade'"));
  const Simulation one(sandwich(GeometryKind::plane_strain, Sides::one), {1});
  EXPECT_TRUE(said(one.notes(), "with sides: one the material on its two sides shares nodes"));
  EXPECT_FALSE(said(one.warnings(), "'blade'")) << "it is the scene's own choice";
}

// ---- where the tool is not between them, the sides are one body

/// A block with random velocities that flies past the edge of a short plate, which points at it and touches nothing.
SimulationDefinition past_an_edge(GeometryKind geometry, Sides sides) {
  SimulationDefinition d = empty_scene(geometry);
  const bool axial = geometry == GeometryKind::axisymmetric;
  d.bodies = {block(geometry, "block", {axial ? 0.0 : 1.5, 1.8, 1.7}, {5, 3, 5})};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-0.3, 0.3);
  for (const Vec3& x : d.bodies[0].positions) {
    d.bodies[0].velocities.emplace_back(axial ? u(random) * x.x() : u(random), u(random), 2.0 + u(random));
  }
  // The edge is 1.4 cells from the block: too far for its nodes, near enough for its sides.
  const double edge = (axial ? 0.5 : 2.0) + 1.4 * kCell;
  if (axial) {
    d.rigid_bodies = {tool(make_ring(edge, edge + 0.3, 0.05), {0.0, 0.0, 2.0}, sides)};
  } else {
    d.rigid_bodies = {tool(make_box({0.3, 2.0, 0.05}), {edge + 0.15, 2.0, 2.0}, sides)};
  }
  return d;
}

TEST(ThinTool, GluedSidesAreOneField) {
  for (const GeometryKind geometry : kGeometries) {
    each_method(geometry, [&](const MethodDefinition& method, const std::string& name) {
      SimulationDefinition one = past_an_edge(geometry, Sides::one), two = past_an_edge(geometry, Sides::two);
      one.method = two.method = method;
      Simulation a(one, {1}), b(two, {1});
      for (int n = 0; n < (geometry == GeometryKind::solid ? 4 : 10); ++n) {
        a.advance();
        b.advance();
      }
      double apart = 0.0;
      for (const char* name : {"vx", "vz", "szz"}) {
        const std::vector<double> of_a = field(a, name), of_b = field(b, name);
        const double scale = largest(a, name, "block");
        for (std::size_t p = 0; p < of_a.size(); ++p) apart = std::max(apart, std::abs(of_a[p] - of_b[p]) / scale);
      }
      EXPECT_LT(apart, 1e-9) << name;
      EXPECT_LT(b.state().audit.residual, 1e-10) << name;
      EXPECT_EQ(b.take_contact(0).impulse.norm(), 0.0) << name;
    });
  }
}

// ---- a blade that cuts

/// A blade of one cell enters a block edge-on.
SimulationDefinition cut(GeometryKind geometry, double thickness) {
  SimulationDefinition d = empty_scene(geometry);
  const bool axial = geometry == GeometryKind::axisymmetric;
  d.gravity = {0.0, 0.0, -9.81};
  d.walls[4] = {WallKind::frictional, {0.5, false}};
  d.materials = {{"soil", 1500.0, DruckerPragerDefinition{{1e5, 0.3}, 0.5, 0.0, 200.0}}};
  const bool solid = geometry == GeometryKind::solid;
  d.bodies = {block(geometry, "block", {axial ? 0.0 : 1.0, 1.5, 0.0}, {solid ? 6 : 14, 4, 8})};
  d.bodies[0].material = "soil";
  const double x = axial ? 0.0 : (solid ? 1.3 : 1.7);
  RigidBodyDefinition blade = axial ? tool(make_ring(0.6, 0.6 + thickness, 1.0), {0.0, 0.0, 1.33}, Sides::automatic)
                                    : tool(make_box({thickness, 3.0, 1.0}), {x, 2.0, 1.33}, Sides::automatic);
  blade.velocity[2] = Function(-1.0);
  d.rigid_bodies = {blade};
  return d;
}

// No particle passes through the blade: none crosses its middle, and none that began more than a cell from its plane is
// on the other side later.
TEST(ThinTool, ABladeCutsWithoutLosingMomentumOrParticles) {
  for (const GeometryKind geometry : kGeometries) {
    for (int i = 0; i < 4; ++i) {
      const double thickness = i % 2 == 0 ? kCell : 0.3 * kCell;
      const ContactMethod contact = kContacts[i / 2];
      const std::string name =
          std::string(geometry_name(geometry)) + ", " + std::to_string(thickness) + name_of(contact);
      SimulationDefinition d = cut(geometry, thickness);
      d.contact.method = contact;
      const double middle =
          geometry == GeometryKind::axisymmetric ? 0.6 + 0.5 * thickness : d.rigid_bodies[0].pose.position.x();
      Simulation run(d, {1});
      const std::vector<double> start = field(run, "x");
      for (int n = 0; n < 50; ++n) run.advance();
      EXPECT_LT(run.state().audit.residual, 1e-10) << name;
      EXPECT_GT(run.take_contact(0).impulse.z(), 0.0) << name;  // it is slowed down
      const RigidBody& blade = run.rigid_body(0);
      const std::vector<double> x = field(run, "x"), y = field(run, "y"), z = field(run, "z");
      double deepest = 0.0;
      int passed = 0;
      for (std::size_t p = 0; p < x.size(); ++p) {
        const Vec3 place(x[p], geometry == GeometryKind::solid ? y[p] : 0.0, z[p]);
        deepest = std::max(deepest, -blade.surface().at(blade.pose().to_body(place)).distance);
        const bool beside = std::abs(z[p] - blade.pose().position.z()) < 0.5;  // its height is 1 m
        const bool crossed = (x[p] - middle) * (start[p] - middle) < 0.0;
        passed += beside && crossed && std::abs(start[p] - middle) > kCell;
      }
      EXPECT_LT(deepest, 0.5 * thickness) << name;
      EXPECT_EQ(passed, 0) << name;
    }
  }
}

}  // namespace thin_tool_test
}  // namespace mpm
