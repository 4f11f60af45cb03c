// A disk that spins freely: its angular momentum about the centre should be constant. FLIP does not conserve it: a
// particle moves with the velocity of the grid, not with its own, so position x momentum changes although the forces
// balance. Source: exact-solutions 4. The test also checks the stress of a disk in steady rotation, plane strain, small
// strain (exact-solutions 5): with n = nu / (1 - nu), s = rho omega^2 / 8,
//   sigma_r = (3 + n) s (R^2 - r^2), sigma_theta = s [(3 + n) R^2 - (1 + 3 n) r^2].
#include <fmt/core.h>

#include <algorithm>

#include "mpm/math/constants.hpp"
#include "page.hpp"
#include "ring_stress.hpp"
#include "scene_run.hpp"

namespace verification {
namespace spinning_disk_test {

using mpm::kPi;
constexpr double kRate = 2.0 * kPi;                // [rad/s]
const SteadyDisk kDisk{1000.0, kRate, 0.3 / 0.7};  // numbers of the scene; n above

double angular_momentum(const mpm::Simulation& simulation) {
  const std::vector<double> x = field(simulation, "x"), z = field(simulation, "z");
  const std::vector<double> vx = field(simulation, "vx"), vz = field(simulation, "vz");
  const std::vector<double> mass = field(simulation, "mass");
  double sum = 0.0;
  for (std::size_t p = 0; p < x.size(); ++p) sum += mass[p] * (z[p] * vx[p] - x[p] * vz[p]);
  return sum;
}

struct Turn {
  Numbers time, momentum;    // [s], angular momentum over that of the start
  double change = 0.0;       // change of angular momentum in the turn [%]
  double most_energy = 0.0;  // largest kinetic + elastic over that of the start
  double linear = 0.0;       // largest linear momentum over sum of m |v|
  RingStress stress;
};

Turn spin(const std::vector<std::string>& overrides) {
  mpm::Simulation simulation = start("spinning_disk", overrides);
  const double momentum = angular_momentum(simulation), energy = simulation.state().energy.total();
  Turn turn;
  while (seconds(simulation) < 1.0 - 1e-9) {
    simulation.advance();
    const mpm::SolverState state = simulation.state();
    turn.time.push_back(seconds(simulation));
    turn.momentum.push_back(angular_momentum(simulation) / momentum);
    turn.most_energy = std::max(turn.most_energy, state.energy.total() / energy);
    turn.linear = std::max(turn.linear, state.audit.residual);
    turn.stress.add(simulation);
  }
  turn.change = 100.0 * (turn.momentum.back() - 1.0);
  return turn;
}

double largest(const std::vector<Turn>& turns) {
  double change = 0.0;
  for (const Turn& turn : turns) change = std::max(change, std::abs(turn.change));
  return change;
}

TEST(SpinningDisk, AngularMomentumOfATurn) {
  Page page("conservation", "spinning_disk", "A disk that spins freely");
  page.problem(
          "A disk of radius R = 1 m spins about its centre in free space with ω = 2π rad/s: a turn a second. "
          "Neo-Hookean, "
          "E = 1.857 MPa, Poisson's ratio 0.3, density 1000 kg/m³, plane strain; its rim moves with an eighth of the "
          "wave "
          "speed. It starts unstrained, so that it also swings along its radius. 20 and 40 cells across; transfer "
          "FLIP.")
      .exact(
          "The angular momentum is constant. The mean stress over a turn is σr = (3 + n)s(R² - r²), σθ = s[(3 + n)R² "
          "- (1 + 3n)r²], with n = ν/(1 - ν) and s = ρω²/8, for small strain; the mean of σr + σθ over the disk is "
          "ρω²R²/2.",
          "conservation; equilibrium and compatibility of a rotating disk")
      .meaning(
          "FLIP does not conserve angular momentum: particles move with the velocity of the grid, not with their "
          "own. The change is of the order of a percent a turn, of either sign, larger in a stiffer disk, and does "
          "not fall with the cell or the step alone. A part of PIC removes some in every step. USAVG conserves the "
          "energy; USF adds energy to the disk's vibrations. With one term of the exponential instead of two the "
          "rotating disk swells, which shows as energy.")
      .scene("spinning_disk");
  const Turn usavg = spin({}), usf = spin({"method.update=usf"});
  const Turn fine = spin({"grid.cell=0.05"}), fine_usf = spin({"grid.cell=0.05", "method.update=usf"});
  const Turn small_step = spin({"time.cfl=0.25"}), stiff = spin({"materials.rubber.young=7.43 MPa"});
  const Turn one_term = spin({"method.gradient_terms=1"});
  const Turn one_term_usf = spin({"method.gradient_terms=1", "method.update=usf"});
  const Turn damped = spin({"method.transfer={flip: 0.99}"});

  const std::string change = "change of angular momentum in a turn, ";
  page.report(change + "USAVG, 20 cells across", usavg.change, "%");
  page.report(change + "USAVG, 40 cells", fine.change, "%");
  page.report(change + "USF, 20 cells", usf.change, "%");
  page.report(change + "USF, 40 cells", fine_usf.change, "%");
  page.report(change + "USAVG, 20 cells, half the time step", small_step.change, "%");
  page.report(change + "USAVG, 20 cells, four times as stiff", stiff.change, "%");
  page.report(change + "USAVG, 20 cells, gradient_terms 1", one_term.change, "%");
  page.report(change + "USF, 20 cells, gradient_terms 1", one_term_usf.change, "%");
  page.report(change + "USAVG, 20 cells, FLIP 0.99", damped.change, "%");
  // An independent code lost 5.5 % at 20 cells across.
  page.below("largest change of these, FLIP", largest({usavg, fine, usf, fine_usf, small_step, stiff}), 5.5, "%");
  // Round-off, as in every run.
  page.below("linear momentum, USAVG, 20 cells", usavg.linear, 1e-10, "of the sum of mass times speed");
  // The same limit as for colliding disks.
  page.below("growth of the energy, USAVG, 20 cells", 100.0 * (usavg.most_energy - 1.0), 0.1, "%");
  page.below("growth of the energy, USAVG, 40 cells", 100.0 * (fine.most_energy - 1.0), 0.1, "%");
  page.report("growth of the energy, USF, 20 cells", 100.0 * (usf.most_energy - 1.0), "%");
  page.report("growth of the energy, USF, 40 cells", 100.0 * (fine_usf.most_energy - 1.0), "%");
  page.report("growth of the energy, USAVG, 20 cells, gradient_terms 1", 100.0 * (one_term.most_energy - 1.0), "%");
  // The virial theorem: half of rho omega^2 R^2. 3 %: the strain, rho omega^2 R^2 / E = 2 %, and the lattice's area,
  // 0.6 %.
  page.near("mean of σr + σθ, USAVG, 20 cells", usavg.stress.mean_sum(), 4e-3 * kDisk.scale(), 0.03, "kPa");
  page.near("mean of σr + σθ, USAVG, 40 cells", fine.stress.mean_sum(), 4e-3 * kDisk.scale(), 0.03, "kPa");
  page.report("largest error of a ring's stress, USAVG, 20 cells", usavg.stress.error(kDisk), "% of the centre's");
  page.report("largest error of a ring's stress, USAVG, 40 cells", fine.stress.error(kDisk), "% of the centre's");

  page.figure()
      .panel("Angular momentum", "time [s]", "over the start")
      .exact("exact", {0.0, 1.0}, {1.0, 1.0})
      .line("USAVG, 20 cells across", usavg.time, usavg.momentum)
      .line("USAVG, 40 cells", fine.time, fine.momentum)
      .line("USF, 20 cells", usf.time, usf.momentum)
      .line("USAVG, 20 cells, four times as stiff", stiff.time, stiff.momentum);
  Numbers radius, radial, hoop;
  for (int i = 0; i <= 40; ++i) {
    radius.push_back(i / 40.0);
    radial.push_back(kDisk.radial(radius.back()));
    hoop.push_back(kDisk.hoop(radius.back()));
  }
  page.figure()
      .panel("Stress, mean over the turn and over rings", "radius [m]", "stress [kPa]")
      .exact("σr, exact", radius, radial)
      .exact("σθ, exact", radius, hoop)
      .points("σr, USAVG, 20 cells across", usavg.stress.radius(), usavg.stress.radial())
      .points("σθ, USAVG, 20 cells across", usavg.stress.radius(), usavg.stress.hoop())
      .points("σr, USAVG, 40 cells", fine.stress.radius(), fine.stress.radial())
      .points("σθ, USAVG, 40 cells", fine.stress.radius(), fine.stress.hoop());
}

}  // namespace spinning_disk_test
}  // namespace verification
