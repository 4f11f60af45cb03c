#include "mpm_ros/sweep/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "mpm/math/json_text.hpp"

namespace mpm_ros {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 4> kStates = {"open", "done", "failed", "stopped"};

}  // namespace

const char* state_name(RunState state) { return kStates.at(static_cast<std::size_t>(state)); }

std::string Study::of_run(int run) const { return fmt::format("{}/runs/{:04}", folder_, run); }

bool Study::there() const {
  std::error_code ignored;
  return fs::is_regular_file(plan(), ignored) && fs::is_regular_file(lock(), ignored);
}

int Study::runs() const {
  int most = 0;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ + "/runs", ignored)) {
    const std::string name = entry.path().filename().string();
    int number = 0;
    const auto [stop, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (error == std::errc() && stop == name.data() + name.size()) most = std::max(most, number);
  }
  return most;
}

RunResult Study::result(int run) const {
  RunResult result;
  const std::string path = of_run(run, "result.json");
  const std::optional<std::string> text = read_whole(path);
  if (!text) return result;
  try {
    const auto json = nlohmann::ordered_json::parse(*text);
    const std::string state = json.at("state");
    const auto found = std::find(kStates.begin(), kStates.end(), state);
    if (found == kStates.end()) throw SweepError("state");
    result.state = static_cast<RunState>(found - kStates.begin());
    result.reason = json.at("reason");
    for (const auto& [name, value] : json.at("parameters").items()) result.parameters.emplace_back(name, value);
    result.state_hash = json.at("state_hash");
    result.wall_seconds = json.at("wall_seconds");
    for (const auto& [name, value] : json.at("metrics").items()) {
      const double number = value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
      result.metrics.emplace_back(name, number);
    }
  } catch (const std::exception&) {
    throw SweepError(fmt::format("{}: is no result of a run; remove it, and the run is made again", path));
  }
  return result;
}

void Study::keep(int run, const RunResult& result) const {
  nlohmann::ordered_json json;
  json["run"] = run;
  json["state"] = state_name(result.state);
  json["reason"] = result.reason;
  json["parameters"] = json["metrics"] = nlohmann::ordered_json::object();
  for (const auto& [name, value] : result.parameters) json["parameters"][name] = value;
  for (const auto& [name, value] : result.metrics) json["metrics"][name] = value;
  json["state_hash"] = result.state_hash;
  json["wall_seconds"] = result.wall_seconds;
  write_whole(of_run(run, "result.json"), mpm::json_text(json, 2) + "\n");
}

bool is_study(const std::string& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored) && Study(path).there();
}

}  // namespace mpm_ros
