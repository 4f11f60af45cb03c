// Recordings that are split, replaced, ended by a full disk, and run again from the bag alone.
#include <gtest/gtest.h>
#include <rosbag/view.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "full_disk.hpp"
#include "mpm_ros/message/bag_parts.hpp"
#include "mpm_ros/message/topics.hpp"
#include "mpm_ros/record/output_names.hpp"
#include "mpm_ros/report/report.hpp"
#include "mpm_ros/report/report_bag.hpp"
#include "mpm_ros/run/run.hpp"
#include "mpm_ros/run/run_scene.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace recording_test {

namespace fs = std::filesystem;

const std::string kPress = data_file("press.yaml");

/// Runs 0.2 s in sync periods of 2 ms, with commands of both kinds; returns the state hash at the end.
std::uint64_t press_run(const std::string& bag, const BagOptions& bag_options = {},
                        const std::vector<std::string>& set = {}) {
  const mpm::Scene scene = mpm::load_scene(kPress, set);
  RunOptions options;
  options.threads = 1;
  options.output = output_options(scene);
  options.bag = bag;
  options.bag_options = bag_options;
  mpm_ros::Run run(scene, options, Stamps(), nullptr);
  run.begin();
  AppliedCommand command;
  command.body = run.simulation().find_body("plate");
  command.twist.linear.z() = -0.1;
  run.apply(command);
  bool posed = false;
  while (!run.ended()) {
    if (!posed && run.simulation().time() >= 120'000'000) {
      command.kind = CommandKind::pose;
      command.twist = {};
      command.pose.position = {0.1, 0.0, 0.058};
      command.effect = run.simulation().time();
      command.arrival = command.effect + 5 * run.simulation().sync_period();
      run.apply(command);
      posed = true;
    }
    run.advance();
  }
  run.finish();
  return run.simulation().state_hash();
}

/// Counts the messages of a recording.
class Counter : public RunVisitor {
 public:
  void bodies(std::int64_t time, const BodyStates&) override { times.push_back(time); }
  void solver_state(std::int64_t, const SolverState& message) override {
    ++states;
    hash = message.state_hash;
  }
  void command(std::int64_t, const mpm_ros::Command&) override { ++commands; }
  void particles(std::int64_t time, const sensor_msgs::PointCloud2&) override { clouds.push_back(time); }
  void markers(const visualization_msgs::MarkerArray&) override { ++shapes; }
  std::vector<std::int64_t> times, clouds;
  int states = 0, commands = 0, shapes = 0;
  std::string hash;
};

Counter read_all(const std::string& path) {
  Counter counter;
  RunBag bag(path, "");
  bag.read({&counter});
  return counter;
}

TEST(Recording, PartsAreInTheOrderOfTheirNames) {
  EXPECT_EQ(part_path("a/run.bag", 1), "a/run.bag");
  EXPECT_EQ(part_path("a/run.bag", 2), "a/run_part0002.bag");
  std::vector<std::string> names;
  for (int part = 1; part < 1200; ++part) names.push_back(part_path("run.bag", part));
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
}

