// A program of your own on the solver library, without a node: a controller presses a plate onto foam until the force
// is the wanted one. It is the loop that a robot's program has, in simulated time: read the force, set the velocity,
// advance.
//
// What comes of it is known beforehand. Foam that cannot get wider, under a force F on an area A, has the stress F / A
// and yields by H F / (M A), with its height H and M = E (1 - nu) / ((1 + nu) (1 - 2 nu)): 1000 Pa and 0.9 mm here.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace {

constexpr double kWanted = 20.0;              // force on the plate, upwards [N]
constexpr double kGain = 4e-4;                // velocity for a force that is missing [m/s/N]
constexpr double kSpeed = 5e-3;               // largest speed of the plate [m/s]
constexpr std::int64_t kEnd = 1'500'000'000;  // time is in whole nanoseconds
constexpr std::int64_t kRow = 100'000'000;    // between rows of the table [ns]

void press(const std::string& scene_file) {
  const mpm::Scene scene = mpm::load_scene(scene_file);  // overrides may follow: {"grid.cell=0.005"}
  mpm::Simulation simulation(scene);
  const int plate = simulation.find_body("plate");
  if (plate < 0) throw std::runtime_error(scene_file + ": has no rigid body 'plate'");
  const double start = simulation.bodies().at(plate).pose.position.z();
  std::printf("%zu particles, a step of the loop each %g s\n", static_cast<std::size_t>(simulation.particles()),
              1e-9 * static_cast<double>(simulation.sync_period()));
  std::printf("%8s %10s %14s %10s %14s\n", "time [s]", "force [N]", "speed [mm/s]", "way [mm]", "stress [Pa]");

  std::vector<double> stress;  // of every particle; its memory is used again
  while (simulation.time() < kEnd) {
    const double force = simulation.take_contact(plate).mean.force.z();  // mean since it was taken last
    mpm::Twist twist;
    twist.linear.z() = -std::clamp(kGain * (kWanted - force), -kSpeed, kSpeed);
    simulation.command_velocity(plate, twist);
    simulation.advance();  // to the next sync point

    if (simulation.time() % kRow != 0) continue;
    simulation.particle_field("szz", stress);
    const double mean = std::accumulate(stress.begin(), stress.end(), 0.0) / static_cast<double>(stress.size());
    std::printf("%8.2f %10.3f %14.3f %10.4f %14.2f\n", 1e-9 * static_cast<double>(simulation.time()), force,
                1e3 * twist.linear.z(), 1e3 * (simulation.bodies().at(plate).pose.position.z() - start), mean);
  }
  std::printf("the balance of momentum closes to %.1e\n", simulation.state().audit.residual);
}

}  // namespace

int main(int argc, char** argv) try {
  press(argc > 1 ? argv[1] : "foam.yaml");
  return 0;
} catch (const mpm::PhysicsError& error) {  // the material failed: too fast, too coarse
  std::fprintf(stderr, "press_foam: %s\n", error.what());
  return 3;
} catch (const std::exception& error) {  // bad input: each text says what, where and what to do
  std::fprintf(stderr, "press_foam: %s\n", error.what());
  return 2;
}
