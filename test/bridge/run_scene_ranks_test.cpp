// run_scene over several ranks, here threads: one set of files and lines, and the forces of one process.
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "run_scene_over_ranks.hpp"

namespace mpm_ros {
namespace run_scene_ranks_test {

namespace fs = std::filesystem;
using Said = test::SaidByRank;
using test::RunSceneOverRanks;

std::size_t lines(const fs::path& path) {
  std::ifstream file(path);
  std::size_t count = 0;
  for (std::string line; std::getline(file, line);) ++count;
  return count;
}

TEST_F(RunSceneOverRanks, WritesOnceWhatOneProcessWrites) {
  options_.summary = file("alone.json");
  options_.csv = file("alone");
  std::ostringstream out, err;
  ASSERT_EQ(run_scene(options_, out, err, false, [] { return false; }), RunSceneResult::done) << err.str();
  const nlohmann::json alone = summary();
  EXPECT_EQ(alone["ranks"], 1);
  EXPECT_FALSE(alone.contains("communication"));
  const double impulse = alone["contact_impulse"]["plate"][2];
  ASSERT_GT(impulse, 0.0);
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
    EXPECT_GE(over["sharing"]["divisions"], 1);
    EXPECT_EQ(over["particles"], alone["particles"]);
    EXPECT_EQ(over["steps"], alone["steps"]);
    // Sums in another order over eighty steps, the bound for a hundred.
    EXPECT_NEAR(over["contact_impulse"]["plate"][2], impulse, 1e-10 * impulse);
    EXPECT_NEAR(over["energy"]["end"]["elastic"], alone["energy"]["end"]["elastic"],
                1e-9 * alone["energy"]["end"]["elastic"].get<double>());
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

// As many ranks repeat a recording to the bit, others to the round-off of sums in another order, as a bound for a
// hundred steps has it. 2 s.
TEST_F(RunSceneOverRanks, RunsARecordingAgain) {
  const auto impulse = [&] { return summary()["contact_impulse"]["plate"][2].get<double>(); };
  options_.summary = file("summary.json");
  for (const int recorded : {1, 2}) {
    options_.from_bag.clear();
    options_.scene = source_file("test/data/press.yaml");
    options_.set = {"rigid_bodies.plate.motion={velocity: [0, -0.5]}"};
    options_.end = "30 ms";
    options_.bag = file(std::to_string(recorded) + ".bag");
    if (recorded == 1) {
      std::ostringstream out, err;
      ASSERT_EQ(run_scene(options_, out, err, false, [] { return false; }), RunSceneResult::done) << err.str();
    } else {
      run(2);
    }
    const double expected = impulse();
    ASSERT_GT(expected, 0.0);
    options_.from_bag = options_.bag;
    options_.bag.clear();
    options_.scene.clear();
    options_.set.clear();
    options_.end.clear();
    for (const int count : {1, 2}) {
      Said told;
      if (count == 1) {
        std::ostringstream out, err;
        told.result = run_scene(options_, out, err, false, [] { return false; });
        told.out = out.str();
        told.err = err.str();
      } else {
        told = run(2)[0];
      }
      EXPECT_EQ(told.result, RunSceneResult::done) << told.err;
      EXPECT_NEAR(impulse(), expected, 1e-10 * expected);
      EXPECT_NE(told.out.find(count == recorded ? "equal to the recorded one" : "processes add up in another order"),
                std::string::npos)
          << told.out;
    }
  }
}

// The first rank chooses, and all run what it has chosen: one process that is told the choice has the same forces. Sums
// of two ranks have other round-off, 1e-16, which yielding sand and sweeps of contact let grow; another choice is off
// by per cents. 1 s.
TEST_F(RunSceneOverRanks, AimsAtATargetTogether) {
  options_.scene = file("pushed.yaml");
  std::ofstream(options_.scene)
      << "geometry: plane_strain\ngravity: [0, -9.81]\ngrid: {cell: 0.05, min: [0, 0], max: [1.6, 0.8]}\n"
         "time: {end: 0.02, sync: 0.005}\n"
         "materials: [{name: sand, law: drucker_prager, density: 1600, young: 1 MPa, poisson: 0.3, friction_angle: "
         "30 deg, dilation_angle: 0 deg, cohesion: 0}]\n"
         "bodies: [{name: bed, material: sand, shape: {box: {min: [0, 0], max: [1.6, 0.4]}}}]\n"
         "rigid_bodies: [{name: tool, shape: {polygon: {points: [[0, 0], [0.2, 0], [0.2, 0.3], [0, 0.3]]}}, "
         "pose: {position: [0.7, 0.41]}, motion: {velocity: [0, -1]}}]\nboundaries: {all: slip}\n";
  options_.set = {"target={force_error: 50 %}"};
  options_.end.clear();
  options_.summary = file("summary.json");
  options_.bag = file("run.bag");
  const std::vector<Said> said = run(2);
  EXPECT_EQ(said[0].result, RunSceneResult::done) << said[0].err;
  EXPECT_NE(said[0].err.find("of real time expected"), std::string::npos) << said[0].err;
  EXPECT_EQ(said[1].out + said[1].err, "");
  const double impulse = summary()["contact_impulse"]["tool"][2];
  ASSERT_GT(impulse, 0.0);
  options_.from_bag = options_.bag;  // its scene has the choice
  options_.bag.clear();
  options_.scene.clear();
  options_.set.clear();
  std::ostringstream out, err;
  ASSERT_EQ(run_scene(options_, out, err, false, [] { return false; }), RunSceneResult::done) << err.str();
  EXPECT_NEAR(summary()["contact_impulse"]["tool"][2], impulse, 1e-8 * impulse);
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

}  // namespace run_scene_ranks_test
}  // namespace mpm_ros
