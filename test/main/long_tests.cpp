#include "long_tests.hpp"

#include <fstream>
#include <set>

#include "test_files.hpp"

namespace {

/// Names between backquotes in the first column of the table.
std::set<std::string> listed() {
  std::set<std::string> names;
  std::ifstream file(source_file("test/full.md"));
  for (std::string line; std::getline(file, line);) {
    const std::size_t end = line.rfind("| `", 0) == 0 ? line.find('`', 3) : std::string::npos;
    if (end != std::string::npos) names.insert(line.substr(3, end - 3));
  }
  return names;
}

/// Without what an instantiation adds before or behind it: "Isas/WideTest" and "TensorTest/0".
std::string plain(const std::string& name) {
  const std::size_t slash = name.find('/');
  if (slash == std::string::npos) return name;
  const std::string behind = name.substr(slash + 1);
  const bool number = behind.find_first_not_of("0123456789") == std::string::npos;
  return number ? name.substr(0, slash) : plain(behind);
}

}  // namespace

bool long_test(const std::string& suite, const std::string& name, const std::string& file) {
  static const std::set<std::string> kListed = listed();
  const std::size_t folder = file.rfind("test/");
  if (folder != std::string::npos && kListed.count(file.substr(folder)) > 0) return true;
  const std::string base = plain(suite), test = name.substr(0, name.find('/'));
  return base.rfind("Full", 0) == 0 || kListed.count(base + "." + test) > 0 || kListed.count(base + "." + name) > 0;
}
