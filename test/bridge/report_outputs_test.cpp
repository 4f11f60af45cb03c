// Outputs of bag_report other than its tables: JSON, a comparison of several bags, an animation.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mpm_ros/report/recorded_run.hpp"
#include "mpm_ros/report/report.hpp"
#include "mpm_ros/report/report_animation.hpp"
#include "mpm_ros/report/report_error.hpp"
#include "mpm_ros/report/temporary_folder.hpp"
#include "report_run.hpp"

namespace mpm_ros {
namespace report_outputs_test {

using nlohmann::json;
using test::HalfSineRun;
using test::kPi;
namespace fs = std::filesystem;

/// Round-off of sums of about a hundred doubles.
constexpr double kRoundOff = 1e-13;

class ReportOutputs : public ::testing::Test {
 protected:
  std::string in_folder(const std::string& name) const { return folder_.file(name); }
  std::string bag_of(const HalfSineRun& run, const std::string& name = "run.bag") const {
    run.write(in_folder(name));
    return in_folder(name);
  }
  /// The program's output.
  static std::string text_of(const ReportOptions& options) {
    std::ostringstream out, err;
    EXPECT_EQ(run_report(options, out, err, false), ReportResult::done) << err.str();
    return out.str();
  }
  /// Exit code of a line of Python.
  static int python(const std::string& line) {
    return WEXITSTATUS(std::system(fmt::format("/usr/bin/python3 -c '{}'", line).c_str()));
  }

