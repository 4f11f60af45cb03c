// Every method gives the same bits for any number of threads: sums at a node are grouped by the colours of blocks, and
// the values of a particle are written by one thread.
#include <gtest/gtest.h>

#include "step_scene.hpp"

namespace mpm::test {
namespace step_threads_test {

/// The complete result of a step: positions and the values of particles, by id.
template <class Geometry, class T>
std::vector<double> state_after(const StepMethod& method, int threads, int steps) {
  typename StepScene<Geometry, T>::Body body;
  body.cells = Geometry::kDim == 3 ? 6 : 16;  // three blocks along an axis, five in a plane
  body.centre = {Geometry::kHoop ? 1.05 : 1.45, 1.55, 1.5};
  StepScene<Geometry, T> scene(method, body, threads);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  scene.set_velocity([&](const auto&) { return std::array<double, 3>{u(random), u(random), u(random)}; });
  scene.advance(steps);
  const ParticleSet& set = scene.set();
  std::vector<double> state;
  const auto add = [&](const auto& values) {
    std::vector<double> by_id(set.size());
    for (int p = 0; p < set.size(); ++p) by_id[set.id[p]] = values[p];
    state.insert(state.end(), by_id.begin(), by_id.end());
  };
  for (const auto& x : set.x) add(x);
  for (const auto* fields : {&set.v, &set.f, &set.tau, &set.affine}) {
    for (const ParticleScalar& field : *fields) add(field);
  }
  return state;
}

template <class Geometry, class T>
void check_threads() {
  for (const ShapeKind shape : kAllShapes) {
    if (!has_shape(shape, kGeometryKind<Geometry>)) continue;
    for (const Transfer& transfer : kAllTransfers) {
      const StepMethod method{shape, UpdateScheme::usavg, transfer};
      const std::vector<double> one = state_after<Geometry, T>(method, 1, 5);
      for (const int threads : {2, 3}) {
        EXPECT_EQ((state_after<Geometry, T>(method, threads, 5)), one)
            << method.name() << ", " << threads << " threads";
      }
    }
  }
}
TEST(StepThreads, ChangeNoBitInAPlane) { check_threads<PlaneStrain, double>(); }
#ifndef __SANITIZE_ADDRESS__  // half a minute; the release build runs it
TEST(StepThreads, ChangeNoBitInASolid) { check_threads<Solid, double>(); }
#endif
TEST(StepThreads, ChangeNoBitOfRings) { check_threads<Axisymmetric, double>(); }
TEST(StepThreads, ChangeNoBitInSinglePrecision) { check_threads<PlaneStrain, float>(); }

}  // namespace step_threads_test
}  // namespace mpm::test
