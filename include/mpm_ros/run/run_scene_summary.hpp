// The numbers of a run that is over: as one JSON object, and as a few lines for people.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm_ranks/make_ranks.hpp"
#include "mpm_ros/message/contact_average.hpp"

namespace mpm_ros {

struct RunSummary {
  /// Reads the simulation where it stands. `start`: where the run began. `contacts`: the last reports. `cut_short`: it
  /// stands between two sync points, and its state is none that a run has. `device`: name of the processor that took
  /// the steps, empty for this one. Collective over several ranks.
  RunSummary(const mpm::Scene& scene, const mpm::Simulation& simulation, const mpm::SolverState& start,
             const Contacts& contacts, bool cut_short, const std::string& device);

  /// Keys and units as doc/analysis.md lists them; the order of the keys is kept.
  nlohmann::ordered_json json() const;
  /// A few lines, each ended.
  std::string text() const;

  std::string scene;
  std::optional<mpm::pace::Target> target;  ///< with what was chosen for it
  mpm::SimulationDefinition definition;     ///< particle positions left out
  std::string isa;
  std::string device;  ///< "cpu", or the name of the processor that took the steps
  int ranks = 1;
  int threads = 0;    ///< threads of each rank
  mpm::Traffic sent;  ///< by all ranks since the start
  mpm::SharingReport sharing;
  mpm::SolverState state;
  mpm::SolverState start;  ///< at time zero
  std::int64_t end = 0;    ///< end of the run as it was asked for [ns]
  bool cut_short = false;
  std::uint64_t state_hash = 0;   ///< none when it was cut short
  std::uint64_t peak_memory = 0;  ///< [byte] of the whole process; over several ranks of the largest
  Contacts contacts;              ///< impulses and energies since the start
  std::vector<mpm::RobotReport> robots;
  std::vector<std::pair<std::string, double>> metrics;

  double seconds() const { return mpm::nearest_seconds(state.time); }
  double particle_steps_per_second() const;
  double real_time_factor() const;
};

}  // namespace mpm_ros
