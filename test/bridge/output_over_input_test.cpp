// No output of run_scene overwrites what the run reads, nor another output; and a run that does not come to its start
// leaves the outputs of an earlier one. Half a second in all.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mpm_ros/report/report.hpp"
#include "mpm_ros/report/temporary_folder.hpp"
#include "mpm_ros/run/run_scene.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace output_over_input_test {

namespace fs = std::filesystem;

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

using Option = std::string RunSceneOptions::*;

/// A scene in a folder of its own, with a map of heights, a robot whose link is a mesh, and a recording.
class OutputOverInput : public ::testing::Test {
 protected:
  OutputOverInput() {
    fs::create_directory(file("maps"));
    std::ofstream(file("maps/particles.csv")) << "0.04,0.04\n0.04,0.04\n";
    fs::copy_file(data_file("robot/tetrahedron.obj"), file("outline_tip.obj"));
    std::ofstream(file("arm.urdf")) << R"(<robot name="arm"><link name="tip"><collision><geometry>)"
                                    << R"(<mesh filename="outline_tip.obj" scale="0.05 0.05 0.05"/>)"
                                    << "</geometry></collision></link></robot>\n";
    std::ofstream(file("scene.yaml")) << R"(name: slab
grid: {cell: 0.02, min: [0, 0, 0], max: [0.08, 0.08, 0.08]}
time: {end: 2 us}
materials: [{name: foam, density: 1000, law: neo_hookean, young: 0.1 MPa, poisson: 0.3}]
bodies:
  - {name: slab, material: foam, shape: {height_field: {file: maps/particles.csv, x: [0, 0.08], y: [0, 0.08]}}}
rigid_bodies:
  - {name: tip, shape: {urdf: {file: arm.urdf, link: tip}}, pose: {position: [0.04, 0.04, 0.06]}}
)";
    options_.scene = file("scene.yaml");
    options_.threads = 1;
  }
  std::string file(const std::string& name) const { return folder_.file(name); }
  RunSceneResult run() {
    out_.str("");
    err_.str("");
    return run_scene(options_, out_, err_, false, [] { return false; });
  }
  /// Every file of the folder, with what it holds.
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(file(".")))
      if (entry.is_regular_file()) all[entry.path().string()] = text_of(entry.path().string());
    return all;
  }
  /// Refused in one line, with code 2, and nothing is changed.
  void expect_refused(const std::vector<std::pair<Option, std::string>>& outputs, const std::string& why) {
    const RunSceneOptions good = options_;
    const auto before = files();
    for (const auto& [option, path] : outputs) options_.*option = path;
    EXPECT_EQ(run(), RunSceneResult::bad_input) << outputs.front().second;
    EXPECT_NE(err_.str().find(why), std::string::npos) << err_.str();
    EXPECT_EQ(err_.str().find('\n'), err_.str().size() - 1) << err_.str();
    EXPECT_EQ(files(), before) << err_.str();
    options_ = good;
  }

  const TemporaryFolder folder_;
  RunSceneOptions options_;
  std::ostringstream out_, err_;
};

TEST_F(OutputOverInput, TheSceneAndItsFiles) {
  const std::string scene = "would overwrite the scene that is run; choose another name";
  fs::create_symlink(file("scene.yaml"), file("link.yaml"));
  fs::create_hard_link(file("scene.yaml"), file("same.yaml"));
  fs::create_directory_symlink(file("maps"), file("other"));
  fs::copy_file(file("scene.yaml"), file("scene_part0002.bag"));
  for (const Option option : {&RunSceneOptions::summary, &RunSceneOptions::bag, &RunSceneOptions::checkpoint}) {
    for (const char* name : {"scene.yaml", "maps/../scene.yaml", "link.yaml", "same.yaml"})
      expect_refused({{option, file(name)}}, scene);
    for (const char* name : {"arm.urdf", "outline_tip.obj", "other/particles.csv"})
      expect_refused({{option, file(name)}}, "would overwrite a file that the scene reads");
  }
  // A table has the name of the map, an outline that of the mesh.
  expect_refused({{&RunSceneOptions::csv, file("other")}}, "would overwrite a file that the scene reads");
  expect_refused({{&RunSceneOptions::csv, file(".")}}, "would overwrite a file that the scene reads");
  // Parts of an earlier recording of that name are removed.
  options_.scene = file("scene_part0002.bag");
  expect_refused({{&RunSceneOptions::bag, file("scene.bag")}}, "would overwrite the scene that is run");
}