TEST(Recording, IsSplitByTimeAndReadsLikeOneBag) {
  const TemporaryFolder folder;
  press_run(folder.file("whole.bag"));
  BagOptions options;
  options.split_duration = 50'000'000;
  press_run(folder.file("split.bag"), options);

  const std::vector<std::string> parts = parts_of(folder.file("split.bag"));
  // Parts end at 0.05, 0.1, 0.15 and 0.2 s; nothing is left for a fifth part.
  ASSERT_EQ(parts.size(), 4U);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    rosbag::Bag bag(parts[i]);
    rosbag::View view(bag);
    // All messages of a sync point are in one part, so a part ends at a multiple of 0.05 s.
    EXPECT_EQ(view.getEndTime().toNSec(), 50'000'000U * (i + 1)) << parts[i];
    std::map<std::string, int> latched;
    for (const rosbag::MessageInstance& message : view) {
      if (const auto info = message.instantiate<RunInfo>()) {
        EXPECT_EQ(info->part, i + 1);
      }
      const std::string topic = message.getTopic();
      if (topic == "/mpm/run_info" || topic == "/mpm/markers") {
        ++latched[topic];
        EXPECT_EQ(message.getTime(), view.getBeginTime()) << parts[i];  // the first message, and not of an earlier time
      }
    }
    EXPECT_EQ(latched["/mpm/run_info"], 1) << parts[i];
    EXPECT_EQ(latched["/mpm/markers"], 1) << parts[i];
    read_all(parts[i]);  // each part alone has the topics and the start
  }

  const Counter whole = read_all(folder.file("whole.bag")), split = read_all(folder.file("split.bag"));
  EXPECT_EQ(whole.times.size(), 101U);
  EXPECT_EQ(split.times, whole.times);
  EXPECT_EQ(split.clouds, whole.clouds);
  EXPECT_EQ(split.states, whole.states);
  EXPECT_EQ(split.commands, 2);
  EXPECT_EQ(split.shapes, 1);
  EXPECT_EQ(split.hash, whole.hash);

  ReportOptions report;
  report.bags = {folder.file("split.bag")};
  report.check = true;
  std::ostringstream out, err;
  EXPECT_EQ(run_report(report, out, err, false), ReportResult::done) << out.str() << err.str();
}

