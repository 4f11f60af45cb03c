// run_scene over several ranks, here threads, where one of them cannot go on: all end with one reason, and none waits
// for ever.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "full_disk.hpp"
#include "run_scene_over_ranks.hpp"

namespace mpm_ros {
namespace run_scene_ranks_end_test {

namespace fs = std::filesystem;
using Said = test::SaidByRank;
class RunSceneThatEnds : public test::RunSceneOverRanks {};

TEST_F(RunSceneThatEnds, EndsOnAllWithOneReasonWhenAPieceHasNoRoom) {
  options_.vtk = file("vtk");
  options_.summary = file("summary.json");
  fs::create_directories(file("vtk/particles_0000_1.vtp"));  // in the way of the second rank
  const std::vector<Said> said = run(2);
  for (const Said& told : said) EXPECT_EQ(told.result, RunSceneResult::machine_failed);
  EXPECT_NE(said[0].err.find("particles_0000_1.vtp: cannot be written"), std::string::npos) << said[0].err;
  EXPECT_EQ(said[1].out + said[1].err, "");
}

TEST_F(RunSceneThatEnds, EndsOnAllWhenTheFirstHasNoRoom) {
  options_.summary = file("summary.json");
  options_.bag = file("run.bag");
  const test::FullDisk full(20'000);
  const std::vector<Said> said = run(2);
  EXPECT_EQ(said[0].result, RunSceneResult::machine_failed);
  EXPECT_NE(said[0].err.find("run.bag"), std::string::npos) << said[0].err;
  EXPECT_EQ(said[1].out + said[1].err, "");
}

TEST_F(RunSceneThatEnds, TellsOnceThatARecordingIsNotThere) {
  options_.scene.clear();
  options_.set.clear();
  options_.from_bag = file("run.bag");
  int code = 0;
  EXPECT_NE(reason(2, &code).find("run.bag"), std::string::npos) << reason(2);
  EXPECT_EQ(code, static_cast<int>(RunSceneResult::bad_input));
}

TEST_F(RunSceneThatEnds, RefusesACheckpointThatCannotBeWritten) {
  options_.checkpoint = file("no/such/folder/run.h5");
  EXPECT_NE(reason(2).find("--checkpoint"), std::string::npos) << reason(2);
}

TEST_F(RunSceneThatEnds, EndsAllWithTheReasonOfOne) {
  options_.bag = file("no/such/folder/run.bag");  // the first alone opens it
  EXPECT_NE(reason(3).find("run.bag"), std::string::npos) << reason(3);
  options_.bag.clear();
  options_.set = {"rigid_bodies.plate.motion={velocity: [0, -0.5]}", "materials.foam.young=1e99"};
  EXPECT_NE(reason(3).find("run_scene: "), std::string::npos) << reason(3);
}

// A particle leaves the grid on one rank; all know, and the checkpoint from before it can be gone on with.
TEST_F(RunSceneThatEnds, FailsOnAllWithTheParticleOfOneAndLeavesACheckpoint) {
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

// Finds on one rank what is not a number in the middle of a step, while others wait: the physics failed all the
// same.
TEST_F(RunSceneThatEnds, EndsAllWhereTheStepOfOneFails) {
  options_.set = {"loads=[{body_force: {acceleration: [\"x > 0.12 && t > 0.01 ? log(0 - 1) : 0\", 0]}}]"};
  int code = 0;
  EXPECT_NE(reason(3, &code).find("body force on 'strip'"), std::string::npos) << reason(3);
  EXPECT_EQ(code, static_cast<int>(RunSceneResult::physics_failed));
}

TEST_F(RunSceneThatEnds, RefusesTheCheckpointOfAnotherScene) {
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

TEST_F(RunSceneThatEnds, RefusesBadInputWithOneSentence) {
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

TEST_F(RunSceneThatEnds, RefusesRanksThatReadDifferentScenes) {
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

}  // namespace run_scene_ranks_end_test
}  // namespace mpm_ros
