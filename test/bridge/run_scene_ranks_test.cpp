// run_scene over several ranks, here threads: one set of files and lines, the forces of one process, and no rank that
// waits for ever when another one cannot go on.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "full_disk.hpp"
#include "mpm_ranks/make_ranks.hpp"
#include "mpm_ros/run/run_scene.hpp"
#include "test_files.hpp"
#include "thread_communicator.hpp"

namespace mpm_ros {
namespace run_scene_ranks_test {

namespace fs = std::filesystem;

/// What a rank has said, and its result.
struct Said {
  std::string out, err;
  RunSceneResult result = RunSceneResult::done;
};

std::size_t lines(const fs::path& path) {
  std::ifstream file(path);
  std::size_t count = 0;
  for (std::string line; std::getline(file, line);) ++count;
  return count;
}

class RunSceneOverRanks : public ::testing::Test {
 protected:
  RunSceneOverRanks() : folder_(fs::temp_directory_path() / ("mpm_run_scene_ranks_test_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    options_.scene = source_file("test/data/press.yaml");
    options_.set = {"rigid_bodies.plate.motion={velocity: [0, -0.5]}"};
    options_.threads = 1;
    options_.end = "30 ms";
  }
  ~RunSceneOverRanks() override { fs::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  std::vector<Said> run(
      int count, const std::function<bool(int)>& stop = [](int) { return false; }) const {
    std::vector<Said> said(count);
    mpm::run_ranks(count, [&](mpm::Communicator& ranks) {
      RunSceneOptions own = options_;
      own.ranks = {&ranks, [](mpm::Communicator*) {}};
      std::ostringstream out, err;
      Said& told = said[ranks.rank()];
      told.result = run_scene(own, out, err, false, [&] { return stop(ranks.rank()); });
      told.out = out.str();
      told.err = err.str();
    });
    return said;
  }
  /// What ends all ranks. `code`: with which exit code.
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

  fs::path folder_;
  RunSceneOptions options_;
};

TEST_F(RunSceneOverRanks, WritesOnceWhatOneProcessWrites) {
  options_.summary = file("alone.json");
  options_.csv = file("alone");
  std::ostringstream out, err;
  ASSERT_EQ(run_scene(options_, out, err, false, [] { return false; }), RunSceneResult::done) << err.str();
  const nlohmann::json alone = summary();
  EXPECT_EQ(alone["ranks"], 1);
  EXPECT_FALSE(alone.contains("communication"));
  // One process solves points of contact in another order than ranks, so numbers are those of one rank.
  options_.summary = file("one.json");
  options_.csv.clear();
  run(1);
  const nlohmann::json one = summary();
  const double impulse = one["contact_impulse"]["plate"][2];
  ASSERT_GT(impulse, 0.0);
  // By their order, 5e-4 of it here.
  EXPECT_NEAR(alone["contact_impulse"]["plate"][2], impulse, 1e-3 * impulse);
  for (const int count : {2, 3}) {
    options_.summary = file(std::to_string(count) + ".json");
    options_.csv = file(std::to_string(count));
    options_.bag = file(std::to_string(count) + ".bag");
    const std::vector<Said> said = run(count);
    EXPECT_NE(said[0].out.find(std::to_string(count) + " ranks of 1 thread"), std::string::npos) << said[0].out;
    for (int rank = 0; rank < count; ++rank) {
      EXPECT_EQ(said[rank].result, RunSceneResult::done) << said[rank].err;
      if (rank > 0) {
        EXPECT_EQ(said[rank].out + said[rank].err, "");
      }
    }
    const nlohmann::json over = summary();
    EXPECT_EQ(over["ranks"], count);
    EXPECT_TRUE(over.contains("communication"));
    EXPECT_EQ(over["particles"], alone["particles"]);
    EXPECT_EQ(over["steps"], alone["steps"]);
    // Sums in another order over eighty steps, the bound for a hundred.
    EXPECT_NEAR(over["contact_impulse"]["plate"][2], impulse, 1e-10 * impulse);
    EXPECT_NEAR(over["energy"]["end"]["elastic"], one["energy"]["end"]["elastic"],
                1e-9 * one["energy"]["end"]["elastic"].get<double>());
    EXPECT_LT(over["momentum_error"], 1e-10);
    EXPECT_TRUE(fs::exists(options_.bag));
    for (const auto& entry : fs::directory_iterator(file("alone"))) {
      const fs::path same = fs::path(options_.csv) / entry.path().filename();
      ASSERT_TRUE(fs::exists(same)) << same;
      EXPECT_EQ(lines(same), lines(entry.path())) << same;
    }
  }
}

TEST_F(RunSceneOverRanks, StopsOnAllWhenOneIsAskedTo) {
  std::atomic<int> asked{0};
  options_.summary = file("summary.json");
  const std::vector<Said> said = run(3, [&](int rank) { return rank == 2 && ++asked > 4; });
  for (const Said& told : said) EXPECT_EQ(told.result, RunSceneResult::done);
  EXPECT_NE(said[0].err.find("stopped at"), std::string::npos) << said[0].err;
  EXPECT_FALSE(summary()["ended"]);
}

TEST_F(RunSceneOverRanks, EndsOnAllWhenTheFirstHasNoRoom) {
  options_.summary = file("summary.json");
  options_.bag = file("run.bag");
  const test::FullDisk full(20'000);
  const std::vector<Said> said = run(2);
  EXPECT_EQ(said[0].result, RunSceneResult::machine_failed);
  EXPECT_NE(said[0].err.find("run.bag"), std::string::npos) << said[0].err;
  EXPECT_EQ(said[1].out + said[1].err, "");
}

TEST_F(RunSceneOverRanks, RefusesByNameWhatOneProcessAloneCan) {
  options_.from_bag = file("run.bag");
  EXPECT_NE(reason(2).find("--from-bag"), std::string::npos) << reason(2);
  options_.from_bag.clear();
  options_.set = {"target={real_time: 1}"};
  EXPECT_NE(reason(2).find("target"), std::string::npos) << reason(2);
}

// To the bit on as many ranks, to round-off on others.
TEST_F(RunSceneOverRanks, GoesOnFromItsCheckpoint) {
  const auto hash_and_impulse = [&](int count) {
    options_.summary = file("summary.json");
    for (const Said& told : run(count)) EXPECT_EQ(told.result, RunSceneResult::done) << told.err;
    const nlohmann::json found = summary();
    return std::pair(found["state_hash"].dump(), found["contact_impulse"]["plate"][2].get<double>());
  };
  options_.checkpoint = file("end.h5");
  const auto [hash, impulse] = hash_and_impulse(3);
  EXPECT_TRUE(fs::exists(options_.checkpoint));
  options_.end = "15 ms";
  options_.checkpoint = file("half.h5");
  options_.checkpoint_every = "5 ms";
  const double first = hash_and_impulse(3).second;
  options_.resume = options_.checkpoint;
  options_.checkpoint.clear();
  options_.checkpoint_every.clear();
  options_.scene.clear();
  options_.set.clear();
  options_.end = "30 ms";
  for (const int count : {3, 2}) {
    const auto [of_rest, rest] = hash_and_impulse(count);
    EXPECT_EQ(of_rest == hash, count == 3) << count;
    EXPECT_NEAR(rest, impulse, 1e-10 * impulse) << first;
  }
}

TEST_F(RunSceneOverRanks, RefusesACheckpointThatCannotBeWritten) {
  options_.checkpoint = file("no/such/folder/run.h5");
  EXPECT_NE(reason(2).find("--checkpoint"), std::string::npos) << reason(2);
}

TEST_F(RunSceneOverRanks, EndsAllWithTheReasonOfOne) {
  options_.bag = file("no/such/folder/run.bag");  // the first alone opens it
  EXPECT_NE(reason(3).find("run.bag"), std::string::npos) << reason(3);
  options_.bag.clear();
  options_.set = {"rigid_bodies.plate.motion={velocity: [0, -0.5]}", "materials.foam.young=1e99"};
  EXPECT_NE(reason(3).find("run_scene: "), std::string::npos) << reason(3);
}

// A particle leaves the grid on one rank; all know, and the checkpoint from before it can be gone on with.
TEST_F(RunSceneOverRanks, FailsOnAllWithTheParticleOfOneAndLeavesACheckpoint) {
  options_.scene = source_file("test/data/leaves_domain.yaml");
  options_.set = {"time.sync=1 ms"};
  options_.end = "200 ms";
  options_.checkpoint = file("run.h5");
  options_.checkpoint_every = "40 ms";
  options_.csv = file("csv");
  const std::vector<Said> said = run(3);
  for (const Said& told : said) EXPECT_EQ(told.result, RunSceneResult::physics_failed);
  EXPECT_NE(said[0].err.find("outside the domain"), std::string::npos) << said[0].err;
  EXPECT_NE(said[0].err.find("particle "), std::string::npos) << said[0].err;
  EXPECT_EQ(said[1].err + said[2].err, "");
  ASSERT_TRUE(fs::exists(options_.checkpoint));
  options_.resume = options_.checkpoint;
  options_.scene.clear();
  options_.set.clear();
  options_.checkpoint.clear();
  options_.checkpoint_every.clear();
  options_.csv.clear();
  options_.summary = file("summary.json");
  options_.end = "42 ms";
  for (const Said& told : run(2)) EXPECT_EQ(told.result, RunSceneResult::done) << told.err;
  EXPECT_LT(summary()["momentum_error"], 1e-10);
  options_.end = "200 ms";
  for (const Said& told : run(2)) EXPECT_EQ(told.result, RunSceneResult::physics_failed);
}

// What is not a number in the middle of a step is found on one rank, while others wait: the physics failed all the
// same.
TEST_F(RunSceneOverRanks, EndsAllWhereTheStepOfOneFails) {
  options_.set = {"loads=[{body_force: {acceleration: [\"x > 0.12 && t > 0.01 ? log(0 - 1) : 0\", 0]}}]"};
  int code = 0;
  EXPECT_NE(reason(3, &code).find("body force on 'strip'"), std::string::npos) << reason(3);
  EXPECT_EQ(code, static_cast<int>(RunSceneResult::physics_failed));
}

TEST_F(RunSceneOverRanks, LetsRanksWithoutParticlesBe) {
  options_.summary = file("summary.json");
  run(1);
  const double impulse = summary()["contact_impulse"]["plate"][2];
  const std::vector<Said> said = run(24);
  for (const Said& told : said) EXPECT_EQ(told.result, RunSceneResult::done) << told.err;
  EXPECT_NE(said[0].err.find("of 24 ranks have no particle"), std::string::npos) << said[0].err;
  EXPECT_NEAR(summary()["contact_impulse"]["plate"][2], impulse, 1e-10 * impulse);
  EXPECT_EQ(run(2)[0].err.find("no particle"), std::string::npos);
}

TEST_F(RunSceneOverRanks, RefusesTheCheckpointOfAnotherScene) {
  options_.checkpoint = file("press.h5");
  options_.end = "5 ms";
  run(2);
  options_.resume = options_.checkpoint;
  options_.checkpoint.clear();
  options_.scene = source_file("test/data/leaves_domain.yaml");
  options_.set.clear();
  int code = 0;
  const std::string told = reason(3, &code);
  EXPECT_NE(told.find("press.h5"), std::string::npos) << told;
  EXPECT_EQ(told.find('\n'), std::string::npos) << told;
  EXPECT_EQ(code, static_cast<int>(RunSceneResult::bad_input));
}

TEST_F(RunSceneOverRanks, RefusesBadInputWithOneSentence) {
  const auto refused = [&] {
    int code = 0;
    const std::string told = reason(3, &code);
    EXPECT_EQ(told.find('\n'), std::string::npos) << told;
    EXPECT_EQ(code, static_cast<int>(RunSceneResult::bad_input)) << told;
    return told;
  };
  options_.set = {"grid.cell=-1"};
  EXPECT_NE(refused().find("grid.cell"), std::string::npos);
  options_.set.clear();
  options_.scene = file("none.yaml");
  EXPECT_NE(refused().find("no such scene file"), std::string::npos);
  options_.scene.clear();
  options_.resume = file("none.h5");
  EXPECT_NE(refused().find("none.h5"), std::string::npos);
}

TEST_F(RunSceneOverRanks, RefusesRanksThatReadDifferentScenes) {
  try {
    mpm::run_ranks(2, [&](mpm::Communicator& ranks) {
      RunSceneOptions own = options_;
      own.ranks = {&ranks, [](mpm::Communicator*) {}};
      if (!ranks.first()) own.set.push_back("contact.friction=0.3");
      std::ostringstream out, err;
      run_scene(own, out, err, false, [] { return false; });
    });
    FAIL() << "both run";
  } catch (const mpm::RanksError& error) {
    EXPECT_NE(std::string(error.what()).find("rank 1 reads another scene"), std::string::npos) << error.what();
  }
}

}  // namespace run_scene_ranks_test
}  // namespace mpm_ros
