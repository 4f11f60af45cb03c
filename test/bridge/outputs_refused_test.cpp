// Refusal of what run_scene cannot mean, or write to, before it runs, also by --explain; a bag that is removed under it
// is noticed.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

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

// Files in a folder for tables or pictures may be links to something else. The first are opened before
// the run, those of a snapshot in it.
TEST(OutputsRefused, LinksToDevicesInFolders) {
  const TemporaryFolder folder;
  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  int number = 0;
  const auto expect_link_refused = [&](std::string RunSceneOptions::*option, const std::string& file,
                                       RunSceneResult result) {
    for (const std::string& target : {std::string("/dev/null"), pipe}) {
      const std::string outputs = folder.file(std::to_string(++number));
      std::filesystem::create_directory(outputs);
      std::filesystem::create_symlink(target, outputs + "/" + file);
      RunSceneOptions options = press();
      options.*option = outputs;
      const Told told = run(options);
      EXPECT_EQ(told.result, result) << file << ": " << told.errors;
      EXPECT_NE(told.errors.find(outputs + "/" + file + ": cannot be written: it is a device, a pipe or a socket"),
                std::string::npos)
          << told.errors;
    }
  };
  expect_link_refused(&RunSceneOptions::csv, "particles.csv", RunSceneResult::bad_input);
  expect_link_refused(&RunSceneOptions::csv, "particles_0001.csv", RunSceneResult::machine_failed);
  expect_link_refused(&RunSceneOptions::vtk, "run.pvd", RunSceneResult::bad_input);
  expect_link_refused(&RunSceneOptions::vtk, "particles_0001.vtp", RunSceneResult::machine_failed);
}

/// A user who may not write everywhere, as long as the object exists: where the tests run as root, the user nobody.
class NoRoot {
 public:
  NoRoot() : root_(getuid() == 0) {
    if (root_ && setresuid(kNobody, kNobody, 0) != 0) ADD_FAILURE() << "still root";
  }
  ~NoRoot() {
    if (root_ && setresuid(0, 0, 0) != 0) ADD_FAILURE() << "not root any more";
  }

 private:
  static constexpr uid_t kNobody = 65534;
  bool root_;
};

TEST(OutputsRefused, FoldersThatMayNotBeWritten) {
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  const std::string closed = folder.file("closed"), scene = folder.file("press.yaml");
  fs::copy_file(data_file("press.yaml"), scene);
  fs::create_directory(closed);
  std::ofstream(closed + "/old.json") << "{}";
  fs::permissions(folder.file("."), fs::perms(0755));
  fs::permissions(scene, fs::perms(0644));
  fs::permissions(closed + "/old.json", fs::perms(0444));
  fs::permissions(closed, fs::perms(0555));
  const auto expect_closed = [&](std::string RunSceneOptions::*option, const std::string& name,
                                 const std::string& text) {
    RunSceneOptions options = press();
    options.scene = scene;
    options.*option = closed + name;
    const NoRoot nobody;
    expect_refused(options, text);
  };
  const std::string may_not = "Permission denied", advice = "choose another";
  expect_closed(&RunSceneOptions::bag, "/run.bag", "is not writable; " + advice);
  expect_closed(&RunSceneOptions::csv, "", "no file can be made in the folder: " + may_not);
  expect_closed(&RunSceneOptions::csv, "/csv", may_not + "; " + advice);
  expect_closed(&RunSceneOptions::vtk, "", "no file can be made in the folder: " + may_not);
  expect_closed(&RunSceneOptions::vtk, "/vtk", may_not + "; " + advice);
  expect_closed(&RunSceneOptions::summary, "/run.json", "cannot be written: " + may_not + "; check the folder");
  expect_closed(&RunSceneOptions::summary, "/old.json", "cannot be written: " + may_not + "; check the folder");
  expect_closed(&RunSceneOptions::checkpoint, "/run.h5", "cannot be written: " + may_not + "; check the folder");
  expect_closed(&RunSceneOptions::out, "", may_not + "); " + advice);
}

/// As long as the object exists, the process may have this much memory [bytes].
class LittleMemory {
 public:
  explicit LittleMemory(rlim_t bytes) {
    getrlimit(RLIMIT_AS, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_AS, &limit);
  }
  ~LittleMemory() { setrlimit(RLIMIT_AS, &before_); }

 private:
  rlimit before_{};
};

/// Address space of this process [bytes].
rlim_t memory_taken() {
  std::ifstream pages("/proc/self/statm");
  rlim_t number = 0;
  pages >> number;
  return number * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

// The block is 0.1 m wide: 200 cells with 8 particles each along each edge are 64 million, 50 cells one million.
TEST(OutputsRefused, MoreParticlesThanMemory) {
  RunSceneOptions options = press();
  options.scene = "elastic_block";
  options.set = {"grid.cell=0.0005"};
  {
    const LittleMemory memory(4'000'000'000);
    expect_refused(options,
                   "bodies.block.shape: with body 'block' there would be about 6.4e+07 particles, which need ");
    expect_refused(options, " GB of memory; 4 GB can be had here: make grid.cell larger");
  }
  options.set = {"grid.cell=0.002"};
  const LittleMemory memory(memory_taken() + 150'000'000);
  expect_refused(options, "there is not enough memory for its 1e+06 particles, which need at least 0.2");
}

}  // namespace outputs_refused_test
}  // namespace mpm_ros::test
