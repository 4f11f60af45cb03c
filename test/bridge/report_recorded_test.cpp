// bag_report on real runs: the check `momentum`, which needs a scene, and the Python of doc/analysis.md.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mpm_ros/report/report.hpp"
#include "mpm_ros/report/report_bag.hpp"
#include "mpm_ros/report/report_statistics.hpp"
#include "mpm_ros/report/temporary_folder.hpp"
#include "mpm_ros/run/run_scene.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace report_recorded_test {

using nlohmann::json;

class ReportRecorded : public ::testing::Test {
 protected:
  /// Records 50 ms of a block under a press: 2,000 particles, two bodies, damping.
  std::string record(const std::vector<std::string>& set = {}, const std::string& scene = "compressed_block") const {
    RunSceneOptions options;
    options.scene = scene;
    options.end = "50 ms";
    options.bag = folder_.file(scene + ".bag");
    options.set = set;
    options.threads = 1;
    std::ostringstream out, err;
    EXPECT_EQ(run_scene(options, out, err, false, [] { return false; }), RunSceneResult::done) << err.str();
    return options.bag;
  }

  static json report_of(const std::string& bag) {
    ReportOptions options;
    options.bags = {bag};
    options.json = "-";
    options.check = true;
    std::ostringstream out, err;
    EXPECT_NE(run_report(options, out, err, false), ReportResult::bad_input) << err.str();
    return json::parse(out.str());
  }
  /// "ok", "failed" or "not made" by the name of the check, without the checks of messages that these bags do not have.
  static std::map<std::string, std::string> results_of(const json& report) {
    std::map<std::string, std::string> results;
    for (const json& check : report.at("checks")) results[check.at("name")] = check.at("result");
    EXPECT_EQ(results.at("clock"), "not made");
    EXPECT_EQ(results.at("global"), "not made");
    EXPECT_EQ(results.at("robots"), "not made");
    results.erase("robots");
    results.erase("clock");
    results.erase("global");
    return results;
  }
  static std::string detail_of(const json& report, const std::string& name) {
    for (const json& check : report.at("checks")) {
      if (check.at("name") == name) return check.at("detail");
    }
    return {};
  }

  TemporaryFolder folder_;
};

TEST_F(ReportRecorded, ParticlesMoveAsForcesWeightAndWallsSay) {
  for (const char* scene : {"compressed_block", "elastic_block", "sliding_block"}) {
    const json report = report_of(record({}, scene));
    for (const auto& [name, result] : results_of(report)) {
      // Balances are made of soil.
      EXPECT_EQ(result, name == "balance" ? "not made" : "ok")
          << scene << " " << name << ": " << detail_of(report, name);
    }
  }
}

// Foam that starts under its weight is denser than in the scene by half of rho g h (1 - 2 nu) / E.
TEST_F(ReportRecorded, ParticlesThatStartUnderStressHaveTheMassOfTheRun) {
  const json report = report_of(record({"bodies.0.initial=geostatic"}, "elastic_block"));
  EXPECT_EQ(results_of(report).at("momentum"), "ok") << detail_of(report, "momentum");
}

TEST_F(ReportRecorded, TheBalanceOfSoilCloses) {
  const json report = report_of(record({"grid.cell=0.02", "time.end=0.3"}, "column_collapse"));
  EXPECT_EQ(results_of(report).at("balance"), "ok") << detail_of(report, "balance");
}

TEST_F(ReportRecorded, ARunInSinglePrecisionPassesByItsOwnLimit) {
  const json report = report_of(record({"method.precision=single"}));
  for (const auto& [name, result] : results_of(report))
    EXPECT_EQ(result, name == "balance" ? "not made" : "ok") << name << ": " << detail_of(report, name);
  EXPECT_NE(detail_of(report, "audit").find("limit 1e-07"), std::string::npos) << detail_of(report, "audit");
  EXPECT_EQ(report.at("audit").at("limit"), 1e-7);
}