  TemporaryFolder folder_;
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(ReportOutputs, JsonHasTheFiguresOfTheTables) {
  ReportOptions options;
  options.bags = {bag_of({})};
  options.json = "-";
  options.check = true;
  const json run = json::parse(text_of(options));  // nothing but JSON is printed
  EXPECT_EQ(run.at("schema"), 1);
  EXPECT_EQ(run.at("scene"), "half_sine");
  EXPECT_EQ(run.at("duration"), 0.101);
  EXPECT_EQ(run.at("steps"), 1010);
  EXPECT_EQ(run.at("dt").at("max"), HalfSineRun::kStep / 10);
  EXPECT_EQ(run.at("energy").at("start").at("kinetic"), 1.0);
  EXPECT_EQ(run.at("energy").at("end").at("kinetic"), 102.0);
  const json& tool = run.at("bodies").at("tool");
  const double impulse = 2.0 * HalfSineRun::kAmplitude * HalfSineRun::kDuration / kPi;  // the integral of a half sine
  EXPECT_NEAR(tool.at("impulse").at(0), impulse, kRoundOff * impulse);
  EXPECT_NEAR(tool.at("mean_force").at(0), impulse / HalfSineRun::kDuration, 1e-12 * impulse / HalfSineRun::kDuration);
  EXPECT_EQ(tool.at("peak_force").at("time"), 0.051);  // the middle of 101 intervals
  EXPECT_EQ(run.at("audit").at("impulses").at("gravity").at(2), HalfSineRun::kWeight * 0.101);
  EXPECT_EQ(run.at("audit").at("limit"), 1e-10);
  EXPECT_EQ(run.at("snapshots").at("count"), 11);
  EXPECT_EQ(run.at("commands").at(0).at("late"), 1);
  ASSERT_EQ(run.at("checks").size(), 18U);
  for (const json& check : run.at("checks")) {
    // The run is artificial: it has no scene that gives the masses and laws of particles, no /clock, no global
    // quantities and no robots.
    const bool made = check.at("name") != "momentum" && check.at("name") != "balance" && check.at("name") != "clock" &&
                      check.at("name") != "global" && check.at("name") != "robots";
    EXPECT_EQ(check.at("result"), made ? "ok" : "not made") << check.dump();
  }
}

/// Two deformable bodies press with 2 N, then with 3 N in the last interval, and slide; five particles came back.
HalfSineRun run_with_pair() {
  HalfSineRun run;
  run.on_forces = [](int i, ContactForces& message) {
    message.bodies[0].contact_area = 0.01 + 0.001 * i;
    message.bodies[0].friction_energy = 0.5 * i;
    message.pairs.resize(1);
    ContactPair& pair = message.pairs[0];
    pair.name = "block/slab";
    if (i > 0) pair.interval = HalfSineRun::kStep;
    if (i > 0) pair.force.z = i == HalfSineRun::kIntervals ? -3.0 : -2.0;
    pair.impulse.z = -2.0 * i * HalfSineRun::kStep - (i == HalfSineRun::kIntervals ? HalfSineRun::kStep : 0.0);
    pair.contact_area = 0.02;
    pair.friction_energy = 0.25 * i;
    pair.interface_energy = 0.125;
    return true;
  };
  run.on_state = [](int i, SolverState& message) {
    message.energy_friction = 0.5 * i;
    message.energy_pair_friction = 0.25 * i;
    message.energy_interface = 0.125;
    message.particles_returned = 5;
    return true;
  };
  return run;
}

TEST_F(ReportOutputs, TellOfAreaFrictionAndPairs) {
  ReportOptions options;
  options.bags = {bag_of(run_with_pair())};
  options.json = "-";
  options.csv = in_folder("tables");
  const json run = json::parse(text_of(options));
  const json& tool = run.at("bodies").at("tool");
  EXPECT_DOUBLE_EQ(tool.at("largest_contact_area"), 0.01 + 0.101);
  EXPECT_EQ(tool.at("friction_energy"), 50.5);
  EXPECT_EQ(run.at("energy").at("end").at("friction"), 50.5);
  EXPECT_EQ(run.at("energy").at("end").at("pair_friction"), 25.25);
  EXPECT_EQ(run.at("energy").at("end").at("interface"), 0.125);
  EXPECT_EQ(run.at("returned"), 5);
  const json& pair = run.at("contact_pairs").at("block/slab");
  EXPECT_EQ(pair.at("peak_force").at("size"), 3.0);
  EXPECT_EQ(pair.at("peak_force").at("time"), 0.101);
  EXPECT_NEAR(pair.at("mean_force").at(2), -(2.0 * 0.101 + 0.001) / 0.101, kRoundOff);
  EXPECT_NEAR(pair.at("impulse").at(2), -0.203, kRoundOff);
  EXPECT_EQ(pair.at("largest_contact_area"), 0.02);
  EXPECT_EQ(pair.at("friction_energy"), 25.25);
  EXPECT_EQ(pair.at("interface_energy"), 0.125);
  EXPECT_EQ(pair.at("contact"), json::array({0.001, 0.101}));

  std::ifstream table(in_folder("tables/contact_pairs.csv"));
  std::string header;
  std::getline(table, header);
  EXPECT_EQ(header.find("time [s],block/slab fx [N],block/slab fy [N],block/slab fz [N],"), 0U) << header;
  EXPECT_TRUE(contains(header, ",block/slab contact area [m^2],block/slab friction energy [J],")) << header;

  options.json.clear();
  const std::string text = text_of(options);
  for (const char* part : {"Contact of deformable bodies", "block/slab", "lost to friction on the bodies",
                           "lost to friction of deformable bodies", "5 particles left the grid"}) {
    EXPECT_TRUE(contains(text, part)) << part << " not in:\n" << text;
  }
}

// Numbers that no list describes come from modules of the solver, by names of their own.
TEST_F(ReportOutputs, TellOfNumbersByNamesOfTheirOwn) {
  HalfSineRun run;
  run.on_state = [](int i, SolverState& message) {
    message.values.resize(1);
    message.values[0].name = "heat";
    message.values[0].unit = "J";
    message.values[0].value = {0.5 * i};
    return true;
  };
  ReportOptions options;
  options.bags = {bag_of(run)};
  options.json = "-";
  options.csv = in_folder("tables");
  EXPECT_EQ(json::parse(text_of(options)).at("energy").at("end").at("heat"), 50.5);
  std::ifstream table(in_folder("tables/solver_state.csv"));
  std::string header;
  std::getline(table, header);
  EXPECT_TRUE(contains(header, ",heat [J],")) << header;
  options.json.clear();
  EXPECT_TRUE(contains(text_of(options), "  heat "));
}

TEST_F(ReportOutputs, SayNothingOfPairsWhereThereAreNone) {
  ReportOptions options;
  options.bags = {bag_of({})};
  options.csv = in_folder("tables");
  EXPECT_FALSE(contains(text_of(options), "deformable"));
  EXPECT_FALSE(fs::exists(in_folder("tables/contact_pairs.csv")));
}

TEST_F(ReportOutputs, JsonOfSeveralBagsIsAListOfRuns) {
  ReportOptions options;
  options.bags = {bag_of({}), bag_of({}, "other.bag")};
  options.json = in_folder("runs.json");
  text_of(options);
  std::ifstream file(options.json);
  const json both = json::parse(file);
  EXPECT_EQ(both.at("schema"), 1);
  ASSERT_EQ(both.at("runs").size(), 2U);
  EXPECT_EQ(both.at("runs").at(1).at("label"), "other");
}

TEST_F(ReportOutputs, WhatIsNotFiniteIsNullInJson) {
  HalfSineRun run;
  run.on_state = [](int i, SolverState& message) {
    if (i == HalfSineRun::kIntervals) message.energy_plastic = std::numeric_limits<double>::infinity();
    return true;
  };
  ReportOptions options;
  options.bags = {bag_of(run)};
  options.json = "-";
  EXPECT_TRUE(json::parse(text_of(options)).at("energy").at("end").at("plastic").is_null());
}

TEST(ReportLabels, AreTheFilesNamesAndDiffer) {
  EXPECT_EQ(labels_of({"a/run.bag", "b/run.bag", "run_2.bag", "x.bag.active"}),
            (std::vector<std::string>{"run", "run_2", "run_2_2", "x.bag"}));
  EXPECT_EQ(labels_of({"a b.bag", "a_b.bag"}), (std::vector<std::string>{"a_b", "a_b_2"}));  // each has its own folder
}

TEST_F(ReportOutputs, SeveralBagsAreSetSideBySide) {
  HalfSineRun with_blade;
  with_blade.on_forces = [](int, ContactForces& message) {
    message.bodies.push_back(message.bodies.front());
    message.bodies.back().name = "blade";
    return true;
  };
  ReportOptions options;
  options.bags = {bag_of({}, "one.bag"), bag_of(with_blade, "two.bag")};
  options.csv = in_folder("csv");
  options.plots = in_folder("plots");
  const std::string text = text_of(options);
  // A body that only one bag has is shown for that bag.
  bool found = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!contains(line, "blade impulse")) continue;
    found = true;
    EXPECT_LT(line.find(" - "), line.find("2.572")) << line;  // impulse 2 A T / pi [N s] of the second bag
  }
  EXPECT_TRUE(found) << text;
  EXPECT_TRUE(contains(text, "instruction set")) << text;
  for (const char* file :
       {"csv/one/contact_forces.csv", "csv/two/contact_forces.csv", "plots/compare_contact_tool.png",
        "plots/compare_contact_blade.png", "plots/compare_energies.png", "plots/compare_audit.png"}) {
    EXPECT_TRUE(fs::exists(in_folder(file))) << file;
  }
}

TEST_F(ReportOutputs, AnimationHasAFrameASnapshot) {
  ReportOptions options;
  options.bags = {bag_of({})};
  options.animate = in_folder("run.gif");
  text_of(options);
  // 11 snapshots; each differs from the others, since the tool and the line of the present time have moved.
  EXPECT_EQ(
      python(fmt::format("import sys, PIL.Image as i; g = i.open(\"{}\"); sys.exit(g.n_frames)", options.animate)), 11);
  options.frames = 4;
  text_of(options);
  EXPECT_EQ(
      python(fmt::format("import sys, PIL.Image as i; g = i.open(\"{}\"); sys.exit(g.n_frames)", options.animate)), 4);
}

/// Sets PATH for the duration of a test.
class WithPath {
 public:
  explicit WithPath(const std::string& path) : before_(std::getenv("PATH")) { setenv("PATH", path.c_str(), 1); }
  ~WithPath() { setenv("PATH", before_.c_str(), 1); }

