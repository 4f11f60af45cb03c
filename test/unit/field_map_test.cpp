// The map from bodies and sides to velocity fields (grid/field_map.hpp).
#include "mpm/grid/field_map.hpp"

#include <gtest/gtest.h>

namespace mpm {
namespace field_map_test {

TEST(FieldMap, GivesEveryGroupAField) {
  const FieldMap map({0, 2, 0}, {false, false, false});
  EXPECT_EQ(map.count(), 3);  // no body has group 1, its field stays empty
  EXPECT_EQ(map.field(0), 0);
  EXPECT_EQ(map.field(1, 1), 2);  // the body is not divided
  EXPECT_EQ(map.field(2), 0);
  EXPECT_EQ(map.fields(1), (std::vector<int>{2}));
  EXPECT_TRUE(map.divisions().empty());
}

// Division of one body gives the others no second field.
TEST(FieldMap, DividesOneBodyAlone) {
  const FieldMap map({0, 1, 2}, {false, true, false});
  EXPECT_EQ(map.count(), 4);
  EXPECT_EQ(map.fields(0), (std::vector<int>{0}));
  EXPECT_EQ(map.fields(1), (std::vector<int>{1, 2}));
  EXPECT_EQ(map.fields(2), (std::vector<int>{3}));
  EXPECT_EQ(map.side(1), 0);
  EXPECT_EQ(map.side(2), 1);
  EXPECT_EQ(map.side(3), 0);
  ASSERT_EQ(map.divisions().size(), 1u);
  EXPECT_EQ(map.divisions()[0], (std::array<int, 2>{1, 2}));
}

// A body beside a divided one in its group shares the field of side 0 and has none on side 1.
TEST(FieldMap, LeavesAGroupsOtherBodiesWhole) {
  const FieldMap map({0, 0}, {true, false});
  EXPECT_EQ(map.count(), 2);
  EXPECT_EQ(map.field(0, 1), 1);
  EXPECT_EQ(map.field(1, 1), 0);
  EXPECT_FALSE(map.divided(1));
}

}  // namespace field_map_test
}  // namespace mpm
