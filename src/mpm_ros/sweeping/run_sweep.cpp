#include "mpm_ros/sweeping/run_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <list>
#include <thread>

#include "mpm/advice/memory.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm/simulation/threads.hpp"
#include "mpm/sweep/plan.hpp"
#include "mpm_ros/message/progress_bar.hpp"
#include "mpm_ros/sweep/sweep_table.hpp"
#include "mpm_ros/sweeping/sweep_layout.hpp"
#include "mpm_ros/sweeping/sweep_run.hpp"

namespace mpm_ros {
namespace {

/// Between two looks at the processes.
constexpr std::chrono::milliseconds kLook{3};
/// Part of the memory that runs may take, and what a run takes over its particles' least: outputs, the grid's spare
/// nodes.
constexpr double kMemoryPart = 0.8, kMemoryTimes = 1.5;
constexpr double kProgramMemory = 64e6;  ///< memory of a process without particles [bytes]
constexpr int kMostTold = 5;             ///< failed runs that the end of a sweep names

/// As many runs at once as cores and memory carry.
int jobs_of(const RunSweepOptions& options, double memory) {
  if (options.jobs > 0) return options.jobs;
  const double carried = kMemoryPart * mpm::usable_memory() / (kProgramMemory + kMemoryTimes * memory);
  return std::max(1,
                  static_cast<int>(std::min(carried, static_cast<double>(mpm::machine_threads() / options.threads))));
}

class Sweep {
 public:
  Sweep(const Study& study, const RunSweepOptions& options, std::ostream& err)
      : study_(study),
        plan_(mpm::sweep::read_plan(study.plan())),
        options_{options.program, options.threads, options.isa},
        err_(err) {}

  /// Starts a run unless it has a result, or another process holds it. True when it was started.
  bool start(int run) {
    std::optional<FileLock> lock = FileLock::try_take(study_.of_run(run, "lock"));
    if (!lock) {
      ++held_;
      return false;
    }
    if (study_.result(run).final()) return false;
    running_.emplace_back(study_, plan_, run, std::move(*lock), options_);
    return true;
  }

  /// Takes the results of runs that have ended. @throws SweepError that names the run
  void look(ProgressBar& progress) {
    for (auto run = running_.begin(); run != running_.end();) {
      std::optional<RunResult> result;
      try {
        result = run->end();
      } catch (const SweepError& error) {
        throw SweepError(fmt::format("run {}: {}", run->number(), error.what()));
      }
      if (!result) {
        ++run;
        continue;
      }
      if (result->state != RunState::done) {
        progress.clear();
        err_ << fmt::format("run {} {}: {}\n", run->number(), state_name(result->state), result->reason);
      }
      run = running_.erase(run);
    }
  }

  const mpm::sweep::Plan& plan() const { return plan_; }
  std::size_t running() const { return running_.size(); }
  int held() const { return held_; }
  /// Kills what runs: it has no result, and is made again.
  void stop() { running_.clear(); }

