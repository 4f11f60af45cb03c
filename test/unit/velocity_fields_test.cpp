// Velocity fields: a body in a field of its own moves as it does alone, with any method, and impulses that act on every
// field are counted once.
//
// Two bodies that share no node move alike in one field and in two: each node sums the same numbers in the same order,
// so the bits are the same. Only sums over all nodes (accounts, the reports of contacts) are in another order.
#include <gtest/gtest.h>

#include "mpm/rigid/surface.hpp"
#include "mpm/rules/method_rules.hpp"
#include "mpm/simulation/simulation.hpp"
#include "particle_block.hpp"

namespace mpm {
namespace velocity_fields_test {

constexpr double kCell = 0.1;

/// A body of `cells` cells along each axis with its lower corner at `corner` and two particles along each axis of a
/// cell.
DeformableBody body(GeometryKind geometry, const std::string& name, const Vec3& corner, int cells, int field) {
  DeformableBody body;
  body.name = name;
  body.material = "rubber";
  body.field = field;
  const double step = 0.5 * kCell;
  const int dim = geometry == GeometryKind::line ? 1 : geometry == GeometryKind::solid ? 3 : 2;
  body.particle_volume = std::pow(step, dim);
  const int n = 2 * cells;
  body.positions = particle_block(geometry, corner, {n, n, n}, step);
  for (const Vec3& x : body.positions) {
    const double from_axis = geometry == GeometryKind::axisymmetric ? x.x() : x.x() - corner.x();
    body.velocities.emplace_back(0.8 * from_axis, 0.2, 0.3 * x.x() - 1.0);
  }
  return body;
}

/// Two bodies far apart, with everything that acts on nodes: gravity, damping, loads, tractions, walls, a tool.
SimulationDefinition apart(GeometryKind geometry, const MethodDefinition& method, int second_field) {
  SimulationDefinition d;
  d.geometry = geometry;
  d.grid = {Vec3::Constant(kCell), Vec3::Zero(), Vec3::Constant(4.0)};
  d.time.sync = 5'000'000;
  d.materials = {{"rubber", 1000.0, NeoHookeanDefinition{{1e5, 0.3}}}};
  d.method = method;
  d.method.damping.grid = Function(2.0);
  d.gravity = {0.0, 0.0, -9.81};
  const bool solid = geometry == GeometryKind::solid;
  const int cells = solid ? 3 : 5;
  d.bodies = {body(geometry, "low", {0.0, 1.0, 0.0}, cells, 0),
              body(geometry, "high", {0.0, 1.0, 2.6}, cells, second_field)};
  if (geometry == GeometryKind::line) d.bodies[1] = body(geometry, "high", {2.6, 0.0, 0.0}, cells, second_field);
  if (geometry != GeometryKind::axisymmetric) d.walls[0] = {WallKind::slip, {}};
  d.walls[4] = {WallKind::frictional, {0.4, false}};
  BodyForceDefinition load;
  load.acceleration[0] = Function::parse("0.5+x");
  d.body_forces = {load};
  ParticleForceDefinition force;
  force.body = "high";
  force.force[0] = Function(3.0);
  force.spread = LoadSpread::center;
  d.particle_forces = {force};
  TractionDefinition traction;
  traction.body = "high";
  traction.face = 1;
  traction.value[0] = Function(20.0);
  d.tractions = {traction};
  if (geometry != GeometryKind::line) {
    RigidBodyDefinition tool;
    tool.name = "tool";
    tool.surface = make_box({8.0, 8.0, 0.4});
    tool.pose.position = {0.0, 0.0, 2.4};
    tool.friction.coefficient = 0.3;
    if (geometry == GeometryKind::axisymmetric) tool.surface = make_cylinder(1.0, 0.4);
    d.rigid_bodies.push_back(std::move(tool));
  }
  return d;
}

void expect_same(const SimulationDefinition& in_one, const SimulationDefinition& in_two, const std::string& name) {
  Simulation one(in_one, {1}), two(in_two, {1});
  for (int n = 0; n < 4; ++n) {
    one.advance();
    two.advance();
  }
  EXPECT_EQ(one.state_hash(), two.state_hash()) << name;
  const SolverState a = one.state(), b = two.state();
  ASSERT_EQ(a.audit.impulses.size(), b.audit.impulses.size()) << name;
  for (std::size_t i = 0; i < a.audit.impulses.size(); ++i) {
    EXPECT_EQ(a.audit.impulses[i].name, b.audit.impulses[i].name) << name;
    // Round-off of some thousand numbers, each at most of the size of the exchanged momentum, in another order.
    EXPECT_LT((a.audit.impulses[i].impulse - b.audit.impulses[i].impulse).norm(), 1e-12 * a.audit.exchanged)
        << name << ", " << a.audit.impulses[i].name;
  }
  EXPECT_LT(b.audit.residual, 1e-10) << name;
  EXPECT_NEAR(a.energy.of("load_work"), b.energy.of("load_work"), 1e-12 * a.energy.of("kinetic")) << name;
  EXPECT_NEAR(a.energy.of("contact_work"), b.energy.of("contact_work"), 1e-12 * a.energy.of("kinetic")) << name;
}

template <class Visit>
void each_method(GeometryKind geometry, const std::vector<ShapeKind>& shapes, Visit&& visit) {
  for (const ShapeKind shape : shapes) {
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

constexpr ShapeKind kShapes[] = {ShapeKind::dirac, ShapeKind::ugimp,    ShapeKind::ugimp_stretch, ShapeKind::cpdi,
                                 ShapeKind::qcpdi, ShapeKind::bspline2, ShapeKind::bspline3};

TEST(VelocityFields, BodiesApartMoveAsInOneFieldBitForBit) {
  for (const GeometryKind geometry :
       {GeometryKind::line, GeometryKind::plane_strain, GeometryKind::plane_stress, GeometryKind::axisymmetric}) {
    each_method(geometry, {std::begin(kShapes), std::end(kShapes)},
                [&](const MethodDefinition& method, const std::string& name) {
                  expect_same(apart(geometry, method, 0), apart(geometry, method, 1), name);
                });
  }
}

TEST(VelocityFields, BodiesApartInASolidMoveAsInOneFieldBitForBit) {
  each_method(GeometryKind::solid, {ShapeKind::ugimp, ShapeKind::cpdi},
              [&](const MethodDefinition& method, const std::string& name) {
                expect_same(apart(GeometryKind::solid, method, 0), apart(GeometryKind::solid, method, 1), name);
              });
}

TEST(VelocityFields, VolumeAveragingSinglePrecisionAndAFieldWithoutMaterialChangeNothing) {
  MethodDefinition method;
  method.average_dilatation = true;
  expect_same(apart(GeometryKind::plane_strain, method, 0), apart(GeometryKind::plane_strain, method, 1), "averaged");
  method.average_dilatation = false;
  expect_same(apart(GeometryKind::plane_strain, method, 0), apart(GeometryKind::plane_strain, method, 2),
              "empty field");
  method.precision = Precision::float32;
  SimulationDefinition single = apart(GeometryKind::plane_strain, method, 1);
  Simulation run(single, {1}), same(apart(GeometryKind::plane_strain, method, 0), {1});
  for (int n = 0; n < 4; ++n) {
    run.advance();
    same.advance();
  }
  EXPECT_EQ(run.state_hash(), same.state_hash());
}

/// Two squares that touch; the left one moves towards the right one, which is at rest.
SimulationDefinition touching(int second_field) {
  SimulationDefinition d;
  d.geometry = GeometryKind::plane_strain;
  d.grid = {Vec3::Constant(kCell), Vec3::Zero(), Vec3::Constant(4.0)};
  d.time.sync = 5'000'000;
  d.materials = {{"rubber", 1000.0, NeoHookeanDefinition{{1e5, 0.3}}}};
  d.bodies = {body(d.geometry, "left", {1.0, 0.0, 1.0}, 5, 0),
              body(d.geometry, "right", {1.5, 0.0, 1.0}, 5, second_field)};
  d.bodies[0].velocities.assign(d.bodies[0].positions.size(), Vec3(2.0, 0.0, 0.0));
  d.bodies[1].velocities.clear();
  return d;
}

double fastest_of_second(Simulation& simulation) {
  std::vector<double> v;
  simulation.particle_field("vx", v);
  double most = 0.0;
  for (std::size_t p = v.size() / 2; p < v.size(); ++p) most = std::max(most, std::abs(v[p]));
  return most;
}

TEST(VelocityFields, BodiesInTwoFieldsFeelNothingOfEachOther) {
  Simulation one(touching(0), {1}), two(touching(1), {1});
  for (int n = 0; n < 6; ++n) {
    one.advance();
    two.advance();
  }
  EXPECT_GT(fastest_of_second(one), 0.1);
  EXPECT_EQ(fastest_of_second(two), 0.0);  // although the first overlaps it
  EXPECT_LT(two.state().audit.residual, 1e-12);
}

TEST(VelocityFields, SameBitsForAnyNumberOfThreads) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 3}) {
    Simulation run(touching(1), {threads});
    for (int n = 0; n < 6; ++n) run.advance();
    hashes.push_back(run.state_hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(VelocityFields, RefusesWhatCannotBeNumbered) {
  SimulationDefinition d = touching(-1);
  EXPECT_THROW(Simulation(d, {1}), DefinitionError);
  const GridLayout huge(3, Vec3::Constant(1.0), Vec3::Zero(), Vec3::Constant(2e6));  // 1.3e17 blocks
  EXPECT_EQ(make_fields(huge, 2).size(), 2U);
  EXPECT_THROW(make_fields(huge, 3), GridError);
}

}  // namespace velocity_fields_test
}  // namespace mpm
