// Effect of growth on pairs of particle and node that it puts across the crack (crack/field_jumps.hpp), and which field
// of a node holds what lies beyond cracks (crack/divided_node.hpp).
#include <gtest/gtest.h>

#include "mpm/crack/field_jumps.hpp"
#include "mpm/grid/field_map.hpp"

namespace crack_field_jumps_test {

using namespace mpm;

TEST(CrackFieldJumps, AWayThatCrossesTwiceDoesNotCross) {
  CracksBetween between;
  between.toggle({3, true});
  between.toggle({1, false});
  ASSERT_EQ(between.count, 2);
  EXPECT_EQ(between.across[0].crack, 1);  // in the cracks' order
  EXPECT_EQ(between.across[1].crack, 3);
  between.toggle({1, true});
  ASSERT_EQ(between.count, 1);
  EXPECT_EQ(between.across[0], (AcrossCrack{3, true}));
  EXPECT_EQ(between.across[1].crack, -1);
}

TEST(CrackFieldJumps, FieldsAreKnownByWhatTheyHold) {
  FieldLabels labels;
  labels.single = {AcrossCrack{2, true}, AcrossCrack{0, false}};
  labels.both = {AcrossCrack{0, false}, AcrossCrack{2, true}};
  EXPECT_EQ(labels.field_of({}), 0);
  EXPECT_EQ(labels.field_of({{AcrossCrack{0, false}}, 1}), 2);
  EXPECT_EQ(labels.field_of({{AcrossCrack{2, true}}, 1}), 1);
  EXPECT_EQ(labels.field_of({{AcrossCrack{2, false}}, 1}), -1);
  EXPECT_EQ(labels.field_of({labels.both, 2}), 3);
}

/// A crack along z = 0.75 whose tip has come to x = 0.5, and a node above it, at (0.5, 0.8), in whose field 1 there is
/// material from below.
struct Opening {
  Opening() : fields(make_fields(GridLayout(2, Vec3::Constant(0.1), Vec3::Zero(), Vec3(1.6, 0.0, 1.6)), 2)) {
    const std::array<int, 3> block{1, 2, 0};
    const int local = 1 * 4 + 0;
    node.place = Vec2(0.5, 0.8);
    node.single[0] = {0, false};
    node.ref.fill({-1, 0});
    for (int f = 0; f < 2; ++f) {
      Grid& grid = *fields[f];
      grid.rebuild({grid.layout.key(block)});
      const int b = grid.blocks.find(grid.layout.key(block));
      grid.mass.at(b, 0, local) = 1.0;
      grid.velocity.at(b, 0, local) = 0.0;
      grid.velocity.at(b, 1, local) = f == 0 ? 2.0 : -1.0;
      node.ref[f] = {b, local};
    }
  }
  Fields fields;
  DividedNode node;
  std::vector<std::uint8_t> heeded{1};
  const Vec2 ahead{0.57, 0.72}, tip{0.5, 0.75}, grown{0.6, 0.75};
};

// Both fields part at 3 m/s; after two passes of 0.1 s a particle whose way to the node the growth cuts has missed
// -0.6 m. Its way to another node, one that it did not cut, and one without growth have missed nothing.
TEST(CrackFieldJumps, APairThatChangesFeelsTheOpening) {
  Opening at;
  FieldJumps jumps(at.fields, 1.0);
  const CracksBetween cut{{AcrossCrack{0, false}}, 1};
  for (int pass = 0; pass < 2; ++pass) jumps.move({at.tip}, {at.node}, 0.1);
  EXPECT_FALSE(jumps.any());
  EXPECT_EQ(jumps.find(0, at.ahead, at.node.place, cut, at.heeded).code, 0);
  jumps.add(0, {at.tip, at.grown});
  const FieldJumps::Jump jump = jumps.find(0, at.ahead, at.node.place, cut, at.heeded);
  EXPECT_GT(jump.code, 0);
  EXPECT_LT(jump.code, FieldJumps::kCodes);
  EXPECT_EQ(jump.by[0], 0.0);
  EXPECT_NEAR(jump.by[1], -0.6, 1e-15);
  EXPECT_EQ(jumps.find(0, at.ahead, Vec2(0.6, 0.8), cut, at.heeded).code, 0) << "a node that was not divided";
  EXPECT_EQ(jumps.find(0, Vec2(0.4, 0.72), at.node.place, cut, at.heeded).code, 0) << "behind the growth";
  EXPECT_EQ(jumps.find(0, at.ahead, at.node.place, {}, {0}).code, 0) << "a particle that does not heed the crack";
  jumps.forget_growth();
  EXPECT_EQ(jumps.find(0, at.ahead, at.node.place, cut, at.heeded).code, 0);
}

// Openings are kept near tips alone.
TEST(CrackFieldJumps, NodesFarFromTipsAreForgotten) {
  Opening at;
  FieldJumps jumps(at.fields, 1.0);
  jumps.move({at.tip}, {at.node}, 0.1);
  jumps.move({Vec2(1.4, 0.75)}, {at.node}, 0.1);
  jumps.add(0, {at.tip, at.grown});
  EXPECT_EQ(jumps.find(0, at.ahead, at.node.place, {{AcrossCrack{0, false}}, 1}, at.heeded).code, 0);
}

}  // namespace crack_field_jumps_test
