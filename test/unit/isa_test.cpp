// Instruction sets: their names, and the choice for a run.
#include "mpm/kernel/isa.hpp"

#include <gtest/gtest.h>

namespace mpm {
namespace isa_test {

constexpr Isa kAll[] = {Isa::plain, Isa::avx2, Isa::avx512};

TEST(Isa, IsFoundByItsName) {
  EXPECT_STREQ(isa_name(Isa::plain), "plain");
  EXPECT_STREQ(isa_name(Isa::avx2), "avx2");
  EXPECT_STREQ(isa_name(Isa::avx512), "avx512");
  for (const Isa isa : kAll) EXPECT_EQ(find_isa(isa_name(isa)), isa);
  for (const char* name : {"", "auto", "AVX2", "avx", "avx512f"}) EXPECT_FALSE(find_isa(name)) << name;
}

// Tests are built with the plain one, which any machine can run; scripts/demo leaves it out.
TEST(Isa, PlainIsEverywhere) { EXPECT_TRUE(isa_available(Isa::plain)); }

TEST(Isa, AutoIsTheWidestThatIsThere) {
  Isa widest = Isa::plain;
  if (isa_available(Isa::avx2)) widest = Isa::avx2;
  if (isa_available(Isa::avx512)) widest = Isa::avx512;
  EXPECT_EQ(best_isa(), widest);
  EXPECT_EQ(choose_isa("auto"), widest);
  EXPECT_EQ(choose_isa(""), widest);
}

TEST(Isa, IsTheOneAskedForOrAnErrorThatListsTheOthers) {
  for (const Isa isa : kAll) {
    if (isa_available(isa)) {
      EXPECT_EQ(choose_isa(isa_name(isa)), isa);
    } else {
      EXPECT_THROW(choose_isa(isa_name(isa)), IsaError);
    }
  }
  try {
    choose_isa("sse9");
    FAIL() << "sse9 was taken";
  } catch (const IsaError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find("there is no instruction set 'sse9'; this machine has plain"), 0U) << text;
    for (const Isa isa : kAll) {
      EXPECT_EQ(text.find(isa_name(isa), text.find("has")) != std::string::npos, isa_available(isa)) << text;
    }
  }
}

}  // namespace isa_test
}  // namespace mpm
