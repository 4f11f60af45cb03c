// What run_scene cannot mean, or write to, is refused before it runs, also by --explain; a bag that is removed under it
// is noticed.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "mpm_ros/report/temporary_folder.hpp"
#include "mpm_ros/run/run_scene.hpp"
#include "test_files.hpp"

namespace mpm_ros::test {
namespace outputs_refused_test {

RunSceneOptions press() {
  RunSceneOptions options;
  options.scene = data_file("press.yaml");
  options.threads = 1;
  options.end = "0.02";
  return options;
}

struct Told {
  RunSceneResult result;
  std::string errors;
};

Told run(const RunSceneOptions& options) {
  std::ostringstream out, err;
  const RunSceneResult result = run_scene(options, out, err, false, [] { return false; });
  return {result, err.str()};
}

void expect_refused(const RunSceneOptions& options, const std::string& text) {
  const Told told = run(options);
  EXPECT_EQ(told.result, RunSceneResult::bad_input) << told.errors;
  EXPECT_NE(told.errors.find(text), std::string::npos) << told.errors;
  EXPECT_EQ(std::count(told.errors.begin(), told.errors.end(), '\n'), 1) << told.errors;
}

TEST(OutputsRefused, DevicesPipesAndFolders) {
  const TemporaryFolder folder;
  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& name : {std::string("/dev/null"), pipe}) {
    RunSceneOptions options = press();
    options.bag = name;
    expect_refused(options, name + ": cannot be written: it is a device, a pipe or a socket");
    options = press();
    options.checkpoint = name;
    expect_refused(options, name + ": cannot be written: it is a device, a pipe or a socket");
    options = press();
    options.summary = name;
    expect_refused(options, name + ": cannot be written: it is a device, a pipe or a socket");
    EXPECT_FALSE(std::filesystem::is_regular_file(name));
  }
  std::filesystem::create_directory(folder.file("folder"));
  RunSceneOptions options = press();
  options.checkpoint = folder.file("folder");
  expect_refused(options, "it is a folder");
  for (const std::string& name : {std::string("/dev/null"), pipe}) {
    options = press();
    options.csv = name;
    EXPECT_EQ(run(options).result, RunSceneResult::bad_input);
    options = press();
    options.vtk = name;
    EXPECT_EQ(run(options).result, RunSceneResult::bad_input);
  }
}

TEST(OutputsRefused, APipeIsNoCheckpoint) {
  const TemporaryFolder folder;
  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  RunSceneOptions options;
  options.resume = pipe;  // opening it would wait for a writer
  expect_refused(options, "it is a device, a pipe or a socket");
}

TEST(OutputsRefused, EndsThatCannotBeMeant) {
  for (const char* end : {"1e-300", "1e300", "0", "-1", "nan"}) {
    RunSceneOptions options = press();
    options.end = end;
    expect_refused(options, "--end");
  }
}

TEST(OutputsRefused, AnEndBeforeTheCheckpoint) {
  const TemporaryFolder folder;
  RunSceneOptions options = press();
  options.checkpoint = folder.file("run.h5");
  ASSERT_EQ(run(options).result, RunSceneResult::done);
  RunSceneOptions further = press();
  further.scene.clear();
  further.resume = options.checkpoint;
  further.end = "0.01";
  expect_refused(further, "--end: '0.01' is before the checkpoint's time of 0.02 s");
  further.end = "0.02";
  const Told told = run(further);
  EXPECT_EQ(told.result, RunSceneResult::done);
  EXPECT_NE(told.errors.find("where the run ends already; nothing is computed"), std::string::npos) << told.errors;
}

TEST(OutputsRefused, MoreThreadsThanThereCanBe) {
  RunSceneOptions options = press();
  options.threads = 99999;
  expect_refused(options, "99999 threads are asked for; at most 1024");
}

TEST(OutputsRefused, ExplainChecksWhatARunChecks) {
  std::ostringstream out;
  RunSceneOptions options = press();
  options.set = {"output.particle_fields=[vx, z]"};
  try {
    explain_scene(options, out);
    FAIL() << out.str();
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("particle field 'z' is always written"), std::string::npos);
  }
  expect_refused(options, "particle field 'z' is always written");
}

// The folder goes at the first look whether the run is to stop, before the sixth of the sync periods.
TEST(OutputsRefused, ABagThatIsRemovedEndsTheRun) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("bags"));
  RunSceneOptions options = press();
  options.bag = folder.file("bags/run.bag");
  const auto open_files = [] {
    const std::filesystem::directory_iterator files("/proc/self/fd");
    return std::distance(begin(files), end(files));
  };
  const auto before = open_files();
  std::ostringstream out, err;
  int looks = 0;
  const auto result = run_scene(options, out, err, false, [&] {
    if (++looks == 5) std::filesystem::remove_all(folder.file("bags"));
    return false;
  });
  EXPECT_EQ(result, RunSceneResult::machine_failed) << err.str();
  EXPECT_NE(err.str().find("run.bag: it is not there any more"), std::string::npos) << err.str();
  EXPECT_EQ(open_files(), before);
}

}  // namespace outputs_refused_test
}  // namespace mpm_ros::test
