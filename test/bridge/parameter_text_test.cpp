// Parameters that rosrun and roslaunch hand on as text: what they mean.
#include "mpm_ros/node/parameter_text.hpp"

#include <gtest/gtest.h>

#include "mpm_ros/node/node_parameters.hpp"

namespace mpm_ros {
namespace parameter_text_test {

using List = std::vector<std::string>;

// Each as one override that run_scene --set takes.
TEST(ParameterText, OneChangeOfTheSceneIsTakenAsItStands) {
  for (const char* text :
       {"gravity=[0, 0, -1.62]", "materials.foam.young=20 kPa", "bodies.block.initial={velocity: [0, 0, 1]}",
        "time.end=0.5", "output.global=[kinetic energy]",
        "rigid_bodies.blade.motion.velocity=t == 1 ? 2 : min(1, 3 * t)", R"(bodies.0.name="a, b=c d")",
        "rigid_bodies.blade.shape={box: {size: [1, 2, 3]}}"}) {
    EXPECT_EQ(overrides_in(text), List{text});
    EXPECT_EQ(overrides_in(std::string(" '") + text + "' "), List{text});
  }
}

TEST(ParameterText, SeveralChangesAreAListWithOrWithoutBracketsAndQuotes) {
  const List expected{"time.end=0.01", "gravity=[0, 0, -1.62]", "materials.foam.young=20 kPa"};
  for (const char* text : {R"(["time.end=0.01", "gravity=[0, 0, -1.62]", "materials.foam.young=20 kPa"])",
                           "['time.end=0.01', 'gravity=[0, 0, -1.62]', 'materials.foam.young=20 kPa']",
                           "[time.end=0.01, gravity=[0, 0, -1.62], materials.foam.young=20 kPa]",
                           "time.end=0.01,gravity=[0, 0, -1.62],materials.foam.young=20 kPa",
                           "time.end=0.01 gravity=[0, 0, -1.62] materials.foam.young=20 kPa",
                           R"("time.end=0.01", "gravity=[0, 0, -1.62]", "materials.foam.young=20 kPa",)"}) {
    EXPECT_EQ(overrides_in(text), expected) << text;
  }
  EXPECT_EQ(overrides_in("[a.b=[1, 2], c=[3]]"), (List{"a.b=[1, 2]", "c=[3]"}));
  EXPECT_EQ(overrides_in("[1, 2]"), (List{"1", "2"}));  // refused by name where they are applied
  EXPECT_TRUE(overrides_in("[]").empty());
  EXPECT_TRUE(overrides_in("").empty());
}

TEST(ParameterText, WordsAndNumbers) {
  EXPECT_EQ(words_in("[vx, szz]"), (List{"vx", "szz"}));
  EXPECT_EQ(words_in("vx szz"), (List{"vx", "szz"}));
  EXPECT_EQ(words_in("['vx']"), List{"vx"});
  EXPECT_EQ(number_in("1e-1"), 0.1);
  EXPECT_EQ(number_in(" +2E3 "), 2000.0);
  for (const char* text : {"", "1e", "0x10", "1,5", "1 m", "--1"}) EXPECT_FALSE(number_in(text)) << text;
}

NodeParameters with(const std::string& name, const XmlRpc::XmlRpcValue& value) {
  std::vector<std::string> warnings;
  return read_parameters({{"scene", XmlRpc::XmlRpcValue("press")}, {name, value}}, warnings);
}

// YAML 1.1, by which launch files are read, takes 1e-1 for text.
TEST(ParameterText, TextCountsAsTheNumberTheTruthOrTheListThatItSays) {
  EXPECT_EQ(with("command_timeout", "1e-1").command_timeout, 0.1);
  EXPECT_EQ(with("particle_rate", "2e1").particle_rate, 20.0);
  EXPECT_EQ(with("threads", "3").threads, 3);
  EXPECT_EQ(with("threads", 1e0).threads, 1);  // value that roscpp makes of 1e0 on a command line
  EXPECT_TRUE(with("start_paused", "True").start_paused);
  EXPECT_EQ(with("set", "gravity=[0, 0, -1.62]").set, List{"gravity=[0, 0, -1.62]"});
  const mpm::Box box{{0.0, -1.0, 0.0}, {1.0, 1.0, 0.1}};
  XmlRpc::XmlRpcValue list;
  const char* corners[] = {"0", "-1", "0", "1", "1", "1e-1"};
  for (int i = 0; i < 6; ++i) list[i] = corners[i];
  for (const XmlRpc::XmlRpcValue& value : {XmlRpc::XmlRpcValue("[0, -1, 0, 1, 1, 1e-1]"), list}) {
    const std::optional<mpm::Box> region = with("particle_region", value).particle_region;
    ASSERT_TRUE(region);
    EXPECT_EQ(region->min, box.min);
    EXPECT_EQ(region->max, box.max);
  }
  EXPECT_THROW(with("threads", "1.5"), ParameterError);
  EXPECT_THROW(with("start_paused", "yess"), ParameterError);
  EXPECT_THROW(with("diagnostic_period", "1e0"), ParameterError);  // text that another library reads, as 1 s
}

}  // namespace parameter_text_test
}  // namespace mpm_ros
