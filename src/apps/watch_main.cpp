// rosrun mpm_ros watch [CONFIG.rviz] [_field:=NAME] [__ns:=NAMESPACE]: starts RViz with a view that fits the run at
// hand, which it finds by its run_info; a namespace has to be named only where several runs go on, or where the run
// starts later, as in a launch file. Waits for the first particles, writes the domain, the particles' size and their
// field into the configuration (by default the package's config/rviz/mpm.rviz), and starts RViz. While RViz is open it
// publishes what RViz cannot make by itself: the particles in colours whose range outliers do not set, and a colour
// bar.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mpm_ros/RunInfo.h>
#include <ros/callback_queue.h>
#include <ros/package.h>
#include <ros/ros.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <thread>
#include <utility>
#include <vector>

#include "mpm/math/input_file.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm_ros/message/local_frame.hpp"
#include "mpm_ros/message/particle_colours.hpp"
#include "mpm_ros/message/run_namespaces.hpp"
#include "mpm_ros/message/topics.hpp"
#include "mpm_ros/message/view.hpp"
#include "mpm_ros/node/master.hpp"
#include "mpm_ros/node/neighbours.hpp"
#include "mpm_ros/node/parameter_sources.hpp"

namespace {

constexpr double kPatience = 2.0;  ///< time of a wait for particles that nothing is said about [s]

std::filesystem::path fitted_path() {
  const char* ros_home = std::getenv("ROS_HOME");
  const char* home = std::getenv("HOME");
  const std::filesystem::path folder =
      ros_home != nullptr ? ros_home : std::filesystem::path(home != nullptr ? home : "/tmp") / ".ros";
  std::filesystem::create_directories(folder);
  return folder / "mpm_ros_watch.rviz";
}

/// Domain of the running scene, in the frame of its particles; empty when it is not known.
mpm::Box domain_of(const mpm_ros::RunInfoConstPtr& info) {
  if (!info) return {};
  try {
    const mpm::Scene scene = mpm::parse_scene(info->scene_text, info->scene_path);
    const mpm::GridDefinition& grid = scene.definition.grid;
    const mpm::Vec3 origin = mpm_ros::local_frame(grid, "world").origin;
    return {grid.min - origin, grid.max - origin};
  } catch (const mpm::Error&) {
    return {};  // the scene is of another version; the particles alone suffice
  }
}

/// The namespace that was asked for, else that of the run that goes on.
std::string find_namespace() {
  const std::vector<std::string> found = mpm_ros::running_namespaces();
  const std::string& asked = ros::this_node::getNamespace();
  if (asked != "/") {
    if (std::find(found.begin(), found.end(), asked) == found.end()) {
      ROS_INFO("no run below %s yet: waiting for one", asked.c_str());
    }
    return asked;
  }
  if (found.empty()) {
    throw std::runtime_error(
        "nothing runs: no simulator and no bag that is played publishes run_info; start one, or name the namespace in "
        "which it will start, __ns:=mpm");
  }
  if (found.size() > 1) {
    throw std::runtime_error(fmt::format("which run? Name its namespace, __ns:=: {}", fmt::join(found, ", ")));
  }
  return found.front();
}

/// The field that the command line or a launch file names, or empty.
std::string field_asked(const mpm_ros::ParameterSources& sources) {
  const mpm_ros::ForgetParameters forget(sources);
  return ros::param::param<std::string>("~field", "");
}

/// Publishes a run's particles in colours, and the colour bar, from each cloud that arrives.
class Colourist {
 public:
  /// Begins with the cloud that has arrived, since it may be the last one for long.
  Colourist(const std::string& name_space, mpm_ros::View view, const sensor_msgs::PointCloud2& first)
      : view_(std::move(view)),
        colours_(view_.field),
        coloured_(own_.advertise<sensor_msgs::PointCloud2>("particles", 1, true)),
        bar_(own_.advertise<visualization_msgs::MarkerArray>("colour_bar", 1, true)),
        subscriber_(ros::NodeHandle(name_space).subscribe(mpm_ros::topics::kParticles, 1, &Colourist::take, this)) {
    show(first);
  }

 private:
  void take(const sensor_msgs::PointCloud2ConstPtr& cloud) { show(*cloud); }
  void show(const sensor_msgs::PointCloud2& cloud) {
    coloured_.publish(colours_.colour(cloud));
    bar_.publish(colours_.bar(view_, cloud.header.frame_id));
  }

