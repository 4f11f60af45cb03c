// How much of the time a controller has its wrench in time: the simulator runs in real time at 200 Hz, and this node
// takes the wrench on a tool at every sync point, as a controller does. It prints the share of sync periods that were
// computed in time, by the simulator's own count, and how unevenly the wrenches came.
//
//   roslaunch benchmark/periods_in_time/periods_in_time.launch
#include <fmt/format.h>
#include <geometry_msgs/WrenchStamped.h>
#include <mpm_ros/SolverState.h>
#include <ros/ros.h>

#include <algorithm>
#include <cstdio>
#include <vector>

namespace {

constexpr int kWarmUp = 200;     // periods before the count begins
constexpr int kPeriods = 10000;  // counted

class Controller {
 public:
  explicit Controller(ros::NodeHandle& node)
      : wrench_(node.subscribe("wrench", 1000, &Controller::take, this, ros::TransportHints().tcpNoDelay())),
        state_(node.subscribe("solver_state", 1000, &Controller::count, this, ros::TransportHints().tcpNoDelay())) {}

  bool done() const { return taken_ >= kWarmUp + kPeriods; }

  void tell() {
    std::sort(late_.begin(), late_.end());
    const auto at = [&](double part) { return 1e3 * late_[static_cast<std::size_t>(part * (late_.size() - 1.0))]; };
    fmt::print(
        "{} sync periods of {:.1f} ms: {:.2f} % computed in time; behind the median wrench 99 of 100 came by at most "
        "{:.2f} ms, 999 of 1000 by {:.2f} ms, all by {:.2f} ms\n",
        late_.size(), 1e3 * period_, 100.0 * (1.0 - static_cast<double>(last_ - first_) / kPeriods), at(0.99) - at(0.5),
        at(0.999) - at(0.5), at(1.0) - at(0.5));
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
    if (taken_ <= kWarmUp) first_ = last_;
  }

  ros::Subscriber wrench_, state_;
  int taken_ = 0;
  std::vector<double> late_;  // behind the stamp [s]
  double period_ = 0.0;       // [s]
  ros::Time before_;
  std::uint64_t first_ = 0, last_ = 0;  // overruns
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "periods_in_time");
  ros::NodeHandle node;
  Controller controller(node);
  while (ros::ok() && !controller.done()) {
    ros::spinOnce();
    ros::WallDuration(0.0002).sleep();
  }
  if (controller.done()) controller.tell();
  return controller.done() ? 0 : 1;
}
