#include "mpm_ros/node/parameter_reader.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/math/constants.hpp"
#include "mpm/math/nearest.hpp"

namespace mpm_ros {

void ParameterReader::read(const std::string& name, std::string& result) {
  if (const XmlRpc::XmlRpcValue* value = find(name)) result = text(name, *value);
}

void ParameterReader::read(const std::string& name, bool& result) {
  const XmlRpc::XmlRpcValue* value = find(name);
  if (value == nullptr) return;
  const std::optional<bool> truth = truth_of(*value);
  if (!truth) fail(name, "must be true or false");
  result = *truth;
}

void ParameterReader::read(const std::string& name, double& result, double min, bool open) {
  const XmlRpc::XmlRpcValue* value = find(name);
  if (value == nullptr) return;
  const std::optional<double> number = number_of(*value);
  if (!number) fail(name, "must be a number");
  result = *number;
  const bool inside = open ? result > min : result >= min;
  if (!inside || !(result < mpm::kInfinity)) {
    fail(name, fmt::format("is {}; it must be finite and {} {}", result, open ? "above" : "at least", min));
  }
}

void ParameterReader::read(const std::string& name, int& result, int min) {
  const XmlRpc::XmlRpcValue* value = find(name);
  if (value == nullptr) return;
  const std::optional<double> number = number_of(*value);
  constexpr double kMost = std::numeric_limits<int>::max();
  if (!number || std::trunc(*number) != *number || std::abs(*number) > kMost) fail(name, "must be a whole number");
  result = static_cast<int>(*number);
  if (result < min) fail(name, fmt::format("is {}; it must be at least {}", result, min));
}

bool ParameterReader::read_words(const std::string& name, std::vector<std::string>& result) {
  const XmlRpc::XmlRpcValue* value = find(name);
  if (value == nullptr) return false;
  result.clear();
  if (value->getType() != XmlRpc::XmlRpcValue::TypeArray) {
    result = words_in(text(name, *value));
    return true;
  }
  XmlRpc::XmlRpcValue list(*value);
  for (int i = 0; i < list.size(); ++i) result.push_back(text(name, list[i]));
  return true;
}

void ParameterReader::read_overrides(const std::string& name, std::vector<std::string>& result) {
  const XmlRpc::XmlRpcValue* value = find(name);
  if (value != nullptr && value->getType() == XmlRpc::XmlRpcValue::TypeString) {
    result = overrides_in(text(name, *value));
  } else {
    read_words(name, result);
  }
}

void ParameterReader::read(const std::string& name, std::optional<mpm::Box>& result) {
  const XmlRpc::XmlRpcValue* value = find(name);
  if (value == nullptr) return;
  std::vector<XmlRpc::XmlRpcValue> given;
  XmlRpc::XmlRpcValue list(*value);
  if (list.getType() == XmlRpc::XmlRpcValue::TypeArray) {
    for (int i = 0; i < list.size(); ++i) given.push_back(list[i]);
  } else if (list.getType() == XmlRpc::XmlRpcValue::TypeString) {
    for (const std::string& word : words_in(static_cast<std::string>(list))) given.emplace_back(word);
  }
  if (given.size() != 6) fail(name, "must be six numbers, [xmin, ymin, zmin, xmax, ymax, zmax]");
  double corners[6];
  for (std::size_t i = 0; i < 6; ++i) {
    const std::optional<double> number = number_of(given[i]);
    if (!number) fail(name, fmt::format("has something else than a number at place {}", i + 1));
    corners[i] = *number;
  }
  result = mpm::Box{{corners[0], corners[1], corners[2]}, {corners[3], corners[4], corners[5]}};
  if (result->empty() || !result->min.allFinite() || !result->max.allFinite()) {
    fail(name, "is empty or not finite; write [xmin, ymin, zmin, xmax, ymax, zmax]");
  }
}

std::vector<std::string> ParameterReader::unknown() const {
  std::vector<std::string> lines;
  for (const auto& [name, value] : values_) {
    if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
    lines.push_back(fmt::format("parameter ~{} is not known and has no effect; {}", name, mpm::suggest(name, known_)));
  }
  return lines;
}

void ParameterReader::fail(const std::string& name, const std::string& problem) {
  throw ParameterError(fmt::format("parameter ~{} {}", name, problem));
}

const XmlRpc::XmlRpcValue* ParameterReader::find(const std::string& name) {
  known_.push_back(name);
  const auto entry = values_.find(name);
  return entry == values_.end() ? nullptr : &entry->second;
}

std::string ParameterReader::text(const std::string& name, const XmlRpc::XmlRpcValue& value) {
  if (value.getType() != XmlRpc::XmlRpcValue::TypeString) fail(name, "must be text; put it in quotes");
  return static_cast<std::string>(XmlRpc::XmlRpcValue(value));
}

std::string ParameterReader::one_of(const std::string& given, const std::vector<std::string>& names) {
  return fmt::format("is '{}'; it must be one of {}", given, fmt::join(names, ", "));
}

}  // namespace mpm_ros