 private:
  const Study& study_;
  const mpm::sweep::Plan plan_;
  const SweepRunOptions options_;
  std::ostream& err_;
  std::list<SweepRun> running_;
  int held_ = 0;
};

void wait() { std::this_thread::sleep_for(kLook); }

int count_final(const Study& study, int runs) {
  int count = 0;
  for (int run = 1; run <= runs; ++run) count += study.result(run).final() ? 1 : 0;
  return count;
}

/// "57 of 200 runs have a result, which stays"
std::string kept(const Study& study, int runs) {
  return fmt::format("{} of {} runs have a result, which stays; the same command goes on", count_final(study, runs),
                     runs);
}

/// Writes what has come of all runs into sweep.csv and to the user.
RunSweepResult tell(const Study& study, int held, std::ostream& out) {
  const SweepTable table = read_sweep(study);
  write_sweep(table, study.table());
  out << fmt::format("{} runs: {}; table in {}\n", table.runs(), table.counts(), study.table());
  int told = 0;
  for (int run = 1; run <= table.runs() && table.failed > 0; ++run) {
    const RunResult result = study.result(run);
    if (result.state != RunState::failed || ++told > kMostTold) continue;
    out << fmt::format("  run {} failed: {}\n", run, result.reason);
  }
  if (told > kMostTold) out << fmt::format("  and {} more\n", told - kMostTold);
  if (held > 0 && table.open > 0) out << "  open ones are under way in another process\n";
  if (table.done == table.runs()) return RunSweepResult::done;
  return table.done + table.failed == table.runs() ? RunSweepResult::some_failed : RunSweepResult::not_all;
}

RunSweepResult run_all(const RunSweepOptions& options, std::ostream& out, std::ostream& err, bool bar,
                       const std::function<bool()>& stop_requested) {
  const Study study = study_of(options.plan, options.out);
  ProgressBar checking(err, bar);
  const LaidOut laid_out = lay_out(options.plan, study, [&](double part) {
    checking.show(part, [] { return "reading the scenes"; });
    return stop_requested();
  });
  checking.clear();
  if (!laid_out.has_metrics) {
    err << "warning: the scene has no metrics, so the table of the sweep has no column of results; add some, such as\n"
           "metrics: {drag: {mean: force_x, of: TOOL}}\n";
  }
  if (options.jobs == 0) {
    out << fmt::format("{} runs laid out in {}\n", laid_out.runs, study.folder());
    return RunSweepResult::done;
  }
  const auto jobs = static_cast<std::size_t>(jobs_of(options, laid_out.memory));
  const int before = count_final(study, laid_out.runs);
  err << fmt::format("{} runs in {}, {} at once{}\n", laid_out.runs, study.folder(), jobs,
                     before > 0 ? fmt::format("; {} have a result already", before) : "");
  Sweep sweep(study, options, err);
  ProgressBar progress(err, bar);
  int next = 1;
  try {
    while (next <= laid_out.runs || sweep.running() > 0) {
      if (stop_requested()) {
        sweep.stop();
        progress.clear();
        err << fmt::format("run_scene: stopped; {}\n", kept(study, laid_out.runs));
        tell(study, 0, out);
        return RunSweepResult::not_all;
      }
      while (next <= laid_out.runs && sweep.running() < jobs) sweep.start(next++);
      sweep.look(progress);
      const int ended = next - 1 - static_cast<int>(sweep.running());
      progress.show(static_cast<double>(ended) / laid_out.runs,
                    [&] { return fmt::format("{} of {} runs", ended, laid_out.runs); });
      if (sweep.running() > 0) wait();
    }
  } catch (const SweepError& error) {
    sweep.stop();
    progress.clear();
    err << fmt::format("run_scene: {}; {}\n", error.what(), kept(study, laid_out.runs));
    return RunSweepResult::not_all;
  }
  progress.clear();
  return tell(study, sweep.held(), out);
}

RunSweepResult run_one(const RunSweepOptions& options, std::ostream& out, std::ostream& err, bool bar,
                       const std::function<bool()>& stop_requested) {
  const Study study = study_of(options.plan, options.out);
  if (!study.there()) {
    throw SweepError(fmt::format("--only {}: there is no study in {}; lay it out first: --sweep {} --jobs 0",
                                 options.only, study.folder(), options.plan));
  }
  Sweep sweep(study, options, err);
  if (const int runs = sweep.plan().runs(); options.only > runs)
    throw SweepError(fmt::format("--only {}: the study {} has {} runs", options.only, study.folder(), runs));
  ProgressBar progress(err, bar);
  try {
    sweep.start(options.only);
    while (sweep.running() > 0) {
      if (stop_requested()) {
        sweep.stop();
        err << fmt::format("run_scene: stopped; run {} has no result\n", options.only);
        return RunSweepResult::not_all;
      }
      wait();
      sweep.look(progress);
    }
  } catch (const SweepError& error) {
    sweep.stop();
    err << fmt::format("run_scene: {}; it has no result, and the same command makes it again\n", error.what());
    return RunSweepResult::not_all;
  }
  if (sweep.held() > 0) {
    err << fmt::format("run_scene: run {} is under way in another process\n", options.only);
    return RunSweepResult::not_all;
  }
  const RunResult result = study.result(options.only);
  out << fmt::format("run {} {}{}{}\n", options.only, state_name(result.state), result.reason.empty() ? "" : ": ",
                     result.reason);
  if (result.state == RunState::done) return RunSweepResult::done;
  return result.state == RunState::failed ? RunSweepResult::some_failed : RunSweepResult::not_all;
}

}  // namespace

RunSweepResult run_sweep(const RunSweepOptions& options, std::ostream& out, std::ostream& err, bool bar,
                         const std::function<bool()>& stop_requested) {
  try {
    return (options.only > 0 ? run_one : run_all)(options, out, err, bar, stop_requested);
  } catch (const mpm::StoppedError&) {
    err << "run_scene: stopped; nothing was run\n";
    return RunSweepResult::not_all;
  } catch (const MachineError& error) {
    err << "run_scene: " << error.what() << "\n";
    return RunSweepResult::not_all;
  } catch (const mpm::Error& error) {
    err << "run_scene: " << error.what() << "\n";
    return RunSweepResult::bad_input;
  }
}

}  // namespace mpm_ros
