#include "mpm_ros/report/report_plots.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "mpm_ros/report/report_error.hpp"
#include "mpm_ros/report/script.hpp"

namespace mpm_ros {
namespace {

void call(const std::vector<std::string>& words) {
  if (Script(words, {}).finish() != 0) throw ReportError(fmt::format("{} failed; its own message is above", words[0]));
}

}  // namespace

std::string plot_script(const std::string& name) {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path script = program.parent_path() / name;
  if (!std::filesystem::exists(script, error)) {
    throw ReportError(fmt::format("{} is not beside {}; build and install the package again", name, program.string()));
  }
  return script.string();
}

void make_plots(const PlotOptions& options) {
  std::vector<std::string> words = {plot_script()};
  words.insert(words.end(), options.csv.begin(), options.csv.end());
  words.push_back(options.plots);
  if (!options.field.empty()) words.push_back("--field=" + options.field);
  call(words);
}

void make_work_precision_plots(const std::string& folder) { call({plot_script("plot_work_precision.py"), folder}); }

void make_sweep_plots(const std::string& table, std::size_t parameters, std::size_t metrics,
                      const std::string& folder) {
  call({plot_script("plot_sweep.py"), table, std::to_string(parameters), std::to_string(metrics), folder});
}

}  // namespace mpm_ros
