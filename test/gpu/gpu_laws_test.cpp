// Every law of the list, as a register of one lane, agrees with the solver's kernels on a block that is sheared and
// pressed. Cost: 1 s.
#include <gtest/gtest.h>

#include "../unit/material_zoo.hpp"
#include "gpu_scenes.hpp"

namespace gpu_laws_test {

using mpm::Vec3;

constexpr int kSteps = 20;

// A free block whose velocity gradient strains it twice as much as the specimen asks for, over all steps.
mpm::SimulationDefinition strained_block(const mpm::paths::Specimen& specimen, mpm::GeometryKind geometry) {
  mpm::SimulationDefinition d = gpu_scenes::empty_scene(geometry, mpm::Precision::float64);
  d.materials = {specimen.material};
  d.bodies = {gpu_scenes::block(d, specimen.material.name, {4.0, 4.0, 4.0}, {6.0, 6.0, 6.0}, Vec3::Zero())};
  const double rate = 2.0 * specimen.strain / (kSteps * gpu_scenes::step_of(d));
  for (std::size_t p = 0; p < d.bodies[0].positions.size(); ++p) {
    const Vec3 arm = d.bodies[0].positions[p] - Vec3::Constant(0.5);
    d.bodies[0].velocities[p] =
        rate * Vec3(arm.z() - 0.5 * arm.x(), -0.2 * arm.x() - 0.4 * arm.y(), 0.4 * arm.x() - arm.z());
  }
  return d;
}

// The bound is round-off of some hundred operations a step, 1e-16 each, that a law's stiffness may raise by four
// orders.
TEST(GpuLaws, AllAgreeWithTheSolver) {
  for (const mpm::paths::Specimen& specimen : mpm::paths::zoo()) {
    for (const auto geometry : {mpm::GeometryKind::solid, mpm::GeometryKind::plane_strain}) {
      SCOPED_TRACE(specimen.material.name + " " + mpm::geometry_name(geometry));
      const mpm::SimulationDefinition d = strained_block(specimen, geometry);
      mpm::SimulationProbe solver(d);
      mpm_gpu::DeviceRun<double> run(d, solver.sets());
      const double dt = gpu_scenes::step_of(d);
      double fastest = 0.0, stress = 0.0;  // the largest component on the way [J/kg]
      for (const Vec3& v : d.bodies[0].velocities) fastest = std::max(fastest, v.norm());
      for (int i = 0; i < kSteps; ++i) {
        solver.step(dt);
        run.solver().step(dt);
        for (const mpm::ParticleScalar& component : solver.sets()[0].tau) {
          for (std::size_t p = 0; p < component.size(); ++p) stress = std::max(stress, std::abs(component[p]));
        }
      }
      std::vector<mpm::ParticleSet> sets = solver.sets();
      run.write_to(sets);
      double most = 0.0, off = 0.0;
      for (int p = 0; p < sets[0].size(); ++p) {
        for (std::size_t k = 0; k < sets[0].v.size(); ++k) {
          most = std::max(most, std::abs(sets[0].v[k][p] - solver.sets()[0].v[k][p]));
        }
        for (std::size_t c = 0; c < sets[0].tau.size(); ++c) {
          off = std::max(off, std::abs(sets[0].tau[c][p] - solver.sets()[0].tau[c][p]));
        }
      }
      EXPECT_LT(most, 1e-10 * fastest);
      EXPECT_GT(stress, 0.0);
      EXPECT_LT(off, 1e-10 * stress);
    }
  }
}

}  // namespace gpu_laws_test
