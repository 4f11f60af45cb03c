// Runs that write a checkpoint half way, and runs that go on from it, each on some number of ranks.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>
#include <utility>

#include "mpm/checkpoint/checkpoint.hpp"
#include "over_ranks_run.hpp"

namespace verification {
namespace over_ranks {

/// Its file goes with it. A number of ranks of 1 is one process.
class HalfWay {
 public:
  HalfWay()
      : path_(
            (std::filesystem::temp_directory_path() / ("mpm_half_way_" + std::to_string(getpid()) + ".h5")).string()) {}
  HalfWay(const HalfWay&) = delete;
  HalfWay& operator=(const HalfWay&) = delete;
  ~HalfWay() { std::filesystem::remove(path_); }

  /// Runs half of the steps, writes the checkpoint, and runs the rest.
  Outcome write(const Case& run, int count) const {
    return on(run, count, [&](mpm::Simulation& simulation) {
      run_steps(simulation, run.steps / 2);
      mpm::save_checkpoint(path_, simulation, {});
      run_steps(simulation, run.steps);
    });
  }
  Outcome go_on(const Case& run, int count) const {
    return on(run, count, [&](mpm::Simulation& simulation) {
      mpm::load_checkpoint(path_, simulation, "");
      run_steps(simulation, run.steps);
    });
  }

 private:
  template <class Work>
  static Outcome on(const Case& run, int count, Work&& work) {
    Outcome of_first;
    if (count == 1) {
      mpm::Simulation simulation = start_on(run, nullptr);
      work(simulation);
      return outcome_of(simulation);
    }
    mpm::run_ranks(count, [&](mpm::Communicator& ranks) {
      mpm::Simulation simulation = start_on(run, &ranks);
      work(simulation);
      Outcome own = outcome_of(simulation);
      if (ranks.first()) of_first = std::move(own);
    });
    return of_first;
  }

  std::string path_;
};

}  // namespace over_ranks
}  // namespace verification