TEST_F(OutputOverInput, AnotherOutput) {
  fs::create_symlink(file("later"), file("link"));  // to what is not there yet
  expect_refused({{&RunSceneOptions::bag, file("x")}, {&RunSceneOptions::summary, file("x")}},
                 "--summary " + file("x") + ": --bag writes that file too; choose another name");
  expect_refused({{&RunSceneOptions::bag, file("later")}, {&RunSceneOptions::checkpoint, file("link")}},
                 "--checkpoint writes that file too");
  expect_refused({{&RunSceneOptions::checkpoint, file("x.h5")}, {&RunSceneOptions::summary, file("x_failed.h5")}},
                 "--checkpoint writes that file too");
  expect_refused({{&RunSceneOptions::csv, file("csv")}, {&RunSceneOptions::summary, file("csv/bodies.csv")}},
                 "--csv writes that file too");
  expect_refused({{&RunSceneOptions::vtk, file("maps")}, {&RunSceneOptions::bag, file("maps/run.pvd")}},
                 "--vtk writes that file too");
}

TEST_F(OutputOverInput, WhatARunGoesOnFrom) {
  options_.bag = file("run.bag");
  options_.checkpoint = file("run.h5");
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  options_.bag.clear();
  options_.checkpoint.clear();
  fs::copy_file(file("run.bag"), file("run_part0002.bag"));
  RunSceneOptions again;
  again.threads = 1;
  again.from_bag = file("run.bag");
  options_ = again;
  for (const Option option : {&RunSceneOptions::summary, &RunSceneOptions::bag, &RunSceneOptions::checkpoint}) {
    for (const char* name : {"run.bag", "run_part0002.bag"})
      expect_refused({{option, file(name)}}, "is no part of this recording");
  }
  fs::remove(file("run_part0002.bag"));
  for (const Option option : {&RunSceneOptions::summary, &RunSceneOptions::bag, &RunSceneOptions::checkpoint})
    expect_refused({{option, file("run.bag")}}, "would overwrite the recording that is run again");
  again.from_bag.clear();
  again.resume = file("run.h5");
  options_ = again;
  for (const Option option : {&RunSceneOptions::summary, &RunSceneOptions::bag})
    expect_refused({{option, file("run.h5")}}, "would overwrite the checkpoint that the run goes on from");
  // A later state of the run, whole, may replace it.
  options_.checkpoint = file("run.h5");
  options_.end = "4 us";
  EXPECT_EQ(run(), RunSceneResult::done) << err_.str();
  ReportOptions report;
  report.bags = {file("run.bag")};
  const std::pair<std::string ReportOptions::*, const char*> cases[] = {
      {&ReportOptions::json, "is a bag; name a file for the figures"},
      {&ReportOptions::animate, "would overwrite the bag"}};
  for (const auto& [option, refusal] : cases) {
    fs::create_hard_link(file("run.bag"), file("run.gif"));
    report.*option = file("run.gif");
    std::ostringstream out, err;
    EXPECT_EQ(run_report(report, out, err, false), ReportResult::bad_input);
    EXPECT_NE(err.str().find(refusal), std::string::npos) << err.str();
    fs::remove(file("run.gif"));
    report.*option = "";
  }
}

// Fields of the start cannot be had of a checkpoint that was made without: told when the run is built.
TEST_F(OutputOverInput, ARunThatIsNotBegunLeavesTheOutputsOfAnother) {
  options_.checkpoint = file("run.h5");
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  options_.checkpoint.clear();
  options_.scene.clear();
  options_.resume = file("run.h5");
  options_.set = {"output.particle_fields=[ux]"};
  options_.summary = file("summary.json");
  options_.csv = file("csv");
  std::ofstream(options_.summary) << "of an earlier run";
  EXPECT_EQ(run(), RunSceneResult::bad_input);
  EXPECT_NE(err_.str().find("do not remember where they were at the start"), std::string::npos) << err_.str();
  EXPECT_EQ(text_of(options_.summary), "of an earlier run");
  EXPECT_TRUE(fs::is_empty(options_.csv));
}

// The byte e9 is an accent in Latin 1, and no UTF-8, of which JSON is made.
TEST_F(OutputOverInput, NamesThatAreNotUtf8) {
  options_.scene = file("pr\xe9s.yaml");
  std::string text = text_of(file("scene.yaml"));
  text.replace(text.find("name: slab"), 10, "");
  std::ofstream(options_.scene) << text;
  options_.summary = file("summary.json");
  options_.bag = file("run\xe9.bag");
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  EXPECT_EQ(nlohmann::json::parse(text_of(options_.summary))["scene"], "pr\xef\xbf\xbds");  // U+FFFD
  RunSceneOptions again;
  again.threads = 1;
  again.from_bag = options_.bag;
  again.bag = file("again.bag");
  options_ = again;
  EXPECT_EQ(run(), RunSceneResult::done) << err_.str();
}

}  // namespace output_over_input_test
}  // namespace mpm_ros
