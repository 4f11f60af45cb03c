// Begin and end of contact with a rigid plane: the gap at which a slow block is first felt, for positions of the plane
// between the nodes and for angles to the grid; and the release, at which the force ends at once and never pulls.
#include <algorithm>

#include "rigid_contact_cases.hpp"

namespace verification {
namespace onset_contact_test {

constexpr int kThreads = 1;
constexpr double kCell = 0.025, kSide = 0.1, kYoung = 1e6;

/// A block of 4 x 4 cells whose lower side is `above` the plate's surface, along the normal [m].
mpm::SimulationDefinition block_above(const ContactMethod& method, const Slope& slope, double above, double sync) {
  mpm::SimulationDefinition d = rubber_scene(method, kCell, kYoung, sync);
  const double spacing = 0.5 * kCell;
  std::vector<mpm::Vec3> places = turned_lattice(slope, kSide, kSide, spacing);
  for (mpm::Vec3& place : places) place += above * slope.normal();
  add_particles(d, "block", places, spacing * spacing);
  d.rigid_bodies = {plate(slope, 0.0, 1.0, 0.2)};
  return d;
}

/// Lays the grid so that nodes lie `off` cells from the plate along the normal.
void lay_grid(mpm::SimulationDefinition& d, const Slope& slope, double off) {
  const mpm::Vec3 around = mpm::Vec3(0.4, 0.0, 0.4);
  const mpm::Vec3 low = kCell * (-around / kCell).array().floor().matrix();
  set_domain(d, low + off * kCell * slope.normal(), around);
}

/// Gap between the block's lower side and the plate [cells] when the force first exceeds a thousandth of the force that
/// stops the block.
double gap_at_onset(const ContactMethod& method, const Slope& slope, double off) {
  const double speed = 0.1, start = 2.0 * kCell;
  mpm::SimulationDefinition d = block_above(method, slope, start, 5e-4);
  lay_grid(d, slope, off);
  for (mpm::Vec3& v : d.bodies[0].velocities) v = -speed * slope.normal();
  mpm::Simulation simulation(d, {kThreads});
  const double middle = mean_along(simulation, "", slope.normal()) - start;  // for a block that lies on the plate
  // The stopping force is the pressure rho c v of a plane wave, on the block's whole side.
  const double wave = std::sqrt(kYoung * 0.7 / (1.3 * 0.4) / 1000.0), stopping = 1000.0 * wave * speed * kSide;
  double gap = start;
  while (seconds(simulation) < 4.0 * kCell / speed) {
    simulation.advance();
    gap = mean_along(simulation, "", slope.normal()) - middle;
    if (simulation.take_contact(0).peak.force.norm() > 1e-3 * stopping) return gap / kCell;
  }
  ADD_FAILURE() << "the block was never felt";
  return gap / kCell;
}

TEST(RigidContact, BlockIsFeltWhereItMeetsThePlane) {
  Page page("contact", "rigid_onset", "The gap at which contact begins");
  page.problem(
          "A block of 0.1 m (4 cells, E = 1 MPa) comes slowly, at 0.1 m/s, to a smooth plane that lies 0 to 3/4 of a "
          "cell from the nodes, at 0, 30 and 45 degrees to the grid. Gap at which force is a thousandth of rho c v.")
      .exact("0", "geometry");
  for (const ContactMethod& method : contact_methods()) {
    for (const double degrees : {0.0, 30.0, 45.0}) {
      Numbers gaps;
      for (const double off : {0.0, 0.25, 0.5, 0.75}) {
        gaps.push_back(gap_at_onset(method, {degrees * kPi / 180.0}, off));
        const std::string name = fmt::format("{}, {:g} degrees, nodes off by {:g}", method.name, degrees, off);
        page.report("gap, " + name, gaps.back(), "cells");
        say("gap, " + name, gaps.back(), 0.0, "cells");
      }
      const auto [least, most] = std::minmax_element(gaps.begin(), gaps.end());
      // Nodes in the plate are constrained as soon as they have mass. A particle gives mass to nodes up to 1.25 cells
      // from its centre, which lies a quarter of a cell inside the face: up to a cell early along an axis. At 45
      // degrees the reach is longer by the square root of two.
      const double early = method.at_nodes ? std::sqrt(2.0) : 0.1;
      page.below(fmt::format("largest gap, {}, {:g} degrees", method.name, degrees), *most, early, "cells");
      page.above(fmt::format("smallest gap, {}, {:g} degrees", method.name, degrees), *least, -0.1, "cells");
    }
  }
}

TEST(RigidContact, ForceEndsWithContactAndNeverPulls) {
  Page page("contact", "rigid_release", "Force when a tool goes away");
  page.problem(
          "A block of 0.1 m between a plate and a plane is compressed by 2 %, held, and released by the plane at 10 "
          "m/s, faster than it springs back. Force on the plane step by step, at 0 and 30 degrees to the grid.")
      .exact("0 from the step on after the plane has left the block, and never a pull", "contact without adhesion");
  for (const ContactMethod& method : contact_methods()) {
    for (const double degrees : {0.0, 30.0}) {
      const Slope slope{degrees * kPi / 180.0};
      const double step = 1e-4;
      mpm::SimulationDefinition d = block_above(method, slope, 0.0, step);
      lay_grid(d, slope, 0.3);
      d.time.step = step;
      d.method.damping.pic = mpm::Function::parse("0.05*(t<0.1)");
      mpm::RigidBodyDefinition ram = plate(slope, 0.0, 1.0, 0.2);
      ram.name = "ram";
      ram.pose.position = (kSide + 0.1) * slope.normal();
      d.rigid_bodies.push_back(ram);
      mpm::Simulation simulation(d, {kThreads});
      const auto push = [&](double speed) {
        simulation.command_velocity(1, {speed * slope.normal(), mpm::Vec3::Zero()});
      };
      double most = 0.0, pull = 0.0;
      const auto force = [&] {
        simulation.advance();
        const double f = simulation.take_contact(1).mean.force.dot(slope.normal());
        most = std::max(most, f);
        pull = std::min(pull, f);
        return f;
      };
      push(-0.02 * kSide / 0.05);
      while (seconds(simulation) < 0.05) force();
      push(0.0);
      while (seconds(simulation) < 0.1) force();
      push(10.0);
      int last = -1;
      for (int i = 0; i < 300; ++i) {
        if (force() != 0.0) last = i;
      }
      const std::string name = fmt::format("{}, {:g} degrees", method.name, degrees);
      EXPECT_GT(most, 0.0);
      page.below("largest pull over the largest force, " + name, -pull / most, 0.0, "");
      // The plane moves by 0.04 cells a step, and the block springs back by less: they separate in the first step, 0.
      page.below("last step with force after the plane went, " + name, last, 0.0, "");
      say("largest pull over largest force, " + name, -pull / most, 0.0, "");
      say("last step with force, " + name, last, -1.0, "");
    }
  }
  page.meaning("A surface that goes is not followed by force.");
}

}  // namespace onset_contact_test
}  // namespace verification
