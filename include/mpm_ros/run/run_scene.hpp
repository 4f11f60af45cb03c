// A scene run offline, as fast as it goes, without a ROS master: what the program run_scene does behind its options.
#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "mpm/ranks/communicator.hpp"
#include "mpm/simulation/device_choice.hpp"

namespace mpm_ros {

struct RunSceneOptions {
  std::string scene;                     ///< a shipped name, or a path; empty with from_bag
  std::string from_bag;                  ///< recording to run again in place of a scene
  std::vector<std::string> set;          ///< overrides, "key.path=value"
  std::string end;                       ///< a time in seconds or with a unit; empty: the scene's
  int threads = 0;                       ///< 0: as many as the machine has
  std::string isa = "auto";              ///< instruction set; auto: the widest one available
  mpm::DeviceRequest device;             ///< processor that takes the steps
  std::string bag;                       ///< path, "auto", or empty for none
  std::string bag_compression = "none";  ///< none, lz4, bz2
  std::string bag_split;         ///< end of a part of the bag: "500 MB", or a simulated time as "10 s"; empty: never
  std::string csv;               ///< folder, or empty for none
  std::string vtk;               ///< folder of files for ParaView, or empty for none
  std::string summary;           ///< JSON file, or empty for none
  std::string terrain;           ///< GeoTIFF of the ground at the end, or empty for none
  std::string out;               ///< folder in which the run gets one of its own, with all of these; empty for none
  std::string resume;            ///< checkpoint to go on from; the scene may then be empty
  std::string checkpoint;        ///< file to save the run to at its end, or when it is stopped; empty: none
  bool profile = false;          ///< a table of where the wall time went
  std::string checkpoint_every;  ///< a simulated time with or without unit, after which it is saved each time
  /// That run the scene together, each with the same options; null: this process alone. The first one alone writes
  /// files and lines. One of them that cannot go on ends all (mpm::end_all).
  std::shared_ptr<mpm::Communicator> ranks;
};

/// Result of a run, as an exit code.
enum class RunSceneResult {
  done = 0,
  machine_failed = 1,  ///< a disk on which the record does not find room
  bad_input = 2,
  physics_failed = 3,
  another_state = 3  ///< a recording that was run again ended in another state
};

/// Names and descriptions of the shipped scenes, a line each.
void list_scenes(std::ostream& out);
/// Tells what the scene amounts to, and warnings. @throws mpm::Error
void explain_scene(const RunSceneOptions& options, std::ostream& out);
/// Runs the scene to its end, or to the sync point after `stop_requested` says true; then writes what was asked, as
/// it does when the physics fail. Results go to `out`, progress and errors to `err`; `bar`: progress as a bar that is
/// drawn over and over (a terminal).
RunSceneResult run_scene(const RunSceneOptions& options, std::ostream& out, std::ostream& err, bool bar,
                         const std::function<bool()>& stop_requested);

}  // namespace mpm_ros
