#include "mpm_ros/sweeping/sweep_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "mpm_ros/run/run_scene.hpp"

namespace mpm_ros {
namespace {

constexpr const char* kLog = "log.txt";
constexpr const char* kSummary = "summary.json";
/// Before the sentence that says why a run has failed.
const std::string kTold = "run_scene: ";
/// Signals that come from outside: the run was not to blame.
constexpr std::array<int, 5> kFromOutside = {SIGKILL, SIGTERM, SIGINT, SIGHUP, SIGQUIT};

/// The command of a run. A log begins with it, so that the run can be repeated by hand.
std::vector<std::string> command_of(const Study& study, const mpm::sweep::Plan& plan, int run,
                                    const SweepRunOptions& options) {
  std::vector<std::string> words = {
      options.program, study.of_run(run, "scene.yaml"), "--summary", study.of_run(run, kSummary),
      "--threads",     std::to_string(options.threads), "--isa",     options.isa};
  for (const std::string& record : plan.record) {
    words.push_back("--" + record);
    words.push_back(study.of_run(run, record == "bag" ? "run.bag" : record));
  }
  return words;
}

/// Makes the log anew. @throws MachineError
std::string begin_log(const Study& study, int run, const std::vector<std::string>& words) {
  std::string path = study.of_run(run, kLog), text = "$";
  for (const std::string& word : words) text += " " + word;
  write_whole(path, text + "\n");
  std::error_code ignored;
  std::filesystem::remove(study.of_run(run, kSummary), ignored);
  return path;
}

/// The first sentence of a failure in a run's log; empty when it has none.
std::string told_in(const std::string& log) {
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    if (line.compare(0, kTold.size(), kTold) == 0) return line.substr(kTold.size());
  }
  return {};
}

}  // namespace

SweepRun::SweepRun(const Study& study, const mpm::sweep::Plan& plan, int run, FileLock lock,
                   const SweepRunOptions& options)
    : study_(study),
      plan_(plan),
      run_(run),
      lock_(std::move(lock)),
      process_(command_of(study, plan, run, options), begin_log(study, run, command_of(study, plan, run, options)),
               lock_.descriptor()) {}

std::optional<RunResult> SweepRun::end() {
  const std::optional<ProcessEnd> end = process_.end();
  if (!end) return std::nullopt;
  RunResult result = result_of(*end);
  for (const mpm::sweep::Setting& setting : plan_.settings(run_))
    result.parameters.emplace_back(setting.path, setting.value);
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  study_.keep(run_, result);
  return result;
}

RunResult SweepRun::result_of(const ProcessEnd& end) const {
  RunResult result;
  const std::string told = told_in(read_whole(study_.of_run(run_, kLog)).value_or(""));
  if (end.code == static_cast<int>(RunSceneResult::machine_failed) || end.signal == SIGXFSZ)
    throw MachineError(told.empty() ? "the machine failed it, and its log says nothing; is the disk full?" : told);
  if (end.code < 0) {
    const bool outside = std::find(kFromOutside.begin(), kFromOutside.end(), end.signal) != kFromOutside.end();
    result.state = outside ? RunState::stopped : RunState::failed;
    result.reason = fmt::format("{} by signal {} ({}){}", outside ? "ended" : "crashed", end.signal,
                                end.signal > 0 ? strsignal(end.signal) : "unknown",
                                end.signal == SIGKILL ? "; if memory was short, lower --jobs" : "");
    return result;
  }
  if (end.code != static_cast<int>(RunSceneResult::done)) {
    // Its scene was read and built before: what is wrong now is around it, and may be mended.
    const bool around = end.code == static_cast<int>(RunSceneResult::bad_input);
    result.state = around ? RunState::stopped : RunState::failed;
    result.reason = told.empty() ? fmt::format("ended with exit code {}; its log has no reason", end.code) : told;
    return result;
  }
  const std::string path = study_.of_run(run_, kSummary);
  const std::optional<std::string> text = read_whole(path);
  try {
    const auto summary = nlohmann::ordered_json::parse(text.value_or(""));
    const bool ended = summary.at("ended");
    result.state = ended ? RunState::done : RunState::stopped;
    if (!ended) result.reason = fmt::format("was stopped at t = {} s", summary.at("time").get<double>());
    for (const auto& [name, value] : summary.at("metrics").items()) {
      const double number = value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
      result.metrics.emplace_back(name, number);
    }
    if (ended) result.state_hash = summary.at("state_hash");
  } catch (const std::exception&) {
    result = RunResult();
    result.state = RunState::stopped;
    result.reason = fmt::format("ended without a whole {}", path);
  }
  return result;
}

}  // namespace mpm_ros
