// Runs over several ranks, which are threads here, against the same runs on one process: the motion, the forces on
// tools and what is dissipated; checkpoints, which any number of ranks reads; and a run that fails on one rank.
// Cost: 25 s on two processors, of which spheres pressed into an elastic body about an axis take 7.
#include <gtest/gtest.h>

#include <cmath>

#include "over_ranks_checkpoint.hpp"
#include "rank_counts.hpp"

namespace verification {
namespace over_ranks {
namespace over_ranks_test {

class OverRanks : public testing::TestWithParam<Case> {};

TEST_P(OverRanks, MovesAsOnOneProcess) {
  const Outcome alone = run_alone(GetParam());
  ASSERT_GT(alone.exchanged + alone.carried, 0.0);
  const auto presses = [](const auto& report) { return report.pressing > 0.0; };
  EXPECT_TRUE(alone.contacts.empty() || std::any_of(alone.contacts.begin(), alone.contacts.end(), presses));
  EXPECT_TRUE(std::all_of(alone.pairs.begin(), alone.pairs.end(), presses));
  for (const int count : mpm::test::rank_counts({1, 2, 3, 8}, 3)) {
    SCOPED_TRACE(count);
    const Outcome over = run_over(GetParam(), count);
    expect_equal(over, alone, 1e-10);
    // Not of every scene: whether a node that neither nears nor leaves a tool touches it is a matter of round-off.
    for (std::size_t b = 0; b < alone.contacts.size(); ++b) {
      EXPECT_EQ(over.contacts[b].nodes, alone.contacts[b].nodes) << alone.contacts[b].body;
    }
  }
}

const Case kCases[] = {
    {"sliding_block", {}},                                                  // friction on a tool, in the plane
    {"column_collapse", {}},                                                // soil, mean stresses of cells, rough walls
    {"speed_tool_3d", {"grid.cell=0.04", "rigid_bodies.blade.sides=one"}},  // a tool met at points
    {"sphere_indentation", {"time.end=0.01"}, 300},                         // about an axis
    {"end_loaded_cylinder", {}},                                            // tractions
    {"compressed_block", {}},                                               // tools and damping
    {"speed_block_3d", {"grid.cell=0.04", "time.sync=0.005"}},              // free flight
    {"wheel_in_sand", {"method={update: usf}"}},                            // a free body in the plane
    {"ranks_free", {}},                               // a free body in space, heat between it and the material
    {"ranks_plough", {"contact.method=nodes"}, 300},  // a tool in soil, met at nodes
    {"ranks_pair", {}},                               // bodies that meet and warm each other, loads on particles
    {"ranks_warm", {}},                               // heat, in bodies of which ranks have no particle at the start
    {"ranks_chute", {}},                              // a periodic axis
    {"swelling_strip", {}},                           // a solvent that flows in, velocity conditions
    {"consolidating_cylinder", {}},                   // water in pores
    {"terzaghi_column", {}},                          // the same on a line, which has fewer blocks than ranks
    {"pressed_disk", {"rigid_bodies.top.motion={velocity: [0, -0.2]}"}},  // particles of masses of their own
    {"plate_in_sleeping_sand",
     {"grid.max=[1.6, 0.5]", "bodies.bed.shape.box.max=[1.6, 0.2]", "rigid_bodies.plate.pose.position=[0.3, 0.2502]",
      "rigid_bodies.plate.motion={velocity: [0, -0.3]}"}},  // geostatic
};

INSTANTIATE_TEST_SUITE_P(Of, OverRanks, testing::ValuesIn(kCases), [](const auto& run) { return run.param.scene; });

TEST(OverRanksRepeated, HasTheSameBits) {
  const Case run{"column_collapse", {}};
  const Outcome first = run_over(run, 3), second = run_over(run, 3);
  EXPECT_EQ(first.state_hash, second.state_hash);
  EXPECT_EQ(first.memory_hash, second.memory_hash);
}

class OverRanksCheckpoint : public testing::Test {
 protected:
  Outcome write(int count) const { return half_way_.write(run_, count); }
  Outcome go_on(int count) const { return half_way_.go_on(run_, count); }

  Case run_{"column_collapse", {}};
  HalfWay half_way_;
};

TEST_F(OverRanksCheckpoint, GoesOnToTheBitOnAsManyRanks) {
  const Outcome whole = write(3), resumed = go_on(3);
  EXPECT_EQ(resumed.state_hash, whole.state_hash);
  EXPECT_EQ(resumed.memory_hash, whole.memory_hash);
}

TEST_F(OverRanksCheckpoint, IsReadByAnyNumberOfRanks) {
  const Outcome whole = write(3);
  for (const int count : mpm::test::rank_counts({1, 2, 5}, 2)) {
    SCOPED_TRACE(count);
    expect_equal(go_on(count), whole, 1e-10);
  }
}

// Ranks met when the tool was 0.8 cells from where it is when the checkpoint is written: blocks near it are those of
// that place, and nodes of the absorbing face are stored by the numbers of blocks.
TEST_F(OverRanksCheckpoint, GoesOnToTheBitWhileAToolMoves) {
  run_ = {"ranks_plough", {"boundaries.x_max=absorbing"}, 130};
  const Outcome whole = write(3), resumed = go_on(3);
  EXPECT_EQ(resumed.state_hash, whole.state_hash);
  EXPECT_EQ(resumed.memory_hash, whole.memory_hash);
}

// Memory of what a free body, points of contact, heat, pairs and conditions remember, too.
TEST_F(OverRanksCheckpoint, KeepsWhatModulesRemember) {
  for (const char* scene : {"ranks_free", "ranks_pair", "ranks_chute", "terzaghi_column", "swelling_strip"}) {
    SCOPED_TRACE(scene);
    run_.scene = scene;
    const Outcome whole = write(3), same = go_on(3);
    EXPECT_EQ(same.state_hash, whole.state_hash);
    EXPECT_EQ(same.memory_hash, whole.memory_hash);
    expect_equal(go_on(2), whole, 1e-10);
  }
}

TEST_F(OverRanksCheckpoint, KeepsMassesAndReachesOfParticlesThatASurfaceCuts) {
  run_ = {"pressed_disk", {"rigid_bodies.top.motion={velocity: [0, -0.2]}"}};
  const Outcome whole = write(3), same = go_on(3);
  EXPECT_GT(whole.contacts[1].pressing, 0.0);
  EXPECT_EQ(same.state_hash, whole.state_hash);
  EXPECT_EQ(same.memory_hash, whole.memory_hash);
  expect_equal(go_on(2), whole, 1e-10);
}

TEST_F(OverRanksCheckpoint, OfOneProcessGoesOnOverRanks) {
  const Outcome whole = write(1);
  expect_equal(go_on(4), whole, 1e-10);
}

}  // namespace over_ranks_test
}  // namespace over_ranks
}  // namespace verification
