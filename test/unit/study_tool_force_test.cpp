// The suite of forces on tools: its scenes are scenes, and its measures measure what they say.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mpm/math/constants.hpp"
#include "mpm/scene/scene.hpp"
#include "study/suite.hpp"
#include "study/tool_force/force_measure.hpp"
#include "study/tool_force/run.hpp"

namespace mpm::study::tool_force {
namespace study_tool_force_test {

// Every problem can be built on two grids and with both laws. One about the force on a tool has one tool, which reaches
// the end of the stretch on which its force is averaged; any other runs until the end of what it measures. (1 s)
TEST(ToolForce, ProblemsAreScenes) {
  for (const Problem& problem : problems()) {
    for (const double cells : {4.0, 6.0}) {
      for (const char* law : {"drucker_prager/plane_strain", "mohr_coulomb"}) {
        const SimulationDefinition definition =
            build(parse_scene(problem.scene(problem, {cells, law}), problem.name, {"contact.method=nodes"}));
        if (!problem.measure) {
          ASSERT_EQ(definition.rigid_bodies.size(), 1u) << problem.name;
        }
        EXPECT_NEAR(definition.grid.cell.x() * cells, problem.length, 1e-12) << problem.name;
        const double last = problem.measure ? problem.to : problem.time_of(problem.last(cells));
        EXPECT_GE(definition.time.end, last) << problem.name;
        EXPECT_LE(problem.answer.lower, problem.answer.upper) << problem.name;
        EXPECT_EQ(problem.known == Known::exact, problem.answer.lower == problem.answer.upper) << problem.name;
      }
    }
  }
}

TEST(ToolForce, UnknownProblemsAndLawsAreRefused) {
  try {
    find_problem("blade");
    FAIL();
  } catch (const StudyError& error) {
    EXPECT_NE(std::string(error.what()).find("no problem of tool_force is called 'blade'; there are blade_flat, "),
              std::string::npos);
  }
  const ForceRow row = run_row(find_problem("blade_flat"), 4.0, {"law=mud"});
  EXPECT_EQ(row.status, "refused");
  EXPECT_NE(row.message.find("mud"), std::string::npos) << row.message;
}

// The slower tool takes longer for the same way, and meets the same exact force.
TEST(ToolForce, SpeedIsAFactorOfTheProblems) {
  const Problem& strip = find_problem("strip_clay");
  const ForceRow usual = run_row(strip, 4.0, {}), slow = run_row(strip, 4.0, {"speed=0.5"});
  ASSERT_EQ(slow.status, "ok") << slow.message;
  EXPECT_GT(slow.steps, 1.5 * static_cast<double>(usual.steps));
  EXPECT_NEAR(slow.curve.back().first, usual.curve.back().first, 0.1 * usual.curve.back().first);
  const ForceRow wrong = run_row(strip, 4.0, {"speed=fast"});
  EXPECT_EQ(wrong.status, "refused");
  EXPECT_EQ(wrong.message, "'speed=fast' is no factor of the tool's speed; write one such as speed=0.5");
}

TEST(ToolForce, VariantsAreAllCombinations) {
  EXPECT_EQ(variants_of({}), std::vector<Overrides>{{}});
  EXPECT_EQ(variants_of({"a=1|2", "b={c: 0.5}|d"}),
            (std::vector<Overrides>{{"a=1", "b={c: 0.5}"}, {"a=1", "b=d"}, {"a=2", "b={c: 0.5}"}, {"a=2", "b=d"}}));
  EXPECT_THROW(variants_of({"a"}), StudyError);
}

// Two cells: 1, 2, 3 has the deviation sqrt(2/3), 4, 4, 4 has none; means 2 and 4. A cell of two particles does not
// count, but one of its particles carries nothing.
TEST(ToolForce, ScatterIsThatInsideCells) {
  PressureScatter scatter;
  std::vector<Vec3> places;
  for (const double x : {0.1, 0.2, 0.3, 1.1, 1.2, 1.3, -0.5, -0.6}) places.emplace_back(x, 0.0, 0.5);
  scatter.add(places, {1.0, 2.0, 3.0, 4.0, 4.0, 4.0, 0.0, 9.0}, 1.0);
  EXPECT_NEAR(scatter.scatter(), std::sqrt(2.0 / 3.0) / 6.0, 1e-12);
  EXPECT_NEAR(scatter.unloaded(), 1.0 / 8.0, 1e-12);
}

// A force that grows by a straight line has no ripple. A cosine on it of a tenth of the mean 6.5 has one of 0.1, less
// what averages over a tenth of its period take: sin(pi/10) / (pi/10) = 0.984, and cos(pi/10) = 0.951 at their middles.
TEST(ToolForce, RippleIsWhatIsLeftOfAStraightLine) {
  std::vector<double> travel, line, wave;
  for (int i = 0; i < 1000; ++i) {
    travel.push_back(1e-3 * (i + 0.5));  // none on the border of two parts
    line.push_back(5.0 + 3.0 * travel.back());
    wave.push_back(line.back() + 0.65 * std::cos(2.0 * kPi * (travel.back() - 0.1) / 0.8));
  }
  EXPECT_NEAR(ripple(travel, line, 0.1, 0.8), 0.0, 1e-12);
  EXPECT_NEAR(ripple(travel, wave, 0.1, 0.8), 0.1 * 0.984 * 0.951, 1e-3);
  EXPECT_TRUE(std::isnan(ripple(travel, line, 0.5, 0.8)));
}

// The table is read by programs: a number that is not known is null there.
TEST(ToolForce, JsonHasEveryRow) {
  ForceRow row;
  row.problem = "blade_flat";
  row.cells = 4.0;
  row.over_exact = 1.25;
  row.status = "ok";
  std::stringstream text;
  write_json(text, {row});
  const nlohmann::json json = nlohmann::json::parse(text.str());
  EXPECT_EQ(json["problems"].size(), problems().size());
  EXPECT_EQ(json["rows"][0]["over_exact"], 1.25);
  EXPECT_TRUE(json["rows"][0]["ripple"].is_null());
}

// A run of the coarsest strip. Between a quarter and twice the exact load: the tool has met the ground, forces have the
// right sign and unit, and the half is counted twice. The accuracy is measured by the suite.
TEST(ToolForce, ARunFillsItsRow) {
  const ForceRow row = run_row(find_problem("strip_clay"), 4.0, {"contact.method=nodes"});
  ASSERT_EQ(row.status, "ok") << row.message;
  EXPECT_EQ(row.contact, "nodes");
  EXPECT_GT(row.over_exact, 0.25);
  EXPECT_LT(row.over_exact, 2.0);
  EXPECT_GT(row.real_time_factor, 0.0);
  EXPECT_TRUE(std::isfinite(row.scatter));
  EXPECT_GT(row.curve.size(), 20u);
  EXPECT_GE(row.curve.back().first, 0.9 * find_problem("strip_clay").to);
}

}  // namespace study_tool_force_test
}  // namespace mpm::study::tool_force
