// A smooth rigid plate presses a block onto a smooth floor, by a fifth of its height, and holds it: plane strain,
// free to grow sideways. With F = diag(a, 1, b), b given by the plate and a by sigma_xx = 0,
//   sigma = K/2 (J - 1/J) I + G J^(-5/3) dev B,  J = a b,
// and the force on the plate is -sigma_zz times the width a that the block has then.
// Pressing takes some ten times as long as a wave takes through the block; what vibration is left counts as error.
// Source: Nairn & Guilkey (2015) eq. (64) for a homogeneous state.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "mpm/math/constants.hpp"
#include "study/lattice.hpp"
#include "study/problems.hpp"

namespace mpm::study {
namespace plate_compression_problem {

constexpr double kDensity = 1000.0;
constexpr Elasticity kElasticity = {1000.0, 0.3};
constexpr double kEdge = 1.0, kPressed = 0.2;       // [m]
constexpr double kPressing = 16.0, kHolding = 4.0;  // [s]; a wave takes 0.9 s through the block

/// Cauchy stress across (index 0) and along the pressing, at stretches a and b [Pa].
std::array<double, 2> stress(double a, double b) {
  const double j = a * b, mean = (a * a + b * b + 1.0) / 3.0;
  const double pressure = 0.5 * kElasticity.bulk() * (j - 1.0 / j);
  const double deviatoric = kElasticity.shear() * std::pow(j, -5.0 / 3.0);
  return {pressure + deviatoric * (a * a - mean), pressure + deviatoric * (b * b - mean)};
}

class ForceError final : public ErrorMeasure {
 public:
  void look(Simulation& simulation) override {
    const double force = simulation.take_contact(0).mean.force.z();  // since the last look
    if (seconds_of(simulation.time()) <= kPressing) return;
    squares_ += std::pow(force / holding_force() - 1.0, 2);
    count_ += 1.0;
  }
  double error() const override { return std::sqrt(squares_ / count_); }

 private:
  /// On the plate, for 1 m of thickness [N].
  static double holding_force() {
    const double b = 1.0 - kPressed / kEdge;
    double low = 1.0, high = 2.0;  // sigma_xx rises with a
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      (stress(middle, b)[0] < 0.0 ? low : high) = middle;
    }
    return -stress(low, b)[1] * low * kEdge;
  }

  double squares_ = 0.0, count_ = 0.0;
};

SimulationDefinition definition(const MethodDefinition& method, const Discretisation& discretisation) {
  SimulationDefinition d = empty_definition("plate_compression", GeometryKind::plane_strain, method, discretisation,
                                            kEdge / discretisation.cells, Vec3::Zero(), {1.5 * kEdge, 0.0, 1.5 * kEdge},
                                            0.2, kPressing + kHolding);
  d.walls[0].kind = d.walls[4].kind = WallKind::slip;
  add_block(d, {"rubber", kDensity, NeoHookeanDefinition{kElasticity}}, {Vec3::Zero(), {kEdge, 0.0, kEdge}});
  RigidBodyDefinition plate;
  plate.name = "plate";
  const double thickness = 0.5 * kEdge;
  plate.surface = make_box({4.0 * kEdge, std::numeric_limits<double>::infinity(), thickness});
  plate.pose.position = {0.0, 0.0, kEdge + 0.5 * thickness};
  plate.velocity[2] = Function::parse(fmt::format("t<{0} ? -{1:.17g}*sin({2:.17g}*t) : 0", kPressing,
                                                  0.5 * kPi * kPressed / kPressing, kPi / kPressing));
  d.rigid_bodies = {plate};
  return d;
}

}  // namespace plate_compression_problem

Suite plate_compression() {
  using namespace plate_compression_problem;
  Suite suite;
  suite.name = "plate_compression";
  suite.title = "A plate compresses a block";
  suite.problem =
      "A smooth rigid plate presses a block of 1 m onto a smooth floor by 20 % of its height within 16 s and holds it "
      "for 4 s, without damping. Neo-Hookean, E = 1000 Pa, 1000 kg/m³, Poisson's ratio 0.3, plane strain. Cells: along "
      "an edge.";
  suite.exact = "force of the homogeneous state with sides free of stress, neo-Hookean law (Nairn and Guilkey 2015)";
  suite.measure_text = "RMS over the 4 s of holding of the error of the force on the plate, over the exact force";
  suite.geometry = GeometryKind::plane_strain;
  suite.costly = true;
  suite.definition = definition;
  suite.measure = [] { return std::make_unique<ForceError>(); };
  suite.quick = grids({8, 16, 32}, 16);
  suite.full = grids({8, 16, 32, 64}, 16);
  return suite;
}

}  // namespace mpm::study
