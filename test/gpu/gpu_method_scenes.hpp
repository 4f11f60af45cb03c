// Scenes of methods beside the plain ones: mixtures of transfers, damping, loads, prescribed velocities.
#pragma once

#include "gpu_scenes.hpp"
#include "mpm/rigid/surface.hpp"

namespace gpu_scenes {

/// The column with a fraction of XPIC(3) in every second step, its strain updated half first and half last.
inline mpm::SimulationDefinition column_mixture(mpm::Precision precision) {
  mpm::SimulationDefinition d = column_usavg(precision);
  d.method.transfer.flip = 0.7;
  d.method.transfer.mixed = 3;
  d.method.transfer.every = 2;
  return d;
}
/// The falling block with a fraction of XPIC(2) in all steps, whose energy the solver counts.
inline mpm::SimulationDefinition block_mixture(mpm::Precision precision) {
  mpm::SimulationDefinition d = falling_block(precision);
  d.method.transfer.flip = 0.8;
  d.method.transfer.mixed = 2;
  return d;
}

/// The falling block in water, as it were: damping of the grid that grows, as a force on the nodes.
inline mpm::SimulationDefinition block_damped(mpm::Precision precision) {
  mpm::SimulationDefinition d = falling_block(precision);
  d.method.damping.grid = mpm::Function::parse("20 + 500 * t");
  return d;
}
/// The column with damping of grid and particles in their update, that of the grid by feedback of the kinetic energy,
/// and a part of PIC.
inline mpm::SimulationDefinition column_damped(mpm::Precision precision) {
  mpm::SimulationDefinition d = column_usavg(precision);
  d.method.transfer.flip = 1.0;
  d.method.damping.in_force = false;
  d.method.damping.grid = 3.0;
  d.method.damping.particle = mpm::Function::parse("5 * (1 + sin(300 * t))");
  d.method.damping.pic = 0.02;
  mpm::FeedbackDefinition feedback;
  feedback.gain = 50.0;
  feedback.target = 10.0;
  d.method.damping.feedback = feedback;
  return d;
}
/// The column with FMPM(2) and damping of what is adopted.
inline mpm::SimulationDefinition column_damped_fmpm(mpm::Precision precision) {
  mpm::SimulationDefinition d = column_fmpm(precision);
  d.method.damping.in_force = false;
  d.method.damping.grid = 10.0;
  d.method.damping.particle = 4.0;
  return d;
}

/// The falling block under loads: an acceleration that swings, one that differs from particle to particle, forces on
/// some of them, at their centres.
inline mpm::SimulationDefinition block_loaded(mpm::Precision precision) {
  mpm::SimulationDefinition d = falling_block(precision);
  mpm::BodyForceDefinition swings, twists;
  swings.acceleration = {mpm::Function::parse("60 * sin(900 * t)"), 0.0, 4.0};
  twists.body = "block";
  const auto of_start = mpm::FunctionPlaces::present_and_start;
  twists.acceleration = {mpm::Function::parse("200 * (Y - 0.5)", {}, of_start),
                         mpm::Function::parse("-200 * (X - 0.5)", {}, of_start), 0.0};
  d.body_forces = {swings, twists};
  mpm::ParticleForceDefinition shared, each;
  shared.body = each.body = "block";
  for (std::uint32_t p = 0; p < 512; p += 7) shared.particles.push_back(p);
  shared.force = {0.0, mpm::Function::parse("300 * (1 - t)"), 0.0};
  shared.spread = mpm::LoadSpread::center;
  each.particles = {0, 5, 300};
  each.shared = false;
  each.force = {5.0, 0.0, mpm::Function::parse("2 * cos(500 * t)")};
  d.particle_forces = {shared, each};
  return d;
}
/// The column with FMPM(2) and strain in halves, pushed sideways.
inline mpm::SimulationDefinition column_loaded(mpm::Precision precision) {
  mpm::SimulationDefinition d = column_fmpm(precision);
  mpm::BodyForceDefinition pushes;
  pushes.acceleration = {mpm::Function::parse("30 * t / 0.02"), 0.0, 1.0};
  d.body_forces = {pushes};
  return d;
}

/// The column pulled at its top and pushed at a side, and a load beside that; half of its strain after the motion.
inline mpm::SimulationDefinition column_traction(mpm::Precision precision) {
  mpm::SimulationDefinition d = column_usavg(precision);
  mpm::TractionDefinition top, side;
  top.body = side.body = "sand";
  top.face = 5;
  top.value = {mpm::Function::parse("4e3 * sin(200 * t)"), 0.0, -2e3};
  side.face = 1;
  side.particles = {180, 181, 182, 371};
  side.value = {-3e3, 0.0, 500.0};
  d.tractions = {top, side};
  mpm::BodyForceDefinition pushes;
  pushes.acceleration = {3.0, 0.0, 0.0};
  d.body_forces = {pushes};
  return d;
}
/// The falling block with a traction on a face of its box.
inline mpm::SimulationDefinition block_traction(mpm::Precision precision) {
  mpm::SimulationDefinition d = falling_block(precision);
  mpm::TractionDefinition side;
  side.body = "block";
  side.face = 2;
  side.value = {mpm::Function::parse("1e4 * t / 0.01"), 2e3, -1e3};
  d.tractions = {side};
  return d;
}

/// A velocity that is prescribed in a box about a place, along a direction.
inline mpm::ConditionDefinition prescribed(const std::string& name, const Vec3& at, const Vec3& size,
                                           const Vec3& direction, const mpm::Function& velocity) {
  mpm::ConditionDefinition condition;
  condition.region.name = name;
  condition.region.surface = mpm::make_box(size);
  condition.region.pose.position = at;
  condition.direction = direction;
  condition.velocity = velocity;
  return condition;
}
/// The falling block with its top pulled up and turned aside, by conditions of which two act along one direction and
/// others across it, where it meets a wall, too.
inline mpm::SimulationDefinition block_pulled(mpm::Precision precision) {
  mpm::SimulationDefinition d = falling_block(precision);
  const double slant = std::sqrt(0.5);
  d.conditions = {
      prescribed("lift", {0.5, 0.5, 0.45}, {0.9, 0.9, 0.15}, Vec3::UnitZ(), mpm::Function::parse("1 - 40 * t")),
      prescribed("more", {0.4, 0.5, 0.45}, {0.3, 0.9, 0.15}, -Vec3::UnitZ(), 0.3),
      prescribed("aside", {0.5, 0.5, 0.45}, {0.9, 0.9, 0.15}, {slant, slant, 0.0},
                 mpm::Function::parse("0.4 * sin(300 * t) * (1 + x)")),
      prescribed("foot", {0.5, 0.3, 0.0}, {0.5, 0.25, 0.15}, Vec3::UnitX(), 0.2)};
  return d;
}
/// The column with FMPM(2), strain in halves and a plate that moves down into it.
inline mpm::SimulationDefinition column_pressed(mpm::Precision precision) {
  mpm::SimulationDefinition d = column_fmpm(precision);
  mpm::ConditionDefinition plate =
      prescribed("plate", {0.4, 0.0, 1.15}, {0.5, 1.0, 0.2}, Vec3::UnitZ(), mpm::Function());
  plate.velocity.reset();
  plate.region.velocity[2] = mpm::Function::parse("-1 - 20 * t");
  d.conditions = {plate};
  return d;
}
/// The blocks of unlike laws with XPIC(3), mixed with FLIP, while one of them is held at a velocity.
inline mpm::SimulationDefinition blocks_held(mpm::Precision precision) {
  mpm::SimulationDefinition d = two_blocks(precision);
  d.method.transfer.flip = 0.8;
  d.method.transfer.mixed = 3;
  for (Vec3& velocity : d.bodies[1].velocities) velocity.z() = -0.5;
  d.conditions = {prescribed("grip", {0.2, 0.0, 0.2}, {0.25, 1.0, 0.25}, Vec3::UnitX(), 0.5)};
  return d;
}

/// The two blocks of which one runs out of the domain, and is put back.
inline mpm::SimulationDefinition blocks_leaving(mpm::Precision precision) {
  mpm::SimulationDefinition d = two_blocks(precision);
  d.walls[1].kind = mpm::WallKind::none;
  d.grid.leave_limit = 64;
  d.bodies[1] = block(d, "foam", {7.4, 0.0, 0.2}, {11.4, 0.0, 4.2}, {4.0, 0.0, -0.5});
  return d;
}

/// Water stands in a corner and falls to its open side: walls rub below it and behind it.
inline mpm::SimulationDefinition dam(mpm::Precision precision, mpm::GeometryKind geometry) {
  mpm::SimulationDefinition d = empty_scene(geometry, precision);
  for (const int face : {0, 4}) {
    d.walls[face].kind = mpm::WallKind::frictional;
    d.walls[face].friction.coefficient = 0.1;
  }
  mpm::NewtonianFluidDefinition law;
  law.bulk_modulus = 9e5;
  law.viscosity = 0.5;
  d.materials = {{"water", 1000.0, law}};
  const bool solid = geometry == mpm::GeometryKind::solid;
  const Vec3 to = solid ? Vec3(3.0, 3.0, 4.0) : Vec3(6.0, 0.0, 10.0);
  d.bodies = {block(d, "water", Vec3::Zero(), to, {solid ? 1.0 : 1.5, solid ? 0.7 : 0.0, -0.5})};
  return d;
}
inline mpm::SimulationDefinition dam_in_plane(mpm::Precision precision) {
  return dam(precision, mpm::GeometryKind::plane_strain);
}

}  // namespace gpu_scenes
