// rosrun mpm_ros run_scene SCENE: runs a scene without a ROS master, as fast as possible. Wiring only; see
// mpm_ros/run/run_scene.hpp.
//
// Exit codes: 0 done (or stopped on request), 1 the machine failed (a full disk), 2 bad input, 3 the physics failed, or
// a recording that was run again ended in another state.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <new>

#include "mpm/sections/all_keys.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm_devices/find_card.hpp"
#include "mpm_ranks/make_ranks.hpp"
#include "mpm_robots/robots.hpp"
#include "mpm_ros/node/exit_watchdog.hpp"
#include "mpm_ros/run/run_scene.hpp"
#include "mpm_ros/run/stop_signals.hpp"
#include "mpm_ros/sweeping/run_sweep.hpp"
#include "mpm_ros/sweeping/shared_cores.hpp"

namespace {

/// Runs the scene on all ranks that the program was started as.
int run(mpm_ros::RunSceneOptions options) {
  options.ranks = mpm::make_ranks();
  if (options.ranks && options.threads == 0) options.threads = mpm::threads_of_rank(*options.ranks);
  // Until the run begins, which is when it is first asked whether it is to stop, nothing is written yet.
  static mpm_ros::ExitWatchdog* watchdog = options.ranks ? nullptr : new mpm_ros::ExitWatchdog;  // lasts as its thread
  const auto stop_requested = [] {
    if (watchdog != nullptr) watchdog->must_finish();
    return mpm_ros::stop_requested();
  };
  try {
    const mpm_ros::RunSceneResult result =
        mpm_ros::run_scene(options, std::cout, std::cerr, isatty(STDERR_FILENO) != 0, stop_requested);
    const std::string used_up = mpm_ros::used_up();
    if (used_up.empty() || result != mpm_ros::RunSceneResult::done) return static_cast<int>(result);
    std::cerr << "run_scene: " << used_up << "\n";
    return static_cast<int>(mpm_ros::RunSceneResult::machine_failed);
  } catch (const std::exception& error) {
    if (!options.ranks) throw;
    return mpm::end_all(*options.ranks, fmt::format("rank {}: run_scene: {}", options.ranks->rank(), error.what()), 1);
  }
}

}  // namespace

