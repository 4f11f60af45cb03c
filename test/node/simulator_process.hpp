// Simulators and other programs in processes of their own, as a user starts them; for node tests.
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <mpm_ros/Command.h>
#include <mpm_ros/SolverState.h>
#include <mpm_ros/Step.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <xmlrpcpp/XmlRpc.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "mpm_ros/report/temporary_folder.hpp"

namespace mpm_ros::test {

/// Calls `ask` until it returns true or `seconds` of wall time have passed; simulated time may stand still. Returns its
/// last answer.
inline bool eventually(const std::function<bool()>& ask, double seconds = 20.0) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (std::chrono::steady_clock::now() < deadline) {
    if (ask()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return ask();
}

inline mpm_ros::Command velocity(const std::string& body, double vz) {
  mpm_ros::Command command;
  command.body = body;
  command.kind = mpm_ros::Command::VELOCITY;
  command.twist.linear.z = vz;
  return command;
}

/// Environment variable of the processes that a test starts. A test program that acts as another node must not run its
/// tests there, which would start it again and again.
constexpr const char* kChild = "MPM_TEST_CHILD";

constexpr const char* kNoNode = "-";

/// A program of this package, or of the path, in a process of its own, and a node in a namespace, as a user starts it.
class ProgramProcess {
 public:
  /// `arguments`: as on the command line. Each program has a namespace of its own, or the given one; kNoNode: it is no
  /// node.
  /// `largest_file`: simulated space on the disk [byte]; 0: unlimited.
  explicit ProgramProcess(const std::string& program, const std::vector<std::string>& arguments,
                          const std::string& name_space = {}, rlim_t largest_file = 0) {
    static int count = 0;
    namespace_ = name_space.empty() ? "/sim" + std::to_string(getpid()) + "_" + std::to_string(++count) : name_space;
    log_ = folder_.file("log");
    std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe").parent_path() / program;
    if (!std::filesystem::exists(path)) path = program;
    std::vector<std::string> words{path.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    if (name_space != kNoNode) words.push_back("__ns:=" + namespace_);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    pid_ = fork();
    if (pid_ == 0) {
      if (largest_file > 0) {
        ::signal(SIGXFSZ, SIG_IGN);  // then writing beyond the limit fails, as on a full disk
        const rlimit limit{largest_file, largest_file};
        setrlimit(RLIMIT_FSIZE, &limit);
      }
      const int log = open(log_.c_str(), O_CREAT | O_WRONLY | O_APPEND, 0600);
      dup2(log, STDOUT_FILENO);
      dup2(log, STDERR_FILENO);
      execvp(path.c_str(), pointers.data());
      _exit(127);
    }
  }

  ~ProgramProcess() {
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }

  const std::string& name_space() const { return namespace_; }
  std::string name(const std::string& relative) const { return namespace_ + "/" + relative; }
  pid_t pid() const { return pid_; }
  void signal(int number) const { kill(pid_, number); }

  /// Waits for the end and returns the exit code; -1 if it did not end in time, -2 if a signal ended it.
  int wait(double seconds = 60.0) {
    int status = 0;
    if (!eventually([&] { return waitpid(pid_, &status, WNOHANG) == pid_; }, seconds)) return -1;
    pid_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -2;
  }

  /// Processor time that it has taken since its start [s]; 0 when it has ended.
  double processor_seconds() const {
    std::ifstream file("/proc/" + std::to_string(pid_) + "/stat");
    std::string text;
    std::getline(file, text);
    std::istringstream fields(text.substr(std::min(text.rfind(')') + 1, text.size())));
    std::string skipped;
    for (int i = 3; i < 14; ++i) fields >> skipped;  // numbered as in proc(5), after the name
    double user = 0.0, system = 0.0;
    fields >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  }

  /// The output of the program.
  std::string log() const {
    std::ifstream file(log_);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }

 private:
  TemporaryFolder folder_;
  std::string namespace_;
  std::string log_;
  pid_t pid_ = 0;
};

class SimulatorProcess : public ProgramProcess {
 public:
  /// `parameters`: "name:=value" without the underscore. `largest_file` [byte]: as above.
  explicit SimulatorProcess(const std::vector<std::string>& parameters, rlim_t largest_file = 0)
      : ProgramProcess("simulator", private_parameters(parameters), {}, largest_file) {}

  bool ready() const {
    return eventually([&] { return ros::service::exists(name("step"), false); });
  }

  /// Lines of the output with FATAL.
  std::vector<std::string> fatal_lines() const {
    std::vector<std::string> lines;
    std::istringstream text(log());
    for (std::string line; std::getline(text, line);) {
      if (line.find("FATAL") != std::string::npos) lines.push_back(line);
    }
    return lines;
  }

  /// Calls one of its services. The connection is kept until the answer is there: on one that the node closes after it
  /// roscpp now and then loses the answer (ros/ros_comm, issue 1976).
  template <class Service>
  bool call(const std::string& service, Service& message) const {
    return ros::NodeHandle().serviceClient<Service>(name(service), true).call(message);
  }

  Step::Response step(const Step::Request& request) const {
    Step message;
    message.request = request;
    EXPECT_TRUE(call("step", message)) << log();
    return message.response;
  }
  Step::Response step(std::uint32_t count, const std::vector<mpm_ros::Command>& commands = {}) const {
    Step::Request request;
    request.count = count;
    request.commands = commands;
    return step(request);
  }

 private:
  static std::vector<std::string> private_parameters(std::vector<std::string> parameters) {
    for (std::string& parameter : parameters) parameter.insert(0, "_");
    return parameters;
  }
};

/// True if a node that publishes the topic lists this node among those that it sends to.
inline bool sent_to_this_node(const std::string& topic) {
  XmlRpc::XmlRpcValue request, response, state;
  request[0] = ros::this_node::getName();
  if (!ros::master::execute("getSystemState", request, response, state, false)) return false;
  for (int i = 0; i < state[0].size(); ++i) {
    if (static_cast<std::string>(state[0][i][0]) != topic) continue;
    for (int k = 0; k < state[0][i][1].size(); ++k) {
      XmlRpc::XmlRpcValue node, where, links;
      node[0] = ros::this_node::getName();
      node[1] = static_cast<std::string>(state[0][i][1][k]);
      std::string host;
      std::uint32_t port = 0;
      if (!ros::master::execute("lookupNode", node, response, where, false) ||
          !ros::network::splitURI(where, host, port)) {
        continue;
      }
      XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
      if (!client.execute("getBusInfo", request, links) || links.size() < 3) continue;
      // A link is its number, the node at its other end, its direction, its transport and its topic.
      for (int link = 0; link < links[2].size(); ++link) {
        XmlRpc::XmlRpcValue& one = links[2][link];
        if (static_cast<std::string>(one[1]) == ros::this_node::getName() && static_cast<std::string>(one[2]) == "o" &&
            static_cast<std::string>(one[4]) == topic) {
          return true;
        }
      }
    }
  }
  return false;
}

/// Subscribes to a topic on a thread of roscpp and keeps every message.
template <typename Message>
class Ear {
 public:
  explicit Ear(const std::string& topic) {
    subscriber_ =
        ros::NodeHandle().subscribe<Message>(topic, 10000, [this](const boost::shared_ptr<const Message>& message) {
          const std::lock_guard<std::mutex> lock(mutex_);
          messages_.push_back(*message);
        });
  }
  /// Waits until a publisher sends its messages here: this side counts a publisher before that one has answered.
  bool connected() const {
    return eventually([&] { return subscriber_.getNumPublishers() > 0 && sent_to_this_node(subscriber_.getTopic()); });
  }
  std::vector<Message> heard() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_;
  }
  bool hears(std::size_t count) const {
    return eventually([&] { return heard().size() >= count; });
  }

 private:
  mutable std::mutex mutex_;
  std::vector<Message> messages_;
  ros::Subscriber subscriber_;
};

/// Waits until the status `commands` or `solver` of that simulator contains `text`.
inline bool diagnosed(const Ear<diagnostic_msgs::DiagnosticArray>& ear, const SimulatorProcess& simulator,
                      const std::string& text) {
  const std::string node = simulator.name("simulator").substr(1) + ": ";
  return eventually([&] {
    for (const diagnostic_msgs::DiagnosticArray& array : ear.heard()) {
      for (const diagnostic_msgs::DiagnosticStatus& status : array.status) {
        if (status.name.compare(0, node.size(), node) == 0 && status.message.find(text) != std::string::npos) {
          return true;
        }
      }
    }
    return false;
  });
}

/// The last solver state in a bag; throws when rosbag cannot open it.
inline mpm_ros::SolverState last_state_in(const std::string& path) {
  rosbag::Bag bag(path);
  rosbag::View view(bag, rosbag::TypeQuery("mpm_ros/SolverState"));
  mpm_ros::SolverState state;
  for (const rosbag::MessageInstance& message : view) state = *message.instantiate<mpm_ros::SolverState>();
  return state;
}
inline std::string hash_in(const std::string& path) { return last_state_in(path).state_hash; }

}  // namespace mpm_ros::test
