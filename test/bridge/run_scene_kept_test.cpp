// Files that run_scene keeps: those of a run on a full disk, and an existing recording when a run is resumed.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "full_disk.hpp"
#include "mpm/checkpoint/checkpoint.hpp"
#include "mpm_ros/report/report_bag.hpp"
#include "mpm_ros/report/temporary_folder.hpp"
#include "mpm_ros/run/run_scene.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace run_scene_kept_test {

namespace fs = std::filesystem;

class RunSceneKept : public ::testing::Test {
 protected:
  RunSceneKept() {
    options_.scene = data_file("press.yaml");
    options_.threads = 1;
    options_.summary = folder_.file("summary.json");
  }
  RunSceneResult run(const std::function<bool()>& stop = [] { return false; }) {
    out_.str("");
    err_.str("");
    return run_scene(options_, out_, err_, false, stop);
  }
  std::string hash() const {
    std::ifstream file(options_.summary);
    return nlohmann::json::parse(file)["state_hash"];
  }

  const TemporaryFolder folder_;
  RunSceneOptions options_;
  std::ostringstream out_, err_;
};

TEST_F(RunSceneKept, ACheckpointOfARunWhoseRecordFoundNoRoom) {
  // A cloud at each of 501 sync points: about 3 MB.
  options_.set = {"time.end=1", "time.sync=0.002", "output.period=0.002"};
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  const std::string whole = hash();
  options_.bag = folder_.file("run.bag");
  options_.csv = folder_.file("csv");
  options_.checkpoint = folder_.file("run.h5");
  {
    const test::FullDisk disk(2'000'000);
    EXPECT_EQ(run(), RunSceneResult::machine_failed) << err_.str();
  }
  EXPECT_NE(err_.str().find("File too large"), std::string::npos) << err_.str();
  const std::int64_t reached = mpm::read_checkpoint(options_.checkpoint).time;
  EXPECT_GT(reached, 0);
  EXPECT_LT(reached, 1'000'000'000);
  EXPECT_TRUE(fs::is_regular_file(folder_.file("csv/solver_state.csv")));
  options_.resume = options_.checkpoint;
  options_.bag = folder_.file("rest.bag");
  options_.csv.clear();
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  EXPECT_EQ(hash(), whole);
}

/// The hash in the last state of a recording; empty if it has none.
struct LastHash : RunVisitor {
  void solver_state(std::int64_t, const SolverState& message) override { hash = message.state_hash; }
  std::string hash;
};

/// From now on the disk is full for an open file of this process.
void fill_disk_of(const std::string& path) {
  const int full = open("/dev/full", O_WRONLY | O_CLOEXEC);
  ASSERT_GE(full, 0);
  int found = 0;
  for (const auto& entry : fs::directory_iterator("/proc/self/fd")) {
    std::error_code gone;  // the folder's own
    if (fs::read_symlink(entry.path(), gone) != path) continue;
    found += dup2(full, std::stoi(entry.path().filename())) >= 0 ? 1 : 0;
  }
  close(full);
  EXPECT_EQ(found, 1) << path;
}

TEST_F(RunSceneKept, TheRestOfARunWhoseTablesFindNoRoom) {
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  options_.csv = folder_.file("csv");
  options_.vtk = folder_.file("vtk");
  // Tables and files for ParaView. Those that are open all the time are on a full disk, which is seen when they are
  // flushed or closed; in the place of the others, opened in the middle of the run, is a device.
  for (const char* name : {"csv/solver_state.csv", "csv/particles_0003.csv", "csv/commands.csv",
                           "vtk/particles_0003.vtp", "vtk/run.pvd"}) {
    fs::remove_all(options_.csv);
    fs::remove_all(options_.vtk);
    fs::remove(options_.summary);
    fs::remove(options_.bag);
    fs::create_directories(options_.csv);
    fs::create_directories(options_.vtk);
    const bool later = std::string(name).find("particles") != std::string::npos;
    if (later) fs::create_symlink("/dev/full", folder_.file(name));
    options_.bag = folder_.file("run.bag");
    int asked = 0;
    const auto fill_once = [&] {
      if (!later && asked++ == 3) fill_disk_of(folder_.file(name));
      return false;
    };
    EXPECT_EQ(run(fill_once), RunSceneResult::machine_failed) << name;
    // Reported once, by name.
    EXPECT_EQ(err_.str().find("run_scene: " + folder_.file(name)), 0U) << err_.str();
    EXPECT_EQ(err_.str().find('\n'), err_.str().size() - 1) << err_.str();
    LastHash last;
    RunBag(options_.bag, "").read({&last});
    EXPECT_EQ(last.hash, hash()) << name;
  }
}

TEST_F(RunSceneKept, WhatWasRecordedBeforeItGoesOn) {
  options_.checkpoint = folder_.file("run.h5");
  options_.bag = folder_.file("run.bag");
  options_.csv = folder_.file("csv");
  options_.vtk = folder_.file("vtk");
  int asked = 0;
  ASSERT_EQ(run([&asked] { return asked++ == 20; }), RunSceneResult::done) << err_.str();
  const auto size = fs::file_size(options_.bag);
  options_.resume = options_.checkpoint;
  const auto refused = [this](const std::string& text) {
    EXPECT_EQ(run(), RunSceneResult::bad_input);
    EXPECT_EQ(err_.str(), "run_scene: " + text + ": holds the run so far; choose another name\n");
  };
  refused("--bag " + options_.bag);
  EXPECT_EQ(fs::file_size(options_.bag), size);
  options_.bag = folder_.file("rest.bag");
  refused("--csv " + options_.csv);
  options_.csv = folder_.file("rest");
  fs::create_directories(options_.csv);  // empty: nothing to lose
  refused("--vtk " + options_.vtk);
  EXPECT_FALSE(fs::exists(options_.bag));
  options_.vtk.clear();
  EXPECT_EQ(run(), RunSceneResult::done) << err_.str();
}

TEST_F(RunSceneKept, ARecordingWhoseEndIsInACheckpointIsCompared) {
  options_.end = "0.1";
  options_.bag = folder_.file("run.bag");
  options_.checkpoint = folder_.file("end.h5");
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  options_.end = "0.15";
  options_.bag.clear();
  options_.checkpoint = folder_.file("later.h5");
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  options_ = {};
  options_.threads = 1;
  options_.from_bag = folder_.file("run.bag");
  options_.resume = folder_.file("end.h5");
  EXPECT_EQ(run(), RunSceneResult::done) << err_.str();
  EXPECT_NE(out_.str().find("equal to the recorded one"), std::string::npos) << out_.str();
  options_.resume = folder_.file("later.h5");
  EXPECT_EQ(run(), RunSceneResult::done) << err_.str();
  EXPECT_NE(out_.str().find("not compared with the recording: it goes on from a checkpoint after"), std::string::npos)
      << out_.str();
}

TEST_F(RunSceneKept, ARecordingOfTheRestRunsAgainFromItsCheckpoint) {
  options_.end = "0.1";
  options_.checkpoint = folder_.file("run.h5");
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  options_.resume = options_.checkpoint;
  options_.checkpoint.clear();
  options_.end = "0.15";
  options_.bag = folder_.file("rest.bag");
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  options_ = {};
  options_.threads = 1;
  options_.from_bag = folder_.file("rest.bag");
  EXPECT_EQ(run(), RunSceneResult::bad_input);
  EXPECT_NE(err_.str().find("rest.bag: begins 0.1 s after the run's start"), std::string::npos) << err_.str();
  EXPECT_NE(err_.str().find("resume from a checkpoint"), std::string::npos) << err_.str();
  options_.resume = folder_.file("run.h5");
  EXPECT_EQ(run(), RunSceneResult::done) << err_.str();
  EXPECT_NE(out_.str().find("equal to the recorded one"), std::string::npos) << out_.str();
}

}  // namespace run_scene_kept_test
}  // namespace mpm_ros
