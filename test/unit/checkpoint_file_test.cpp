// Checkpoint files: their description; a file that does not fit the run, or is damaged, is refused with the reason and
// leaves the simulation unchanged.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "checkpoint_run.hpp"
#include "full_disk.hpp"
#include "mpm/checkpoint/checkpoint.hpp"

#ifdef __SANITIZE_ADDRESS__
extern "C" std::size_t __sanitizer_get_current_allocated_bytes();  // gcc ships no header for it
#endif

namespace mpm::test {
namespace checkpoint_file_test {

namespace fs = std::filesystem;

std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const CheckpointError& error) {
    return error.what();
  }
  return "not refused";
}

class BadCheckpoint : public testing::Test {
 protected:
  BadCheckpoint() : simulation_(definition_of(plane_), {1}) {
    run(simulation_, 0, 2);
    save_checkpoint(file_, simulation_, {"plane.yaml", kPlane, {}});
  }
  std::string load(const std::string& text = kPlane) {
    return refusal([&] { load_checkpoint(file_, simulation_, text); });
  }
  void expect_refused(const std::string& reason, const std::string& text = kPlane) {
    const std::uint64_t before = simulation_.memory_hash();
    const std::string answer = load(text);
    EXPECT_NE(answer.find(reason), std::string::npos) << answer;
    EXPECT_NE(answer.find(file_), std::string::npos) << answer;
    EXPECT_EQ(answer.find('\n'), std::string::npos) << answer;
    EXPECT_EQ(simulation_.memory_hash(), before);
  }

  const Folder folder_;
  const std::string file_ = folder_.file("run.h5");
  const Case plane_{"plane", kPlane, {}};
  Simulation simulation_;
};

TEST_F(BadCheckpoint, SaysOfItselfWhatItIs) {
  const CheckpointAbout about = read_checkpoint(file_);
  EXPECT_EQ(about.version, kCheckpointVersion);
  EXPECT_EQ(about.label.scene_text, kPlane);
  EXPECT_EQ(about.label.scene_path, "plane.yaml");
  EXPECT_EQ(about.particles, simulation_.particles());
  EXPECT_EQ(about.time, simulation_.time());
  EXPECT_EQ(about.state_hash, simulation_.state_hash());
  EXPECT_EQ(about.isa, simulation_.isa());
}

TEST_F(BadCheckpoint, IsNotThere) {
  fs::remove(file_);
  expect_refused("no such file");
}

TEST_F(BadCheckpoint, IsNotHdf5) {
  std::ofstream(file_) << "grid: {cell: 0.1}\n";
  expect_refused("it is no HDF5 file");
}

TEST_F(BadCheckpoint, IsOtherHdf5) {
  const hid_t file = H5Fcreate(file_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(file);
  expect_refused("no checkpoint");
}

TEST_F(BadCheckpoint, IsCutOff) {
  fs::resize_file(file_, fs::file_size(file_) / 2);
  expect_refused("cut off or damaged");
}

/// Overwrites a number of the file, as a later version would write it.
void overwrite(const std::string& path, const char* name, hid_t type, const void* value) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
  ASSERT_GE(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value), 0) << name;
  H5Dclose(set);
  H5Fclose(file);
}

/// Ends the program as std::exit() does, but for the leak sanitizer: what the library leaves open it does not free
/// either.
[[noreturn]] void end_well() {
#ifdef __SANITIZE_ADDRESS__
  H5close();
  std::_Exit(0);
#else
  std::exit(0);
#endif
}

