// The main() of test programs without ROS.
#include <gtest/gtest.h>

#include "choose_tests.hpp"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (const int result = choose_tests(argc, argv); result != 0) return result;
  return RUN_ALL_TESTS();
}
