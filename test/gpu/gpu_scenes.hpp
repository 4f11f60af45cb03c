// Small scenes for the tests of steps on a graphics processor: each run by the solver and by the kernels of an index.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../stability/probe.hpp"
#include "mpm/material/material_point.hpp"
#include "mpm/rigid/surface.hpp"
#include "mpm_gpu/exchange.hpp"

namespace gpu_scenes {

using mpm::Vec3;

/// A lattice of particles in cells [from, to) of the grid.
inline mpm::DeformableBody block(const mpm::SimulationDefinition& d, const std::string& name, const Vec3& from,
                                 const Vec3& to, const Vec3& velocity) {
  const bool solid = d.geometry == mpm::GeometryKind::solid;
  const double h = d.grid.cell.x(), step = 0.5;
  mpm::DeformableBody body;
  body.name = body.material = name;
  body.particle_volume = solid ? h * h * h / 8.0 : h * h / 4.0;
  for (double x = from.x() + 0.25; x < to.x(); x += step) {
    for (double z = from.z() + 0.25; z < to.z(); z += step) {
      for (double y = from.y() + 0.25; y < (solid ? to.y() : from.y() + step); y += step) {
        body.positions.push_back(h * Vec3(x, solid ? y : 0.0, z));
        body.velocities.push_back(velocity);
      }
    }
  }
  return body;
}

inline mpm::SimulationDefinition empty_scene(mpm::GeometryKind geometry, mpm::Precision precision) {
  mpm::SimulationDefinition d;
  d.geometry = geometry;
  d.grid = {Vec3::Constant(0.1), Vec3::Zero(), Vec3::Constant(1.2)};
  d.gravity = {0.0, 0.0, -9.81};
  d.time.sync = 1'000'000;
  d.method.update = mpm::UpdateScheme::usf;
  d.method.average_stress = false;
  d.method.precision = precision;
  for (mpm::WallDefinition& wall : d.walls) wall.kind = mpm::WallKind::slip;
  return d;
}

/// A solid elastic block, of 512 particles, falls askew on a fixed floor.
inline mpm::SimulationDefinition falling_block(mpm::Precision precision) {
  mpm::SimulationDefinition d = empty_scene(mpm::GeometryKind::solid, precision);
  d.walls[4].kind = mpm::WallKind::fixed;
  mpm::NeoHookeanDefinition law;
  law.elasticity = {1e6, 0.3};
  d.materials = {{"block", 1000.0, law}};
  d.bodies = {block(d, "block", {3.0, 3.3, 0.1}, {7.0, 7.3, 4.1}, {0.7, 0.3, -2.0})};
  return d;
}

/// A column of sand collapses in plane strain, 384 particles; a little of PIC.
inline mpm::SimulationDefinition column(mpm::Precision precision) {
  mpm::SimulationDefinition d = empty_scene(mpm::GeometryKind::plane_strain, precision);
  d.walls[4].kind = mpm::WallKind::fixed;
  d.method.transfer.flip = 0.98;
  mpm::DruckerPragerDefinition law;
  law.elasticity = {1e6, 0.3};
  law.friction_angle = 0.6;
  d.materials = {{"sand", 1600.0, law}};
  d.bodies = {block(d, "sand", {0.0, 0.0, 0.0}, {8.0, 0.0, 12.0}, {1.0, 0.0, -0.5})};
  return d;
}

/// A block of metal, 216 particles, strikes a slip wall at 80 m/s and yields; quadratic splines.
inline mpm::SimulationDefinition metal(mpm::Precision precision) {
  mpm::SimulationDefinition d = empty_scene(mpm::GeometryKind::solid, precision);
  d.method.shape = mpm::ShapeKind::bspline2;
  mpm::J2PlasticityDefinition law;
  law.elasticity = {70e9, 0.33};
  law.yield_stress = 1e8;
  d.materials = {{"metal", 2700.0, law}};
  d.bodies = {block(d, "metal", {3.0, 3.0, 0.3}, {6.0, 6.0, 3.3}, {5.0, 0.0, -80.0})};
  return d;
}

/// Two elastic blocks of unlike laws, 64 particles each, meet in one velocity field in plane strain.
inline mpm::SimulationDefinition two_blocks(mpm::Precision precision) {
  mpm::SimulationDefinition d = empty_scene(mpm::GeometryKind::plane_strain, precision);
  mpm::NeoHookeanDefinition rubber;
  rubber.elasticity = {1e6, 0.4};
  mpm::LinearElasticDefinition foam;
  foam.elasticity = {3e5, 0.1};
  d.materials = {{"rubber", 1000.0, rubber}, {"foam", 300.0, foam}};
  d.bodies = {block(d, "rubber", {1.0, 0.0, 0.0}, {5.0, 0.0, 4.0}, {1.0, 0.0, 0.0}),
              block(d, "foam", {5.1, 0.0, 0.2}, {9.1, 0.0, 4.2}, {-1.0, 0.0, 0.0})};
  return d;
}

/// The falling block, its strain updated last.
inline mpm::SimulationDefinition block_usl(mpm::Precision precision) {
  mpm::SimulationDefinition d = falling_block(precision);
  d.method.update = mpm::UpdateScheme::usl;
  return d;
}
/// The column, its strain updated half first and half last; a little of PIC.
inline mpm::SimulationDefinition column_usavg(mpm::Precision precision) {
  mpm::SimulationDefinition d = column(precision);
  d.method.update = mpm::UpdateScheme::usavg;
  return d;
}

/// The block of metal with cubic splines.
inline mpm::SimulationDefinition metal_cubic(mpm::Precision precision) {
  mpm::SimulationDefinition d = metal(precision);
  d.method.shape = mpm::ShapeKind::bspline3;
  return d;
}
/// The column with cubic splines, which its walls fold.
inline mpm::SimulationDefinition column_cubic(mpm::Precision precision) {
  mpm::SimulationDefinition d = column(precision);
  d.method.shape = mpm::ShapeKind::bspline3;
  return d;
}
/// The column with boxes that stretch, half of its strain after the motion: its boxes are those of the step's start.
inline mpm::SimulationDefinition column_stretch(mpm::Precision precision) {
  mpm::SimulationDefinition d = column_usavg(precision);
  d.method.shape = mpm::ShapeKind::ugimp_stretch;
  return d;
}

/// The falling block with APIC.
inline mpm::SimulationDefinition block_apic(mpm::Precision precision) {
  mpm::SimulationDefinition d = falling_block(precision);
  d.method.transfer.kind = mpm::TransferKind::apic;
  return d;
}
/// The column with APIC and quadratic splines, which have no second moment on its walls; momentum is gathered twice.
inline mpm::SimulationDefinition column_apic(mpm::Precision precision) {
  mpm::SimulationDefinition d = column_usavg(precision);
  d.method.shape = mpm::ShapeKind::bspline2;
  d.method.transfer = {};
  d.method.transfer.kind = mpm::TransferKind::apic;
  return d;
}

/// The two blocks with XPIC(3).
inline mpm::SimulationDefinition blocks_xpic(mpm::Precision precision) {
  mpm::SimulationDefinition d = two_blocks(precision);
  d.method.transfer.kind = mpm::TransferKind::xpic;
  d.method.transfer.order = 3;
  return d;
}
/// The column with FMPM(2), its strain updated half first and half last.
inline mpm::SimulationDefinition column_fmpm(mpm::Precision precision) {
  mpm::SimulationDefinition d = column_usavg(precision);
  d.method.transfer = {};
  d.method.transfer.kind = mpm::TransferKind::fmpm;
  d.method.transfer.order = 2;
  return d;
}

/// The falling block on a floor with friction, from which it rebounds.
inline mpm::SimulationDefinition block_friction(mpm::Precision precision) {
  mpm::SimulationDefinition d = falling_block(precision);
  d.walls[4].kind = mpm::WallKind::frictional;
  d.walls[4].friction.coefficient = 0.2;
  return d;
}
/// The column with FMPM(2) and strain in halves, on a floor with friction and beside a wall that it sticks to while
/// pressed.
inline mpm::SimulationDefinition column_friction(mpm::Precision precision) {
  mpm::SimulationDefinition d = column_fmpm(precision);
  for (mpm::WallDefinition* wall : {&d.walls[0], &d.walls[4]}) wall->kind = mpm::WallKind::frictional;
  d.walls[0].friction.stick = true;
  d.walls[4].friction.coefficient = 0.3;
  return d;
}

/// A tool that moves at a constant velocity.
inline mpm::RigidBodyDefinition tool(const std::string& name, std::unique_ptr<mpm::Surface> surface, const Vec3& place,
                                     const Vec3& velocity) {
  mpm::RigidBodyDefinition body;
  body.name = name;
  body.surface = std::move(surface);
  body.pose.position = place;
  for (int k = 0; k < 3; ++k) body.velocity[k] = mpm::Function(velocity[k]);
  body.friction.coefficient = 0.4;
  return body;
}

/// Lets a ball fall, free to turn.
inline void let_fall(mpm::RigidBodyDefinition& ball) {
  ball.velocity = {};
  ball.free = mpm::FreeDefinition{};
  ball.free->mass = 40.0;
  ball.free->inertia = 0.6 * mpm::Mat3::Identity();
  ball.free->velocity.linear = {0.5, 0.2, -1.5};
}

/// Time in which the fastest wave of the materials at rest crosses 0.3 cells [s].
inline double step_of(const mpm::SimulationDefinition& d) {
  double fastest = 0.0;
  for (const mpm::MaterialDefinition& material : d.materials) {
    fastest = std::max(fastest, mpm::MaterialPoint(material).wave_speed());
  }
  return 0.3 * d.grid.cell.x() / fastest;
}

/// All numbers of a run as bytes.
template <class T>
std::vector<unsigned char> bytes_of(mpm_gpu::DeviceRun<T>& run) {
  std::vector<unsigned char> bytes;
  const auto add = [&](const void* data, std::size_t size) {
    const auto* from = static_cast<const unsigned char*>(data);
    bytes.insert(bytes.end(), from, from + size);
  };
  run.solver().particles().each([&](const auto& buffer) {
    const auto numbers = buffer.download();
    add(numbers.data(), buffer.bytes());
  });
  const auto momentum = run.solver().momentum();
  add(momentum.data(), sizeof(momentum));
  add(&run.solver().impulses(), sizeof(mpm_gpu::Impulses));
  return bytes;
}

}  // namespace gpu_scenes
