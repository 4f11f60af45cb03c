#include "mpm_ros/node/height_maps.hpp"

#include <fmt/format.h>
#include <mpm_ros/HeightMap.h>
#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/subscriber.h>

#include <cstdio>

#include "mpm/simulation/simulation.hpp"
#include "mpm/terrain/height_topic.hpp"
#include "mpm_ros/message/height_map.hpp"
#include "mpm_ros/run/stop_signals.hpp"

namespace mpm_ros {

HeightMaps wait_for_height_maps(const ros::NodeHandle& node, const std::string& scene,
                                const std::vector<std::string>& set, const std::string& world_frame) {
  constexpr double kLook = 0.05;  // [s] between looks whether a stop is asked for
  HeightMaps maps;
  maps.set = set;
  for (const mpm::HeightTopic& field : mpm::height_topics(scene, set)) {
    ros::CallbackQueue queue;  // queue of its own: nothing else spins yet
    ros::NodeHandle listening(node);
    listening.setCallbackQueue(&queue);
    HeightMap::ConstPtr message;
    const ros::Subscriber subscriber = listening.subscribe<HeightMap>(
        field.topic, 1, [&message](const HeightMap::ConstPtr& received) { message = received; });
    const std::string topic = subscriber.getTopic();
    ROS_INFO_STREAM("waits for the heights of '" << field.body << "' on " << topic
                                                 << " (mpm_ros/HeightMap, latched) before it starts");
    std::fflush(stdout);  // a pipe would keep it meanwhile
    while (!message) {
      if (stop_requested() || !ros::ok())
        throw mpm::StoppedError(fmt::format("stopped while waiting for the heights of '{}' on {}", field.body, topic));
      queue.callAvailable(ros::WallDuration(kLook));
    }
    maps.set.push_back(mpm::heights_override(field, height_grid(*message, topic, world_frame)));
    maps.from.emplace_back(field.body, topic);
  }
  return maps;
}

}  // namespace mpm_ros
