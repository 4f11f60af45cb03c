// Scenes that run_scene runs over several ranks, here threads: what they wrote and said, and what ended them.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "mpm_ranks/make_ranks.hpp"
#include "mpm_ros/run/run_scene.hpp"
#include "test_files.hpp"
#include "thread_communicator.hpp"

namespace mpm_ros::test {

/// Output of a rank, and its result.
struct SaidByRank {
  std::string out, err;
  RunSceneResult result = RunSceneResult::done;
};

/// A plate that presses a strip for 30 ms.
class RunSceneOverRanks : public ::testing::Test {
 protected:
  RunSceneOverRanks()
      : folder_(std::filesystem::temp_directory_path() / ("mpm_run_scene_ranks_test_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
    options_.scene = source_file("test/data/press.yaml");
    options_.set = {"rigid_bodies.plate.motion={velocity: [0, -0.5]}"};
    options_.threads = 1;
    options_.end = "30 ms";
  }
  ~RunSceneOverRanks() override { std::filesystem::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  std::vector<SaidByRank> run(
      int count, const std::function<bool(int)>& stop = [](int) { return false; }) const {
    std::vector<SaidByRank> said(count);
    mpm::run_ranks(count, [&](mpm::Communicator& ranks) {
      RunSceneOptions own = options_;
      own.ranks = {&ranks, [](mpm::Communicator*) {}};
      std::ostringstream out, err;
      SaidByRank& told = said[ranks.rank()];
      told.result = run_scene(own, out, err, false, [&] { return stop(ranks.rank()); });
      told.out = out.str();
      told.err = err.str();
    });
    return said;
  }
  /// Reason that ends all ranks. `code`: with which exit code.
  std::string reason(int count, int* code = nullptr) const {
    try {
      run(count);
    } catch (const mpm::RanksEnded& error) {
      if (code != nullptr) *code = error.code();
      return error.what();
    }
    return "nothing";
  }

  nlohmann::json summary() const {
    std::ifstream file(options_.summary);
    return nlohmann::json::parse(file);
  }

  std::filesystem::path folder_;
  RunSceneOptions options_;
};

}  // namespace mpm_ros::test
