// The limits of this machine, and the share of them that a step of the solver reaches: multiply-adds and the bandwidth
// of memory, measured in the same run as the steps. roofline --json FILE writes everything for scripts/benchmark.
#include <fmt/format.h>
#include <omp.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ctime>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "counted_work.hpp"
#include "loops.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace roofline {
namespace {

using nlohmann::json;

/// Present time [s]. For one thread this is the processor time of the process, which other programs on the machine
/// disturb less; for more threads it is the wall clock.
double now(int threads) {
  timespec t{};
  clock_gettime(threads == 1 ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Duration of `work(thread)` on all threads [s], from the common start to the end of the last thread.
double seconds(int threads, const std::function<void(int)>& work) {
  double start = 0.0;
#pragma omp parallel num_threads(threads)
  {
#pragma omp barrier
#pragma omp master
    start = now(threads);
#pragma omp barrier
    work(omp_get_thread_num());
  }
  return now(threads) - start;
}

/// Best rate of several tries, each long enough to time: other programs can only lower it.
double best_rate(int threads, double least, const std::function<double(int, long)>& count_of) {
  constexpr int kTries = 5;
  double best = 0.0;
  long turns = 1;
  for (int tries = 0; tries < kTries;) {
    std::vector<double> counts(threads);
    const double time = seconds(threads, [&](int t) { counts[t] = count_of(t, turns); });
    if (time < least) {
      turns *= time < 0.1 * least ? 8 : 2;
      continue;
    }
    double total = 0.0;
    for (const double count : counts) total += count;
    best = std::max(best, total / time);
    ++tries;
  }
  return best;
}

/// Bytes a second of the triad, with `bytes` in its three arrays together on each thread.
double triad_rate(const Loops& loops, int threads, double bytes, double least) {
  const auto n = static_cast<std::size_t>(bytes / (3 * sizeof(double)));
  std::vector<std::vector<double>> arrays(threads);
  seconds(threads, [&](int t) { arrays[t].assign(3 * n + 64, 1.0); });  // each thread fills its own: near memory
  return best_rate(threads, least, [&](int t, long turns) {
    double* a = arrays[t].data();
    loops.triad(a, a + n + 16, a + 2 * n + 32, n, turns);
    return 24.0 * static_cast<double>(n) * static_cast<double>(turns);
  });
}

struct Case {
  const char* scene;
  const char* update;
  int dim;
};

/// Particle-steps a second of a shipped scene, sorting and step control included.
double step_rate(const Case& which, int threads, double least) {
  const mpm::Scene scene = mpm::load_scene(which.scene, {std::string("method.update=") + which.update});
  mpm::Simulation simulation(mpm::build(scene), {threads});
  simulation.advance();  // the first period touches memory for the first time
  const auto steps = simulation.state().step.steps;
  const double start = now(threads);
  do {
    simulation.advance();
  } while (now(threads) - start < least);
  const double time = now(threads) - start;
  return static_cast<double>(simulation.state().step.steps - steps) * static_cast<double>(simulation.particles()) /
         time;
}

json measure_machine(const std::vector<int>& threads, double least) {
  json machine = json::array();
  for (const Loops* loops : {&kPlain, &kAvx2, &kAvx512}) {
    if (!loops->available()) continue;
    for (const int count : threads) {
      json row = {{"isa", loops->isa}, {"threads", count}};
      row["double"] = best_rate(count, least, [&](int, long turns) { return loops->multiply_add_double(turns); });
      row["single"] = best_rate(count, least, [&](int, long turns) { return loops->multiply_add_single(turns); });
      // On each thread: half of the first and of the second cache of usual machines, then more than the last cache.
      row["triad_l1"] = triad_rate(*loops, count, 24e3, least);
      row["triad_l2"] = triad_rate(*loops, count, 768e3, least);
      row["triad_memory"] = triad_rate(*loops, count, 600e6 / count, least);
      fmt::print(
          "{:<7} {} threads   {:6.1f} double {:6.1f} single G multiply-adds/s   {:6.1f} L1 {:6.1f} L2 {:6.1f} "
          "memory GB/s\n",
          loops->isa, count, 1e-9 * row["double"].get<double>(), 1e-9 * row["single"].get<double>(),
          1e-9 * row["triad_l1"].get<double>(), 1e-9 * row["triad_l2"].get<double>(),
          1e-9 * row["triad_memory"].get<double>());
      machine.push_back(row);
    }
  }
  return machine;
}

/// The counts by kernel, and which kernels make a step, for each geometry.
json counted_json() {
  json counted;
  for (const int dim : {2, 3}) {
    json& geometry = counted[dim == 3 ? "solid" : "plane_strain"];
    for (const Work& work : counted_kernels(dim)) {
      geometry["kernels"][work.kernel] = {{"multiply_adds", work.multiply_adds},
                                          {"bytes", {{"double", work.bytes(8)}, {"single", work.bytes(4)}}}};
    }
    geometry["steps"] = {{"usf", kernels_of_step(false)}, {"usavg", kernels_of_step(true)}};
  }
  return counted;
}

json measure_steps(const json& machine, const std::vector<int>& threads, double least) {
  json steps = json::array();
  for (const Case& which : {Case{"speed_block_3d", "usf", 3}, Case{"speed_block_3d", "usavg", 3},
                            Case{"speed_block_2d", "usf", 2}, Case{"speed_block_2d", "usavg", 2}}) {
    double multiply_adds = 0.0, bytes = 0.0;
    for (const Work& work : counted_step(which.dim, which.update == std::string("usavg"))) {
      multiply_adds += work.multiply_adds;
      bytes += work.bytes(sizeof(double));
    }
    for (const int count : threads) {
      const double rate = step_rate(which, count, 5.0 * least);
      // The widest registers of the machine set the limit, whichever the kernels use.
      json limit;
      for (const json& row : machine) {
        if (row["threads"] == count) limit = row;
      }
      const double arithmetic = rate * multiply_adds / limit["double"].get<double>();
      const double bandwidth = rate * bytes / limit["triad_memory"].get<double>();
      fmt::print(
          "{} {:<5} {} threads   {:6.2f} M particle-steps/s   {:4.1f} % of arithmetic ({:.0f} multiply-adds), "
          "{:4.1f} % of memory's bandwidth ({:.0f} bytes)\n",
          which.scene, which.update, count, 1e-6 * rate, 100.0 * arithmetic, multiply_adds, 100.0 * bandwidth, bytes);
      steps.push_back({{"scene", which.scene},
                       {"update", which.update},
                       {"threads", count},
                       {"particle_steps_per_second", rate},
                       {"multiply_adds", multiply_adds},
                       {"bytes", bytes},
                       {"limit_isa", limit["isa"]},
                       {"of_arithmetic", arithmetic},
                       {"of_bandwidth", bandwidth}});
    }
  }
  return steps;
}

}  // namespace
}  // namespace roofline

int main(int argc, char** argv) {
  std::string file;
  double least = 0.2;
  CLI::App app("Measures this machine's multiply-adds and bandwidth, and a step's share of them.");
  app.add_option("--json", file, "write everything to this file too");
  app.add_option("--seconds", least, "least time of one try [s]")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  std::vector<int> threads = {1};
  if (omp_get_num_procs() > 1) threads.push_back(2);
  const nlohmann::json machine = roofline::measure_machine(threads, least);
  const nlohmann::json steps = roofline::measure_steps(machine, threads, least);
  if (!file.empty()) {
    const nlohmann::json all = {{"machine", machine}, {"steps", steps}, {"counted", roofline::counted_json()}};
    std::ofstream(file) << all.dump(1) << "\n";
  }
  return 0;
}