// A damaged header of an array leaves the library with parts of the file open, of which it would tell at the end of the
// program.
TEST_F(BadCheckpoint, IsToldOfByUsAlone) {
  std::ifstream file(file_, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const std::size_t header = bytes.find("OHDR", bytes.size() / 2);
  ASSERT_LT(header, bytes.size() - 20);
  bytes[header + 20] = static_cast<char>(~bytes[header + 20]);
  std::ofstream(file_, std::ios::binary) << bytes;
  EXPECT_EXIT(
      {
        expect_refused("it has no '");
        end_well();
      },
      testing::ExitedWithCode(0), "^$");
}

TEST_F(BadCheckpoint, IsOfAnotherVersion) {
  const std::uint32_t version = kCheckpointVersion + 1;
  overwrite(file_, "about/version", H5T_NATIVE_UINT32, &version);
  expect_refused("its layout is version " + std::to_string(version) + ", this program reads version " +
                 std::to_string(kCheckpointVersion));
}

TEST_F(BadCheckpoint, IsOfAnotherScene) {
  std::string text = kPlane;
  text.replace(text.find("friction: 0.4"), 13, "friction: 0.5");
  expect_refused(
      "line 9 is 'boundaries: {z_min: {friction: 0.4}}' there and 'boundaries: {z_min: {friction: 0.5}}' here", text);
}

TEST_F(BadCheckpoint, IsOfOtherParticles) {
  Simulation other(definition_of({"", kPair, {}}), {1});
  const std::string answer = refusal([&] { load_checkpoint(file_, other, kPlane); });
  EXPECT_NE(answer.find("64 particles"), std::string::npos) << answer;
  EXPECT_EQ(other.time(), 0);
}

TEST_F(BadCheckpoint, IsOfAnotherPrecision) {
  Simulation other(definition_of({"", kPlane, {"method.precision=single"}}), {1});
  const std::string answer = refusal([&] { load_checkpoint(file_, other, kPlane); });
  EXPECT_NE(answer.find("single precision"), std::string::npos) << answer;
}

TEST_F(BadCheckpoint, IsOfAnotherInstructionSet) {
  // A text of the same length replaces the name of the instruction set.
  const std::string there = simulation_.isa(), other(there.size(), 'x');
  overwrite(file_, "about/isa", H5T_NATIVE_UINT8, other.data());
  expect_refused("start it with --isa " + other);
}

TEST_F(BadCheckpoint, IsOfAFailedRun) {
  save_checkpoint(file_, simulation_, {"plane.yaml", kPlane, "the volume ratio J is not positive"});
  expect_refused("cannot go on (the volume ratio J is not positive)");
}

TEST_F(BadCheckpoint, HoldsOtherNumbersThanWereSaved) {
  const double other = 0.25;
  overwrite(file_, "simulation/total_mass", H5T_NATIVE_DOUBLE, &other);
  EXPECT_NE(load().find("the file is damaged"), std::string::npos);
}

TEST_F(BadCheckpoint, HasAByteThatFlipped) {
  // Positions lie in the file as in memory: one byte of a position, found by its value, is damaged.
  std::vector<double> x;
  simulation_.particle_field("x", x);
  std::fstream file(file_, std::ios::in | std::ios::out | std::ios::binary);
  const std::string all((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const std::size_t at = all.find(std::string(reinterpret_cast<const char*>(&x[20]), sizeof x[20]));
  ASSERT_NE(at, std::string::npos);
  file.clear();
  file.seekp(static_cast<std::streamoff>(at));
  file.put(static_cast<char>(all[at] ^ 1));
  file.close();
  EXPECT_NE(load().find("cut off or damaged"), std::string::npos);
}

TEST_F(BadCheckpoint, CannotBeWrittenThere) {
  const std::string answer = refusal([&] {
    save_checkpoint(folder_.file("none/run.h5"), simulation_, {"plane.yaml", kPlane, {}});
  });
  EXPECT_NE(answer.find("cannot be written: No such file or directory"), std::string::npos) << answer;
}

// A checkpoint that cannot be completed leaves the previous file unchanged and no other file beside it.
TEST_F(BadCheckpoint, LeavesTheOneBefore) {
  const std::uint64_t hash = read_checkpoint(file_).state_hash;
  run(simulation_, 2, 3);
  const auto breaks = [](StateArchive&) { throw CheckpointError("no more room"); };
  EXPECT_EQ(refusal([&] { save_checkpoint(file_, simulation_, {"plane.yaml", kPlane, {}}, breaks); }), "no more room");
  EXPECT_EQ(read_checkpoint(file_).state_hash, hash);
  EXPECT_FALSE(fs::exists(file_ + ".part"));
}

/// Memory that this process holds [kB]: its resident memory, but with the address sanitizer, which keeps what was given
/// back, that which is allocated.
double memory() {
#ifdef __SANITIZE_ADDRESS__
  return static_cast<double>(__sanitizer_get_current_allocated_bytes()) / 1024.0;
#else
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmRSS:", 0) == 0) return std::stod(line.substr(6));
  }
  return 0.0;
#endif
}

// HDF5 keeps a file that it cannot close: a hundred of them held 240 MB.
TEST_F(BadCheckpoint, FullDisksCostNoMemory) {
  const mpm_ros::test::FullDisk full(4000);
  const auto fail = [&] {
    return refusal([&] { save_checkpoint(folder_.file("full.h5"), simulation_, {"plane.yaml", kPlane, {}}); });
  };
  for (int i = 0; i < 10; ++i) EXPECT_NE(fail().find("cannot be written whole (File too large)"), std::string::npos);
  const double before = memory();
  for (int i = 0; i < 100; ++i) fail();
  EXPECT_LT(memory() - before, 1000.0);
  EXPECT_FALSE(fs::exists(folder_.file("full.h5.part")));
}

// HDF5 tries to write such a file again when the process ends, and it says so on the terminal.
TEST_F(BadCheckpoint, FullDisksEndInSilence) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(
      {
        const mpm_ros::test::FullDisk full(4000);
        refusal([&] { save_checkpoint(folder_.file("full.h5"), simulation_, {"plane.yaml", kPlane, {}}); });
        refusal([&] { load_checkpoint("/dev/null", simulation_, kPlane); });
        std::exit(0);
      },
      testing::ExitedWithCode(0), "^$");
}

TEST_F(BadCheckpoint, IsNoRegularFile) {
  EXPECT_NE(refusal([&] {
              save_checkpoint("/dev/null", simulation_, {"plane.yaml", kPlane, {}});
            }).find("cannot be written: it is a device"),
            std::string::npos);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

}  // namespace checkpoint_file_test
}  // namespace mpm::test
