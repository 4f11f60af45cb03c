// One element of the standard linear solid in simple shear. G of the long-term spring, G1 and T of the Maxwell branch:
//   relaxation (sudden constant shear gamma):  tau = gamma (G + G1 exp(-t / T))
//   creep (sudden constant stress s):          gamma = s / G (1 - G1 / (G + G1) exp(-t G / ((G + G1) T)))
// Relaxation of the shear stress is exact at any strain; creep is the solution for small strain. Source: textbook
// (Ferry, Viscoelastic Properties of Polymers, ch. 1); derived from tau = G gamma + q, dq/dt = G1 dgamma/dt - q / T.
#include <cmath>

#include "mpm/material/path_driver.hpp"
#include "page.hpp"

namespace verification {
namespace viscoelastic_test {

constexpr int kShear = 4;                                                   // xz among the components
constexpr double kYoung = 1e5, kPoisson = 0.2, kBranch = 3e4, kTime = 0.2;  // [Pa], [Pa], [s]
const double kLongTerm = kYoung / (2.0 * (1.0 + kPoisson));

mpm::PathDriver foam() {
  return mpm::PathDriver({"foam", 50.0, mpm::StandardLinearSolidDefinition{{kYoung, kPoisson}, kBranch, kTime}});
}

TEST(Viscoelastic, OneElementRelaxesAndCreeps) {
  Page page("viscoelastic", "standard_linear_solid", "Relaxation and creep of one element");
  page.problem(
      "A foam of the law `viscoelastic` (E = 100 kPa and nu = 0.2 in the long term, branch 30 kPa, relaxation time 0.2 "
      "s) in simple shear: a shear of 0.5 is held for 1 s; a shear stress of 10 Pa is held for 1 s, in 100 steps "
      "each.");
  page.exact(
      "relaxation: stress = shear (G + G1 exp(-t/T)). Creep: shear = stress / G (1 - G1/(G + G1) exp(-t G/((G + G1) "
      "T))).",
      "the differential equation of the standard linear solid, solved in the test");

  mpm::PathDefinition held;
  held.strain = 0.5;
  held.shear = true;
  mpm::PathDriver relaxing = foam();
  const mpm::StrainPath relaxation = make_strain_path("relaxation", held);
  relaxing.run(relaxation[0]);
  const double begin = relaxing.time();
  Numbers time, stress, exact_stress;
  double worst_stress = 0.0;
  relaxing.run(relaxation[1], [&] {
    const double t = relaxing.time() - begin, exact = 0.5 * (kLongTerm + kBranch * std::exp(-t / kTime));
    const double reached = relaxing.point().cauchy().xz;
    time.push_back(t);
    stress.push_back(reached / 1e3);
    exact_stress.push_back(exact / 1e3);
    worst_stress = std::max(worst_stress, std::abs(reached / exact - 1.0));
  });
  // The sudden strain takes 5e-6 of the relaxation time; nothing else differs.
  page.below("relaxation: largest relative error of the stress", worst_stress, 5e-6, "1");

  mpm::PathDefinition loaded;
  loaded.stress = 10.0;
  loaded.shear = true;
  mpm::PathDriver creeping = foam();
  Numbers creep_time, shear, exact_shear;
  double worst_shear = 0.0;
  const mpm::StrainPath creep = make_strain_path("creep", loaded);
  creeping.run(creep[0]);
  const double loaded_at = creeping.time();
  creeping.run(creep[1], [&] {
    const double t = creeping.time() - loaded_at, branch = kBranch / (kLongTerm + kBranch);
    const double exact = 10.0 / kLongTerm * (1.0 - branch * std::exp(-t * (1.0 - branch) / kTime));
    const double reached = 2.0 * creeping.strain()[kShear];
    creep_time.push_back(t);
    shear.push_back(1e6 * reached);
    exact_shear.push_back(1e6 * exact);
    worst_shear = std::max(worst_shear, std::abs(reached / exact - 1.0));
  });
  // Steps of 1/20 of the relaxation time at second order: (1/20)^2 / 12 = 2e-4 of the creep, which is two fifths of the
  // shear.
  page.below("creep: largest relative error of the shear", worst_shear, 2e-4, "1");
  page.figure()
      .panel("Relaxation at a shear of 0.5", "time [s]", "shear stress [kPa]")
      .exact("exact", time, exact_stress)
      .points("run", time, stress);
  page.figure()
      .panel("Creep under 10 Pa", "time [s]", "shear [1e-6]")
      .exact("exact", creep_time, exact_shear)
      .points("run", creep_time, shear);
  page.meaning(
      "Stress at constant strain relaxes exactly with any step; the step matters only while the strain "
      "changes.");
}

}  // namespace viscoelastic_test
}  // namespace verification
