#include "mpm_ros/message/run_namespaces.hpp"

#include <fmt/format.h>
#include <mpm_ros/RunInfo.h>
#include <ros/master.h>

#include <algorithm>
#include <stdexcept>

#include "mpm_ros/message/topics.hpp"

namespace mpm_ros {

std::vector<std::string> run_namespaces(const std::vector<std::pair<std::string, std::string>>& topics) {
  const std::string leaf = std::string("/") + topics::kRunInfo;
  std::vector<std::string> found;
  for (const auto& [name, type] : topics) {
    if (type != ros::message_traits::datatype<RunInfo>() || name.size() < leaf.size()) continue;
    const std::size_t end = name.size() - leaf.size();
    if (name.compare(end, leaf.size(), leaf) == 0) found.push_back(end == 0 ? "/" : name.substr(0, end));
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::string> running_namespaces() {
  if (!ros::master::check()) {
    throw std::runtime_error(
        fmt::format("no master answers at {}; start roscore, or a launch file", ros::master::getURI()));
  }
  ros::master::V_TopicInfo infos;
  ros::master::getTopics(infos);
  std::vector<std::pair<std::string, std::string>> topics;
  for (const ros::master::TopicInfo& info : infos) topics.emplace_back(info.name, info.datatype);
  return run_namespaces(topics);
}

}  // namespace mpm_ros
