// rosrun mpm_ros simulator _scene:=NAME: the node. Wiring only; see mpm_ros/node/simulator_node.hpp.
//
// Exit codes: 0 done (or stopped on request), 1 a bag that cannot be written or another failure of the machine, 2 bad
// input, 3 the physics failed.
#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <new>
#include <thread>

#include "mpm_ros/node/parameter_sources.hpp"
#include "mpm_ros/node/simulator_node.hpp"
#include "mpm_ros/run/shared_cores.hpp"
#include "mpm_ros/run/stop_signals.hpp"

namespace {

using mpm_ros::stop_requested;

/// Ends the process where roscpp does not: with a master that is gone, or hangs, its calls wait without a limit.
class Ender {
 public:
  Ender() {
    std::thread([this] { watch(); }).detach();
  }
  /// Nothing is being recorded: after a stop the process may end with this exit code, finished or not.
  void may_end(int exit_code) {
    exit_code_ = exit_code;
    may_end_ = true;
  }
  /// There is a record, which has to be closed first.
  void must_finish() { may_end_ = false; }

 private:
  [[noreturn]] void watch() const {
    constexpr std::chrono::milliseconds kLook{50}, kPatience{900};
    for (std::chrono::milliseconds waited{0};; std::this_thread::sleep_for(kLook)) {
      waited = stop_requested() && may_end_ ? waited + kLook : std::chrono::milliseconds{0};
      if (waited > kPatience) std::_Exit(exit_code_);
    }
  }

  std::atomic<int> exit_code_{0};
  std::atomic<bool> may_end_{true};
};

/// Returns false if the program is stopped before there is a master.
bool wait_for_master() {
  bool said = false;
  while (!stop_requested()) {
    if (ros::master::check()) return true;
    if (!said) ROS_WARN_STREAM("waiting for a master at " << ros::master::getURI() << "; start roscore");
    said = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  return false;
}

/// The node, once its parameters are read: only then, because diagnostic_updater reads one by itself. What the command
/// line wrote to the parameter server is deleted then, also when there is no node because something is wrong with it.
std::unique_ptr<mpm_ros::SimulatorNode> make_node(const mpm_ros::ParameterSources& sources) {
  struct Forget {
    const mpm_ros::ParameterSources& sources;
    ~Forget() { sources.forget(); }
  } const forget{sources};
  const mpm_ros::ParameterValues values = mpm_ros::fetch_parameters(ros::NodeHandle("~"));
  const std::string origin = sources.text(values, ros::this_node::getName());
  if (sources.doubtful(values)) {
    ROS_WARN_STREAM(origin);
  } else if (!origin.empty()) {
    ROS_INFO_STREAM(origin);
  }
  std::vector<std::string> warnings;
  const mpm_ros::NodeParameters parameters = mpm_ros::read_parameters(values, warnings);
  for (const std::string& warning : warnings) ROS_WARN_STREAM(warning);
  return std::make_unique<mpm_ros::SimulatorNode>(ros::NodeHandle(), parameters);
}

int run(const mpm_ros::ParameterSources& sources, Ender& ender) {
  const std::unique_ptr<mpm_ros::SimulatorNode> node = make_node(sources);
  ender.must_finish();
  const int exit_code = node->spin();
  ender.may_end(exit_code);
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  mpm_ros::spin_only_briefly(argv);
  const mpm_ros::ParameterSources sources(argc, argv);
  // Own signal handlers, because roscpp's would close the connections before the bag is closed.
  ros::init(argc, argv, "simulator", ros::init_options::NoSigintHandler);
  mpm_ros::catch_stop_signals();
  static Ender ender;
  if (!wait_for_master()) return 0;
  ros::start();
  int exit_code = 1;
  try {
    exit_code = run(sources, ender);
  } catch (const mpm::StoppedError& error) {
    ROS_WARN_STREAM(error.what());
    exit_code = 0;
  } catch (const mpm::PhysicsError& error) {
    ROS_FATAL_STREAM(error.what());
    exit_code = 3;
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
  ender.may_end(exit_code);
  ros::shutdown();
  return exit_code;
}
