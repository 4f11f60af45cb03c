// A run that the first of several ranks leads, as the node does, here with threads as ranks: what is commanded, set and
// begun anew on the first has on all the effect that it has in one process, and what one rank fails at ends them. 3 s.
#include "mpm_ros/run/led_run.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "mpm_ranks/make_ranks.hpp"
#include "mpm_ros/run/follow.hpp"
#include "test_files.hpp"
#include "thread_communicator.hpp"

namespace mpm_ros {
namespace led_run_test {

using AnyRun = Run;  ///< Run of a test is another thing

constexpr int kPress = 15;  ///< sync periods of 2 ms in which the plate comes 7 mm into the strip

AppliedCommand velocity_of(const Run& run, const std::string& body, double vz) {
  AppliedCommand command;
  command.body = run.simulation().find_commanded(body);
  command.twist.linear = {0.0, 0.0, vz};
  command.effect = run.simulation().time();
  return command;
}

/// Numbers that a session of commands comes to: pose of the plate and force on it, and pose of the rod.
struct Reached {
  std::vector<double> plate, rod;
  double force = 0.0;  ///< on the plate, upwards [N]
};

Reached reached(Run& run) {
  Reached found;
  const std::vector<mpm::BodyState> bodies = run.simulation().bodies();
  for (int axis = 0; axis < 3; ++axis) {
    found.plate.push_back(bodies[0].pose.position[axis]);
    found.rod.push_back(bodies[1].pose.position[axis]);
  }
  found.force = run.outputs().contacts().bodies[0].mean.force.z();
  return found;
}

class LedRuns : public ::testing::Test {
 protected:
  LedRuns() : folder_(std::filesystem::temp_directory_path() / ("mpm_led_run_test_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~LedRuns() override { std::filesystem::remove_all(folder_); }

  std::unique_ptr<AnyRun> make(const mpm::Scene& scene, mpm::Communicator* ranks,
                               const std::string& resume = {}) const {
    RunOptions options;
    options.threads = 1;
    options.output = output_options(scene);
    options.resume = resume;
    if (!resume.empty()) options.more = [](mpm::StateArchive&) {};  // no commands wait here
    options.stop = [] { return false; };
    if (ranks != nullptr) options.ranks = {ranks, [](mpm::Communicator*) {}};
    return make_run(scene, options, Stamps(), nullptr);
  }
  /// lead(ranks) on the first of two ranks, which the other follows; null: in one process. Returns the code with which
  /// the other has ended.
  template <class Lead>
  int led(const Lead& lead) const {
    int code = -1;
    mpm::run_ranks(2, [&](mpm::Communicator& ranks) {
      if (ranks.first()) {
        lead(&ranks);
        end_following(ranks, 7);
      } else {
        code = follow({&ranks, [](mpm::Communicator*) {}});
      }
    });
    return code;
  }

  const std::filesystem::path folder_;
  const mpm::Scene scene_ = mpm::load_scene(source_file("test/data/press.yaml"));
};

// Round-off of sums in another order is at most 1e-10 of what is exchanged in a hundred steps; tools that are commanded
// have the same bits.
TEST_F(LedRuns, DoWhatOneProcessDoes) {
  const auto session = [&](mpm::Communicator* ranks) {
    std::vector<Reached> found;
    std::unique_ptr<AnyRun> run = make(scene_, ranks);
    run->begin();
    run->apply(velocity_of(*run, "plate", -0.4));
    run->apply(velocity_of(*run, "rod", 0.2));
    for (int period = 0; period < kPress; ++period) run->advance({});
    found.push_back(reached(*run));
    mpm::StateSet set;
    set.name = "rod";
    set.pose = mpm::Pose{};
    set.pose->position = {0.02, 0.0, 0.1};
    run->set_state(set);
    set.pose->position = {0.1, 0.0, 0.01};  // in the strip
    EXPECT_THROW(run->set_state(set), mpm::RigidError);
    const std::string saved = (folder_ / (ranks == nullptr ? "alone.h5" : "led.h5")).string();
    run->save(saved, [](mpm::StateArchive&) {}, {});
    for (int period = 0; period < 3; ++period) run->advance({});
    found.push_back(reached(*run));
    // Another one is made beside it, as a reset does.
    std::unique_ptr<AnyRun> again = make(scene_, ranks, saved);
    run->finish();
    run = std::move(again);
    run->begin();
    for (int period = 0; period < 3; ++period) run->advance({});
    found.push_back(reached(*run));
    run->finish();
    EXPECT_TRUE(run->closed());
    EXPECT_FALSE(run->parted());
    return found;
  };
  const std::vector<Reached> alone = session(nullptr);
  std::vector<Reached> over;
  EXPECT_EQ(led([&](mpm::Communicator* ranks) { over = session(ranks); }), 7);
  ASSERT_EQ(over.size(), alone.size());
  ASSERT_GT(alone[0].force, 0.0);
  EXPECT_NEAR(alone[0].plate[2], 0.065 - 0.4 * 0.03, 1e-12);
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(over[i].plate, alone[i].plate);
    EXPECT_EQ(over[i].rod, alone[i].rod);
    EXPECT_NEAR(over[i].force, alone[i].force, 1e-10 * alone[0].force);
  }
  EXPECT_EQ(alone[1].rod[0], 0.02);
}

// All find that a particle has left the grid, and the next run begins.
TEST_F(LedRuns, FailTogetherAndBeginAgain) {
  const mpm::Scene scene = mpm::load_scene(source_file("test/data/leaves_domain.yaml"), {"time.sync=1 ms"});
  EXPECT_EQ(led([&](mpm::Communicator* ranks) {
              std::unique_ptr<AnyRun> run = make(scene, ranks);
              run->begin();
              std::string reason;
              for (int period = 0; period < 200 && reason.empty(); ++period) {
                try {
                  run->advance({});
                } catch (const mpm::PhysicsError& error) {
                  reason = error.what();
                }
              }
              EXPECT_NE(reason.find("outside the domain"), std::string::npos) << reason;
              run->fail(reason);
              EXPECT_FALSE(run->parted());
              run->save((folder_ / "failed.h5").string(), [](mpm::StateArchive&) {}, reason);
              run = make(scene, ranks);
              run->begin();
              run->advance({});
              run->finish();
            }),
            7);
}

TEST_F(LedRuns, EndWhereTheStepOfOneRankFails) {
  const mpm::Scene scene =
      mpm::load_scene(source_file("test/data/press.yaml"),
                      {"loads=[{body_force: {acceleration: [\"x > 0.14 && t > 0.01 ? log(0 - 1) : 0\", 0]}}]"});
  try {
    led([&](mpm::Communicator* ranks) {
      const std::unique_ptr<AnyRun> run = make(scene, ranks);
      run->begin();
      for (int period = 0; period < 20; ++period) run->advance({});
    });
    FAIL() << "nothing fails";
  } catch (const mpm::RanksError& error) {
    EXPECT_NE(std::string(error.what()).find("body force on 'strip'"), std::string::npos) << error.what();
    EXPECT_EQ(exit_code_of(error), 3);
  }
}

TEST_F(LedRuns, RefuseOnAllWhatCannotBeResumed) {
  EXPECT_EQ(led([&](mpm::Communicator* ranks) {
              EXPECT_THROW(make(scene_, ranks, (folder_ / "none.h5").string()), mpm::CheckpointError);
              const std::unique_ptr<AnyRun> run = make(scene_, ranks);
              run->begin();
              run->finish();
            }),
            7);
}

}  // namespace led_run_test
}  // namespace mpm_ros
