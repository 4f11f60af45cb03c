// Choice of the processor that takes the steps of a run, by the word of an option: cpu, this one; gpu, a graphics
// processor, or an error; auto, a graphics processor where there is one that can take the run, else this one, and why.
// A program gives the function that looks for one (mpm_devices/find_card.hpp), so that nothing here knows what it is
// built for.
//
// Without a word it is cpu: the same command then gives the same bits on every machine, whatever card it has.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>

#include "mpm/simulation/simulation.hpp"

namespace mpm {

inline constexpr std::array<const char*, 3> kDeviceWords = {"cpu", "gpu", "auto"};

/// A graphics processor that this program can use on this machine, or why there is none.
struct FoundDevice {
  DeviceMaker maker;
  std::string missing;  ///< one sentence that says what to do; empty where there is one
};

/// The word of the option, and who looks for a graphics processor.
struct DeviceRequest {
  std::string word = "cpu";           ///< one of kDeviceWords
  std::function<FoundDevice()> find;  ///< not asked for cpu; without it there is none
};

/// Looks whether the word can be followed at all, before a scene is read. `ranks`: number of processes.
/// @throws DeviceError for a word that is none, and for gpu where there is none or there are several processes
void check_device(const DeviceRequest& request, int ranks);

struct DeviceChoice {
  std::optional<DeviceMaker> maker;  ///< for SimulationOptions::device; none: this processor
  std::string note;  ///< one line on what was chosen, and why if not the graphics processor; empty for cpu
};

/// Chooses for a definition whose bodies have been built.
/// @throws DeviceError as check_device() does; DefinitionError for gpu if the scene cannot run there
DeviceChoice choose_device(const DeviceRequest& request, const SimulationDefinition& definition, int ranks);

/// Processor that takes the steps of a run.
struct StepsBy {
  std::string device;  ///< its name; empty: this one
  std::string note;    ///< as in DeviceChoice
};

/// A simulation by choose_device(), whose choice is told to `by`. `build` makes the definition: a second time where
/// auto has chosen a graphics processor that cannot begin the run. @throws what the Simulation throws
Simulation make_simulation(const DeviceRequest& request, const std::function<SimulationDefinition()>& build,
                           SimulationOptions options, StepsBy& by);

}  // namespace mpm
