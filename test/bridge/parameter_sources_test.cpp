// Text of the node on the origin of its parameters, and the namespaces that have a run.
#include "mpm_ros/node/parameter_sources.hpp"

#include <gtest/gtest.h>

#include "mpm_ros/message/run_namespaces.hpp"

namespace mpm_ros {
namespace parameter_sources_test {

ParameterSources sources(std::vector<const char*> words) {
  words.insert(words.begin(), "simulator");
  return ParameterSources(static_cast<int>(words.size()), words.data());
}

const ParameterValues kValues = {{"scene", std::string("press")}, {"threads", 2}};

TEST(ParameterSources, AllFromTheCommandLine) {
  const ParameterSources given = sources({"_scene:=press", "_threads:=2", "__ns:=/mpm"});
  EXPECT_FALSE(given.doubtful(kValues));
  EXPECT_EQ(given.text(kValues, "/mpm/simulator"), "from the command line: ~scene = press, ~threads = 2");
}

TEST(ParameterSources, WhatTheServerHadBeforeIsInDoubt) {
  const ParameterSources given = sources({"_scene:=press", "topic:=other"});
  EXPECT_TRUE(given.doubtful(kValues));
  EXPECT_EQ(
      given.text(kValues, "/simulator"),
      "from the command line: ~scene = press; from the parameter server: ~threads = 2 (set by rosparam, or left by an "
      "earlier run; `rosparam delete /simulator` removes what is there)");
}

TEST(ParameterSources, WhatALaunchFileSetIsNot) {
  const ParameterSources given = sources({"_scene:=press", "__name:=simulator", "__log:=/tmp/log"});
  EXPECT_FALSE(given.doubtful(kValues));
  EXPECT_EQ(given.text(kValues, "/simulator"),
            "from the command line: ~scene = press; from the launch file or the parameter server: ~threads = 2");
}

TEST(ParameterSources, NothingGivenIsNoText) { EXPECT_EQ(sources({}).text({}, "/simulator"), ""); }

TEST(RunNamespaces, AreThoseOfRunInfo) {
  EXPECT_EQ(run_namespaces({{"/mpm/run_info", "mpm_ros/RunInfo"},
                            {"/run_info", "mpm_ros/RunInfo"},
                            {"/a/b/run_info", "mpm_ros/RunInfo"},
                            {"/other/run_info", "std_msgs/String"},
                            {"/rerun_info", "mpm_ros/RunInfo"},
                            {"/mpm/particles", "sensor_msgs/PointCloud2"}}),
            (std::vector<std::string>{"/", "/a/b", "/mpm"}));
  EXPECT_TRUE(run_namespaces({}).empty());
}

}  // namespace parameter_sources_test
}  // namespace mpm_ros