TEST(Recording, IsSplitBySize) {
  const TemporaryFolder folder;
  BagOptions options;
  options.split_size = 100'000;
  press_run(folder.file("split.bag"), options);
  const std::vector<std::string> parts = parts_of(folder.file("split.bag"));
  ASSERT_GT(parts.size(), 2U);
  // A part ends at the first sync point beyond the size: all but the last reach it, and exceed it by less than a sync
  // point. The largest sync point has particles, about 12 kB; the index at the end is smaller than the messages.
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    EXPECT_GE(fs::file_size(parts[i]), 100'000U) << parts[i];
    EXPECT_LE(fs::file_size(parts[i]), 200'000U) << parts[i];
  }
  EXPECT_EQ(read_all(folder.file("split.bag")).times.size(), 101U);
}

TEST(Recording, ReplacesAllPartsOfAnEarlierOne) {
  const TemporaryFolder folder;
  BagOptions options;
  options.split_duration = 20'000'000;
  press_run(folder.file("run.bag"), options);
  ASSERT_EQ(parts_of(folder.file("run.bag")).size(), 10U);
  std::ofstream(folder.file("run_2.bag")) << "after a reset";
  std::ofstream(folder.file("run_partly.bag")) << "of another name";
  options.split_duration = 100'000'000;
  {
    BagRecorder recorder(folder.file("run.bag"), options);
    EXPECT_TRUE(recorder.replaced());
  }
  EXPECT_EQ(parts_of(folder.file("run.bag")).size(), 1U);
  EXPECT_FALSE(fs::exists(folder.file("run_part0007.bag")));
  EXPECT_TRUE(fs::exists(folder.file("run_2.bag")));
  EXPECT_TRUE(fs::exists(folder.file("run_partly.bag")));
  EXPECT_FALSE(BagRecorder(folder.file("new.bag")).replaced());
}

TEST(Recording, APartOfAnotherRecordingIsRefused) {
  const TemporaryFolder folder;
  BagOptions options;
  options.split_duration = 100'000'000;
  press_run(folder.file("a.bag"), options);
  press_run(folder.file("b.bag"), options, {"contact.friction=0.3"});
  fs::copy_file(folder.file("b_part0002.bag"), folder.file("a_part0002.bag"), fs::copy_options::overwrite_existing);
  try {
    RunBag bag(folder.file("a.bag"), "");
    FAIL() << "not refused";
  } catch (const BagError& error) {
    EXPECT_NE(std::string(error.what()).find("a_part0002.bag is no part of this recording"), std::string::npos)
        << error.what();
  }
}

using test::FullDisk;

/// A cloud at each of 501 sync points: about 3 MB.
const std::vector<std::string> kLarge = {"time.end=1", "time.sync=0.002", "output.period=0.002"};

TEST(Recording, AFullDiskIsNamedAndWhatIsThereCanBeRead) {
  const TemporaryFolder folder;
  const std::string bag = folder.file("run.bag");
  std::string problem;
  {
    const FullDisk disk(2'000'000);
    try {
      press_run(bag, {}, kLarge);
    } catch (const BagError& error) {
      problem = error.what();
    }
  }
  EXPECT_NE(problem.find(bag), std::string::npos) << problem;
  EXPECT_NE(problem.find("File too large"), std::string::npos) << problem;  // the system's own words
  EXPECT_NE(problem.find("rosbag reindex"), std::string::npos) << problem;
  EXPECT_EQ(problem.find('\n'), std::string::npos) << problem;
  const Counter counter = read_all(bag);
  ASSERT_GT(counter.times.size(), 1U);
  // Without a gap from the start, and to within a chunk (768 kB) of the 2 MB that the disk holds.
  for (std::size_t i = 0; i < counter.times.size(); ++i) EXPECT_EQ(counter.times[i], 2'000'000 * std::int64_t(i));
  press_run(folder.file("whole.bag"), {}, kLarge);
  const double each =
      static_cast<double>(fs::file_size(folder.file("whole.bag"))) / 501.0;  // bytes for each sync point
  EXPECT_GE(static_cast<double>(counter.times.size()) * each, 2e6 - 768.0 * 1024.0 - 2.0 * each);
}

TEST(Recording, TheRunGoesOnWithoutARecordThatIsNotRequired) {
  const TemporaryFolder folder;
  BagOptions options;
  options.required = false;
  const std::uint64_t hash = press_run("", {}, kLarge);
  const FullDisk disk(1'000'000);
  EXPECT_EQ(press_run(folder.file("run.bag"), options, kLarge), hash);
}

TEST(Recording, FirstSnapshotAndPeriod) {
  const TemporaryFolder folder;
  press_run(folder.file("run.bag"), {}, {"output.first=0.05"});
  // The start; every 0.02 s from 0.05 s on; the end.
  std::vector<std::int64_t> expected = {0};
  for (std::int64_t time = 50'000'000; time < 200'000'000; time += 20'000'000) expected.push_back(time);
  expected.push_back(200'000'000);
  EXPECT_EQ(read_all(folder.file("run.bag")).clouds, expected);
}

TEST(Recording, NamesOfItsOwn) {
  const TemporaryFolder folder;
  EXPECT_EQ(bag_path("a.bag", "press", 2, "bags"), "bags/a_2.bag");
  EXPECT_EQ(bag_path("/tmp/a.bag", "press", 1, "bags"), "/tmp/a.bag");
  const std::string first = bag_path("auto", "press", 1, folder.path());
  std::ofstream(first) << "there";
  EXPECT_NE(bag_path("auto", "press", 1, folder.path()), first);
  EXPECT_NE(make_run_folder(folder.file("runs"), "press"), make_run_folder(folder.file("runs"), "press"));
}

// ---------------------------------------------------------------------------------------------- run_scene --from-bag

struct Outcome {
  RunSceneResult result;
  std::string out, err;
};

Outcome run(const RunSceneOptions& options) {
  std::ostringstream out, err;
  const RunSceneResult result = run_scene(options, out, err, false, [] { return false; });
  return {result, out.str(), err.str()};
}

RunSceneOptions from_bag(const std::string& bag) {
  RunSceneOptions options;
  options.from_bag = bag;
  options.threads = 2;
  return options;
}

TEST(FromBag, EndsInTheRecordedState) {
  const TemporaryFolder folder;
  BagOptions split;
  split.split_duration = 50'000'000;
  press_run(folder.file("run.bag"), split, {"contact.friction=0.4"});
  RunSceneOptions options = from_bag(folder.file("run.bag"));
  options.bag = folder.file("again.bag");
  const Outcome outcome = run(options);
  EXPECT_EQ(outcome.result, RunSceneResult::done) << outcome.err;
  EXPECT_NE(outcome.out.find("equal to the recorded one"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.err.find("2 commands, to t = 0.2 s"), std::string::npos) << outcome.err;
  // The recording of that run replays as well.
  const Outcome third = run(from_bag(folder.file("again.bag")));
  EXPECT_EQ(third.result, RunSceneResult::done) << third.err;
  EXPECT_NE(third.out.find("equal to the recorded one"), std::string::npos) << third.out;
}

// Repeats the sweeps that the recording says were made before the clock ended them.
TEST(FromBag, SweepsEndWhereABudgetHasEndedThem) {
  const TemporaryFolder folder;
  RunSceneOptions options;
  options.scene = data_file("implicit_blade.yaml");
  options.set = {"time.budget=1 ns"};
  options.threads = 1;
  options.bag = folder.file("run.bag");
  const Outcome first = run(options);
  EXPECT_EQ(first.result, RunSceneResult::done) << first.err;
  EXPECT_NE(first.err.find("time.budget: 1e-06 ms is too little: with 10 sweeps in a step"), std::string::npos)
      << first.err;
  EXPECT_NE(first.err.find("no two runs have the same bits"), std::string::npos) << first.err;
  const Outcome again = run(from_bag(options.bag));
  EXPECT_EQ(again.result, RunSceneResult::done) << again.err;
  EXPECT_NE(again.out.find("equal to the recorded one"), std::string::npos) << again.out;
  EXPECT_NE(again.err.find("time.budget: the sweeps of 50 steps end as recorded"), std::string::npos) << again.err;
}

TEST(FromBag, AnotherRunIsNotCompared) {
  const TemporaryFolder folder;
  press_run(folder.file("run.bag"));
  RunSceneOptions options = from_bag(folder.file("run.bag"));
  options.set = {"contact.friction=0.5"};
  const Outcome outcome = run(options);
  EXPECT_EQ(outcome.result, RunSceneResult::done) << outcome.err;
  EXPECT_NE(outcome.out.find("not compared with the recording: --set changes the scene"), std::string::npos)
      << outcome.out;
}

TEST(FromBag, AnotherStateIsToldAndExitCodeThree) {
  const TemporaryFolder folder;
  press_run(folder.file("run.bag"));
  // A copy of the recording in which one command is faster by a thousandth.
  {
    rosbag::Bag source(folder.file("run.bag"));
    rosbag::Bag changed(folder.file("changed.bag"), rosbag::bagmode::Write);
    for (const rosbag::MessageInstance& message : rosbag::View(source)) {
      if (const auto command = message.instantiate<mpm_ros::Command>()) {
        mpm_ros::Command faster = *command;
        faster.twist.linear.z *= 1.001;
        changed.write(message.getTopic(), message.getTime(), faster);
      } else {
        changed.write(message.getTopic(), message.getTime(), message);
      }
    }
  }
  const Outcome outcome = run(from_bag(folder.file("changed.bag")));
  EXPECT_EQ(static_cast<int>(outcome.result), 3);
  EXPECT_NE(outcome.err.find("was recorded"), std::string::npos) << outcome.err;
}

TEST(FromBag, ARunThatFailedFailsAgain) {
  const TemporaryFolder folder;
  RunSceneOptions options;
  options.scene = data_file("leaves_domain.yaml");
  options.threads = 1;
  options.bag = folder.file("run.bag");
  ASSERT_EQ(run(options).result, RunSceneResult::physics_failed);
  const Outcome again = run(from_bag(folder.file("run.bag")));
  EXPECT_EQ(again.result, RunSceneResult::physics_failed);
  EXPECT_NE(again.out.find("equal to the recorded one"), std::string::npos) << again.out << again.err;
}

TEST(FromBag, AMeshThatIsGoneOrChangedIsNamed) {
  const TemporaryFolder folder;
  const auto write_mesh = [&](double height) {
    std::ofstream(folder.file("tool.obj"))
        << "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 " << height << "\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  };
  write_mesh(0.1);
  std::ofstream(folder.file("scene.yaml")) << R"(geometry: solid
grid: {cell: 0.05, min: [0, 0, 0], max: [0.4, 0.4, 0.4]}
time: {end: 0.01}
materials: [{name: foam, density: 1000, law: neo_hookean, young: 0.1 MPa, poisson: 0.3}]
bodies: [{name: block, material: foam, shape: {box: {min: [0.1, 0.1, 0], max: [0.3, 0.3, 0.1]}}}]
rigid_bodies: [{name: tool, shape: {mesh: {file: tool.obj}}, pose: {position: [0.2, 0.2, 0.2]}}]
)";
  RunSceneOptions options;
  options.scene = folder.file("scene.yaml");
  options.threads = 1;
  options.bag = folder.file("run.bag");
  ASSERT_EQ(run(options).result, RunSceneResult::done) << run(options).err;
  EXPECT_NE(run(from_bag(options.bag)).out.find("equal to the recorded one"), std::string::npos);

  write_mesh(0.11);
  const Outcome changed = run(from_bag(options.bag));
  EXPECT_EQ(changed.result, RunSceneResult::done);
  EXPECT_NE(changed.err.find("tool.obj has changed since the recording"), std::string::npos) << changed.err;
  EXPECT_NE(changed.out.find("not compared"), std::string::npos) << changed.out;

  fs::remove(folder.file("tool.obj"));
  const Outcome gone = run(from_bag(options.bag));
  EXPECT_EQ(gone.result, RunSceneResult::bad_input);
  EXPECT_NE(gone.err.find("tool.obj"), std::string::npos) << gone.err;
  EXPECT_EQ(gone.err.find('\n'), gone.err.size() - 1) << gone.err;
}

TEST(FromBag, BadInputIsOneLine) {
  const TemporaryFolder folder;
  press_run(folder.file("run.bag"), {}, {"time.end=0.02", "output.period=0.02"});
  const auto refused = [](const RunSceneOptions& options, const std::string& part) {
    const Outcome outcome = run(options);
    EXPECT_EQ(outcome.result, RunSceneResult::bad_input) << part;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
  };
  refused(from_bag(folder.file("none.bag")), "none.bag: no such file");
  RunSceneOptions options = from_bag(folder.file("run.bag"));
  options.scene = "falling_block";
  refused(options, "the bag holds its scene");
  options = from_bag(folder.file("run.bag"));
  options.bag = folder.file("run.bag");
  refused(options, "would overwrite the recording that is run again");
  for (const char* split : {"10", "fast", "-1 s", "0 MB", "5 m"}) {
    options = from_bag(folder.file("run.bag"));
    options.bag_split = split;
    refused(options, "--bag-split");
  }
}

TEST(FromBag, APartThatIsNotTheFirstIsRefused) {
  const TemporaryFolder folder;
  BagOptions split;
  split.split_duration = 100'000'000;
  press_run(folder.file("run.bag"), split);
  const Outcome outcome = run(from_bag(folder.file("run_part0002.bag")));
  EXPECT_EQ(outcome.result, RunSceneResult::bad_input);
  EXPECT_NE(outcome.err.find("first part"), std::string::npos) << outcome.err;
}

TEST(RunFolder, HoldsEverythingOfARun) {
  const TemporaryFolder folder;
  RunSceneOptions options;
  options.scene = kPress;
  options.threads = 1;
  options.set = {"time.end=0.02", "output.period=0.02"};
  options.out = folder.file("runs");
  for (int i = 0; i < 2; ++i) EXPECT_EQ(run(options).result, RunSceneResult::done) << run(options).err;
  int runs = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(options.out)) {
    ++runs;
    EXPECT_EQ(entry.path().filename().string().compare(0, 6, "press_"), 0) << entry.path();
    for (const char* name :
         {"run.bag", "summary.json", "scene.yaml", "csv/contact_forces.csv", "vtk/run.pvd", "vtk/particles_0000.vtp"}) {
      EXPECT_TRUE(fs::is_regular_file(entry.path() / name)) << entry.path() / name;
    }
    // The scene in it can be loaded.
    EXPECT_EQ(mpm::load_scene((entry.path() / "scene.yaml").string()).definition.time.end, 0.02);
  }
  EXPECT_EQ(runs, 2);
}

}  // namespace recording_test
}  // namespace mpm_ros
