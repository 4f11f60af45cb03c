// bag_report with unusable bags and options: exit code 2 and one line that says what to do; and with bags that were cut
// short, which it reads as far as they are intact.
#include <gtest/gtest.h>
#include <std_msgs/String.h>
#include <topic_tools/shape_shifter.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "mpm_ros/message/bag_damage.hpp"
#include "mpm_ros/report/report.hpp"
#include "mpm_ros/report/temporary_folder.hpp"
#include "report_run.hpp"

namespace mpm_ros {
namespace report_bad_input_test {

using test::HalfSineRun;
namespace fs = std::filesystem;

class ReportBadInput : public ::testing::Test {
 protected:
  std::string in_folder(const std::string& name) const { return folder_.file(name); }
  std::string bag_of(const HalfSineRun& run, const std::string& name = "run.bag") const {
    run.write(in_folder(name));
    return in_folder(name);
  }

  /// The program's error message, which must be one line that begins with its name.
  static std::string error_of(const ReportOptions& options) {
    std::ostringstream out, err;
    EXPECT_EQ(run_report(options, out, err, false), ReportResult::bad_input);
    std::string text = err.str();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
    EXPECT_EQ(text.rfind("bag_report: ", 0), 0U) << text;
    return text;
  }
  std::string error_of(const std::string& bag, const std::string& name_space = "") const {
    ReportOptions options;
    options.bags = {bag};
    options.name_space = name_space;
    return error_of(options);
  }
  /// The tables of a readable bag.
  static std::string text_of(const std::string& bag, const std::string& name_space = "") {
    ReportOptions options;
    options.bags = {bag};
    options.name_space = name_space;
    std::ostringstream out, err;
    EXPECT_EQ(run_report(options, out, err, false), ReportResult::done) << err.str();
    return out.str();
  }
  static bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  TemporaryFolder folder_;
};

TEST_F(ReportBadInput, NoFile) { EXPECT_TRUE(contains(error_of(in_folder("none.bag")), "no such file")); }

TEST_F(ReportBadInput, AFolder) { EXPECT_TRUE(contains(error_of(folder_.path()), "it is a folder; name a file")); }

TEST_F(ReportBadInput, AnEmptyFile) {
  std::ofstream(in_folder("empty.bag")).close();
  EXPECT_TRUE(contains(error_of(in_folder("empty.bag")), "an empty file"));
}

TEST_F(ReportBadInput, NotABag) {
  std::ofstream(in_folder("text.bag")) << "time [s],blade fx [N]\n0,0\n";
  EXPECT_TRUE(contains(error_of(in_folder("text.bag")), "not a bag"));
}

TEST_F(ReportBadInput, ABagWithoutMessages) {
  rosbag::Bag bag(in_folder("none.bag"), rosbag::bagmode::Write);
  bag.close();
  EXPECT_TRUE(contains(error_of(in_folder("none.bag")), "without messages"));
}

TEST_F(ReportBadInput, ABagOfAnotherKind) {
  rosbag::Bag bag(in_folder("other.bag"), rosbag::bagmode::Write);
  bag.write("/chatter", ros::Time(1.0), std_msgs::String());
  bag.close();
  EXPECT_TRUE(contains(error_of(in_folder("other.bag")), "no topic */solver_state of type mpm_ros/SolverState among"));
}

TEST_F(ReportBadInput, WithoutForces) {
  HalfSineRun run;
  run.on_forces = [](int, ContactForces&) { return false; };
  EXPECT_TRUE(contains(error_of(bag_of(run)), "no topic /mpm/contact_forces (mpm_ros/ContactForces); record it"));
}

TEST_F(ReportBadInput, WithoutBodies) {
  HalfSineRun run;
  run.on_bodies = [](int, BodyStates&) { return false; };
  EXPECT_TRUE(contains(error_of(bag_of(run)), "no topic /mpm/bodies"));
}

// Lengths and places that are not those of what is there: rosbag reads from, or asks for memory, as they say. The
// offset in an index ended the program with SIGSEGV.
TEST_F(ReportBadInput, LengthsAndPlacesThatAreWrong) {
  const std::string whole = bag_of(HalfSineRun());
  ASSERT_EQ(bag_damage(whole), "");
  std::ifstream file(whole, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const auto op = [&](char code) { return bytes.find(std::string("\x04\0\0\0op=", 7) + code); };
  constexpr std::size_t kOpField = 8, kVersionField = 12, kTime = 8;
  const std::size_t index = op(4) + kOpField + kVersionField;  // behind it the length of its data, its entries
  const std::pair<std::size_t, const char*> places[] = {
      {13, "longer than what it lies in"},       // the first record's header
      {index, "longer than what it lies in"},    // the data of an index
      {index + 4 + kTime, "where none begins"},  // the message that it names
  };
  for (const auto& [at, text] : places) {
    std::string damaged = bytes;
    damaged.replace(at, 4, "\xff\xff\xff\x7f");
    std::ofstream(in_folder("damaged.bag"), std::ios::binary) << damaged;
    const std::string error = error_of(in_folder("damaged.bag"));
    EXPECT_TRUE(contains(error, "damaged: the record at byte") && contains(error, text)) << at << ": " << error;
  }
}

TEST_F(ReportBadInput, MessagesOfAnotherVersion) {
  // The same type's name with another definition: another checksum.
  topic_tools::ShapeShifter old;
  old.morph("0123456789abcdef0123456789abcdef", "mpm_ros/SolverState", "float64 time\n", "");
  std::uint8_t bytes[8] = {};
  ros::serialization::IStream stream(bytes, sizeof bytes);
  old.read(stream);
  rosbag::Bag bag(in_folder("old.bag"), rosbag::bagmode::Write);
  HalfSineRun run;
  run.on_state = [](int, SolverState&) { return false; };
  run.with_info = false;
  run.write(bag);
  bag.write("/mpm/solver_state", ros::Time(1.0), old);
  bag.close();
  EXPECT_TRUE(contains(error_of(in_folder("old.bag")),
                       "mpm_ros/SolverState on /mpm/solver_state has another definition than here; read the bag with "
                       "the version of mpm_ros that recorded it"));
}

TEST_F(ReportBadInput, SeveralRuns) {
  rosbag::Bag bag(in_folder("two.bag"), rosbag::bagmode::Write);
  HalfSineRun run;
  run.name_space = "/left";
  run.write(bag);
  run.name_space = "";
  run.write(bag);
  bag.close();
  EXPECT_TRUE(contains(error_of(in_folder("two.bag")), "choose one with --namespace: "));
  EXPECT_TRUE(contains(error_of(in_folder("two.bag")), "/left"));
  EXPECT_TRUE(contains(text_of(in_folder("two.bag"), "left"), "half_sine"));
  EXPECT_TRUE(contains(text_of(in_folder("two.bag"), "/"), "half_sine"));
  EXPECT_TRUE(contains(error_of(in_folder("two.bag"), "right"), "no run under namespace 'right'; there is: "));
}

TEST_F(ReportBadInput, OneOfSeveralBags) {
  ReportOptions options;
  options.bags = {bag_of({}), in_folder("none.bag")};
  EXPECT_TRUE(contains(error_of(options), "none.bag: no such file"));
}

TEST_F(ReportBadInput, AFieldThatWasNotRecorded) {
  ReportOptions options;
  options.bags = {bag_of({})};
  options.plots = in_folder("plots");
  options.field = "temperature";
  EXPECT_TRUE(contains(error_of(options), "--field temperature: not recorded; there is: vx"));
}

TEST_F(ReportBadInput, FilesAndFoldersThatCannotBeWritten) {
  // A file has the name of the folder, which stops root as well.
  std::ofstream(in_folder("file")) << "x";
  ReportOptions options;
  options.bags = {bag_of({})};
  options.csv = in_folder("file/csv");
  EXPECT_TRUE(contains(error_of(options), "--csv " + in_folder("file/csv") + ": the folder cannot be written"));
  options.csv.clear();
  options.plots = in_folder("file/plots");
  EXPECT_TRUE(contains(error_of(options), "--plots " + in_folder("file/plots")));
  options.plots.clear();
  options.json = in_folder("file/run.json");
  EXPECT_TRUE(contains(error_of(options), "--json " + in_folder("file/run.json") + ": cannot be written"));
  options.json.clear();
  options.animate = in_folder("file/run.gif");
  EXPECT_TRUE(contains(error_of(options), "--animate " + in_folder("file")));
}

// `--json A.bag B.bag` makes the first bag the file to write.
TEST_F(ReportBadInput, ABagIsNotWrittenOver) {
  ReportOptions options;
  options.json = bag_of({}, "first.bag");
  options.bags = {bag_of({}, "second.bag")};
  const auto before = fs::file_size(options.json);
  EXPECT_TRUE(contains(error_of(options), "first.bag: is a bag; name a file for the figures"));
  EXPECT_EQ(fs::file_size(options.json), before);
}

TEST_F(ReportBadInput, LeavesNothingBehind) {
  std::ofstream(in_folder("old.json")) << "old";
  ReportOptions options;
  options.bags = {in_folder("none.bag")};
  options.csv = in_folder("csv");
  options.plots = in_folder("plots/of/run");
  options.json = in_folder("old.json");
  EXPECT_TRUE(contains(error_of(options), "no such file"));
  EXPECT_FALSE(fs::exists(in_folder("csv")));
  EXPECT_FALSE(fs::exists(in_folder("plots")));
  EXPECT_EQ(fs::file_size(in_folder("old.json")), 3U);
}

TEST_F(ReportBadInput, StopsWithoutATrace) {
  const char* set = std::getenv("TMPDIR");
  const std::string old = set != nullptr ? set : "";
  fs::create_directory(in_folder("tmp"));
  setenv("TMPDIR", in_folder("tmp").c_str(), 1);
  ReportOptions options;
  options.bags = {bag_of({})};
  options.plots = in_folder("plots");
  int asked = 0;
  options.stop_requested = [&] { return ++asked > 20; };  // among the messages, with half of the tables written
  std::ostringstream out, err;
  EXPECT_EQ(run_report(options, out, err, false), ReportResult::stopped);
  EXPECT_EQ(err.str(), "bag_report: stopped\n");
  EXPECT_EQ(out.str(), "");
  EXPECT_TRUE(fs::is_empty(in_folder("tmp")));
  old.empty() ? unsetenv("TMPDIR") : setenv("TMPDIR", old.c_str(), 1);
}

TEST_F(ReportBadInput, AFolderWithoutPermission) {
  if (geteuid() == 0) GTEST_SKIP() << "the superuser may write anywhere";
  fs::create_directory(in_folder("locked"));
  fs::permissions(in_folder("locked"), fs::perms::owner_read | fs::perms::owner_exec);
  ReportOptions options;
  options.bags = {bag_of({})};
  options.csv = in_folder("locked");
  EXPECT_TRUE(contains(error_of(options), "the folder cannot be written"));
}

TEST_F(ReportBadInput, AnAnimationOfAnotherKind) {
  ReportOptions options;
  options.bags = {bag_of({})};
  options.animate = in_folder("run.avi");
  EXPECT_TRUE(contains(error_of(options), "neither .mp4 nor .gif"));
}

TEST_F(ReportBadInput, AnAnimationOfSeveralBags) {
  ReportOptions options;
  options.bags = {bag_of({}), bag_of({}, "other.bag")};
  options.animate = in_folder("run.gif");
  EXPECT_TRUE(contains(error_of(options), "give one bag"));
}

TEST_F(ReportBadInput, AnAnimationWithoutParticles) {
  HalfSineRun run;
  run.on_particles = [](int, sensor_msgs::PointCloud2&) { return false; };
  ReportOptions options;
  options.bags = {bag_of(run)};
  options.animate = in_folder("run.gif");
  EXPECT_TRUE(contains(error_of(options), "holds no particle snapshot; record /mpm/particles"));
}

/// Sets the position of the index to 0, as in a bag that was never closed.
void forget_index(const std::string& path) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  std::string head(4096, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  const std::string key = "index_pos=";
  const std::size_t place = head.find(key);
  ASSERT_NE(place, std::string::npos);
  file.seekp(static_cast<std::streamoff>(place + key.size()));
  file.write(std::string(8, '\0').data(), 8);
}

TEST_F(ReportBadInput, AnUnindexedBagIsReadWhole) {
  const std::string path = bag_of({});
  forget_index(path);
  const auto before = fs::last_write_time(path);
  const std::string text = text_of(path);
  EXPECT_TRUE(contains(text, "simulated time    0.101 s")) << text;
  EXPECT_TRUE(contains(text, "cut short")) << text;
  EXPECT_TRUE(contains(text, "rosbag reindex " + path)) << text;
  EXPECT_EQ(fs::last_write_time(path), before);  // the bag itself is unchanged
}

TEST_F(ReportBadInput, ABagThatWasCutOffIsReadAsFarAsItIsWhole) {
  const std::string path = in_folder("cut.bag.active");
  {
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    bag.setChunkThreshold(4096);  // so that only the last few messages are lost
    HalfSineRun().write(bag);
    bag.close();
  }
  fs::resize_file(path, fs::file_size(path) / 2);
  const std::string text = text_of(path);
  EXPECT_TRUE(contains(text, "cut short")) << text;
  const std::size_t place = text.find("simulated time    ");
  ASSERT_NE(place, std::string::npos);
  // Messages are spread evenly over the file, except for the index at its end: half of the file has 30 to 60 % of the
  // time.
  const double time = std::stod(text.substr(place + 18));
  EXPECT_GT(time, 0.3 * HalfSineRun::kDuration) << text;
  EXPECT_LT(time, 0.6 * HalfSineRun::kDuration) << text;
}

TEST_F(ReportBadInput, ABagThatWasCutOffBeforeItsFirstMessages) {
  const std::string path = bag_of({});
  fs::resize_file(path, 5000);  // the header takes 4117 bytes
  EXPECT_TRUE(contains(error_of(path), "cut short")) << error_of(path);
}

}  // namespace report_bad_input_test
}  // namespace mpm_ros
