// Single parts of a scene over several ranks, each in a scene that needs it: motion, energies, impulses and
// numbers as on one process, and checkpoints. Ranks are threads (over_ranks_run.hpp).
//
// Runs are asked to be equal to 1e-10 of the momentum that was exchanged in a hundred steps, as in over_ranks_test.cpp;
// they are seen to be so to 1e-14. Cost: 90 s on two cores, most of it the many messages of cracks between threads.
#include <gtest/gtest.h>

#include <algorithm>

#include "over_ranks_checkpoint.hpp"
#include "rank_counts.hpp"

namespace verification {
namespace over_ranks_more_test {

using namespace over_ranks;
using over_ranks::Case;
using over_ranks::Outcome;

constexpr double kPart = 1e-10;

double number_of(const Outcome& outcome, const std::string& name) {
  for (const mpm::NamedNumber& number : outcome.numbers) {
    if (number.name == name) return number.value;
  }
  ADD_FAILURE() << "no number '" << name << "'";
  return 0.0;
}

/// A scene, and what it is there for: numbers, each with the value that it has to pass.
struct Part {
  const char* name;
  Case run;
  std::vector<std::pair<std::string, double>> passes;
};

std::ostream& operator<<(std::ostream& out, const Part& part) { return out << part.name; }

/// As expect_equal(), with each account of impulses, the numbers of modules and metrics.
void expect_alike(const Outcome& over, const Outcome& alone) {
  expect_equal(over, alone, kPart);
  const double scale = std::max(alone.exchanged, alone.carried);
  ASSERT_EQ(over.impulses.size(), alone.impulses.size());
  for (std::size_t i = 0; i < alone.impulses.size(); ++i) {
    EXPECT_LE((over.impulses[i].impulse - alone.impulses[i].impulse).norm(), kPart * scale) << alone.impulses[i].name;
  }
  ASSERT_EQ(over.numbers.size(), alone.numbers.size());
  for (std::size_t i = 0; i < alone.numbers.size(); ++i) {
    if (alone.numbers[i].name == "temperature budget error") {  // round-off by itself
      EXPECT_LT(over.numbers[i].value, 1e-12);
      continue;
    }
    EXPECT_NEAR(over.numbers[i].value, alone.numbers[i].value, 1e-8 * std::abs(alone.numbers[i].value))
        << alone.numbers[i].name;
  }
}

class OverRanksPart : public testing::TestWithParam<Part> {
 protected:
  Outcome write(int count) const { return half_way_.write(GetParam().run, count); }
  Outcome go_on(int count) const { return half_way_.go_on(GetParam().run, count); }

  HalfWay half_way_;
};

TEST_P(OverRanksPart, IsAsOnOneProcess) {
  const Outcome alone = run_alone(GetParam().run);
  for (const auto& [name, least] : GetParam().passes) EXPECT_GT(number_of(alone, name), least) << name;
  for (const int count : mpm::test::rank_counts({2, 3, 8}, 3)) {
    SCOPED_TRACE(count);
    expect_alike(run_over(GetParam().run, count), alone);
  }
}

TEST_P(OverRanksPart, GoesOnFromACheckpoint) {
  const Outcome whole = write(3), resumed = go_on(3);
  EXPECT_EQ(resumed.state_hash, whole.state_hash);
  EXPECT_EQ(resumed.memory_hash, whole.memory_hash);
  for (const int count : mpm::test::rank_counts({1, 2, 5}, 2)) {
    SCOPED_TRACE(count);
    expect_alike(go_on(count), whole);
  }
  const Outcome alone = write(1);
  SCOPED_TRACE("written by one process");
  expect_alike(go_on(4), alone);
}

const Part kParts[] = {
    {"Leaving", {"spray", {}}, {{"returned", 100.0}}},
    {"FeedbackDamping", {"calming_block", {}}, {{"alpha", 5.0}}},
    {"AbsorbingFaces", {"waves_out", {}}, {}},
    {"AbsorbingFacesByXpic", {"waves_out", {"method.transfer={xpic: 2}"}}, {}},
    {"CrackThatIsPulledOpen", {"edge_crack", {}}, {{"crack 1 end j", 0.0}}},
    {"CrackAboutAnAxis", {"penny_crack", {}}, {{"crack 1 end j", 0.0}}},
    {"CracksThatGrow",
     {"cracked_plate", {}, 150},
     {{"crack 1 start growth", 0.0}, {"crack 1 end growth", 0.0}, {"crack 2 end growth", 0.0}}},
    {"CracksThatCross", {"crossed_cracks", {}}, {{"crack 3 end j", 0.0}}},
    {"GluedFaces", {"glued_blocks", {}}, {}},
    {"HeatOfATip", {"heated_tip", {}, 150}, {{"crack 1 end growth", 0.0}}},
    {"WedgeInACrack",
     {"wedge_block",
      {"rigid_bodies.wedge.motion.velocity=[0, -15]", "materials.foam.fracture.j_ic=30", "contact.method=nodes"},
      150},
     {{"crack 1 end growth", 0.0}}},
    {"WedgeInACrackMetAtPoints",
     {"wedge_block", {"rigid_bodies.wedge.motion.velocity=[0, -15]", "materials.foam.fracture.j_ic=30"}, 150},
     {{"crack 1 end growth", 0.0}}},
    {"ThinTool", {"ploughed_bed", {}}, {}},
    // Averages of stress depend on when particles are sorted, as they are where others read a checkpoint.
    {"ToolOfParticles", {"ploughed_bed", {"rigid_bodies.blade.sides=one", "method.average_stress=false"}}, {}},
    {"ThinToolMetAtPoints", {"speed_tool_3d", {"grid.cell=0.04"}}, {}},
};

INSTANTIATE_TEST_SUITE_P(Of, OverRanksPart, testing::ValuesIn(kParts), [](const auto& of) { return of.param.name; });

// One particle more than may leave, on whichever rank, ends the run on all of them, with one message.
TEST(OverRanksLeaving, IsLimitedOverAllRanks) {
  const auto left = static_cast<int>(number_of(run_alone({"spray", {}}), "returned"));
  const auto run_with = [](int limit) { return run_over({"spray", {"grid.leave.limit=" + std::to_string(limit)}}, 3); };
  EXPECT_EQ(number_of(run_with(left), "returned"), left);
  try {
    run_with(left - 1);
    FAIL() << "nothing was said";
  } catch (const mpm::PhysicsError& error) {
    EXPECT_EQ(std::string(error.what())
                  .find("more than " + std::to_string(left - 1) +
                        " particles have left the grid (grid.leave.limit): particle "),
              0u)
        << error.what();
  }
}

}  // namespace over_ranks_more_test
}  // namespace verification
