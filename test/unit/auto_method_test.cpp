// method: auto. Expected choices are worked out by hand from made-up tables by the rule of choice/preference.hpp, and
// the expected motion by the formulas of advice/expected_motion.hpp.
#include "mpm/advice/auto_method.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "mpm/advice/expected_motion.hpp"
#include "mpm/advice/explain.hpp"
#include "mpm/choice/method_choice.hpp"
#include "test_files.hpp"

namespace mpm {
namespace auto_method_test {

const char* const kHead = "suite,method,error,cost\n";

choice::MethodCosts table(const std::string& rows) {
  std::istringstream in(kHead + rows);
  return choice::read_method_costs(in);
}

/// A scene of one elastic block at rest in the plane, standing on the lower face of the grid.
std::string block(const std::string& rest = "", const std::string& initial = "",
                  const std::string& law = "neo_hookean") {
  return "geometry: plane_strain\n"
         "grid: {cell: 0.1, min: [0, 0], max: [1, 1]}\n"
         "materials: [{name: soft, density: 1000, law: " +
         law +
         ", young: 1000, poisson: 0}]\n"
         "bodies: [{name: block, material: soft, shape: {box: {min: [0.2, 0], max: [0.6, 0.4]}}" +
         initial + "}]\n" + rest;
}

/// The choice of `auto` for a scene, with `rows` as the only measurements.
Scene chosen(const std::string& scene, const std::string& rows, AutoMethod asked = {}) {
  Scene read = parse_scene(scene, "test.yaml");
  read.definition.method = MethodDefinition{};
  read.choices.clear();
  choose_method(asked, {table(rows), "made-up.csv", ""}, read);
  return read;
}

std::string label(const Scene& scene) {
  const MethodDefinition& method = scene.definition.method;
  return choice::choose(method.shape, method.update, method.transfer).label;
}

std::string said(const Scene& scene, const std::string& key = "method") {
  for (const auto& [name, reason] : scene.choices) {
    if (name == key) return reason;
  }
  return "";
}

choice::Preference preferred(const std::string& rows, const std::vector<std::string>& suites,
                             const std::vector<std::string>& candidates, const choice::Budget& budget) {
  const auto found = choice::prefer(table(rows), suites, candidates, budget);
  EXPECT_TRUE(found);
  return found.value_or(choice::Preference{});
}

const choice::Budget kOnePercent{0.01, {}};

// Costs at 1 % error, at the measured runs: ugimp 100 and 400, cpdi 200 and 200; over the least of each suite 1 and 2,
// 2 and 1. The spline: 120 and 240, that is 1.2 and 1.2, which is the least in the worst suite.
const char* const kTwoSuites =
    "square_large,ugimp/usavg/flip,0.01,100\nsquare_large,cpdi/usavg/flip,0.01,200\n"
    "square_large,bspline2/usavg/flip,0.01,120\n"
    "rotation,ugimp/usavg/flip,0.01,400\nrotation,cpdi/usavg/flip,0.01,200\nrotation,bspline2/usavg/flip,0.01,240\n";
const std::vector<std::string> kThree = {"ugimp/usavg/flip", "cpdi/usavg/flip", "bspline2/usavg/flip"};

TEST(Preference, TheWorstSuiteDecides) {
  const choice::Preference found = preferred(kTwoSuites, {"square_large", "rotation"}, kThree, kOnePercent);
  EXPECT_EQ(found.suites.at(0).by, choice::Judged::cost);
  EXPECT_EQ(found.suites.at(0).least, 100.0);
  EXPECT_EQ(found.chosen.method, "bspline2/usavg/flip");
  EXPECT_DOUBLE_EQ(found.chosen.by_suite.at(0), 1.2);
  EXPECT_DOUBLE_EQ(found.chosen.by_suite.at(1), 1.2);
  EXPECT_DOUBLE_EQ(found.others.at(0).worst, 2.0);
  // With one suite the cheapest method wins, and uGIMP among two equal ones.
  EXPECT_EQ(preferred(kTwoSuites, {"square_large"}, kThree, kOnePercent).chosen.method, "ugimp/usavg/flip");
  EXPECT_EQ(preferred(kTwoSuites, {"rotation"}, kThree, kOnePercent).chosen.method, "cpdi/usavg/flip");
}

// The cost of 1 % between runs of 4 % at 10 and 0.25 % at 1000 is 100, on a straight line in log-log.
TEST(Preference, ReadsBetweenRuns) {
  const choice::Preference found = preferred(
      "rotation,ugimp/usavg/flip,0.04,10\nrotation,ugimp/usavg/flip,0.0025,1000\nrotation,cpdi/usavg/flip,0.01,50\n",
      {"rotation"}, kThree, kOnePercent);
  EXPECT_EQ(found.chosen.method, "cpdi/usavg/flip");
  EXPECT_NEAR(found.others.at(0).worst, 2.0, 1e-14);  // round-off of a logarithm
}

// A cost of 109 ties with 100, 111 does not. Of two methods that tie, the one with fewer parts that are not default
// wins.
TEST(Preference, LessThanTenPercentIsATie) {
  const auto pick = [](const std::string& simple, const std::string& cost) {
    return preferred("rotation,cpdi/usavg/flip,0.01,100\nrotation," + simple + ",0.01," + cost + "\n", {"rotation"},
                     {"cpdi/usavg/flip", simple}, kOnePercent)
        .chosen.method;
  };
  EXPECT_EQ(pick("ugimp/usavg/flip", "109"), "ugimp/usavg/flip");
  EXPECT_EQ(pick("ugimp/usavg/flip", "111"), "cpdi/usavg/flip");
  EXPECT_EQ(pick("ugimp/usf/flip", "109"), "ugimp/usf/flip");  // an update differs, not a shape
  EXPECT_EQ(pick("cpdi/usf/flip", "101"), "cpdi/usavg/flip");  // two parts differ, not one
}

// On one suite no method reaches 1 %: errors of 5 % and 4 % count as 1.25 and 1. On the other, costs 100 and 200 count
// as 1 and 2.
TEST(Preference, ASuiteThatNobodySolvesIsJudgedByItsErrors) {
  const choice::Preference found = preferred(
      "plate_compression,ugimp/usavg/flip,0.05,100\nplate_compression,cpdi/usavg/flip,0.04,900\n"
      "rotation,ugimp/usavg/flip,0.01,100\nrotation,cpdi/usavg/flip,0.01,200\n",
      {"plate_compression", "rotation"}, kThree, kOnePercent);
  EXPECT_EQ(found.suites.at(0).by, choice::Judged::smallest_error);
  EXPECT_EQ(found.suites.at(0).least, 0.04);
  EXPECT_EQ(found.suites.at(1).by, choice::Judged::cost);
  EXPECT_EQ(found.chosen.method, "ugimp/usavg/flip");
  EXPECT_DOUBLE_EQ(found.chosen.worst, 1.25);
  EXPECT_DOUBLE_EQ(found.others.at(0).worst, 2.0);
}

// Each method reaches 1 % on one suite only. Smallest errors 5 % and 0.2 % against 0.5 % and 6 %; relative to 1 %: 5
// and 1 against 1 and 6.
TEST(Preference, WhereNoneReachesTheErrorErrorsCount) {
  const choice::Preference found = preferred(
      "square_large,ugimp/usavg/flip,0.05,100\nsquare_large,cpdi/usavg/flip,0.005,900\n"
      "rotation,ugimp/usavg/flip,0.002,100\nrotation,cpdi/usavg/flip,0.06,900\n",
      {"square_large", "rotation"}, kThree, kOnePercent);
  EXPECT_EQ(found.suites.at(0).by, choice::Judged::smallest_error);
  EXPECT_EQ(found.suites.at(0).least, 0.01);
  EXPECT_EQ(found.chosen.method, "ugimp/usavg/flip");
  EXPECT_DOUBLE_EQ(found.chosen.by_suite.at(0), 5.0);
  EXPECT_DOUBLE_EQ(found.chosen.by_suite.at(1), 1.0);
  EXPECT_DOUBLE_EQ(found.others.at(0).worst, 6.0);
}

// uGIMP/USF reaches 1 % at 100. For twice that CPDI has 0.4 % and uGIMP/USAVG 0.8 %; a third of it is less than CPDI's
// cheapest run.
TEST(Preference, ACostBuysTheLeastError) {
  const std::string rows =
      "rotation,ugimp/usf/flip,0.01,100\nrotation,ugimp/usavg/flip,0.1,20\nrotation,ugimp/usavg/flip,0.008,200\n"
      "rotation,cpdi/usavg/flip,0.1,50\nrotation,cpdi/usavg/flip,0.004,200\n";
  EXPECT_EQ(preferred(rows, {"rotation"}, kThree, {{}, 2.0}).chosen.method, "cpdi/usavg/flip");
  EXPECT_EQ(preferred(rows, {"rotation"}, kThree, {{}, 2.0}).others.at(0).worst, 2.0);
  EXPECT_EQ(preferred(rows, {"rotation"}, kThree, {{}, 1.0 / 3.0}).chosen.method, "ugimp/usavg/flip");
  EXPECT_FALSE(choice::prefer(table(rows), {"rotation"}, kThree, {{}, 0.1}));
  // Halfway between 10 and 1000 in log-log, errors 1 and 0.01.
  EXPECT_NEAR(*choice::error_at({{10.0, 1.0}, {1000.0, 0.01}}, 100.0), 0.1, 1e-15);
  EXPECT_FALSE(choice::error_at({{10.0, 1.0}}, 9.0));
}

// A suite without runs does not count; a candidate without a run on a suite that counts is excluded.
TEST(Preference, OnlyWhatWasRunCounts) {
  const choice::Preference found =
      preferred(std::string(kTwoSuites) + "rotation,bspline3/usavg/flip,0.01,1\n",
                {"vortex", "square_large", "rotation"}, {"ugimp/usavg/flip", "bspline3/usavg/flip"}, kOnePercent);
  ASSERT_EQ(found.suites.size(), 2U);
  EXPECT_EQ(found.suites.at(0).name, "square_large");
  EXPECT_EQ(found.suites.at(1).name, "rotation");
  EXPECT_EQ(found.chosen.method, "ugimp/usavg/flip");
  EXPECT_FALSE(choice::prefer(table(kTwoSuites), {"vortex"}, kThree, kOnePercent));
  EXPECT_FALSE(choice::prefer(table(kTwoSuites), {"rotation"}, {"ugimp/usf/flip"}, kOnePercent));
}

// c = 1 m/s from 1000 Pa over 1000 kg/m^3 without lateral strain.
TEST(ExpectedMotion, IsFromTheScenesNumbers) {
  const auto of = [](const std::string& text) { return expected_motion(parse_scene(text, "test.yaml")); };
  EXPECT_EQ(of(block()).strain, 0.0);
  EXPECT_FALSE(of(block()).free || of(block()).contact || of(block()).flows);
  // The block stands on the grid's lower face: g H / c^2 = 0.02 x 0.4.
  EXPECT_NEAR(of(block("gravity: [0, -0.02]\n")).strain, 0.008, 1e-12);
  // Under upward gravity it falls 0.6 m: v = sqrt(2 x 0.02 x 0.6), plus the weight.
  EXPECT_NEAR(of(block("gravity: [0, 0.02]\n")).strain, std::sqrt(0.024) + 0.008, 1e-12);
  EXPECT_TRUE(of(block("gravity: [0, 0.02]\n")).free);
  EXPECT_NEAR(of(block("", ", initial: {velocity: [\"0.5*x\", 0]}")).strain, 0.3, 1e-12);  // at x = 0.6 m
  const std::string tool = "rigid_bodies: [{name: tool, shape: {box: {size: [0.1, 0.1]}}, pose: {position: [0.8, 0.8]}";
  EXPECT_EQ(of(block(tool + "}]\n")).strain, 0.1);
  EXPECT_EQ(of(block(tool + "}]\n")).turn, 0.0);
  EXPECT_TRUE(of(block(tool + "}]\n")).contact);
  EXPECT_NEAR(of(block(tool + ", motion: {rotation_rate: 1}}]\n")).turn, std::acos(0.0), 1e-15);
  EXPECT_TRUE(of(block("boundaries: {z_min: {friction: 0.2}}\n")).contact);
  EXPECT_FALSE(of(block("boundaries: {z_min: slip}\n")).contact);
  // It turns about its middle at (0.4, 0.2) at 2 rad/s for a tenth of a second; a shear turns at half its rate.
  EXPECT_NEAR(of(block("time: {end: 0.1}\n", ", initial: {velocity: [\"2*(z-0.2)\", \"-2*(x-0.4)\"]}")).turn, 0.2,
              1e-12);
  EXPECT_NEAR(of(block("time: {end: 0.1}\n", ", initial: {velocity: [\"2*(z-0.2)\", 0]}")).turn, 0.1, 1e-12);
  EXPECT_NEAR(of(block("", ", initial: {velocity: [\"2*z\", 0]}")).turn, std::acos(0.0), 1e-15);  // no end
  EXPECT_EQ(of(block("", ", initial: {velocity: [\"0.5*x\", 0.1]}")).turn, 0.0);
  const ExpectedMotion sand = of(block("", "", "drucker_prager, friction_angle: 0.5"));
  EXPECT_TRUE(sand.flows);
  EXPECT_EQ(sand.strain, 1.0);
  EXPECT_NEAR(sand.turn, std::acos(0.0), 1e-15);
}

// With the same table, the bar and the small square count at rest, the large square under pressure, and the rotation
// too in a turn.
TEST(AutoMethod, SuitesFollowTheScene) {
  const std::string rows =
      "bar_small,ugimp/usavg/flip,0.01,100\nbar_small,bspline2/usavg/flip,0.01,200\nbar_small,cpdi/usavg/"
      "flip,0.01,200\n"
      "square_small,ugimp/usavg/flip,0.01,100\nsquare_small,bspline2/usavg/flip,0.01,200\n"
      "square_small,cpdi/usavg/flip,0.01,200\n" +
      std::string(kTwoSuites);
  EXPECT_EQ(label(chosen(block(), rows)), "ugimp/usavg/flip");
  AutoMethod asked;
  asked.strain = 0.5;
  EXPECT_EQ(label(chosen(block(), rows, asked)), "ugimp/usavg/flip");
  asked.turn = 1.0;
  const Scene turned = chosen(block(), rows, asked);
  EXPECT_EQ(label(turned), "bspline2/usavg/flip");
  EXPECT_EQ(said(turned),
            "bspline2, usavg, flip: reaches 1 % at 1.20 times the least cost in square_large, 1.20 in rotation; "
            "cpdi, usavg, flip comes next, with 2.00 at worst; ugimp, usavg, flip has 2.00 at worst");
  EXPECT_EQ(said(turned, "method.auto.strain"), "");  // given by the scene
  EXPECT_EQ(said(chosen(block(), rows), "method.auto.strain"), "0 %: nothing moves the material");
}

// For what uGIMP/USF takes for 1 %, CPDI has 0.5 % and uGIMP/USAVG 2 % on the one suite, both the same on the other.
// Where no method reaches the required error, the reasons state errors.
TEST(AutoMethod, SaysWhatABudgetBuys) {
  const std::string rows =
      "bar_small,ugimp/usf/flip,0.01,100\nbar_small,ugimp/usavg/flip,0.02,100\nbar_small,cpdi/usavg/flip,0.005,100\n"
      "square_small,ugimp/usf/flip,0.01,100\nsquare_small,ugimp/usavg/flip,0.01,100\n"
      "square_small,cpdi/usavg/flip,0.01,100\n";
  AutoMethod asked;
  asked.budget = {{}, 1.0};
  const Scene scene = chosen(block(), rows, asked);
  EXPECT_EQ(
      said(scene),
      "cpdi, usavg, flip: at 1 times the cost of ugimp, usf, flip for 1 %, errs by 1.00 times the least error in "
      "bar_small, 1.00 in square_small; ugimp, usf, flip comes next, with 2.00 at worst; ugimp, usavg, flip has 4.00 "
      "at worst");
  asked.budget = {0.001, {}};
  EXPECT_EQ(said(chosen(block(), rows, asked)),
            "cpdi, usavg, flip: where not all methods reach 0.1 %, errs by 1.00 times the smallest error or 0.1 % in "
            "bar_small, 1.00 in square_small; ugimp, usf, flip comes next, with 2.00 at worst; ugimp, usavg, flip has "
            "4.00 at worst");
  asked.budget = {{}, 0.5};
  EXPECT_EQ(said(chosen(block(), rows, asked)).find("ugimp, usavg, flip: the default; no measured method"), 0U);
}

// Counts the square where runs on the cube only reach an error of 2 %, above the required 1 %; where one reaches 1 %,
// the cube counts.
TEST(AutoMethod, ACubeCountsWhereItIsSolved) {
  const std::string rows =
      "bar_small,ugimp/usavg/flip,0.01,100\nbar_small,cpdi/usavg/flip,0.01,100\n"
      "square_small,ugimp/usavg/flip,0.01,300\nsquare_small,cpdi/usavg/flip,0.01,100\n"
      "cube_small,cpdi/usavg/flip,0.02,300\n";
  const std::string solid =
      "grid: {cell: 0.1, min: [0, 0, 0], max: [1, 1, 1]}\n"
      "materials: [{name: soft, density: 1000, law: neo_hookean, young: 1000, poisson: 0}]\n"
      "bodies: [{name: block, material: soft, shape: {box: {min: [0, 0, 0], max: [0.4, 0.4, 0.4]}}}]\n";
  EXPECT_EQ(label(chosen(solid, rows + "cube_small,ugimp/usavg/flip,0.02,100\n")), "cpdi/usavg/flip");
  EXPECT_EQ(label(chosen(solid, rows + "cube_small,ugimp/usavg/flip,0.01,100\n")), "ugimp/usavg/flip");
}

// Dirac is cheapest here but not chosen; where material flows only uGIMP with FLIP is.
TEST(AutoMethod, LeavesOutWhatIsNotSafe) {
  const std::string rows =
      "bar_small,dirac/usavg/flip,0.01,10\nbar_small,cpdi/usavg/flip,0.01,50\nbar_small,ugimp/usavg/flip,0.01,100\n"
      "square_large,dirac/usavg/flip,0.01,10\nsquare_large,cpdi/usavg/flip,0.01,50\n"
      "square_large,ugimp/usavg/flip,0.01,100\nsquare_large,ugimp/usavg/flip/single,0.01,1\n"
      "bar_small,ugimp/usavg/apic,0.01,80\nsquare_large,ugimp/usavg/apic,0.01,80\n"
      "bar_small,bspline2/usavg/flip,0.01,70\nsquare_large,bspline2/usavg/flip,0.01,70\n";
  EXPECT_EQ(label(chosen(block(), rows)), "cpdi/usavg/flip");
  EXPECT_EQ(label(chosen(block("", "", "drucker_prager, friction_angle: 0.5"), rows)), "ugimp/usavg/flip");
}

TEST(AutoMethod, KeepsWhatTheSceneSays) {
  const std::string rows =
      "bar_small,ugimp/usavg/flip,0.01,100\nbar_small,ugimp/usavg/apic,0.01,200\nbar_small,cpdi/usavg/apic,0.01,100\n"
      "bar_small,cpdi/usavg/flip,0.01,300\n";
  AutoMethod apic;
  apic.keep_transfer = true;
  Scene scene = parse_scene(block("method: {transfer: apic}\n"), "test.yaml");
  choose_method(apic, {table(rows), "", ""}, scene);
  EXPECT_EQ(label(scene), "cpdi/usavg/apic");
  // A fraction of FLIP that was not measured is judged as FLIP and kept.
  scene = parse_scene(block("method: {transfer: {flip: 0.998}}\n"), "test.yaml");
  choose_method(apic, {table(rows), "", ""}, scene);
  EXPECT_EQ(label(scene), "ugimp/usavg/flip0.998");
  AutoMethod shape;
  shape.keep_shape = true;
  scene = parse_scene(block("method: {shape: cpdi}\n"), "test.yaml");
  choose_method(shape, {table(rows), "", ""}, scene);
  EXPECT_EQ(label(scene), "cpdi/usavg/apic");
  // APIC cannot be combined with damping of particles, so it is not chosen for a scene with it.
  scene = parse_scene(block("method: {shape: cpdi, damping: {particle: 5}}\n"), "test.yaml");
  choose_method(shape, {table(rows), "", ""}, scene);
  EXPECT_EQ(label(scene), "cpdi/usavg/flip");
  // The text of a scene gives the same.
  scene =
      parse_scene(block("method: {auto: {}, transfer: apic, particles_per_cell: 9, precision: single}\n"), "t.yaml");
  EXPECT_EQ(scene.definition.method.transfer.kind, TransferKind::apic);
  EXPECT_EQ(scene.definition.method.particles_per_direction, 3);
  EXPECT_EQ(scene.definition.method.precision, Precision::float32);
  scene = parse_scene(block("method: {auto: {}, shape: qcpdi, update: usl, transfer: pic}\n"), "t.yaml");
  EXPECT_EQ(label(scene), "qcpdi/usl/pic");
  EXPECT_EQ(said(scene), "qcpdi, usl, pic: all named by the scene");
}

/// Replaces the package's table for the duration of a test.
class TableFile {
 public:
  explicit TableFile(const std::string& text)
      : path_(testing::TempDir() + "costs_" + std::to_string(getpid()) + ".csv") {
    std::ofstream(path_) << text;
    setenv("MPM_ROS_METHOD_COSTS", path_.c_str(), 1);
  }
  TableFile(const TableFile&) = delete;
  TableFile& operator=(const TableFile&) = delete;
  ~TableFile() {
    unsetenv("MPM_ROS_METHOD_COSTS");
    std::remove(path_.c_str());
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

TEST(AutoMethod, WithoutATableTheDefaultIsTakenAndSaid) {
  const struct {
    const char *text, *fault;
  } cases[] = {
      {"", ": line 1: not the header suite,method,error,cost"},
      {"suite,method,error,cost\n", ": no run"},
      {"suite,method,error,cost\nrotation,ugimp/usf/flip,0.1\n", ": line 2: 3 cells, not 4"},
      {"suite,method,error,cost\nrotation,ugimp/usf/flip,x,1\n", ": line 2: 'x' is not a number greater than 0"},
      {"suite,method,error,cost\nrotation,ugimp/usf/flip,1,inf\n", ": line 2: 'inf' is not a number greater"},
      {"suite,method,error,cost\nrotaton,ugimp/usf/flip,1,1\n", ": line 2: no suite is called 'rotaton'"},
      {"suite,method,error,cost\nrotation,gimp/usf/flip,1,1\n", ": line 2: no method is called 'gimp/usf/"}};
  for (const auto& [text, fault] : cases) {
    const TableFile file(text);
    const Scene scene = parse_scene(block(), "test.yaml");
    EXPECT_EQ(label(scene), "ugimp/usavg/flip");
    EXPECT_EQ(said(scene).find("ugimp, usavg, flip: the default; " + file.path() + fault), 0U) << said(scene);
  }
  const TableFile file("");
  std::remove(file.path().c_str());
  EXPECT_EQ(said(parse_scene(block("method: {auto: {}, shape: cpdi}\n"), "test.yaml")),
            "cpdi, usavg, flip: the default; " + file.path() +
                " cannot be read; run scripts/methods, or name a table in MPM_ROS_METHOD_COSTS");
}

// A scene without a method, `method: auto` and `method: {auto: {}}` are the same; --explain reports the choice, and the
// record contains the chosen method, not `auto`.
TEST(AutoMethod, IsWhatASceneWithoutAMethodGets) {
  const TableFile file(std::string(kHead) +
                       "bar_small,cpdi/usf/flip,0.01,10\nsquare_small,cpdi/usavg/fmpm2,0.01,10\n"
                       "square_small,bspline2/usavg/fmpm2,0.01,10\nbar_small,bspline2/usavg/fmpm2,0.01,10\n");
  const Scene scene = parse_scene(block(), "test.yaml");
  EXPECT_EQ(label(scene), "bspline2/usavg/fmpm2");
  for (const char* method : {"method: auto\n", "method: {auto: {}}\n"}) {
    const Scene other = parse_scene(block(method), "test.yaml");
    EXPECT_EQ(label(other), label(scene));
    EXPECT_EQ(said(other), said(scene));
  }
  const std::string explained = explain(scene, build(scene));
  EXPECT_EQ(explained, explain(parse_scene(block(), "test.yaml"), build(scene)));  // equal in every run
  EXPECT_NE(explained.find("method: plane strain, 1 m thick, bspline2, usavg, fmpm 2,"), std::string::npos)
      << explained;
  EXPECT_NE(
      explained.find("\n  method: bspline2, usavg, fmpm 2: reaches 1 % at 1.00 times the least cost in bar_small, "
                     "1.00 in square_small\n"),
      std::string::npos)
      << explained;
  EXPECT_EQ(scene.text.find("auto"), std::string::npos) << scene.text;
  EXPECT_EQ(label(parse_scene(scene.text, "record.yaml")), "bspline2/usavg/fmpm2");
}

TEST(AutoMethod, BadKeysSayWhatToWrite) {
  const auto why = [](const std::string& method, const std::string& scene = block()) -> std::string {
    try {
      parse_scene(scene + "method: " + method + "\n", "bad.yaml");
    } catch (const SceneError& error) {
      return error.what();
    }
    return "no error";
  };
  const std::string start = "bad.yaml:5: method.auto";
  EXPECT_EQ(why("{auto: {strian: 1}}").find(start + ".strian: unknown key 'strian'; did you mean 'strain'?"), 0U);
  EXPECT_EQ(why("{auto: {strain: -1}}").find(start + ".strain: '-1' is less than 0;"), 0U);
  EXPECT_EQ(why("{auto: {turn: 1 m}}").find(start + ".turn: '1 m' is a length, but an angle is expected;"), 0U);
  EXPECT_EQ(why("{auto: {error: 0}}").find(start + ".error: '0' is not greater than 0;"), 0U);
  EXPECT_EQ(why("{auto: {error: 1 %, cost: 2}}"),
            start + ".cost: a budget is an error or a cost, not both; leave one out");
  EXPECT_EQ(why("{auto: true}").find(start + ": found one value; write keys, of strain, turn, error, cost"), 0U);
  EXPECT_EQ(why("auot").find("bad.yaml:5: method: 'auot' is not known; did you mean 'auto'?"), 0U) << why("auot");
  EXPECT_EQ(why("{auto: {}, shape: dirac, transfer: apic}").find("bad.yaml:5: method.transfer: apic and particles"),
            0U);
  const std::string line =
      "geometry: line\ngrid: {cell: 0.1, min: 0, max: 1}\n"
      "materials: [{name: soft, density: 1000, law: neo_hookean, young: 1000, poisson: 0}]\n"
      "bodies: [{name: bar, material: soft, shape: {box: {min: 0.2, max: 0.6}}}]\n";
  EXPECT_EQ(why("{auto: {turn: 1}}", line), start + ".turn: nothing turns in a line; leave it out");
  EXPECT_EQ(why("{auto: {}}", line), "no error");
}

// The shipped table can be read, and gives every kind of scene a method.
TEST(AutoMethod, TheShippedTableServesEveryScene) {
  const MethodCostsFile file = load_method_costs(source_file("config/method_costs.csv"));
  ASSERT_EQ(file.fault, "");
  for (const double strain : {0.001, 0.5}) {
    for (const double turn : {0.0, 1.5}) {
      AutoMethod asked;
      asked.strain = strain;
      asked.turn = turn;
      Scene scene =
          parse_scene(block("boundaries: {z_min: {friction: 0.2}}\n", ", initial: {velocity: [0.1, 0]}"), "t");
      scene.choices.clear();
      choose_method(asked, file, scene);
      EXPECT_EQ(said(scene).find("the default;"), std::string::npos) << said(scene);
    }
  }
}

}  // namespace auto_method_test
}  // namespace mpm
