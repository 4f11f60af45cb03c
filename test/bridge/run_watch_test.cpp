// Output of a run of which a part is watched: a region, global quantities, filtered wrenches.
#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/wrench_filter.hpp"
#include "mpm_ros/report/temporary_folder.hpp"
#include "mpm_ros/run/run.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace run_watch_test {

constexpr double kCutoff = 15.0;  // [Hz]

/// All messages of a type on a topic.
template <typename Message>
std::vector<Message> read(const std::string& path, const std::string& topic) {
  rosbag::Bag bag(path);
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  std::vector<Message> messages;
  for (const rosbag::MessageInstance& instance : view) messages.push_back(*instance.instantiate<Message>());
  return messages;
}

/// Records 0.1 s of the press of test/data in sync periods of 2 ms, with the plate pushed down from the start.
void record(const std::string& path, const std::function<void(OutputOptions&)>& choose) {
  const mpm::Scene scene =
      mpm::load_scene(data_file("press.yaml"),
                      {"time.end=0.1", "output.global=[{quantity: contactz, body: plate}, Kinetic Energy, dispx]",
                       "output.global_period=0.01"});
  RunOptions options;
  options.threads = 1;
  options.output = output_options(scene);
  choose(options.output);
  options.bag = path;
  mpm_ros::Run run(scene, options, Stamps(), nullptr);
  run.begin();
  AppliedCommand command;
  command.body = run.simulation().find_body("plate");
  command.twist.linear.z() = -0.1;
  run.apply(command);
  while (!run.ended()) run.advance();
  run.finish();
}

TEST(RunWatch, OnlyTheRegionIsWritten) {
  const TemporaryFolder folder;
  const std::string all = folder.file("all.bag"), part = folder.file("part.bag");
  record(all, [](OutputOptions&) {});
  const auto whole = read<sensor_msgs::PointCloud2>(all, "/mpm/particles");
  mpm::Box box;
  sensor_msgs::PointCloud2ConstIterator<float> x(whole.back(), "x"), z(whole.back(), "z");
  for (; x != x.end(); ++x, ++z) box.add({*x, 0.0, *z});
  const double middle = box.center().z();
  record(part, [&](OutputOptions& options) {
    options.particles.choice.region = mpm::Box{mpm::Vec3(-1e3, -1e3, middle), mpm::Vec3::Constant(1e3)};
  });
  const auto upper = read<sensor_msgs::PointCloud2>(part, "/mpm/particles");
  ASSERT_EQ(upper.size(), whole.size());
  std::size_t expected = 0;
  sensor_msgs::PointCloud2ConstIterator<float> height(whole.back(), "z");
  for (; height != height.end(); ++height) expected += *height >= static_cast<float>(middle) ? 1U : 0U;
  EXPECT_EQ(upper.back().width, expected);
  EXPECT_LT(upper.back().width, whole.back().width);
  EXPECT_GT(upper.back().width, 0U);
}

TEST(RunWatch, GlobalQuantitiesComeAtTheirPeriodAndAgreeWithTheOtherTopics) {
  const TemporaryFolder folder;
  const std::string path = folder.file("run.bag");
  record(path, [](OutputOptions&) {});
  const auto messages = read<GlobalQuantities>(path, "/mpm/global_quantities");
  ASSERT_EQ(messages.size(), 11U);  // every 10 ms of 0.1 s, and at the start
  EXPECT_EQ(messages[0].names, (std::vector<std::string>{"contactz of plate", "Kinetic Energy", "dispx"}));
  EXPECT_EQ(messages[0].units, (std::vector<std::string>{"N", "J", "m"}));
  EXPECT_EQ(messages[0].values[2], 0.0);
  const auto forces = read<ContactForces>(path, "/mpm/contact_forces");
  const auto states = read<SolverState>(path, "/mpm/solver_state");
  std::size_t state = 0;
  double before = 0.0, largest = 0.0;
  for (const GlobalQuantities& message : messages) {
    while (states[state].header.stamp < message.header.stamp) ++state;
    ASSERT_EQ(states[state].header.stamp, message.header.stamp);
    // The sums are over the same particles in another order.
    EXPECT_NEAR(message.values[1], states[state].energy_kinetic, 1e-12 * states[state].energy_kinetic);
    double impulse = 0.0;
    for (const ContactForce& body : forces[state].bodies) {
      if (body.name == "plate") impulse = body.impulse.z;
    }
    const double mean = (impulse - before) / 0.01;
    largest = std::max(largest, std::abs(mean));
    EXPECT_NEAR(message.values[0], mean, 1e-9 * std::max(1.0, largest));
    before = impulse;
  }
  EXPECT_GT(largest, 0.0);  // it has pressed
}

TEST(RunWatch, TheFilteredWrenchIsTheFilterOfTheWrenches) {
  const TemporaryFolder folder;
  const std::string path = folder.file("run.bag"), raw = folder.file("raw.bag");
  record(path, [](OutputOptions& options) { options.wrench_cutoff = kCutoff; });
  const auto wrenches = read<geometry_msgs::WrenchStamped>(path, "/mpm/bodies/plate/wrench");
  const auto filtered = read<geometry_msgs::WrenchStamped>(path, "/mpm/bodies/plate/wrench_filtered");
  ASSERT_EQ(filtered.size(), wrenches.size());
  ASSERT_GT(wrenches.size(), 10U);
  const double period = read<RunInfo>(path, "/mpm/run_info").front().sync_period;
  WrenchFilter filter(kCutoff, period);
  double largest = 0.0;
  for (std::size_t i = 0; i < wrenches.size(); ++i) {
    EXPECT_EQ(filtered[i].header.frame_id, "plate");
    const mpm::Wrench expected = filter.filter(from_message(wrenches[i].wrench));
    EXPECT_EQ(from_message(filtered[i].wrench).force, expected.force) << i;
    EXPECT_EQ(from_message(filtered[i].wrench).torque, expected.torque) << i;
    largest = std::max(largest, expected.force.norm());
  }
  EXPECT_GT(largest, 0.0);
  record(raw, [](OutputOptions&) {});
  EXPECT_TRUE(read<geometry_msgs::WrenchStamped>(raw, "/mpm/bodies/plate/wrench_filtered").empty());
}

TEST(RunWatch, ACutoffThatSyncPointsCannotHoldIsRefused) {
  const TemporaryFolder folder;
  try {
    record(folder.file("run.bag"), [](OutputOptions& options) { options.wrench_cutoff = 1e4; });
    ADD_FAILURE() << "taken";
  } catch (const mpm::DefinitionError& error) {
    EXPECT_NE(std::string(error.what()).find("cutoff of the filtered wrenches, 10000 Hz, is not below"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace run_watch_test
}  // namespace mpm_ros
