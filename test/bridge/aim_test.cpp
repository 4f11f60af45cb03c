// A scene with a target, from the choice to the record of a run: what is said, what is kept, and that recordings and
// checkpoints do not choose anew.
#include "mpm_ros/aim/aim.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mpm/advice/target_choice.hpp"
#include "mpm_ros/report/temporary_folder.hpp"
#include "mpm_ros/run/run_scene.hpp"

namespace mpm_ros {
namespace aim_test {

const char* const kScene =
    "geometry: plane_strain\n"
    "gravity: [0, -9.81]\n"
    "grid: {cell: 0.05, min: [0, 0], max: [1.6, 0.8]}\n"
    "time: {end: 0.02, sync: 0.005}\n"
    "materials: [{name: sand, law: drucker_prager, density: 1600, young: 1 MPa, poisson: 0.3, friction_angle: 30 deg, "
    "dilation_angle: 0 deg, cohesion: 0}]\n"
    "bodies: [{name: bed, material: sand, shape: {box: {min: [0, 0], max: [1.6, 0.4]}}}]\n"
    "rigid_bodies: [{name: tool, shape: {polygon: {points: [[0, 0], [0.2, 0], [0.2, 0.3], [0, 0.3]]}}, "
    "pose: {position: [0.7, 0.41]}, motion: {velocity: [0, -1]}}]\n"
    "boundaries: {all: slip}\n";

/// An environment variable that gets its value back.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value.c_str(), 1);
  }
  ~Environment() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

class AimTest : public ::testing::Test {
 protected:
  AimTest() : cache_("XDG_CACHE_HOME", folder_.file("cache")) {
    options_.scene = folder_.file("pushed.yaml");
    std::ofstream(options_.scene) << kScene;
    options_.threads = 1;
    options_.summary = folder_.file("summary.json");
  }
  RunSceneResult run() {
    out_.str("");
    err_.str("");
    return run_scene(options_, out_, err_, false, [] { return false; });
  }
  nlohmann::json summary() const {
    std::ifstream file(options_.summary);
    return nlohmann::json::parse(file);
  }
  Aim aim_at(const std::string& target) const {
    return aim(mpm::load_scene(options_.scene, {target}), 1, mpm::choose_isa("auto"), [] { return false; });
  }

