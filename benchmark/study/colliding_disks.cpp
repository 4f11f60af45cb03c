// Two equal elastic disks, R = 0.2 m, meet head-on on a diagonal, 0.1 m/s along x and z each, and part again. No
// closed form is known for the impact; energy is kept, and every method here keeps momentum to round-off. So the drift
// of the energy is the error: what a method makes or loses, not where the disks are.
// Source: exact-solutions 11; the example is that of Sulsky, Chen & Schreyer (1994).
#include "study/lattice.hpp"
#include "study/measures.hpp"
#include "study/problems.hpp"

namespace mpm::study {
namespace colliding_disks_problem {

constexpr double kRadius = 0.2, kEnd = 3.6;

SimulationDefinition definition(const MethodDefinition& method, const Discretisation& discretisation) {
  SimulationDefinition d =
      empty_definition("colliding_disks", GeometryKind::plane_strain, method, discretisation,
                       2.0 * kRadius / discretisation.cells, {-0.2, 0.0, -0.2}, {1.2, 0.0, 1.2}, kEnd / 120.0, kEnd);
  const MaterialDefinition rubber = {"rubber", 1000.0, NeoHookeanDefinition{{1000.0, 0.3}}};
  const auto add_disk = [&](const char* name, double centre, double speed) {
    const Vec3 middle(centre, 0.0, centre), reach(kRadius, 0.0, kRadius);
    add_block(
        d, rubber, {middle - reach, middle + reach}, [&](const Vec3& X) { return (X - middle).norm() < kRadius; },
        [&](const Vec3&) { return Vec3(speed, 0.0, speed); }, name);
  };
  add_disk("left", 0.2, 0.1);
  add_disk("right", 0.8, -0.1);
  return d;
}

}  // namespace colliding_disks_problem

Suite colliding_disks() {
  using namespace colliding_disks_problem;
  Suite suite;
  suite.name = "colliding_disks";
  suite.title = "Two disks collide";
  suite.problem =
      "Two elastic disks of radius 0.2 m meet head-on at an eighth of the wave speed, and part again. Neo-Hookean, "
      "E = 1000 Pa, 1000 kg/m³, Poisson's ratio 0.3, plane strain. Cells: across a disk.";
  suite.exact =
      "energy is kept, and momentum; there is no closed form for the impact itself (Sulsky, Chen and Schreyer 1994)";
  suite.measure_text = "largest drift of kinetic and elastic energy over the energy at the start";
  suite.geometry = GeometryKind::plane_strain;
  suite.costly = true;
  suite.definition = definition;
  suite.measure = [] { return energy_drift(); };
  suite.quick = grids({8, 16, 32}, 16);
  suite.full = grids({8, 16, 32, 64}, 16);
  return suite;
}

}  // namespace mpm::study
