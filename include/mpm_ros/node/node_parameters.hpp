// The node's private parameters: read once, each checked for its type and range.
#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mpm/math/geometry.hpp"
#include "mpm/simulation/device_choice.hpp"
#include "mpm_ros/node/parameter_reader.hpp"

namespace mpm_ros {

enum class Pacing {
  real_time,  ///< simulated time follows the wall clock, times real_time_factor
  free,       ///< as fast as it goes
  lockstep    ///< only when the service `step` is called
};

/// Action for a commanded body that has not heard a command for command_timeout.
enum class OnTimeout {
  hold,  ///< it goes on by its last command
  stop,  ///< it stands still
  error  ///< the run ends
};

/// Time at which what has a stamp takes effect.
enum class StampUse {
  stamp,  ///< by its stamp
  latest  ///< as it comes, whatever its stamp
};

/// Time at which the stamps of a run go on after a reset.
enum class ResetTime {
  resume,  ///< after all stamps before: time never runs backwards
  zero     ///< at zero again, /clock too
};

struct NodeParameters {
  std::string scene;             ///< shipped name or path
  std::vector<std::string> set;  ///< "key.path=value", over the scene
  Pacing pacing = Pacing::real_time;
  double real_time_factor = 1.0;            ///< simulated over wall time, > 0
  int threads = 0;                          ///< 0: as many as the machine has
  std::string isa = "auto";                 ///< instruction set; auto: the widest one available
  mpm::DeviceRequest device;                ///< processor that takes the steps
  std::string record;                       ///< bag to write; empty: none, "auto": named by scene and date
  std::string record_folder;                ///< that relative names of bags start from; empty: the working folder
  std::string record_compression = "none";  ///< none, lz4, bz2
  double record_split_size = 0.0;           ///< [MB] at which a part of the bag ends; 0: never
  double record_split_duration = 0.0;       ///< [s] simulated, the same
  bool record_required = true;              ///< false: the run goes on when the bag cannot be written any further
  std::string resume;                       ///< checkpoint to go on from; empty: the scene's start
  bool checkpoint_on_failure = true;        ///< a run that fails leaves its state in a file
  std::string commands;                     ///< bag whose commands are replayed in place of live ones
  double command_timeout = 0.0;             ///< [s] simulated; 0: never
  OnTimeout on_timeout = OnTimeout::hold;
  StampUse tf_time = StampUse::stamp;       ///< use for tf frames that bodies follow
  StampUse command_time = StampUse::stamp;  ///< use for messages on command topics
  std::string world_frame = "world";
  bool publish_clock = true;                                ///< with use_sim_time
  double clock_rate = 0.0;                                  ///< [1/s] simulated; 0: every sync point
  ResetTime reset_time = ResetTime::resume;                 ///< zero: with use_sim_time alone
  std::optional<double> particle_rate;                      ///< [1/s] simulated; unset: as the scene says
  std::optional<double> particle_first;                     ///< [s] simulated, of the first cloud; unset: the same
  std::optional<std::vector<std::string>> particle_fields;  ///< unset: as the scene says
  std::optional<int> particle_stride;                       ///< unset: as the scene says
  std::optional<mpm::Box> particle_region;                  ///< unset: as the scene says [m]
  double wrench_cutoff = 0.0;  ///< [Hz] of the filtered wrenches; 0: they are not published
  double wrench_rate = 0.0;    ///< [1/s] simulated, of forces, bodies, transforms, state; 0: every sync point
  double force_scale = 0.0;    ///< scale of contact arrows [m/N]; 0: by the largest force met
  bool state_hash = false;     ///< in every solver state
  bool keep_alive = false;     ///< serve on after the run's end; unset: in lockstep only
  bool start_paused = false;

  std::string text;  ///< parameters given, as YAML
};

/// All parameters below a private node handle.
ParameterValues fetch_parameters(const ros::NodeHandle& private_node);
/// `warnings` gets one line for each name that is not known. @throws ParameterError
NodeParameters read_parameters(const ParameterValues& values, std::vector<std::string>& warnings);
/// Gives the node the graphics processors that its program knows, and looks whether there is the one that is asked for.
/// `ranks`: number of processes. @throws ParameterError
void look_for_device(NodeParameters& parameters, const std::function<mpm::FoundDevice()>& find, int ranks);

}  // namespace mpm_ros