  const TemporaryFolder folder_;
  const Environment cache_;
  RunSceneOptions options_;
  std::ostringstream out_, err_;
};

TEST_F(AimTest, ASceneWithoutATargetIsLeftAsItIs) {
  const mpm::Scene scene = mpm::load_scene(options_.scene);
  const Aim aimed = aim(scene, 1, mpm::choose_isa("auto"), [] { return false; });
  EXPECT_EQ(aimed.scene.text, scene.text);
  EXPECT_TRUE(aimed.news.empty() && aimed.warnings.empty() && aimed.table.empty());
}

// The node says these lines too, before its first run.
TEST_F(AimTest, SaysWhatWasChosenWhatItExpectsAndHowToRepeatIt) {
  // Least error that there are figures for, of a pace that every machine keeps.
  const Aim easy = aim_at("target.real_time=1e-6");
  ASSERT_EQ(easy.news.size(), 2U);
  EXPECT_EQ(easy.news[0].find("target real_time: 1e-06: cell "), 0U) << easy.news[0];
  EXPECT_NE(easy.news[0].find(" of real time expected, with an error of the tool's force of "), std::string::npos);
  EXPECT_NE(easy.news[0].find(" at most ("), std::string::npos) << easy.news[0];
  EXPECT_NE(easy.news[0].find("counting cells across 0.2 m of 'tool', a plate"), std::string::npos) << easy.news[0];
  EXPECT_EQ(easy.news[1].find("to run the same without a target, leave 'target' out of the scene and write --set "), 0U)
      << easy.news[1];
  EXPECT_TRUE(easy.warnings.empty());
  EXPECT_NE(easy.table.find("chosen "), std::string::npos) << easy.table;
  // Repeats what was chosen.
  const mpm::Scene by_hand = mpm::load_scene(options_.scene, *easy.scene.target->chosen);
  EXPECT_EQ(by_hand.definition.grid.cell, easy.scene.definition.grid.cell);
  EXPECT_EQ(by_hand.definition.method.precision, easy.scene.definition.method.precision);
  EXPECT_EQ(by_hand.definition.time.cfl, easy.scene.definition.time.cfl);
  // An error costs no more than it needs to: less pace for less error.
  const Aim rough = aim_at("target.force_error=14 %"), fine = aim_at("target.force_error=7 %");
  EXPECT_GT(rough.scene.target->expected_pace, fine.scene.target->expected_pace);
  EXPECT_LE(rough.scene.target->expected_error, 0.14);
  EXPECT_LE(fine.scene.target->expected_error, 0.07);
  EXPECT_TRUE(rough.warnings.empty() && fine.warnings.empty());
}

TEST_F(AimTest, WhatIsOutOfReachIsSaidAndIsNoError) {
  const Aim fast = aim_at("target.real_time=1e9");  // no machine is so fast
  ASSERT_EQ(fast.warnings.size(), 1U);
  EXPECT_EQ(fast.warnings[0].find("target real_time: 1e+09 is not in reach on this machine: "), 0U) << fast.warnings[0];
  EXPECT_NE(fast.warnings[0].find("give up "), std::string::npos) << fast.warnings[0];
  const Aim exact = aim_at("target.force_error=0.01 %");
  ASSERT_EQ(exact.warnings.size(), 1U);
  EXPECT_NE(exact.warnings[0].find("is the least that there are figures for"), std::string::npos) << exact.warnings[0];
  options_.set = {"target.real_time=1e9"};
  EXPECT_EQ(run(), RunSceneResult::done) << err_.str();
  EXPECT_NE(err_.str().find("warning: target real_time: 1e+09 is not in reach"), std::string::npos) << err_.str();
}

TEST_F(AimTest, AMissingTableIsNamedInOneLine) {
  const Environment table("MPM_ROS_FORCE_ERRORS", folder_.file("none.csv"));
  options_.set = {"target.real_time=1"};
  EXPECT_EQ(run(), RunSceneResult::bad_input);
  EXPECT_NE(err_.str().find("none.csv cannot be read"), std::string::npos) << err_.str();
}

TEST_F(AimTest, ATargetWithoutFiguresIsRefused) {
  options_.set = {"target.real_time=1", "target.length=5 mm"};  // no cell that fits is so small
  EXPECT_EQ(run(), RunSceneResult::bad_input);
  EXPECT_NE(err_.str().find("target: there are no figures for "), std::string::npos) << err_.str();
}

TEST_F(AimTest, ParticlesACellWithoutFiguresAreRefusedWithThoseThatHaveSome) {
  options_.set = {"target.real_time=1", "method.particles_per_cell=16", "target.keep=[method.particles_per_cell]"};
  EXPECT_EQ(run(), RunSceneResult::bad_input);
  EXPECT_NE(
      err_.str().find("target: there are no figures for 16 particles a cell, only for 4 and 9; write such a number "
                      "as method.particles_per_cell, or take keys out of target.keep, or leave target out"),
      std::string::npos)
      << err_.str();
}

TEST_F(AimTest, WhatIsSetIsNotOverriddenByARecordedChoice) {
  options_.set = {"target.force_error=10 %"};
  options_.bag = folder_.file("run.bag");
  options_.checkpoint = folder_.file("run.h5");
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  const RunSceneOptions first = options_;
  options_.bag.clear();
  options_.checkpoint.clear();
  // A checkpoint is of its own scene, with its own target.
  options_.resume = first.checkpoint;
  options_.end = "0.03";
  options_.set = {"target.force_error=10 %", "time.cfl=0.2"};
  EXPECT_EQ(run(), RunSceneResult::bad_input);
  EXPECT_NE(err_.str().find("run.h5: it is of another scene, or of another target: "), std::string::npos) << err_.str();
  EXPECT_NE(err_.str().find("time.cfl"), std::string::npos) << err_.str();
  EXPECT_EQ(err_.str().find("target force_error"), std::string::npos) << "nothing is chosen before: " << err_.str();
  options_.set = {"target.force_error=12 %"};
  EXPECT_EQ(run(), RunSceneResult::bad_input);
  EXPECT_NE(err_.str().find("another target: the run has another target; resume"), std::string::npos) << err_.str();
  // A recording runs again with another target: what was chosen for the first is undone.
  options_ = first;
  options_.bag.clear();
  options_.checkpoint.clear();
  options_.scene.clear();
  options_.from_bag = first.bag;
  options_.set = {"target.force_error=12 %"};
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  EXPECT_EQ(err_.str().find("as it was chosen before"), std::string::npos) << err_.str();
  EXPECT_EQ(summary()["target"]["force_error"], 0.12);
}

// A wheel that sinks by half a cell was promised 8.9 % and was off by 37: what no run has measured is not promised.
TEST_F(AimTest, NoErrorIsPromisedOfWhatWasNotMeasured) {
  const std::vector<std::string> wheel = {"rigid_bodies.tool.shape={cylinder: {radius: 0.1}}",
                                          "rigid_bodies.tool.pose.position=[0.7, 0.499]",
                                          "rigid_bodies.tool.motion={velocity: [1, 0], rotation_rate: 10}"};
  options_.set = wheel;
  options_.set.push_back("target.force_error=10 %");
  EXPECT_EQ(run(), RunSceneResult::bad_input);
  EXPECT_NE(err_.str().find("target.force_error: no error was measured for a wheel in sand, so none can be promised; "),
            std::string::npos)
      << err_.str();
  options_.set = wheel;
  options_.set.push_back("target.real_time=1e-6");
  EXPECT_EQ(run(), RunSceneResult::done) << err_.str();
  EXPECT_NE(
      err_.str().find("with an error of the tool's force that is not known: none was measured for a wheel in sand"),
      std::string::npos)
      << err_.str();
  EXPECT_FALSE(summary()["target"]["expected"].contains("force_error"));
  EXPECT_NE(out_.str().find("with an error of the force that is not known"), std::string::npos) << out_.str();
  options_.set = {"target.force_error=10 %",
                  "materials.sand={name: sand, law: neo_hookean, density: 1600, young: 1 MPa, "
                  "poisson: 0.3}"};
  EXPECT_EQ(run(), RunSceneResult::bad_input);
  EXPECT_NE(err_.str().find("no error was measured for a plate in other material"), std::string::npos) << err_.str();
}

// On another machine there may be another table, or none; the recorded choice needs neither it nor any timing.
TEST_F(AimTest, RecordingsAndCheckpointsUseTheRecordedChoice) {
  options_.set = {"target.force_error=10 %"};
  options_.bag = folder_.file("run.bag");
  options_.checkpoint = folder_.file("run.h5");
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  const nlohmann::json first = summary();
  EXPECT_EQ(first["target"]["force_error"], 0.1);
  EXPECT_FALSE(first["target"]["chosen"].empty());
  EXPECT_EQ(first["target"]["reached"]["real_time"], first["real_time_factor"]);
  EXPECT_LE(first["target"]["expected"]["force_error"], 0.1);
  EXPECT_NE(out_.str().find("  target force_error: 10 %: reached "), std::string::npos) << out_.str();

  const Environment table("MPM_ROS_FORCE_ERRORS", folder_.file("none.csv"));
  const Environment cache("XDG_CACHE_HOME", folder_.file("other_cache"));
  RunSceneOptions usual = options_;
  options_.bag.clear();
  options_.checkpoint.clear();
  options_.scene.clear();
  options_.set.clear();
  options_.from_bag = usual.bag;
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  EXPECT_NE(out_.str().find("equal to the recorded one"), std::string::npos) << out_.str() << err_.str();
  EXPECT_NE(err_.str().find("target force_error: 10 %: as it was chosen before, "), std::string::npos) << err_.str();
  EXPECT_EQ(summary()["target"]["chosen"], first["target"]["chosen"]);

  // A checkpoint alone, and with the scene beside it, whose target is open.
  options_.from_bag.clear();
  options_.resume = usual.checkpoint;
  options_.end = "0.03";
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  const std::string hash = summary()["state_hash"];
  options_.scene = usual.scene;
  options_.set = usual.set;
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  EXPECT_EQ(summary()["state_hash"], hash);
}

TEST_F(AimTest, IsExplainedWithThePriceOfWhatWasNotChosen) {
  options_.set = {"target.force_error=10 %"};
  std::ostringstream out;
  explain_scene(options_, out);
  for (const char* text : {"target force_error: 10 %: cell ", "choices that were weighed:\n", "chosen ", "faster ",
                           "error %", "  target: force_error: 10 %: "})
    EXPECT_NE(out.str().find(text), std::string::npos) << text << "\n" << out.str();
}

}  // namespace aim_test
}  // namespace mpm_ros
