#include "mpm_ros/report/report_plots.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <vector>

namespace mpm_ros {
namespace {

constexpr const char* kScript = "plot_report.py";

std::string find_script() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path script = program.parent_path() / kScript;
  if (!std::filesystem::exists(script, error)) {
    throw PlotError(fmt::format("{} is not beside {}; build and install the package again", kScript, program.string()));
  }
  return script.string();
}

}  // namespace

void make_plots(const PlotOptions& options) {
  std::vector<std::string> words = {find_script(), options.csv, options.plots};
  if (!options.title.empty()) words.push_back("--title=" + options.title);
  if (!options.field.empty()) words.push_back("--field=" + options.field);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  pid_t child = 0;
  const int failure = posix_spawn(&child, arguments[0], nullptr, nullptr, arguments.data(), environ);
  if (failure != 0) throw PlotError(fmt::format("{} cannot be run: {}", words[0], std::strerror(failure)));
  int status = 0;
  waitpid(child, &status, 0);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw PlotError(fmt::format("{} failed; its own message is above", words[0]));
  }
}

TemporaryFolder::TemporaryFolder() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  path_ = ((error ? std::filesystem::path("/tmp") : folder) / "bag_report_XXXXXX").string();
  if (mkdtemp(path_.data()) == nullptr) {
    throw PlotError(fmt::format("{}: no temporary folder can be made: {}", path_, std::strerror(errno)));
  }
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace mpm_ros
