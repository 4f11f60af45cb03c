// Namespaces that have a run: the topic run_info says so, of a simulator as of a bag that is played.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace mpm_ros {

/// Namespaces of the topics run_info among `topics` (name and type), sorted: "/mpm", and "/" for the root.
std::vector<std::string> run_namespaces(const std::vector<std::pair<std::string, std::string>>& topics);

/// The same of all topics that the master knows. @throws std::runtime_error when no master answers
std::vector<std::string> running_namespaces();

}  // namespace mpm_ros
