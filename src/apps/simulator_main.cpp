// rosrun mpm_ros simulator _scene:=NAME: the node. Wiring only; see mpm_ros/node/simulator_node.hpp. Of several ranks
// (mpirun) the first is the node, and the others know nothing of ROS (mpm_ros/run/follow.hpp).
//
// Exit codes: 0 done (or stopped on request), 1 a bag that cannot be written or another failure of the machine, 2 bad
// input, 3 the physics failed.
#include <fmt/format.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>

#include <chrono>
#include <iostream>
#include <memory>
#include <new>
#include <thread>

#include "mpm/simulation/rank_failure.hpp"
#include "mpm_devices/find_card.hpp"
#include "mpm_ranks/make_ranks.hpp"
#include "mpm_robots/robots.hpp"
#include "mpm_ros/node/exit_watchdog.hpp"
#include "mpm_ros/node/master.hpp"
#include "mpm_ros/node/parameter_sources.hpp"
#include "mpm_ros/node/simulator_node.hpp"
#include "mpm_ros/run/follow.hpp"
#include "mpm_ros/run/stop_signals.hpp"
#include "mpm_ros/sweeping/shared_cores.hpp"

namespace {

using mpm_ros::stop_requested;
using Ranks = std::shared_ptr<mpm::Communicator>;

/// Returns false if the program is stopped before there is a master.
bool wait_for_master(int argc, char** argv) {
  bool said = false;
  while (!stop_requested()) {
    if (mpm_ros::master_answers(argc, argv)) return true;
    if (!said) ROS_WARN_STREAM("waiting for a master at " << ros::master::getURI() << "; start roscore");
    said = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  return false;
}

/// The node, once its parameters are read: only then, because diagnostic_updater reads one by itself. What the command
/// line wrote to the parameter server is deleted then, also when there is no node because something is wrong with it.
std::unique_ptr<mpm_ros::SimulatorNode> make_node(const mpm_ros::ParameterSources& sources,
                                                  mpm_ros::ExitWatchdog& watchdog, const Ranks& ranks) {
  const mpm_ros::ForgetParameters forget(sources);
  const mpm_ros::ParameterValues values = mpm_ros::fetch_parameters(ros::NodeHandle("~"));
  const std::string origin = sources.text(values, ros::this_node::getName());
  if (sources.doubtful(values)) {
    ROS_WARN_STREAM(origin);
  } else if (!origin.empty()) {
    ROS_INFO_STREAM(origin);
  }
  std::vector<std::string> warnings;
  mpm_ros::NodeParameters parameters = mpm_ros::read_parameters(values, warnings);
  mpm_ros::look_for_device(parameters, mpm::find_card, ranks ? ranks->size() : 1);
  if (ranks && parameters.threads == 0) parameters.threads = mpm::threads_of_rank(*ranks);
  for (const std::string& warning : warnings) ROS_WARN_STREAM(warning);
  mpm_ros::SimulatorNode::check_neighbours(ros::NodeHandle(), parameters);
  return std::make_unique<mpm_ros::SimulatorNode>(ros::NodeHandle(), parameters, watchdog, ranks);
}

int run(const mpm_ros::ParameterSources& sources, mpm_ros::ExitWatchdog& watchdog, const Ranks& ranks) {
  const std::unique_ptr<mpm_ros::SimulatorNode> node = make_node(sources, watchdog, ranks);
  watchdog.must_finish();
  const int exit_code = node->spin();
  watchdog.ends(exit_code);
  return exit_code;
}

/// The node, on the first rank or alone, from its arguments to its exit code. @throws mpm::RankFailure
int be_node(int argc, char** argv, const Ranks& ranks) {
  const mpm_ros::ParameterSources sources(argc, argv);
  static mpm_ros::ExitWatchdog watchdog;
  int exit_code = 1;
  try {
    mpm_ros::check_ros_words(argc, argv);
    if (!wait_for_master(argc, argv)) return 0;
    // Own signal handlers, because roscpp's would close the connections before the bag is closed.
    mpm_ros::init_ros(argc, argv, "simulator", ros::init_options::NoSigintHandler);
    ros::start();
    exit_code = run(sources, watchdog, ranks);
  } catch (const mpm_ros::RosRefused& error) {
    ROS_FATAL_STREAM(error.what());
    return error.exit_code();
  } catch (const mpm::StoppedError& error) {
    ROS_WARN_STREAM(error.what());
    exit_code = 0;
    if (const std::string used_up = mpm_ros::used_up(); !used_up.empty()) {
      ROS_FATAL_STREAM(used_up);
      exit_code = 1;
    }
  } catch (const mpm::PhysicsError& error) {
    ROS_FATAL_STREAM(error.what());
    exit_code = 3;
  } catch (const mpm::RankFailure&) {
    throw;
  } catch (const mpm::Error& error) {
    ROS_FATAL_STREAM(error.what());
    exit_code = 2;
  } catch (const mpm_ros::ParameterError& error) {
    ROS_FATAL_STREAM(error.what());
    exit_code = 2;
  } catch (const mpm_ros::BagError& error) {
    ROS_FATAL_STREAM(error.what());
    exit_code = 2;
  } catch (const std::bad_alloc&) {
    ROS_FATAL_STREAM("there is not enough memory for this scene; use a larger grid.cell or a smaller scene");
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM("unexpected: " << error.what());
  }
  watchdog.ends(exit_code);
  ros::shutdown();
  return exit_code;
}

/// Every rank: the first is the node, and the others follow it.
int be_rank(int argc, char** argv, const Ranks& ranks) {
  try {
    if (!ranks->first()) return mpm_ros::follow(ranks);
    const int exit_code = be_node(argc, argv, ranks);
    mpm_ros::end_following(*ranks, exit_code);
    return exit_code;
  } catch (const std::exception& error) {
    const std::string reason = fmt::format("simulator: rank {}: {}", ranks->rank(), error.what());
    return mpm::end_all(*ranks, reason, mpm_ros::exit_code_of(error));
  }
}

}  // namespace

int main(int argc, char** argv) {
  mpm_ros::spin_only_briefly(argv);  // first: it may begin the program anew
  mpm::provide_robots();
  Ranks ranks;
  try {
    ranks = mpm::make_ranks();
  } catch (const mpm::Error& error) {
    std::cerr << "simulator: " << error.what() << "\n";
    return 2;
  }
  mpm_ros::catch_stop_signals();
  return ranks ? be_rank(argc, argv, ranks) : be_node(argc, argv, nullptr);
}
