// Shipped scenes in the node, as a user starts them, recorded. Those of a second together, with MPM_FULL all.
#include <set>

#include "mpm/scene/scene.hpp"
#include "simulator_process.hpp"

namespace mpm_ros::test {
namespace shipped_node_test {

const std::set<std::string> kSmall{"column_collapse",     "compressed_block",   "elastic_block",
                                   "end_loaded_cylinder", "falling_block",      "foam_probe",
                                   "sliding_block",       "radial_compression", "wheel_in_sand"};

TEST(Shipped, ScenesRunInTheNode) {
  const bool all = std::getenv("MPM_FULL") != nullptr;
  for (const auto& [name, line] : mpm::shipped_scenes()) {
    if (!all && kSmall.count(name) == 0) continue;
    SCOPED_TRACE(name);
    const TemporaryFolder folder;
    SimulatorProcess simulator({"scene:=" + name, "pacing:=lockstep", "record:=" + folder.file("run.bag")});
    ASSERT_TRUE(eventually([&] { return ros::service::exists(simulator.name("step"), false); }, 120.0))
        << simulator.log();
    const Step::Response step = simulator.step(2);
    EXPECT_TRUE(step.success) << step.message;
    const double sync = 1e-9 * static_cast<double>(mpm::load_scene(name).definition.time.sync);
    EXPECT_NEAR(step.time, 2.0 * sync, 1e-12);
    EXPECT_EQ(step.bodies.bodies.size(), step.contact_forces.bodies.size());
    simulator.signal(SIGTERM);
    EXPECT_EQ(simulator.wait(), 0) << simulator.log();
    EXPECT_EQ(hash_in(folder.file("run.bag")).size(), 16U);
  }
}

}  // namespace shipped_node_test
}  // namespace mpm_ros::test