  ros::NodeHandle own_{"~"};
  const mpm_ros::View view_;
  mpm_ros::ParticleColours colours_;
  ros::Publisher coloured_, bar_;
  ros::Subscriber subscriber_;
};

/// True if RViz is given this word of the command line too: names of topics and namespaces, but neither a parameter of
/// watch nor its name and log, since two nodes of one name end each other.
bool for_rviz(const std::string& word) {
  if (word.find(":=") == std::string::npos) return false;
  const auto begins = [&word](const char* prefix) { return word.rfind(prefix, 0) == 0; };
  return begins("__") ? !begins("__name:=") && !begins("__log:=") : !begins("_");
}

/// Ends a program that is a node: as by Ctrl-C, so that it leaves the graph, and by force where it does not.
void end_program(pid_t program) {
  constexpr std::chrono::milliseconds kPatienceForNode{1000}, kLook{20};
  int status = 0;
  for (const int signal : {SIGINT, SIGTERM}) {
    kill(program, signal);
    for (std::chrono::milliseconds waited{0}; waited < kPatienceForNode; waited += kLook) {
      if (waitpid(program, &status, WNOHANG) != 0) return;
      std::this_thread::sleep_for(kLook);
    }
  }
  kill(program, SIGKILL);
  waitpid(program, &status, 0);
}

/// Waits for a program while callbacks are served; ends it when this node is told to end. Its exit code.
int serve_until_end(pid_t program) {
  int status = 0;
  while (waitpid(program, &status, WNOHANG) == 0) {
    if (!ros::ok()) {
      end_program(program);
      return 0;
    }
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.05));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

/// A run's first particles, with the domain of its scene; no cloud when this node is told to end.
struct First {
  sensor_msgs::PointCloud2ConstPtr cloud;
  mpm::Box domain;
};

/// Waits for a run's particles as long as it takes: a run may be paused, wait for `step` or `reset`, or still settle.
First first_particles(const std::string& name_space) {
  ros::NodeHandle node(name_space);
  First first;
  const auto subscriber = node.subscribe<sensor_msgs::PointCloud2>(
      mpm_ros::topics::kParticles, 1, [&](const sensor_msgs::PointCloud2ConstPtr& message) { first.cloud = message; });
  mpm_ros::RunInfoConstPtr info;
  const auto info_subscriber = node.subscribe<mpm_ros::RunInfo>(
      mpm_ros::topics::kRunInfo, 1, [&](const mpm_ros::RunInfoConstPtr& message) { info = message; });
  // In wall time, because simulated time may stand still.
  ros::WallTime known;  // since when there has been a part of what is waited for
  for (bool said = false; ros::ok() && !(first.cloud && info);) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
    if (!first.cloud && !info) continue;
    if (known.isZero()) known = ros::WallTime::now();
    if (ros::WallTime::now() < known + ros::WallDuration(kPatience)) continue;
    if (first.cloud) break;
    if (!said) {
      ROS_INFO(
          "no particles on %s yet: RViz opens with the first ones; a paused run has to go on, a run in lockstep waits "
          "for `step`, one that has ended for `reset`",
          subscriber.getTopic().c_str());
    }
    said = true;
  }
  first.domain = domain_of(info);
  return first;
}

/// Writes a configuration with the view put in. Returns the file's path.
std::string write_fitted(const std::string& path, const mpm_ros::View& view, const std::string& name_space) {
  std::string text;
  if (const std::string refused = mpm::read_input(path, text); !refused.empty())
    throw std::runtime_error(path + ": " + refused);
  const std::string fitted_file = fitted_path();
  std::ofstream out(fitted_file);
  out << mpm_ros::with_view(text, view, name_space == "/" ? name_space : name_space + "/");
  if (!out.flush()) throw std::runtime_error(fitted_file + " cannot be written");
  return fitted_file;
}

}  // namespace

int main(int argc, char** argv) {
  const mpm_ros::ParameterSources sources(argc, argv);
  std::vector<char*> words(argv, argv + argc);  // with the arguments that roslaunch appended, which RViz accepts too
  // Several can watch, each under a name of its own.
  if (const auto refused = mpm_ros::begin_ros(argc, argv, "watch", ros::init_options::AnonymousName)) return *refused;
  const std::string field = field_asked(sources);
  if (argc > 2) {
    ROS_FATAL("usage: rosrun mpm_ros watch [CONFIG.rviz] [_field:=NAME] [__ns:=NAMESPACE]");
    return 2;
  }
  std::string configuration = argc == 2 ? argv[1] : ros::package::getPath("mpm_ros") + "/config/rviz/mpm.rviz";
  std::unique_ptr<Colourist> colourist;
  try {
    const std::string name_space = find_namespace();
    ros::start();
    const First first = first_particles(name_space);
    if (!first.cloud) return 0;
    mpm_ros::View view = mpm_ros::view_of(*first.cloud, field, first.domain);
    if (!view.field.empty()) {
      view.coloured = ros::names::resolve("~particles");
      view.bar = ros::names::resolve("~colour_bar");
      colourist = std::make_unique<Colourist>(name_space, view, *first.cloud);
    }
    configuration = write_fitted(configuration, view, name_space);
  } catch (const std::exception& error) {
    ROS_FATAL("watch: %s", error.what());
    return 2;
  }
  std::string rviz = "rviz", option = "-d";
  std::vector<char*> command{rviz.data(), option.data(), configuration.data()};
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (for_rviz(words[i])) command.push_back(words[i]);
  }
  // A name that is known, so that nothing is left of it when it is gone, however it ends.
  const std::string node = ros::this_node::getName() + "_rviz";
  std::string name = "__name:=" + node.substr(node.rfind('/') + 1);
  command.push_back(name.data());
  command.push_back(nullptr);
  pid_t program = 0;
  if (posix_spawnp(&program, rviz.c_str(), nullptr, nullptr, command.data(), environ) != 0) {
    ROS_FATAL("watch: rviz cannot be started; install it with scripts/install_packages rviz");
    return 1;
  }
  const int exit_code = serve_until_end(program);
  mpm_ros::forget_node(node);
  return exit_code;
}
