// A block slides down an incline of 30 degrees with Coulomb friction 0.3: s = v0 t + a t^2 / 2, a = g (sin 30 - 0.3 cos
// 30). The incline is a rigid body that lies across the grid, so that its normals, not rows of nodes, say where it is.
// The block begins to slide at v0, for one that starts from rest sticks here and there until its own waves have passed,
// which a rigid block, whose motion this is, does not. Source: exact-solutions 14.
#include <cmath>
#include <limits>
#include <numeric>

#include "mpm/math/constants.hpp"
#include "study/lattice.hpp"
#include "study/problems.hpp"

namespace mpm::study {
namespace sliding_block_problem {

constexpr double kGravity = 9.81, kFriction = 0.3, kAngle = kPi / 6.0;
constexpr double kHeight = 0.1, kLength = 0.2, kVelocity = 0.5, kEnd = 0.4;
const Vec3 kDown(std::cos(kAngle), 0.0, -std::sin(kAngle)), kNormal(std::sin(kAngle), 0.0, std::cos(kAngle));
const double kAcceleration = kGravity * (std::sin(kAngle) - kFriction * std::cos(kAngle));

double way(double time) { return kVelocity * time + 0.5 * kAcceleration * time * time; }

class SlideError final : public ErrorMeasure {
 public:
  void look(Simulation& simulation) override {
    const double along = mean(simulation, "x") * kDown.x() + mean(simulation, "z") * kDown.z();
    const double time = seconds_of(simulation.time());
    if (time == 0.0) start_ = along;
    worst_ = std::max(worst_, std::abs(along - start_ - way(time)));
  }
  double error() const override { return worst_ / way(kEnd); }

 private:
  double mean(const Simulation& simulation, const char* field) {
    simulation.particle_field(field, values_);
    return std::accumulate(values_.begin(), values_.end(), 0.0) / static_cast<double>(values_.size());
  }

  std::vector<double> values_;
  double start_ = 0.0, worst_ = 0.0;
};

SimulationDefinition definition(const MethodDefinition& method, const Discretisation& discretisation) {
  SimulationDefinition d =
      empty_definition("sliding_block", GeometryKind::plane_strain, method, discretisation,
                       kHeight / discretisation.cells, Vec3::Zero(), {0.8, 0.0, 0.6}, kEnd / 20.0, kEnd);
  d.gravity = {0.0, 0.0, -kGravity};
  const Vec3 corner(0.1, 0.0, 0.4);  // the lowest of the block, uphill
  add_block(d, {"rubber", 1000.0, NeoHookeanDefinition{{1e5, 0.3}}}, {Vec3::Zero(), {kLength, 0.0, kHeight}}, {},
            [](const Vec3&) { return Vec3(kVelocity * kDown); });
  for (Vec3& place : d.bodies.front().positions) place = corner + place.x() * kDown + place.z() * kNormal;
  RigidBodyDefinition incline;
  incline.name = "incline";
  const double thickness = 0.2;
  incline.surface = make_box({4.0, std::numeric_limits<double>::infinity(), thickness});
  incline.pose.position = corner - 0.5 * thickness * kNormal;
  incline.pose.orientation = Quat(Eigen::AngleAxisd(kAngle, Vec3::UnitY()));
  incline.friction.coefficient = kFriction;
  d.rigid_bodies = {incline};
  return d;
}

}  // namespace sliding_block_problem

Suite sliding_block() {
  using namespace sliding_block_problem;
  Suite suite;
  suite.name = "sliding_block";
  suite.title = "A block slides down an incline";
  suite.problem =
      "An elastic block of 0.2 by 0.1 m slides down an incline of 30 degrees that lies across the grid, for 0.4 s from "
      "0.5 m/s on, friction 0.3. Neo-Hookean, E = 0.1 MPa, 1000 kg/m³, Poisson's ratio 0.3, plane strain. Cells: over "
      "the height.";
  suite.exact = "s = v₀t + at²/2 with a = g(sin 30° - 0.3 cos 30°) = 2.356 m/s², Coulomb's law";
  suite.measure_text = "largest error of the mean way down the incline, over the way at the end";
  suite.geometry = GeometryKind::plane_strain;
  suite.costly = true;
  suite.definition = definition;
  suite.measure = [] { return std::make_unique<SlideError>(); };
  suite.quick = grids({4, 8, 16}, 8);
  suite.full = grids({4, 8, 16, 32}, 8);
  return suite;
}

}  // namespace mpm::study
