// run_scene and the node's parameters with another processor that takes the steps: the kernels of a graphics processor
// in loops on this one, and fake ones that are not there or are lost. Cost: 2 s.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "loss_device.hpp"
#include "mpm_devices/find_card.hpp"
#include "mpm_gpu/device.hpp"
#include "mpm_ros/node/node_parameters.hpp"
#include "mpm_ros/report/report_bag.hpp"
#include "mpm_ros/report/temporary_folder.hpp"
#include "mpm_ros/run/run_scene.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace run_scene_device_test {

class RunSceneDevice : public ::testing::Test {
 protected:
  RunSceneDevice() {
    options_.scene = source_file("config/scenes/falling_block.yaml");
    options_.threads = 1;
    options_.end = "50 ms";  // twenty sync periods of 2.5 ms
    options_.summary = folder_.file("summary.json");
  }
  void ask(const std::string& word, const mpm::DeviceMaker& maker) {
    options_.device = {word, [maker] { return mpm::FoundDevice{maker, {}}; }};
  }
  static mpm::DeviceMaker loops() {
    mpm::DeviceMaker maker = mpm_gpu::device_by();
    maker.name = "loops";
    return maker;
  }
  RunSceneResult run() {
    out_.str("");
    err_.str("");
    return run_scene(options_, out_, err_, false, [] { return false; });
  }
  void expect_one_line(const std::string& text) {
    EXPECT_EQ(run(), RunSceneResult::bad_input);
    EXPECT_EQ(err_.str(), "run_scene: " + text + "\n");
  }
  nlohmann::json summary() const {
    std::ifstream file(options_.summary);
    return nlohmann::json::parse(file);
  }

  const TemporaryFolder folder_;
  RunSceneOptions options_;
  std::ostringstream out_, err_;
};

TEST_F(RunSceneDevice, RunsAsOnTheProcessorAndSaysWhoTookTheSteps) {
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  EXPECT_EQ(err_.str().find("device"), std::string::npos) << err_.str();
  const nlohmann::json here = summary();
  EXPECT_EQ(here["device"], "cpu");
  ask("gpu", loops());
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  const nlohmann::json there = summary();
  EXPECT_EQ(there["device"], "loops");
  EXPECT_NE(err_.str().find("device gpu: loops takes the steps\n"), std::string::npos) << err_.str();
  EXPECT_NE(out_.str().find("a second on loops and 1 thread ("), std::string::npos) << out_.str();
  EXPECT_EQ(there["steps"], here["steps"]);
  // Free fall, v = g t, and round-off of some hundred steps.
  EXPECT_NEAR(there["metrics"]["mean_vz"].get<double>(), -9.81 * 0.05, 1e-12);
  EXPECT_LT(there["momentum_error"].get<double>(), 1e-10);
}

TEST_F(RunSceneDevice, ARecordingIsComparedWithARunBySameProcessorAlone) {
  ask("gpu", loops());
  options_.bag = folder_.file("run.bag");
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  options_.scene.clear();
  options_.end.clear();
  options_.from_bag = options_.bag;
  options_.bag.clear();
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  EXPECT_NE(out_.str().find("equal to the recorded one"), std::string::npos) << out_.str() << err_.str();
  options_.device = {};
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  EXPECT_NE(out_.str().find("not compared with the recording: steps by the processor in place of loops"),
            std::string::npos)
      << out_.str() << err_.str();
}

TEST_F(RunSceneDevice, AutoSaysWhyTheProcessorTakesTheSteps) {
  ask("auto", loops());
  options_.set = {"method.average_dilatation=true"};
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  EXPECT_NE(err_.str().find("device auto: this processor takes the steps, since steps on a graphics processor and "
                            "averaged dilatation do not go together: "),
            std::string::npos)
      << err_.str();
  EXPECT_EQ(summary()["device"], "cpu");
  std::ostringstream explained;
  explain_scene(options_, explained);
  EXPECT_NE(explained.str().find("device auto: this processor takes the steps, since "), std::string::npos);
}

TEST_F(RunSceneDevice, BadInputEndsWithTwoAndOneLine) {
  options_.device = {"cuda", {}};
  expect_one_line("--device cuda: there is no processor 'cuda' to choose; write cpu, gpu or auto");
  ask("gpu", mpm::test::too_small());
  expect_one_line("400 particles need more memory than is free: about 100 particles would fit");
  ask("gpu", loops());
  options_.set = {"method.average_dilatation=true"};
  expect_one_line(
      "--device: steps on a graphics processor and averaged dilatation do not go together: there are no kernels for "
      "that yet; run it with --device cpu");
}

