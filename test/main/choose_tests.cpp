#include "choose_tests.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "long_tests.hpp"

namespace {

constexpr int kSkipped = 77;

struct Choice {
  std::string file;
  bool only_long = false;
};

bool chosen(const testing::TestInfo& test, const Choice& choice) {
  if (!choice.file.empty() && std::filesystem::path(test.file()).filename() != choice.file + "_test.cpp") return false;
  const bool is_long = long_test(test.test_suite_name(), test.name(), test.file());
  if (choice.only_long) return is_long;
  return !is_long || std::getenv("MPM_FULL") != nullptr;
}

/// The names of all chosen cases, as a filter.
std::string filter_of(const Choice& choice) {
  std::string filter;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const testing::TestInfo& test = *suite.GetTestInfo(t);
      if (chosen(test, choice)) filter += std::string(suite.name()) + "." + test.name() + ":";
    }
  }
  return filter;
}

}  // namespace

int choose_tests(int argc, char** argv) {
  Choice choice;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.rfind("--file=", 0) == 0) {
      choice.file = argument.substr(7);
    } else if (argument == "--long") {
      choice.only_long = true;
    } else {
      std::fprintf(stderr, "unknown argument '%s': use --file=NAME, --long or those of GoogleTest\n", argv[i]);
      return 2;
    }
  }
  if (GTEST_FLAG_GET(filter) != "*") return 0;
  const std::string filter = filter_of(choice);
  if (filter.empty()) {
    if (!choice.file.empty() && filter_of({choice.file, true}).empty()) {
      std::fprintf(stderr, "no case in %s_test.cpp\n", choice.file.c_str());
      return 2;
    }
    return kSkipped;
  }
  GTEST_FLAG_SET(filter, filter);
  return 0;
}
