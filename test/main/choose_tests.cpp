#include "choose_tests.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "long_tests.hpp"

namespace {

constexpr int kSkipped = 77;

/// The names of all cases of a file (empty: of all), as a filter.
std::string filter_of(const std::string& file, bool long_too) {
  std::string filter;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const testing::TestInfo& test = *suite.GetTestInfo(t);
      if (!file.empty() && std::filesystem::path(test.file()).filename() != file + "_test.cpp") continue;
      if (!long_too && long_test(suite.name(), test.name(), test.file())) continue;
      filter += std::string(suite.name()) + "." + test.name() + ":";
    }
  }
  return filter;
}

}  // namespace

int choose_tests(int argc, char** argv) {
  std::string file;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.rfind("--file=", 0) != 0) {
      std::fprintf(stderr, "unknown argument '%s': use --file=NAME or those of GoogleTest\n", argv[i]);
      return 2;
    }
    file = argument.substr(7);
  }
  if (GTEST_FLAG_GET(filter) != "*") return 0;
  const std::string filter = filter_of(file, std::getenv("MPM_FULL") != nullptr);
  if (filter.empty()) {
    if (!filter_of(file, true).empty()) return kSkipped;
    std::fprintf(stderr, "no case in %s_test.cpp\n", file.c_str());
    return 2;
  }
  GTEST_FLAG_SET(filter, filter);
  return 0;
}
