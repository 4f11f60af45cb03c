#include "mpm_ros/node/parameter_sources.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ros/param.h>

#include <algorithm>
#include <sstream>

namespace mpm_ros {

ParameterSources::ParameterSources(int argc, const char* const* argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const std::size_t end = word.find(":=");
    if (end == std::string::npos) continue;
    if (word.compare(0, end, "__name") == 0) launched_ = true;
    if (end > 1 && word[0] == '_' && word[1] != '_') names_.push_back(word.substr(1, end - 1));
  }
}

bool ParameterSources::on_command_line(const std::string& name) const {
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

std::string ParameterSources::text(const ParameterValues& values, const std::string& node) const {
  std::vector<std::string> given, found;
  for (const auto& [name, value] : values) {
    std::ostringstream words;
    words << "~" << name << " = ";
    value.write(words);
    (on_command_line(name) ? given : found).push_back(words.str());
  }
  std::vector<std::string> sources;
  if (!given.empty()) sources.push_back(fmt::format("from the command line: {}", fmt::join(given, ", ")));
  if (!found.empty()) {
    sources.push_back(fmt::format("from {}: {}",
                                  launched_ ? "the launch file or the parameter server" : "the parameter server",
                                  fmt::join(found, ", ")));
  }
  std::string result = fmt::format("{}", fmt::join(sources, "; "));
  if (doubtful(values)) {
    result +=
        fmt::format(" (set by rosparam, or left by an earlier run; `rosparam delete {}` removes what is there)", node);
  }
  return result;
}

bool ParameterSources::doubtful(const ParameterValues& values) const {
  return !launched_ &&
         std::any_of(values.begin(), values.end(), [this](const auto& value) { return !on_command_line(value.first); });
}

void ParameterSources::forget() const {
  for (const std::string& name : names_) ros::param::del("~" + name);
}

}  // namespace mpm_ros