 private:
  std::string before_;
};

TEST_F(ReportOutputs, Mp4IsMadeByFfmpegFromEveryFrame) {
  // A substitute that stores its arguments and the number of bytes that it received.
  fs::create_directory(in_folder("bin"));
  std::ofstream(in_folder("bin/ffmpeg")) << "#!/bin/sh\nfor last; do :; done\nprintf '%s ' \"$@\" >\"$last\"\n"
                                            "/usr/bin/wc -c >>\"$last\"\n";
  fs::permissions(in_folder("bin/ffmpeg"), fs::perms::owner_all);
  const WithPath path(in_folder("bin"));
  ReportOptions options;
  options.bags = {bag_of({})};
  options.animate = in_folder("run.mp4");
  text_of(options);
  std::ifstream file(options.animate);
  std::stringstream text;
  text << file.rdbuf();
  std::size_t width = 0, height = 0, bytes = 0;
  const std::size_t size = text.str().find("-s ");
  ASSERT_NE(size, std::string::npos) << text.str();
  ASSERT_EQ(std::sscanf(text.str().c_str() + size, "-s %zux%zu", &width, &height), 2) << text.str();
  const std::string end = text.str().substr(text.str().find("run.mp4 ") + 8);
  bytes = std::stoul(end);
  EXPECT_EQ(bytes, 11U * 3U * width * height);  // 11 snapshots, three bytes a pixel
  EXPECT_EQ(width % 2, 0U);                     // yuv420p halves both
  EXPECT_EQ(height % 2, 0U);
}

TEST_F(ReportOutputs, WithoutFfmpegAnMp4BecomesAGif) {
  fs::create_directory(in_folder("bin"));
  const WithPath path(in_folder("bin"));
  ReportOptions options;
  options.bags = {bag_of({})};
  options.animate = in_folder("run.mp4");
  text_of(options);
  EXPECT_FALSE(fs::exists(in_folder("run.mp4")));
  EXPECT_TRUE(fs::exists(in_folder("run.gif")));
}

TEST(ReportField, IsTheOneAskedForOrTheMostTelling) {
  EXPECT_EQ(choose_field({"x", "y", "z", "id", "vx", "p"}, ""), "p");
  EXPECT_EQ(choose_field({"x", "y", "z", "id", "vx", "p"}, "vx"), "vx");
  EXPECT_EQ(choose_field({"x", "y", "z", "id", "sxx"}, ""), "sxx");
  EXPECT_EQ(choose_field({"x", "y", "z", "id"}, ""), "z");
  EXPECT_THROW(choose_field({"x", "y", "z", "id", "vx"}, "ep"), ReportError);
}

TEST(ReportFieldRange, QuantilesOfManyValuesFromAnEvenSample) {
  // 0 to 999,999 in order, in 100 clouds: more values than are kept. Every stride-th value is kept, so a quantile is
  // off by at most one stride, 16 here (a million values, at most 200,000 kept, strides are powers of two), of a
  // million.
  FieldRange range("v");
  sensor_msgs::PointCloud2 cloud;
  const char* names[] = {"x", "y", "z", "v"};
  for (std::uint32_t field = 0; field < 4; ++field) {
    cloud.fields.emplace_back();
    cloud.fields.back().name = names[field];
    cloud.fields.back().offset = 4 * field;
    cloud.fields.back().datatype = sensor_msgs::PointField::FLOAT32;
  }
  cloud.height = 1;
  cloud.width = 10000;
  cloud.point_step = 16;
  cloud.data.resize(160000);
  for (int i = 0; i < 1000000; ++i) {
    const float row[] = {static_cast<float>(i % 7), -1.0F, 2.0F, static_cast<float>(i)};
    std::memcpy(cloud.data.data() + 16 * (i % 10000), row, 16);
    if (i % 10000 == 9999) range.particles(0, cloud);
  }
  EXPECT_NEAR(range.quantile(0.0), 0.0, 16.0);
  EXPECT_NEAR(range.quantile(0.25), 250000.0, 16.0);
  EXPECT_NEAR(range.quantile(1.0), 999999.0, 16.0);
  EXPECT_EQ(range.box().min, mpm::Vec3(0.0, -1.0, 2.0));
  EXPECT_EQ(range.box().max, mpm::Vec3(6.0, -1.0, 2.0));
}

}  // namespace report_outputs_test
}  // namespace mpm_ros
