// The cost of a call of the service `step` beyond the step itself: transport of request and response, the hand-over
// between threads, commands and the answer. Sync periods are stepped with one call each, and many with one call. Both
// publish the same, so the difference is the cost of a call. The two are measured in turns, because the speed of the
// machine changes.
//
//   roslaunch benchmark/step_round_trip/step_round_trip.launch
#include <fmt/format.h>
#include <mpm_ros/Step.h>
#include <ros/ros.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <vector>

namespace {

constexpr int kRounds = 400;
constexpr int kCalls = 10;  // single calls of a round, and sync periods of the call that they are compared with

/// Wall time of a call that steps `count` sync periods [ms].
double call(ros::ServiceClient& service, std::uint32_t count) {
  mpm_ros::Step step;
  step.request.count = count;
  const auto start = std::chrono::steady_clock::now();
  if (!service.call(step)) throw std::runtime_error("the simulator does not answer");
  const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
  if (!step.response.success) throw std::runtime_error(step.response.message);
  return taken.count();
}

double quantile(std::vector<double> values, double part) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void measure(ros::ServiceClient& service) {
  std::vector<double> single, batch;
  call(service, 100);
  for (int round = 0; round < kRounds; ++round) {
    for (int i = 0; i < kCalls; ++i) single.push_back(call(service, 1));
    batch.push_back(call(service, kCalls));
  }
  // With s the time of a sync period and c that of a call, `one` is s + c and `many` is kCalls * s + c.
  const double one = quantile(single, 0.5), many = quantile(batch, 0.5);
  const double step = (many - one) / (kCalls - 1);
  fmt::print(
      "a sync period: {:.3f} ms of stepping and publishing; a call beyond it: {:.3f} ms (median of {}), "
      "{:.3f} ms (10 %), {:.3f} ms (90 %)\n",
      step, one - step, single.size(), quantile(single, 0.1) - step, quantile(single, 0.9) - step);
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "step_round_trip");
  ros::NodeHandle node;
  const std::string name = node.resolveName("step");
  while (ros::ok() && !ros::service::exists(name, false)) ros::WallDuration(0.05).sleep();
  ros::ServiceClient service = node.serviceClient<mpm_ros::Step>(name, true);
  try {
    measure(service);
  } catch (const std::runtime_error& error) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return 1;
  }
  return 0;
}