TEST_F(ReportRecorded, MomentumFindsForcesThatAreWrongInAllBooks) {
  // Force, impulse, and the audit's impulses and momentum are larger by a thousandth: they agree with each other, but
  // not with the motion of the particles.
  const std::string path = record(), wrong = folder_.file("wrong.bag");
  rosbag::Bag in(path, rosbag::bagmode::Read), out(wrong, rosbag::bagmode::Write);
  const auto grow = [](geometry_msgs::Vector3& vector) {
    vector.x *= 1.001;
    vector.y *= 1.001;
    vector.z *= 1.001;
  };
  rosbag::View view(in);
  for (const rosbag::MessageInstance& instance : view) {
    if (const ContactForces::Ptr forces = instance.instantiate<ContactForces>()) {
      for (ContactForce& body : forces->bodies) {
        if (body.name != "press") continue;
        grow(body.wrench.force);
        grow(body.impulse);
      }
      out.write(instance.getTopic(), instance.getTime(), *forces);
    } else if (const SolverState::Ptr state = instance.instantiate<SolverState>()) {
      for (Impulse& impulse : state->impulses) {
        if (impulse.name != "contact/press") continue;
        state->momentum.z += 0.001 * impulse.impulse.z;
        grow(impulse.impulse);
      }
      out.write(instance.getTopic(), instance.getTime(), *state);
    } else {
      out.write(instance.getTopic(), instance.getTime(), instance);
    }
  }
  out.close();
  for (const auto& [name, result] : results_of(report_of(wrong))) {
    EXPECT_EQ(result, name == "momentum" ? "failed" : name == "balance" ? "not made" : "ok") << name;
  }
}

TEST_F(ReportRecorded, MomentumSaysWhenItCannotBeMade) {
  const json every_second = report_of(record({"output.particle_stride=2"}));
  EXPECT_EQ(results_of(every_second).at("momentum"), "not made");
  EXPECT_EQ(detail_of(every_second, "momentum"), "the clouds hold 1000 of 2000 particles");
  const json without_velocity = report_of(record({"output.particle_fields=[p]"}));
  EXPECT_EQ(results_of(without_velocity).at("momentum"), "not made");
  EXPECT_EQ(detail_of(without_velocity, "momentum"),
            "no velocity is recorded; add vx, vy, vz to output.particle_fields");
}

TEST_F(ReportRecorded, ARunThatEndedEarlyIsTold) {
  // run_scene --end changes the end of a run; a run that is stopped earlier has not reached it.
  EXPECT_TRUE(report_of(record()).at("notes").empty());
  RunSceneOptions options;
  options.scene = "compressed_block";
  options.bag = folder_.file("stopped.bag");
  options.threads = 1;
  int asked = 0;
  std::ostringstream out, err;
  run_scene(options, out, err, false, [&asked] { return ++asked > 4; });
  const json report = report_of(options.bag);
  EXPECT_EQ(report.at("end"), 0.4);
  ASSERT_EQ(report.at("notes").size(), 1U);
  const std::string note = report.at("notes").at(0);
  EXPECT_NE(note.find("before the scene's end at 0.4 s: the run was stopped there"), std::string::npos) << note;
}

TEST_F(ReportRecorded, ThePythonOfTheDocumentationReadsABag) {
  const std::string bag = record();
  std::ifstream page(source_file("doc/analysis.md"));
  std::stringstream text;
  text << page.rdbuf();
  const std::string begin = "```python\n";
  const std::size_t first = text.str().find(begin);
  ASSERT_NE(first, std::string::npos);
  std::string code = text.str().substr(first + begin.size());
  code = code.substr(0, code.find("```"));
  code.replace(code.find("F.bag"), 5, bag);
  std::ofstream(folder_.file("analysis.py")) << code;

  FILE* pipe = popen(fmt::format("/usr/bin/python3 {} 2>&1", folder_.file("analysis.py")).c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::string printed;
  for (char line[512]; std::fgets(line, sizeof line, pipe) != nullptr;) printed += line;
  ASSERT_EQ(pclose(pipe), 0) << printed;

  // The numbers equal those of bag_report.
  RunBag run(bag, "");
  RunStatistics statistics;
  run.read({&statistics});
  for (const BodyStatistics& body : statistics.body_statistics()) {
    const std::string line = fmt::format("{} peak {:.4g} N at {:.4g} s", body.name, body.of("force").peak.norm,
                                         static_cast<double>(body.of("force").peak.time) / 1e9);
    EXPECT_NE(printed.find(line), std::string::npos) << line << "\nis not in\n" << printed;
  }
  std::size_t snapshots = 0;
  for (std::size_t at = printed.find("highest particle"); at != std::string::npos;
       at = printed.find("highest particle", at + 1)) {
    ++snapshots;
  }
  EXPECT_EQ(snapshots, statistics.snapshots().size());
}

}  // namespace report_recorded_test
}  // namespace mpm_ros
