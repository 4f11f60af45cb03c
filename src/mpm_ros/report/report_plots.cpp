#include "mpm_ros/report/report_plots.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "mpm_ros/report/report_error.hpp"
#include "mpm_ros/report/script.hpp"

namespace mpm_ros {
namespace {

constexpr const char* kScript = "plot_report.py";

}  // namespace

std::string plot_script() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path script = program.parent_path() / kScript;
  if (!std::filesystem::exists(script, error)) {
    throw ReportError(
        fmt::format("{} is not beside {}; build and install the package again", kScript, program.string()));
  }
  return script.string();
}

void make_plots(const PlotOptions& options) {
  std::vector<std::string> words = {plot_script()};
  words.insert(words.end(), options.csv.begin(), options.csv.end());
  words.push_back(options.plots);
  if (!options.field.empty()) words.push_back("--field=" + options.field);
  if (Script(words, {}).finish() != 0) throw ReportError(fmt::format("{} failed; its own message is above", words[0]));
}

}  // namespace mpm_ros
