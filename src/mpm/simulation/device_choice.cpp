#include "mpm/simulation/device_choice.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "mpm/math/nearest.hpp"
#include "mpm/rules/feature_rules.hpp"

namespace mpm {
namespace {

const std::string kCpu = kDeviceWords[0], kGpu = kDeviceWords[1], kAuto = kDeviceWords[2];

FoundDevice found_by(const DeviceRequest& request) {
  if (request.find) return request.find();
  return {{}, "this program has no steps for a graphics processor; leave the option out"};
}

DeviceChoice by_this_one(const std::string& reason) {
  return {std::nullopt, fmt::format("device auto: this processor takes the steps, since {}", reason)};
}

}  // namespace

void check_device(const DeviceRequest& request, int ranks) {
  const std::vector<std::string> words(kDeviceWords.begin(), kDeviceWords.end());
  if (std::find(words.begin(), words.end(), request.word) == words.end()) {
    throw DeviceError(fmt::format("there is no processor '{}' to choose; write cpu, gpu or auto", request.word));
  }
  if (request.word != kGpu) return;
  // The scene is not known yet: the rule that breaks is that on the number of processes.
  if (const auto broken = broken_rule({}, {ranks, true}); broken && broken->rule->beside == Feature::ranks) {
    throw DeviceError(fmt::format("{}; {}", broken->why(), broken->rule->remedy));
  }
  if (const std::string missing = found_by(request).missing; !missing.empty()) throw DeviceError(missing);
}

DeviceChoice choose_device(const DeviceRequest& request, const SimulationDefinition& definition, int ranks) {
  check_device(request, ranks);
  if (request.word == kCpu) return {};
  const auto broken = broken_rule(definition, {ranks, true});
  if (broken && request.word == kGpu) {
    throw DefinitionError(
        fmt::format("{}: {}; {}", feature_key(broken->rule->feature), broken->why(), broken->rule->remedy));
  }
  if (broken) return by_this_one(broken->why());
  FoundDevice found = found_by(request);
  if (!found.missing.empty()) return by_this_one(found.missing);
  std::string note = fmt::format("device {}: {} takes the steps", request.word, found.maker.name);
  return {std::move(found.maker), std::move(note)};
}

Simulation make_simulation(const DeviceRequest& request, const std::function<SimulationDefinition()>& build,
                           SimulationOptions options, StepsBy& by) {
  SimulationDefinition definition = build();
  DeviceChoice choice = choose_device(request, definition, options.ranks ? options.ranks->size() : 1);
  options.device = choice.maker;
  by = {choice.maker ? choice.maker->name : "", choice.note};
  try {
    return Simulation(std::move(definition), options);
  } catch (const DeviceError& error) {
    if (request.word != kAuto) throw;
    by = {"", by_this_one(error.what()).note};
  }
  options.device.reset();
  return Simulation(build(), std::move(options));
}

}  // namespace mpm
