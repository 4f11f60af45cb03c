// Pace of shipped scenes whose steps a device takes: wall time of a step, simulated time over wall time, and the mean
// force on the first tool over the time that is measured, as shipped and with finer cells; the same on all cores of the
// machine beside it where that does not take long. gpu_scenes SCENE FROM END [KEY=VALUE...] measures one from FROM to
// END [s], also on the cores; a list of them where none is given.
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm_gpu/device.hpp"

namespace {

using Clock = std::chrono::steady_clock;

struct Run {
  std::string scene;
  double from, end;  ///< [s]
  std::vector<std::string> changes;
  bool on_cores = true;
};

// A blade that pushes sand as it is shipped, in explicit steps, and with cells of a half and a quarter; a rover's wheel
// on ground that is awake, 1.5 million particles; a tool in a block of 64,000.
const std::vector<Run> kRuns = {{"blade_in_soil", 0.44, 0.6, {}},
                                {"blade_in_soil", 0.44, 0.5, {"method.update=usavg", "sleep=off"}},
                                {"blade_in_soil", 0.44, 0.48, {"grid.cell=0.0175"}, false},
                                {"blade_in_soil", 0.44, 0.46, {"grid.cell=0.00875"}, false},
                                {"rover_wheel_terrain", 0.0, 0.05, {"sleep=off"}, false},
                                {"speed_tool_3d", 0.0, 0.001, {}}};

void measure(const Run& run, bool on_device) {
  mpm::SimulationOptions options;
  if (on_device) options.device = mpm_gpu::device_by(mpm_gpu::Executor());
  mpm::Simulation simulation(mpm::load_scene(run.scene, run.changes), options);
  const auto until = [&](double end) {
    while (1e-9 * static_cast<double>(simulation.time()) < end - 1e-9) simulation.advance();
  };
  until(run.from);
  const bool touches = !simulation.definition().rigid_bodies.empty();
  const mpm::Vec3 before = touches ? simulation.take_contact(0).impulse : mpm::Vec3(mpm::Vec3::Zero());
  const std::uint64_t steps_before = simulation.state().step.steps;
  const double began_at = 1e-9 * static_cast<double>(simulation.time());
  const auto begin = Clock::now();
  until(run.end);
  const double wall = std::chrono::duration<double>(Clock::now() - begin).count();
  const double simulated = 1e-9 * static_cast<double>(simulation.time()) - began_at;
  const auto steps = static_cast<double>(simulation.state().step.steps - steps_before);
  const mpm::Vec3 after = touches ? simulation.take_contact(0).impulse : mpm::Vec3(mpm::Vec3::Zero());
  const mpm::Vec3 force = (after - before) / simulated;
  fmt::print("{:<20} {:<6} {:>9} {:>6.0f} {:>10.3f} {:>10.3g} {:>10.4g} {:>10.4g} {:>10.4g}  {}\n", run.scene,
             on_device ? "device" : "cores", simulation.particles(), steps, 1e3 * wall / steps, simulated / wall,
             force.x(), force.y(), force.z(), fmt::join(run.changes, " "));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<Run> runs = kRuns;
  if (argc > 1 && argc < 4) {
    fmt::print(stderr, "usage: gpu_scenes [SCENE FROM END [KEY=VALUE...]]\n");
    return 2;
  }
  if (argc >= 4) runs = {{argv[1], std::atof(argv[2]), std::atof(argv[3]), {argv + 4, argv + argc}, true}};
  try {
    fmt::print("{:<20} {:<6} {:>9} {:>6} {:>10} {:>10} {:>10} {:>10} {:>10}\n", "scene", "", "particles", "steps",
               "ms a step", "real time", "Fx [N]", "Fy [N]", "Fz [N]");
    for (const Run& run : runs) {
      measure(run, true);
      if (run.on_cores) measure(run, false);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}
