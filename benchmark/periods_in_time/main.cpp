// Part of the time in which a controller has its wrench in time: the simulator runs in real time, and this node takes
// the wrench on a tool at every sync point, as a controller does. It prints the share of sync periods that were
// computed in time, by the simulator's own count, how unevenly the wrenches came, and what a time.budget did. ~load:
// part of each core that other work takes.
//
//   roslaunch benchmark/periods_in_time/periods_in_time.launch
//   roslaunch benchmark/periods_in_time/implicit.launch budget:="6 ms" load:=0.6
#include <fmt/format.h>
#include <geometry_msgs/WrenchStamped.h>
#include <mpm_ros/SolverState.h>
#include <ros/ros.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "busy_cores.hpp"

namespace {

constexpr int kWarmUp = 200;  // periods before the count begins

class Controller {
 public:
  Controller(ros::NodeHandle& node, int periods)
      : periods_(periods),
        wrench_(node.subscribe("wrench", 1000, &Controller::take, this, ros::TransportHints().tcpNoDelay())),
        state_(node.subscribe("solver_state", 1000, &Controller::count, this, ros::TransportHints().tcpNoDelay())) {}

  bool done() const { return taken_ >= kWarmUp + periods_; }

  void tell() {
    std::sort(late_.begin(), late_.end());
    const auto at = [&](double part) { return 1e3 * late_[static_cast<std::size_t>(part * (late_.size() - 1.0))]; };
    fmt::print(
        "{} sync periods of {:.1f} ms: {:.2f} % computed in time; behind the median wrench 99 of 100 came by at most "
        "{:.2f} ms, 999 of 1000 by {:.2f} ms, all by {:.2f} ms\n",
        late_.size(), 1e3 * period_, 100.0 * (1.0 - static_cast<double>(last_ - first_) / periods_), at(0.99) - at(0.5),
        at(0.999) - at(0.5), at(1.0) - at(0.5));
    if (sweeps_.empty()) return;
    std::sort(sweeps_.begin(), sweeps_.end());
    std::sort(errors_.begin(), errors_.end());
    fmt::print(
        "sweeps of a step: {:.0f} to {:.0f}, {:.0f} in the median; {} of {} steps cut; error of the force {:.1f} % "
        "in the median, {:.1f} % in 99 of 100\n",
        sweeps_.front(), sweeps_.back(), sweeps_[sweeps_.size() / 2], cut_, steps_, 100.0 * errors_[errors_.size() / 2],
        100.0 * errors_[errors_.size() * 99 / 100]);
  }

 private:
  // A stamp is the wall time at which the run began plus simulated time.
  void take(const geometry_msgs::WrenchStamped& message) {
    const double late = (ros::Time::now() - message.header.stamp).toSec();
    if (++taken_ > kWarmUp) late_.push_back(late);
    period_ = (message.header.stamp - before_).toSec();
    before_ = message.header.stamp;
  }

  void count(const mpm_ros::SolverState& message) {
    last_ = message.overruns;
    if (taken_ <= kWarmUp) {
      first_ = last_;
      first_step_ = message.steps;
      return;
    }
    steps_ = message.steps - first_step_;
    cut_ += message.cut_steps.size();
    for (const mpm_ros::NamedValue& value : message.values) {
      if (value.name == "sweeps") sweeps_.push_back(value.value.at(0));
      if (value.name == "sweep_error") errors_.push_back(value.value.at(0));
    }
  }

  const int periods_;
  ros::Subscriber wrench_, state_;
  int taken_ = 0;
  std::vector<double> late_;  // behind the stamp [s]
  double period_ = 0.0;       // [s]
  ros::Time before_;
  std::uint64_t first_ = 0, last_ = 0;  // overruns
  std::uint64_t first_step_ = 0, steps_ = 0, cut_ = 0;
  std::vector<double> sweeps_, errors_;  // values of the last step of each period
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "periods_in_time");
  const BusyCores other(argc > 1 ? std::atof(argv[1]) : 0.0);
  ros::NodeHandle node;
  Controller controller(node, ros::param::param("~periods", 10000));
  while (ros::ok() && !controller.done()) {
    ros::spinOnce();
    ros::WallDuration(0.0002).sleep();
  }
  if (controller.done()) controller.tell();
  std::fflush(stdout);
  return controller.done() ? 0 : 1;
}