TEST_F(RunSceneDevice, ABuildWithoutCardsSaysWhatToDo) {
  const std::string missing = mpm::find_card().missing;
  options_.device = {"gpu", mpm::find_card};
  expect_one_line("--device gpu: " + missing);
  EXPECT_EQ(missing,
            "this build has no steps for a graphics processor: make one that has with scripts/build --gpu, and run its "
            "programs, in build_gpu/");
  options_.device.word = "auto";
  EXPECT_EQ(run(), RunSceneResult::done) << err_.str();
  EXPECT_NE(err_.str().find("device auto: this processor takes the steps, since " + missing), std::string::npos);
}

/// The last solver state of a bag.
class LastState : public RunVisitor {
 public:
  explicit LastState(const std::string& path) {
    RunBag bag(path, {});
    bag.read_states_and_commands(*this);
  }
  void solver_state(std::int64_t, const SolverState& message) override { last = message; }
  SolverState last;
};

// The block takes some ten steps a sync period. Lost in a step, or when the outputs of a sync point read it.
TEST_F(RunSceneDevice, OneThatIsLostEndsWithThreeAWholeBagAndTheLastCheckpoint) {
  for (const bool in_step : {true, false}) {
    for (const bool saves : {true, false}) {
      SCOPED_TRACE(testing::Message() << "in a step: " << in_step << ", saves: " << saves);
      ask("gpu", mpm::test::lost_after(60, in_step));
      options_.bag = folder_.file("lost.bag");
      options_.checkpoint = saves ? folder_.file("lost.h5") : "";
      options_.checkpoint_every = saves ? "2.5 ms" : "";
      EXPECT_EQ(run(), RunSceneResult::physics_failed) << out_.str();
      EXPECT_NE(err_.str().find(std::string("run_scene: ") + mpm::test::LossDevice::kWhy + "\n"), std::string::npos)
          << err_.str();
      const std::string lost = "run_scene: the state of the run is lost with the graphics processor; ";
      EXPECT_NE(err_.str().find(lost + (saves ? "the last checkpoint is " + options_.checkpoint +
                                                    ", from which it goes on (--resume)\n"
                                              : "no checkpoint was saved from which it could go on\n")),
                std::string::npos)
          << err_.str();
      const SolverState last = LastState(options_.bag).last;  // the bag has its index, or it could not be read
      EXPECT_TRUE(last.failed);
      EXPECT_EQ(last.failure, mpm::test::LossDevice::kWhy);
      EXPECT_GT(last.steps, 0U);
    }
  }
  // And it goes on from there, here.
  options_.device = {};
  options_.scene.clear();
  options_.bag.clear();
  options_.checkpoint.clear();
  options_.checkpoint_every.clear();
  options_.resume = folder_.file("lost.h5");
  EXPECT_EQ(run(), RunSceneResult::done) << err_.str();
  EXPECT_EQ(summary()["time"], 0.05);
}

TEST(NodeParametersDevice, NameTheParameter) {
  std::vector<std::string> warnings;
  const auto error_of = [&](const std::string& word, const mpm::FoundDevice& found, int ranks) -> std::string {
    NodeParameters parameters =
        read_parameters({{"scene", XmlRpc::XmlRpcValue("press")}, {"device", XmlRpc::XmlRpcValue(word)}}, warnings);
    EXPECT_EQ(parameters.device.word, word);
    try {
      look_for_device(
          parameters, [=] { return found; }, ranks);
    } catch (const ParameterError& error) {
      return error.what();
    }
    EXPECT_TRUE(parameters.device.find().missing == found.missing);
    return "";
  };
  const mpm::FoundDevice none{{}, "this machine has no card"}, one{mpm::test::kept(), {}};
  EXPECT_EQ(error_of("cuda", one, 1),
            "parameter ~device: cuda: there is no processor 'cuda' to choose; write cpu, gpu or auto");
  EXPECT_EQ(error_of("gpu", none, 1), "parameter ~device: gpu: this machine has no card");
  EXPECT_NE(error_of("gpu", one, 2).find("parameter ~device: gpu: steps on a graphics processor and several processes"),
            std::string::npos);
  EXPECT_EQ(error_of("gpu", one, 1), "");
  EXPECT_EQ(error_of("auto", none, 1), "");
  EXPECT_EQ(error_of("cpu", none, 2), "");
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(read_parameters({{"scene", XmlRpc::XmlRpcValue("press")}}, warnings).device.word, "cpu");
}

}  // namespace run_scene_device_test
}  // namespace mpm_ros
