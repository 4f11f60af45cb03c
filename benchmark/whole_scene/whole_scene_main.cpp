// Times one run of a scene: stepping alone, by the wall clock and by the processor time of all threads, which other
// programs on the machine disturb less; and, separately, the report of the run (momentum audit, energies) at each sync
// point. Writes one JSON object to standard output; run_scene --summary has the same numbers except these times.
#include <fmt/format.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <ctime>
#include <iostream>
#include <nlohmann/json.hpp>

#include "mpm/rules/method_text.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace {

/// Time measured by the wall clock and by the processor time of the process [s].
struct Clock {
  double wall = 0.0, processor = 0.0;

  template <class Work>
  void time(Work&& work) {
    const auto wall_start = std::chrono::steady_clock::now();
    const double start = processor_now();
    work();
    processor += processor_now() - start;
    wall += std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_start).count();
  }

 private:
  static double processor_now() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
};

struct Options {
  std::string scene, isa;
  std::vector<std::string> set;
  int threads = 1;
};

nlohmann::ordered_json run(const Options& options) {
  Clock build, stepping, report;
  std::unique_ptr<mpm::Simulation> simulation;
  build.time([&] {
    simulation =
        std::make_unique<mpm::Simulation>(mpm::build(mpm::load_scene(options.scene, options.set)),
                                          mpm::SimulationOptions{options.threads, mpm::choose_isa(options.isa)});
  });
  const auto end = static_cast<std::int64_t>(simulation->definition().time.end * 1e9 + 0.5);
  mpm::SolverState state;
  int reports = 0;
  for (; simulation->time() < end; ++reports) {
    stepping.time([&] { simulation->advance(); });
    report.time([&] { state = simulation->state(); });
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const mpm::SimulationDefinition& definition = simulation->definition();
  const bool planar = definition.geometry == mpm::GeometryKind::plane_strain;
  return {{"scene", options.scene},
          {"method",
           {{"geometry", planar ? "plane_strain" : "solid"},
            {"update", mpm::update_name(definition.method.update)},
            {"precision", mpm::precision_name(definition.method.precision)},
            {"isa", simulation->isa()}}},
          {"particles", state.particles},
          {"steps", state.step.steps},
          {"threads", simulation->threads()},
          {"load_seconds", build.wall},
          {"wall_seconds", stepping.wall},
          {"processor_seconds", stepping.processor},
          {"reports", reports},
          {"report_processor_seconds", report.processor},
          {"peak_memory_bytes", 1024.0 * static_cast<double>(usage.ru_maxrss)},
          {"state_hash", fmt::format("{:016x}", simulation->state_hash())}};
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Times one run of a scene and prints what it found as JSON.");
  app.add_option("SCENE", options.scene, "a shipped scene's name, or a path to a YAML file")->required();
  app.add_option("--set", options.set, "change the scene: key.path=value")->allow_extra_args(false);
  app.add_option("--threads", options.threads, "threads")->check(CLI::PositiveNumber);
  app.add_option("--isa", options.isa, "instruction set of the kernels: plain, avx2 or avx512");
  CLI11_PARSE(app, argc, argv);
  try {
    std::cout << run(options).dump(1) << "\n";
    return 0;
  } catch (const mpm::Error& error) {
    std::cerr << "whole_scene: " << error.what() << "\n";
    return 2;
  }
}
