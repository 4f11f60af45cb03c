// The processor that takes the steps: what each word chooses, what it says of it, and a device that is lost.
#include "mpm/simulation/device_choice.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "loss_device.hpp"
#include "mpm/scene/scene.hpp"

namespace mpm {
namespace device_choice_test {

SimulationDefinition block() {
  return build(
      parse_scene("geometry: plane_strain\ngrid: {cell: 0.1, min: [0, 0], max: [1, 1]}\n"
                  "time: {end: 1, sync: 0.01}\ngravity: [0, -9.81]\n"
                  "materials: [{name: m, density: 1000, law: neo_hookean, young: 1 MPa, poisson: 0.3}]\n"
                  "bodies: [{name: b, material: m, shape: {box: {min: [0.2, 0.2], max: [0.6, 0.6]}}}]\n",
                  "scene", {}));
}

/// `looks`: counts how often a card is looked for.
DeviceRequest asks(const std::string& word, FoundDevice found, int* looks = nullptr) {
  return {word, [=] {
            if (looks != nullptr) ++*looks;
            return found;
          }};
}
const FoundDevice kNone{{}, "this machine has no card: buy one"};

template <class Thrown, class Work>
std::string error_of(Work&& work) {
  try {
    work();
  } catch (const Thrown& error) {
    return error.what();
  }
  return "no error";
}

TEST(DeviceChoice, WithoutAWordItIsThisProcessorAndNoCardIsLookedFor) {
  int looks = 0;
  DeviceRequest request = asks("cpu", {test::kept(), {}}, &looks);
  EXPECT_EQ(DeviceRequest().word, "cpu");
  const DeviceChoice choice = choose_device(request, block(), 1);
  EXPECT_FALSE(choice.maker);
  EXPECT_EQ(choice.note, "");
  EXPECT_EQ(looks, 0);
}

TEST(DeviceChoice, AWordThatIsNoneNamesThoseThatAre) {
  EXPECT_EQ(error_of<DeviceError>([] {
              check_device({"cuda", {}}, 1);
            }),
            "there is no processor 'cuda' to choose; write cpu, gpu or auto");
}

TEST(DeviceChoice, AGraphicsProcessorThatIsNotThereIsAnErrorForGpuAlone) {
  EXPECT_EQ(error_of<DeviceError>([] { check_device(asks("gpu", kNone), 1); }), kNone.missing);
  EXPECT_EQ(error_of<DeviceError>([] {
              check_device({"gpu", {}}, 1);
            }),
            "this program has no steps for a graphics processor; leave the option out");
  EXPECT_NO_THROW(check_device(asks("auto", kNone), 1));
  const DeviceChoice choice = choose_device(asks("auto", kNone), block(), 1);
  EXPECT_FALSE(choice.maker);
  EXPECT_EQ(choice.note, "device auto: this processor takes the steps, since this machine has no card: buy one");
}

TEST(DeviceChoice, OneThatIsThereTakesASceneThatRunsThere) {
  for (const char* word : {"gpu", "auto"}) {
    const DeviceChoice choice = choose_device(asks(word, {test::kept(), {}}), block(), 1);
    ASSERT_TRUE(choice.maker);
    EXPECT_EQ(choice.note, std::string("device ") + word + ": a fake card takes the steps");
  }
}

TEST(DeviceChoice, ASceneThatDoesNotRunThereIsRefusedOrTakenByThisOne) {
  SimulationDefinition d = block();
  d.method.average_dilatation = true;
  const std::string why =
      "steps on a graphics processor and averaged dilatation do not go together: there are no kernels for that yet";
  EXPECT_EQ(error_of<DefinitionError>([&] {
              choose_device(asks("gpu", {test::kept(), {}}), d, 1);
            }),
            "--device: " + why + "; run it with --device cpu");
  int looks = 0;
  const DeviceChoice choice = choose_device(asks("auto", {test::kept(), {}}, &looks), d, 1);
  EXPECT_FALSE(choice.maker);
  EXPECT_EQ(choice.note, "device auto: this processor takes the steps, since " + why);
  EXPECT_EQ(looks, 0);  // no card is opened for it
}

TEST(DeviceChoice, SeveralProcessesAreRefusedBeforeAScene) {
  const std::string why =
      "steps on a graphics processor and several processes do not go together: such a processor takes the steps of one "
      "process";
  EXPECT_EQ(error_of<DeviceError>([] {
              check_device(asks("gpu", {test::kept(), {}}), 2);
            }),
            why + "; start one process, or run it with --device cpu");
  EXPECT_EQ(choose_device(asks("auto", {test::kept(), {}}), block(), 2).note,
            "device auto: this processor takes the steps, since " + why);
}

// Only an assembled run shows how much memory it takes.
TEST(DeviceChoice, OneThatCannotBeginTheRunIsAnErrorOrLeavesItToThisOne) {
  StepsBy by;
  SimulationOptions options;
  options.threads = 1;
  EXPECT_EQ(error_of<DeviceError>([&] {
              make_simulation(asks("gpu", {test::too_small(), {}}), block, options, by);
            }),
            "400 particles need more memory than is free: about 100 particles would fit");
  Simulation here = make_simulation(asks("auto", {test::too_small(), {}}), block, options, by);
  EXPECT_EQ(by.device, "");
  EXPECT_EQ(by.note,
            "device auto: this processor takes the steps, since 400 particles need more memory than is free: about 100 "
            "particles would fit");
  Simulation plain(block(), options);
  for (Simulation* run : {&here, &plain}) run->advance();
  EXPECT_EQ(here.state_hash(), plain.state_hash());  // a run as without the word
  make_simulation(asks("auto", {test::kept(), {}}), block, options, by);
  EXPECT_EQ(by.device, "a fake card");
}

// Lost in a step, or when the particles are read: either way the run ends, and what reads them says so again.
TEST(DeviceChoice, OneThatIsLostEndsTheRun) {
  for (const bool in_step : {true, false}) {
    SimulationOptions options;
    options.threads = 1;
    options.device = test::lost_after(4, in_step);
    Simulation run(block(), options);
    const auto advance = [&] {
      for (int period = 0; period < 20; ++period) {
        run.advance();
        run.state();
      }
    };
    EXPECT_EQ(error_of<PhysicsError>(advance), test::LossDevice::kWhy) << in_step;
    EXPECT_EQ(error_of<PhysicsError>([&] { run.state(); }), test::LossDevice::kWhy) << in_step;
    EXPECT_EQ(error_of<PhysicsError>([&] { run.state_hash(); }), test::LossDevice::kWhy) << in_step;
  }
}

}  // namespace device_choice_test
}  // namespace mpm