int main(int argc, char** argv) {
  mpm::provide_robots();
  mpm_ros::spin_only_briefly(argv);
  mpm_ros::RunSceneOptions options;
  options.device.find = mpm::find_card;
  bool list = false;
  bool explain = false;
  std::string keys;
  CLI::App app("Runs a scene without a ROS master, as fast as possible.");
  auto* scene = app.add_option("SCENE", options.scene, "a shipped scene's name (--list), or a path to a YAML file");
  app.add_option("--bag", options.bag, "record everything to this bag; auto: a new name in this folder");
  app.add_option("--bag-compression", options.bag_compression, "compression of the bag: none, lz4 or bz2")
      ->check(CLI::IsMember({"none", "lz4", "bz2"}));
  app.add_option("--bag-split", options.bag_split,
                 "begin another part of the bag at this size (\"500 MB\") or simulated time (\"10 s\")");
  app.add_option("--from-bag", options.from_bag,
                 "run what this bag recorded again, its scene and its commands, and compare the state at its end");
  app.add_option("--out", options.out,
                 "make a new folder in this one, with bag, tables, ParaView files, summary and scene");
  app.add_option("--vtk", options.vtk, "write files for ParaView to this folder (open run.pvd)");
  app.add_option("--csv", options.csv, "write tables (contact forces, bodies, solver state, particles) to this folder");
  app.add_option("--summary", options.summary, "write the run's numbers as JSON to this file");
  app.add_option("--terrain", options.terrain,
                 "write the heights of the ground at the end to this GeoTIFF, which another scene can begin with");
  app.add_option("--checkpoint", options.checkpoint,
                 "save the run to this HDF5 file at its end, or when it is stopped");
  app.add_option("--checkpoint-every", options.checkpoint_every,
                 "save it also each time this simulated time has passed, in seconds or with a unit");
  app.add_option("--resume", options.resume, "continue bit for bit from this checkpoint, which contains its scene");
  app.add_option("--threads", options.threads, "threads; 0: as many as the machine has")->check(CLI::Range(0, 1024));
  app.add_option("--isa", options.isa,
                 "instruction set of the kernels: plain, avx2 or avx512; auto: the widest one available");
  app.add_option(
         "--device", options.device.word,
         "processor that takes the steps: cpu, this one; gpu, a graphics processor; auto: that where there is one "
         "and the scene can run on it, else this one")
      ->capture_default_str();
  app.add_option("--end", options.end, "stop at this time, in seconds or with a unit (\"20 ms\")");
  app.add_option("--set", options.set, "change the scene: key.path=value, as in grid.cell=0.02; may be repeated")
      ->allow_extra_args(false);
  mpm_ros::RunSweepOptions sweep;
  auto* plan =
      app.add_option("--sweep", sweep.plan,
                     "run a plan of many runs (doc/sweeps.md), or go on with the folder of one; --out is that folder");
  auto* jobs = app.add_option("--jobs", sweep.jobs,
                              "runs of a sweep at once; 0: lay it out only; without it as many as the machine carries")
                   ->check(CLI::Range(0, 1024))
                   ->needs(plan);
  app.add_option("--only", sweep.only, "make this run of a sweep that is laid out, alone")
      ->check(CLI::Range(1, 1000000))
      ->needs(plan)
      ->excludes(jobs);
  app.add_flag("--profile", options.profile,
               "tell at the end where the wall time went: seconds, share and calls by name");
  app.add_flag("--list", list, "list the shipped scenes, and exit");
  auto* keys_option =
      app.add_option(
             "--keys", keys,
             "print the keys of a section of scenes, such as sleep, of a law, or of all that have a table, and exit")
          ->expected(0, 1);
  app.add_flag("--explain", explain, "report what was chosen for the scene and why, and exit");
  try {
    app.parse(argc, argv);
    for (const CLI::Option* option : app.get_options()) {
      const std::string name = option->get_name();
      const bool goes = name == "--sweep" || name == "--jobs" || name == "--only" || name == "--out" ||
                        name == "--threads" || name == "--isa" || name == "--help";
      if (!plan->empty() && !option->empty() && !goes)
        throw CLI::ValidationError(name, "not with --sweep: the plan says what is set and what is recorded");
    }
    if (!list && keys_option->empty() && plan->empty() && scene->empty() && options.from_bag.empty() &&
        options.resume.empty())
      throw CLI::RequiredError("SCENE (--list names those that are shipped)");
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  mpm_ros::catch_stop_signals();
  try {
    if (list) {
      mpm_ros::list_scenes(std::cout);
      return 0;
    }
    if (!keys_option->empty()) {
      std::cout << mpm::keys_text(keys);
      return 0;
    }
    if (!sweep.plan.empty()) {
      mpm::forget_launcher();  // several sweeps may share a plan, as tasks of Slurm
      sweep.program = std::filesystem::read_symlink("/proc/self/exe").string();
      sweep.out = options.out;
      sweep.isa = options.isa;
      if (options.threads > 0) sweep.threads = options.threads;
      return static_cast<int>(
          mpm_ros::run_sweep(sweep, std::cout, std::cerr, isatty(STDERR_FILENO) != 0, mpm_ros::stop_requested));
    }
    if (explain) {
      mpm::refuse_ranks("--explain");
      static mpm_ros::ExitWatchdog watchdog;
      mpm_ros::explain_scene(options, std::cout);
      return 0;
    }
    return run(options);
  } catch (const mpm::StoppedError& error) {
    std::cerr << error.what() << "\n";
    return 0;
  } catch (const std::bad_alloc&) {
    std::cerr << "run_scene: there is not enough memory for this scene; use a larger grid.cell or a smaller scene\n";
    return 1;
  } catch (const std::exception& error) {
    std::cerr << "run_scene: " << error.what() << "\n";
    return 2;
  }
}
