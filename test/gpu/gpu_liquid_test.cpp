// Liquids in simulations whose steps a device takes: dams that break in plane strain and in space, between walls that
// rub, beside solids, soil and a tool, against runs on the processor. Cost: 6 s.
#include <gtest/gtest.h>

#include <cstdint>

#include "gpu_runs.hpp"
#include "mpm/rigid/surface.hpp"

namespace gpu_liquid_test {

using namespace gpu_runs;
using mpm::TransferKind;
using mpm::UpdateScheme;
using mpm::Vec3;

/// A sync period is some ten steps.
SimulationDefinition dam(mpm::GeometryKind geometry) {
  SimulationDefinition d = gpu_scenes::dam(mpm::Precision::float64, geometry);
  d.time.sync = 15'000'000;
  return d;
}
SimulationDefinition dam_in_plane(UpdateScheme update = UpdateScheme::usf, TransferKind transfer = TransferKind::flip) {
  SimulationDefinition d = dam(mpm::GeometryKind::plane_strain);
  d.method.update = update;
  d.method.transfer.kind = transfer;
  return d;
}
SimulationDefinition dam_in_space(UpdateScheme update = UpdateScheme::usf, TransferKind transfer = TransferKind::flip) {
  SimulationDefinition d = dam(mpm::GeometryKind::solid);
  d.method.update = update;
  d.method.transfer.kind = transfer;
  return d;
}

/// A block of rubber falls into the water.
SimulationDefinition struck_by_rubber() {
  SimulationDefinition d = dam_in_plane(UpdateScheme::usavg);
  mpm::NeoHookeanDefinition law;
  law.elasticity = {5e5, 0.3};
  d.materials.push_back({"rubber", 800.0, law});
  d.bodies = {gpu_scenes::block(d, "water", {0.0, 0.0, 0.0}, {12.0, 0.0, 5.0}, Vec3::Zero()),
              gpu_scenes::block(d, "rubber", {4.0, 0.0, 5.2}, {7.0, 0.0, 8.2}, {0.5, 0.0, -2.0})};
  return d;
}
/// Water runs against sand, whose cells share a stress, which changes its volume, too.
SimulationDefinition beside_sand() {
  SimulationDefinition d = dam_in_plane(UpdateScheme::usl, TransferKind::apic);
  d.method.average_stress = true;
  const SimulationDefinition other = gpu_scenes::column(mpm::Precision::float64);
  d.materials.push_back(other.materials.front());
  d.bodies.push_back(gpu_scenes::block(d, "sand", {6.0, 0.0, 0.0}, {12.0, 0.0, 6.0}, Vec3::Zero()));
  return d;
}
/// A box pushes the foot of the water. No row of particles ends on nodes to the last bit, where round-off decides
/// whether the next nodes have any mass for contact to act on.
SimulationDefinition pushed_by_tool(mpm::GeometryKind geometry) {
  SimulationDefinition d = dam(geometry);
  d.contact.method = mpm::ContactMethod::nodes;
  d.bodies = {gpu_scenes::block(d, "water", {4.1, 0.1, 0.1}, {9.1, 3.1, 5.1}, Vec3::Zero())};
  mpm::RigidBodyDefinition plate;
  plate.name = "plate";
  plate.surface = mpm::make_box({0.35, 2.0, 0.7});
  plate.pose.position = {0.20, 0.0, 0.36};
  plate.velocity[0] = 1.0;
  plate.friction.coefficient = 0.2;
  d.rigid_bodies = {plate};
  return d;
}

void expect_run_alike(const SimulationDefinition& d, double bound = kRoundOff) {
  Simulation here(d, options(false)), there(d, options(true));
  advance(here, kPeriods);
  advance(there, kPeriods);
  expect_alike(here, there, bound);
  const mpm::EnergyReport energy = there.state().energy;
  EXPECT_GT(std::abs(energy.of("volume correction")), 1e-6 * energy.whole());
  EXPECT_GT(here.state().step.steps, 8U * kPeriods);
  if (d.rigid_bodies.empty()) return;
  const mpm::ContactReport a = here.take_contact(0), b = there.take_contact(0);
  EXPECT_GT(a.nodes, 0);
  EXPECT_LT((a.impulse - b.impulse).norm(), bound * a.impulse.norm());
}

TEST(GpuLiquid, DamsBreakInPlaneStrain) {
  for (const UpdateScheme update : {UpdateScheme::usf, UpdateScheme::usl, UpdateScheme::usavg}) {
    SCOPED_TRACE(mpm::kUpdateNames[static_cast<int>(update)]);
    expect_run_alike(dam_in_plane(update, TransferKind::flip));
    expect_run_alike(dam_in_plane(update, TransferKind::apic));
  }
}
TEST(GpuLiquid, DamsBreakInSpace) {
  for (const UpdateScheme update : {UpdateScheme::usf, UpdateScheme::usl, UpdateScheme::usavg}) {
    SCOPED_TRACE(mpm::kUpdateNames[static_cast<int>(update)]);
    expect_run_alike(dam_in_space(update, TransferKind::flip));
    expect_run_alike(dam_in_space(update, TransferKind::apic));
  }
}
// A node's share of the domain depends on how far its function reaches, and on what a face does to it.
TEST(GpuLiquid, ShapeFunctions) {
  for (const mpm::ShapeKind shape :
       {mpm::ShapeKind::ugimp_stretch, mpm::ShapeKind::bspline2, mpm::ShapeKind::bspline3}) {
    SCOPED_TRACE(mpm::shape_name(shape));
    SimulationDefinition d = dam_in_plane(UpdateScheme::usavg, TransferKind::apic);
    d.method.shape = shape;
    expect_run_alike(d);
  }
}
TEST(GpuLiquid, OpenAndPeriodicFaces) {
  SimulationDefinition d = dam_in_space();
  d.walls[0].kind = mpm::WallKind::none;
  d.grid.max.y() = 0.8;
  d.walls[2].kind = d.walls[3].kind = mpm::WallKind::periodic;
  d.bodies = {gpu_scenes::block(d, "water", {0.0, 0.0, 0.0}, {2.0, 8.0, 3.0}, {1.0, 0.2, -0.5})};
  expect_run_alike(d);
}
TEST(GpuLiquid, BesideRubberAndSand) {
  expect_run_alike(struck_by_rubber());
  expect_run_alike(beside_sand());
}
TEST(GpuLiquid, PushedByATool) {
  expect_run_alike(pushed_by_tool(mpm::GeometryKind::plane_strain));
  expect_run_alike(pushed_by_tool(mpm::GeometryKind::solid));
}
TEST(GpuLiquid, InSingle) {
  SimulationDefinition d = dam_in_plane(UpdateScheme::usavg);
  d.method.precision = mpm::Precision::float32;
  Simulation here(d, options(false)), there(d, options(true));
  advance(here, kPeriods);
  advance(there, kPeriods);
  expect_sums_alike(here, there, 1e-5);
}

// The count of steps between corrections and what they have taken go along, so that a run goes on to the bit; at a
// checkpoint in each of the four places of that count.
TEST(GpuLiquid, ResumesToTheBit) {
  const mpm::test::Folder folder;
  const SimulationDefinition d = dam_in_plane(UpdateScheme::usavg);
  Simulation whole(d, options(true));
  advance(whole, kPeriods);
  std::uint64_t places = 0;
  for (int half = 1; half < kPeriods; ++half) {
    const std::string file = folder.file("half.h5");
    Simulation first(d, options(true)), second(d, options(true)), other(d, options(false));
    advance(first, half);
    places |= 1U << first.state().step.steps % 4;
    mpm::save_checkpoint(file, first, {});
    mpm::load_checkpoint(file, second, "");
    advance(second, kPeriods - half);
    EXPECT_EQ(whole.state_hash(), second.state_hash());
    mpm::load_checkpoint(file, other, "");
    EXPECT_EQ(first.state_hash(), other.state_hash());
    advance(other, kPeriods - half);
    expect_alike(other, whole);
  }
  EXPECT_EQ(places, 15U);
}

}  // namespace gpu_liquid_test
