// Contact at points gives the same bits for any number of threads, where there are points enough for several threads to
// solve for their impulses (500 a thread). Runs 0.3 s.
#include <gtest/gtest.h>

#include "mpm/contact/point_contact.hpp"
#include "mpm/modules/run_parts.hpp"
#include "mpm/simulation/simulation.hpp"
#include "particle_block.hpp"

namespace mpm {
namespace contact_threads_test {

constexpr int kWide = 40;          // particles along the block: 1,600 points below its upper face, for three threads
constexpr double kSpacing = 0.05;  // spacing of particles [m], half a cell

/// A plate that turns and sinks on a wide block: points near the middle stick, those far from it slide.
SimulationDefinition plate_on_block(ShapeKind shape) {
  SimulationDefinition d;
  d.grid = {Vec3::Constant(2.0 * kSpacing), Vec3::Zero(), Vec3(3.0, 3.0, 1.0)};
  d.time.sync = 2'000'000;
  d.method.shape = shape;
  d.gravity = {0.0, 0.0, -9.81};
  d.materials = {{"rubber", 1000.0, NeoHookeanDefinition{{1e5, 0.3}}}};
  DeformableBody block;
  block.name = "block";
  block.material = "rubber";
  block.particle_volume = kSpacing * kSpacing * kSpacing;
  block.positions = particle_block(GeometryKind::solid, {0.53, 0.47, 0.3}, {kWide, kWide, 3}, kSpacing);
  d.bodies = {block};
  RigidBodyDefinition plate;
  plate.name = "plate";
  plate.surface = make_box({4.0, 4.0, 0.2});
  plate.pose.position = {1.5, 1.5, 0.3 + 3 * kSpacing + 0.1};
  plate.velocity[2] = Function(-0.3);
  plate.rotation_rate[2] = Function(0.02);
  plate.friction.coefficient = 0.6;
  d.rigid_bodies = {plate};
  return d;
}

struct Outcome {
  std::uint64_t state = 0, memory = 0;
  ContactReport report;
  int solving_threads = 0;
};

Outcome run(ShapeKind shape, int threads) {
  const PointContact* contact = nullptr;
  SimulationOptions options{threads};
  options.modules = {[&](RunParts& parts) {
    for (const Module* module : parts.modules.list()) {
      if (const auto* found = dynamic_cast<const PointContact*>(module)) contact = found;
    }
  }};
  Simulation simulation(plate_on_block(shape), options);
  for (int i = 0; i < 3; ++i) simulation.advance();
  Outcome outcome{simulation.state_hash(), simulation.memory_hash(), simulation.take_contact(0), 0};
  EXPECT_GE(contact->solver().points().size(), 1500u);
  int sticking = 0, sliding = 0;
  for (const PointSolver::Point& point : contact->solver().points()) {
    if (point.hold == Hold::stick) ++sticking;
    if (point.hold == Hold::slide) ++sliding;
  }
  EXPECT_GT(sticking, 50);
  EXPECT_GT(sliding, 50);
  outcome.solving_threads = contact->solver().solving_threads();
  return outcome;
}

// Splines reach the farthest: 125 nodes a point, so that blocks are nearest to sharing some.
TEST(ContactThreads, ChangeNoBitOfImpulsesAtPoints) {
  for (const ShapeKind shape : {ShapeKind::ugimp, ShapeKind::bspline3}) {
    const Outcome one = run(shape, 1);
    EXPECT_EQ(one.solving_threads, 1);
    for (const int threads : {2, 3}) {
      const Outcome several = run(shape, threads);
      EXPECT_EQ(several.solving_threads, threads) << "the solution did not run in parallel";
      EXPECT_EQ(several.state, one.state) << threads << " threads";
      EXPECT_EQ(several.memory, one.memory) << threads << " threads";
      EXPECT_EQ(several.report.impulse, one.report.impulse);
      EXPECT_EQ(several.report.mean.torque, one.report.mean.torque);
      EXPECT_EQ(several.report.friction, one.report.friction);
    }
  }
}

}  // namespace contact_threads_test
}  // namespace mpm
