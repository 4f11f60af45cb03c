// rosrun mpm_ros teleop [BODY]: moves a rigid body by the keyboard, on its topic cmd_vel.
//
// While a key is held, it publishes at --frequency; when the key is released, on space and at the end it publishes a
// zero and is then silent. A command from a terminal that was lost ends by the simulator's ~command_timeout.
// Exit codes: 0 quit by the user, 2 bad input (no terminal, no such body).
#include <fmt/format.h>
#include <poll.h>
#include <ros/master.h>
#include <ros/ros.h>
#include <termios.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <stdexcept>
#include <thread>

#include "mpm/math/nearest.hpp"
#include "mpm_ros/command/teleop_keys.hpp"
#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/run_namespaces.hpp"
#include "mpm_ros/message/topics.hpp"
#include "mpm_ros/node/master.hpp"

namespace {

using Clock = std::chrono::steady_clock;

volatile std::sig_atomic_t stop_signal = 0;

void on_signal(int signal) { stop_signal = signal; }

struct Options {
  std::string body;
  std::string name_space;
  double speed = 0.05;
  double rotation_rate = 0.5;
  double frequency = 20.0;
  double hold = 0.7;
};

/// Delivers keys one by one without echo during its lifetime, then restores the terminal.
class RawTerminal {
 public:
  RawTerminal() {
    if (tcgetattr(STDIN_FILENO, &before_) != 0)
      throw std::runtime_error(
          "the input is not a terminal; run it in one (in a launch file: launch-prefix=\"xterm -e\")");
    termios raw = before_;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    raw.c_cc[VMIN] = 0;
    raw.c_cc[VTIME] = 0;
    raw.c_cc[VSUSP] = _POSIX_VDISABLE;  // a suspended program would leave a terminal without echo
    tcsetattr(STDIN_FILENO, TCSANOW, &raw);
  }
  ~RawTerminal() {
    tcsetattr(STDIN_FILENO, TCSANOW, &before_);
    std::cout << std::endl;
  }
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

  /// Reads the keys pressed, waiting at most `patience`. Returns false when the terminal is gone.
  static bool read(std::chrono::milliseconds patience, std::string& keys) {
    keys.clear();
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (poll(&input, 1, static_cast<int>(patience.count())) <= 0) return true;
    std::array<char, 64> buffer{};
    const ssize_t count = ::read(STDIN_FILENO, buffer.data(), buffer.size());
    if (count <= 0) return false;
    keys.assign(buffer.data(), static_cast<std::size_t>(count));
    return true;
  }

