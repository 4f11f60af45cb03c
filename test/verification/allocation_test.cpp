// No step after the first ones allocates memory: the number of allocations in a sync period does not grow with its
// steps. And the bytes of a plain scene for each particle and node, counted as they are allocated: features that a
// scene does not name take none.
#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>

#include "../unit/material_zoo.hpp"
#include "mpm/rules/method_rules.hpp"
#include "mpm/simulation/simulation.hpp"

namespace allocation_test {

std::atomic<long> allocations{0};
std::atomic<long> bytes{0};  ///< bytes in use

void* counted(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  ++allocations;
  bytes += static_cast<long>(malloc_usable_size(memory));
  return memory;
}
void give_back(void* memory) {
  bytes -= static_cast<long>(malloc_usable_size(memory));
  std::free(memory);
}

}  // namespace allocation_test

// noinline, because gcc warns of mismatched new and delete when they are inlined.
[[gnu::noinline]] void* operator new(std::size_t size) { return allocation_test::counted(std::malloc(size)); }
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto multiple = static_cast<std::size_t>(alignment);
  return allocation_test::counted(std::aligned_alloc(multiple, (size + multiple - 1) / multiple * multiple));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { allocation_test::give_back(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { allocation_test::give_back(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  allocation_test::give_back(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { allocation_test::give_back(memory); }

namespace allocation_test {

using mpm::Vec3;

// A pressure of a few pascals on the upper side of a body, given as a function.
mpm::TractionDefinition pulsing_pressure(const std::string& body) {
  mpm::TractionDefinition load;
  load.body = body;
  load.face = 5;
  load.follows = true;
  load.value[0] = mpm::Function::parse("sin(9*t)*X", {}, mpm::FunctionPlaces::present_and_start);
  return load;
}

// Number of allocations in a sync period of `steps` steps. A box full of material under gravity is touched by a tool
// that moves along its surface, and shaken by loads that are functions. In a step the fastest wave crosses 0.4 cells.
long allocations_of_a_period(int steps, const mpm::MaterialDefinition& material, const mpm::MethodDefinition& method,
                             mpm::Isa isa, mpm::GeometryKind geometry = mpm::GeometryKind::solid,
                             const mpm::TransportDefinition& transport = {}) {
  mpm::SimulationDefinition d;
  d.geometry = geometry;
  const bool planar = geometry != mpm::GeometryKind::solid;
  const double h = 0.1;
  const int edge = 8;
  const double side = edge * h / 2;
  mpm::MaterialPoint rest(material);  // a gas at rest has its initial pressure
  rest.advance({}, 0.0);
  d.time.sync = std::llround(1e9 * 0.4 * h / rest.wave_speed());
  d.time.step = 1e-9 * static_cast<double>(d.time.sync) / steps;
  d.grid = {Vec3::Constant(h), Vec3::Zero(), Vec3::Constant(side)};
  d.method = method;
  d.gravity = {0.0, 0.0, -9.81};
  d.materials = {material};
  d.transport = transport;
  mpm::DeformableBody body;
  body.name = "body";
  body.material = material.name;
  body.particle_volume = h * h * h / 8.0;
  for (int p = 0; p < edge * edge * (planar ? 1 : edge); ++p) {
    const double y = planar ? 0.0 : p / edge / edge + 0.5;
    body.positions.push_back(0.5 * h * Vec3(p / edge % edge + 0.5, y, p % edge + 0.5));
  }
  d.bodies = {body};
  for (mpm::WallDefinition& wall : d.walls) wall.kind = mpm::WallKind::slip;
  if (mpm::axisymmetric(geometry)) d.walls[0].kind = mpm::WallKind::none;  // the axis
  mpm::RigidBodyDefinition tool;
  tool.name = "tool";
  tool.surface = mpm::make_box({0.2, 0.2, 0.2});
  tool.pose.position = {0.5 * side, planar ? 0.0 : 0.5 * side, side + 0.09};
  tool.velocity[0] = mpm::Function(0.1);
  if (mpm::axisymmetric(geometry)) {  // the tool lies on the axis and moves along it
    tool.pose.position.x() = 0.0;
    tool.velocity = {mpm::Function(), mpm::Function(), mpm::Function(-0.01)};
  }
  d.rigid_bodies = {tool};
  d.body_forces = {{"", {mpm::Function::parse("sin(9*t)*X", {}, mpm::FunctionPlaces::present_and_start)}}};
  d.tractions = {pulsing_pressure("body")};
  if (method.update == mpm::UpdateScheme::implicit) {  // clears loads, which implicit steps do not have
    d.body_forces.clear();
    d.tractions.clear();
    if (!planar) d.time.budget = 1e-9;  // every step is cut
  }
  mpm::Simulation simulation(d, {1, isa});
  for (int i = 0; i < 3; ++i) simulation.advance();
  const long before = allocations;
  const std::uint64_t steps_before = simulation.state().step.steps;
  const long of_state = allocations - before;
  simulation.advance();
  const long during = allocations - before - of_state;
  EXPECT_GE(simulation.state().step.steps - steps_before, static_cast<std::uint64_t>(steps)) << material.name;
  return during;
}

// Number of allocations while a block crosses the grid: it is sorted repeatedly, and the tool keeps meeting new nodes.
long allocations_of_a_crossing(int periods) {
  mpm::SimulationDefinition d;
  d.grid = {Vec3::Constant(0.1), Vec3::Zero(), Vec3::Constant(9.0)};
  d.time.sync = 20'000'000;
  d.materials = {{"m", 1000.0, mpm::NeoHookeanDefinition{{1e5, 0.3}}}};
  mpm::DeformableBody body;
  body.name = "block";
  body.material = "m";
  body.particle_volume = 0.1 * 0.1 * 0.1 / 8.0;
  for (int i = 0; i < 512; ++i) {
    body.positions.emplace_back(0.1 + 0.05 * (i / 64 + 0.5), 2.0 + 0.05 * (i / 8 % 8 + 0.5),
                                2.0 + 0.05 * (i % 8 + 0.5));
  }
  body.velocities.assign(512, Vec3(10.0, 0.0, 0.0));
  d.bodies = {body};
  d.tractions = {pulsing_pressure("block")};
  mpm::RigidBodyDefinition tool;
  tool.name = "tool";
  tool.surface = mpm::make_box({20.0, 2.0, 2.0});  // the block slides along its top
  tool.pose.position = {0.0, 2.0, 1.0};
  d.rigid_bodies = {tool};
  mpm::Simulation simulation(d, {1});
  for (int i = 0; i < 10; ++i) simulation.advance();
  const long before = allocations;
  for (int i = 0; i < periods; ++i) simulation.advance();
  return allocations - before;
}

TEST(Allocation, SortingAndContactDoNotAllocate) {
  // A period allocates the same over ten and over twenty periods, in which the block crosses two and four metres.
  EXPECT_EQ(2 * allocations_of_a_crossing(10), allocations_of_a_crossing(20));
}

// The number of allocations in a period is the same for 4 and for 16 steps.
TEST(Allocation, StepsOfEveryLawDoNotAllocate) {
  for (const mpm::Isa isa : {mpm::Isa::plain, mpm::Isa::avx2, mpm::Isa::avx512}) {
    if (!mpm::isa_available(isa)) continue;
    for (const mpm::Precision precision : {mpm::Precision::float32, mpm::Precision::float64}) {
      for (const mpm::UpdateScheme update : {mpm::UpdateScheme::usf, mpm::UpdateScheme::usavg}) {
        mpm::MethodDefinition method;
        method.precision = precision;
        method.update = update;
        for (const mpm::paths::Specimen& specimen : mpm::paths::zoo()) {
          EXPECT_EQ(allocations_of_a_period(4, specimen.material, method, isa),
                    allocations_of_a_period(16, specimen.material, method, isa))
              << specimen.material.name << ", " << mpm::precision_name(precision) << ", " << mpm::isa_name(isa);
        }
      }
    }
  }
}

// The correction of a fluid's volume acts in every fourth step, here in the one that is counted first.
TEST(Allocation, TheFirstCorrectionOfAVolumeDoesNotAllocate) {
  const mpm::MaterialDefinition water{"water", 1000.0, mpm::NewtonianFluidDefinition{1e6, 7.0, 50.0, true}};
  EXPECT_EQ(allocations_of_a_period(1, water, {}, mpm::best_isa()),
            allocations_of_a_period(16, water, {}, mpm::best_isa()));
}

// This holds for every shape function, update and transfer: in plane strain, which has them all, and about an axis.
TEST(Allocation, StepsOfEveryMethodDoNotAllocate) {
  using mpm::TransferKind;
  const mpm::MaterialDefinition material = mpm::paths::zoo()[2].material;
  for (const mpm::GeometryKind geometry : {mpm::GeometryKind::plane_strain, mpm::GeometryKind::axisymmetric}) {
    for (std::size_t shape = 0; shape < mpm::kShapeTraits.size(); ++shape) {
      for (std::size_t update = 0; update < mpm::kUpdateNames.size(); ++update) {
        for (const TransferKind kind :
             {TransferKind::flip, TransferKind::xpic, TransferKind::fmpm, TransferKind::apic}) {
          mpm::MethodDefinition method;
          method.shape = static_cast<mpm::ShapeKind>(shape);
          method.update = static_cast<mpm::UpdateScheme>(update);
          if (method.update == mpm::UpdateScheme::implicit) continue;  // below
          method.transfer = {kind, 1.0, 3};
          if (mpm::method_fault(method, geometry)) continue;
          EXPECT_EQ(allocations_of_a_period(4, material, method, mpm::best_isa(), geometry),
                    allocations_of_a_period(16, material, method, mpm::best_isa(), geometry))
              << mpm::geometry_name(geometry) << ", " << mpm::kShapeTraits[shape].name << ", "
              << mpm::kUpdateNames[update] << ", " << mpm::kTransferNames[static_cast<int>(kind)];
        }
      }
    }
  }
}

TEST(Allocation, ImplicitStepsDoNotAllocate) {
  for (const mpm::paths::Specimen& specimen : mpm::paths::zoo()) {
    if (!std::holds_alternative<mpm::DruckerPragerDefinition>(specimen.material.law)) continue;
    for (const mpm::GeometryKind geometry : {mpm::GeometryKind::plane_strain, mpm::GeometryKind::solid}) {
      mpm::MethodDefinition method;
      method.update = mpm::UpdateScheme::implicit;
      EXPECT_EQ(allocations_of_a_period(4, specimen.material, method, mpm::best_isa(), geometry),
                allocations_of_a_period(16, specimen.material, method, mpm::best_isa(), geometry))
          << specimen.material.name << ", " << mpm::geometry_name(geometry);
    }
  }
}

// Heat that conducts in one step and in several stages, with a flux, a source, a prescribed value and a hot tool; a
// tensor; and water that drains. A look at all particles within a period would allocate: the scenes are such that there
// is none.
TEST(Allocation, TransportDoesNotAllocate) {
  const mpm::MaterialDefinition material{"m", 1000.0, mpm::LinearElasticDefinition{{1e6, 0.3}}};
  mpm::TransportDefinition transport;
  for (const double conductivity : {1.0, 1e7}) {
    mpm::QuantityDefinition heat;
    heat.reference = 300.0;
    heat.materials.resize(1);
    heat.materials[0].capacity = 1000.0;
    heat.materials[0].conductivity = conductivity;
    heat.materials[0].expansion = 1e-6;
    heat.fluxes.push_back({"flux", "body", 5, {}, mpm::FluxDefinition::Kind::convection, mpm::Function(310.0), 10.0});
    heat.sources.push_back({"", false, mpm::Function(5.0)});
    heat.tools.push_back({"tool", 100.0, mpm::Function(320.0), 0.0, 1.0});
    mpm::ValueDefinition held;
    held.region.surface = mpm::make_box({10.0, 10.0, 0.1});
    held.value = mpm::Function::parse("300+t");
    heat.values.push_back(held);
    transport.quantities.push_back(heat);
    mpm::QuantityDefinition water;
    water.quantity = mpm::Transported::pore_pressure;
    water.materials.resize(1);
    water.materials[0].capacity = 1e-5;  // so that the water does not shorten the steps
    water.materials[0].conductivity = conductivity > 1.0 ? 1e-8 : 1e-11;
    if (conductivity > 1.0) water.materials[0].anisotropy = mpm::Symmetric3<double>{1.0, 1.0, 2.0, 0.0, 0.0, 0.0};
    water.materials[0].biot = mpm::Symmetric3<double>::isotropic(1.0);
    transport.quantities.push_back(water);
    for (const mpm::GeometryKind geometry : {mpm::GeometryKind::plane_strain, mpm::GeometryKind::axisymmetric}) {
      EXPECT_EQ(allocations_of_a_period(4, material, {}, mpm::best_isa(), geometry, transport),
                allocations_of_a_period(12, material, {}, mpm::best_isa(), geometry, transport))
          << conductivity << ", " << mpm::geometry_name(geometry);
    }
    transport.quantities.clear();
  }
}

/// The plainest scene: an elastic body in free flight, after a step.
struct Plain {
  Plain(bool planar, mpm::Precision precision, mpm::UpdateScheme update) {
    definition.geometry = planar ? mpm::GeometryKind::plane_strain : mpm::GeometryKind::solid;
    definition.method.precision = precision;
    definition.method.update = update;
    definition.grid = {Vec3::Constant(1.0), Vec3::Constant(-20.0), Vec3::Constant(200.0)};
    definition.time.sync = 1'000'000;
    definition.materials = {{"rubber", 1000.0, mpm::NeoHookeanDefinition{{1e5, 0.3}}}};
    mpm::DeformableBody body;
    body.name = "block";
    body.material = "rubber";
    definition.bodies = {body};
  }
  /// Bytes in use by the run.
  long bytes_in_use() const {
    const long before = bytes;
    mpm::Simulation simulation(definition, {1, mpm::Isa::plain});
    simulation.advance();
    return bytes - before;
  }
  mpm::SimulationDefinition definition;
};

/// Bytes in use for a block of 24 cells along each axis (96 in a plane), with `per_cell` particles along each axis of a
/// cell.
long bytes_of_block(Plain plain, int per_cell) {
  const bool planar = plain.definition.geometry == mpm::GeometryKind::plane_strain;
  const int edge = (planar ? 96 : 24) * per_cell;
  const double step = 1.0 / per_cell;
  mpm::DeformableBody& body = plain.definition.bodies[0];
  body.particle_volume = planar ? step * step : step * step * step;
  for (int i = 0; i < edge; ++i) {
    for (int j = 0; j < (planar ? 1 : edge); ++j) {
      for (int k = 0; k < edge; ++k) {
        body.positions.emplace_back((i + 0.5) * step, planar ? 0.0 : (j + 0.5) * step, (k + 0.5) * step);
      }
    }
  }
  return plain.bytes_in_use();
}

// With more particles in the same cells the difference comes from particles alone. By hand: position, velocity, F,
// stress and id; and the arrays of the sorter (step/sorter.hpp: 25 bytes, 29 in single precision). There is at most one
// group for each particle, a number of 4 bytes; another field would take 4 or 8 bytes more.
TEST(Allocation, PlainScenesTakeTheBytesOfTheirFields) {
  const auto bytes_a_particle = [](bool planar, mpm::Precision precision, mpm::UpdateScheme update) {
    const Plain plain(planar, precision, update);
    const double cells = planar ? 96.0 * 96.0 : 24.0 * 24.0 * 24.0;
    const double more = (planar ? 9.0 - 4.0 : 27.0 - 8.0) * cells;
    return (bytes_of_block(plain, 3) - bytes_of_block(plain, 2)) / more;
  };
  using mpm::Precision;
  using mpm::UpdateScheme;
  const auto expect = [&](double by_hand, bool planar, Precision precision, UpdateScheme update) {
    const double found = bytes_a_particle(planar, precision, update);
    EXPECT_GE(found, by_hand);
    EXPECT_LT(found, by_hand + 4.0) << "planar " << planar << ", " << mpm::precision_name(precision);
  };
  expect(3 * 8 + (3 + 9 + 6) * 8 + 4 + 25, false, Precision::float64, UpdateScheme::usf);
  expect(6 * 8 + (3 + 9 + 6) * 8 + 4 + 25, false, Precision::float64, UpdateScheme::usavg);
  expect(3 * 8 + (3 + 9 + 6) * 4 + 4 + 29, false, Precision::float32, UpdateScheme::usf);
  expect(2 * 8 + (2 + 4 + 4) * 8 + 4 + 25, true, Precision::float64, UpdateScheme::usf);
}

// Each particle is alone in 27 blocks of 64 nodes, so nearly all memory is that of nodes. By hand: mass, momentum,
// velocity and force, with a sixteenth more as room for new blocks.
TEST(Allocation, PlainScenesTakeTheBytesOfTheirNodes) {
  const auto bytes_of = [](int edge) {
    Plain plain(false, mpm::Precision::float64, mpm::UpdateScheme::usf);
    mpm::DeformableBody& body = plain.definition.bodies[0];
    body.particle_volume = 0.125;
    for (int p = 0; p < edge * edge * edge; ++p) {
      body.positions.push_back(16.0 * Vec3(p / edge / edge, p / edge % edge, p % edge));
    }
    return plain.bytes_in_use();
  };
  const double nodes = (8 * 8 * 8 - 4 * 4 * 4) * 27 * 64;
  const double found = static_cast<double>(bytes_of(8) - bytes_of(4)) / nodes;
  const double by_hand = 8.0 * (1 + 3 + 3 + 3) * 17.0 / 16.0;
  EXPECT_GE(found, by_hand);
  EXPECT_LT(found, by_hand + 4.0);  // the table of blocks takes 0.6, another field would take 8.5
}

}  // namespace allocation_test