 private:
  termios before_{};
};

/// Rigid bodies of the simulator in the namespace: those whose wrench is published.
std::vector<std::string> bodies_there(const ros::NodeHandle& node) {
  const std::string before = node.resolveName(mpm_ros::topics::kBodies) + "/";
  const std::string after = std::string("/") + mpm_ros::topics::kWrench;
  ros::master::V_TopicInfo there;
  ros::master::getTopics(there);
  std::vector<std::string> bodies;
  for (const ros::master::TopicInfo& topic : there) {
    const std::string& name = topic.name;
    if (name.size() <= before.size() + after.size() || name.compare(0, before.size(), before) != 0 ||
        name.compare(name.size() - after.size(), after.size(), after) != 0) {
      continue;
    }
    bodies.push_back(name.substr(before.size(), name.size() - before.size() - after.size()));
  }
  return bodies;
}

/// @throws std::runtime_error when the body does not exist, or when there are several and none is named
std::string find_body(const ros::NodeHandle& node, const std::string& asked) {
  constexpr std::chrono::seconds kPatience{5};
  std::vector<std::string> bodies;
  for (const Clock::time_point end = Clock::now() + kPatience; bodies.empty() && stop_signal == 0;) {
    bodies = bodies_there(node);
    if (!bodies.empty()) break;
    if (Clock::now() > end) {
      throw std::runtime_error(fmt::format("no simulator has rigid bodies below {}; start one, or name its --namespace",
                                           node.resolveName(mpm_ros::topics::kBodies)));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  if (asked.empty() && bodies.size() == 1) return bodies.front();
  if (asked.empty()) throw std::runtime_error(fmt::format("which body? There are {}", fmt::join(bodies, ", ")));
  if (std::find(bodies.begin(), bodies.end(), asked) == bodies.end())
    throw std::runtime_error(fmt::format("there is no rigid body '{}'; {}", asked, mpm::suggest(asked, bodies)));
  return asked;
}

void drive(ros::NodeHandle& node, const std::string& body, const Options& options) {
  ros::Publisher publisher =
      node.advertise<geometry_msgs::Twist>(mpm_ros::topics::of_body(body, mpm_ros::topics::kCmdVel), 10);
  const RawTerminal terminal;
  std::cout << fmt::format("'{}' on {}\n", body, publisher.getTopic()) << mpm_ros::TeleopKeys::help();
  mpm_ros::TeleopKeys keyboard(options.speed, options.rotation_rate, options.hold);
  const Clock::time_point start = Clock::now();
  const std::chrono::duration<double> period(1.0 / options.frequency);
  Clock::time_point due = start;
  bool moving = false, quit = false;
  std::string shown;
  while (ros::ok() && stop_signal == 0 && !quit) {
    std::string keys;
    if (!RawTerminal::read(std::chrono::milliseconds(5), keys)) break;
    const double now = std::chrono::duration<double>(Clock::now() - start).count();
    bool at_once = false;
    for (const char key : keys) {
      const mpm_ros::TeleopKeys::Action action = keyboard.press(key, now);
      at_once = at_once || action == mpm_ros::TeleopKeys::Action::stop;
      quit = quit || action == mpm_ros::TeleopKeys::Action::quit;
    }
    const mpm::Twist twist = keyboard.twist(now);
    const bool moves = !twist.linear.isZero(0.0) || !twist.angular.isZero(0.0);
    if (quit || (!at_once && moves == moving && (!moves || Clock::now() < due))) continue;
    publisher.publish(mpm_ros::to_message(twist));
    moving = moves;
    due = Clock::now() + std::chrono::duration_cast<Clock::duration>(period);
    const std::string status = keyboard.status(now);
    if (status == shown) continue;
    std::cout << "\r" << status << "\033[K" << std::flush;
    shown = status;
  }
  if (!moving) return;
  publisher.publish(geometry_msgs::Twist());
  std::this_thread::sleep_for(std::chrono::milliseconds(200));  // so that the last message is sent
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Moves a rigid body of a running simulator by the keyboard.");
  app.add_option("BODY", options.body, "name of the rigid body; may be left out when there is one");
  app.add_option("--speed", options.speed, "speed while a key is held [m/s]")->check(CLI::PositiveNumber);
  app.add_option("--rotation-rate", options.rotation_rate, "rotation rate while a key is held [rad/s]")
      ->check(CLI::PositiveNumber);
  app.add_option("--frequency", options.frequency, "messages per second while the body moves [1/s]")
      ->check(CLI::Range(1.0, 200.0));
  app.add_option("--hold", options.hold,
                 "time for which a single key press counts [s]; more than the keyboard's delay before repetition")
      ->check(CLI::PositiveNumber);
  app.add_option("--namespace", options.name_space, "namespace of the simulator; may be left out when one runs");
  ros::V_string words;
  ros::removeROSArgs(argc, argv, words);
  std::vector<std::string> arguments(words.rbegin(), words.rend() - 1);  // reversed, for CLI11, without the program
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  constexpr auto kOptions = ros::init_options::NoSigintHandler | ros::init_options::AnonymousName;
  if (const auto refused = mpm_ros::begin_ros(argc, argv, "teleop", kOptions)) return *refused;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) std::signal(signal, on_signal);
  try {
    if (options.name_space.empty() && ros::this_node::getNamespace() == "/") {
      const std::vector<std::string> found = mpm_ros::running_namespaces();
      if (found.size() == 1) options.name_space = found.front();
    }
    ros::NodeHandle node(options.name_space);
    drive(node, find_body(node, options.body), options);
  } catch (const std::exception& error) {
    std::cerr << "teleop: " << error.what() << "\n";
    return 2;
  }
  return 0;
}
