// Parameters as text: rosrun and roslaunch hand on as text whatever is neither a number, nor true or false, to them, so
// lists, and numbers such as 1e-1 in a launch file, arrive as text. These functions read what is meant.
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <optional>
#include <string>
#include <vector>

namespace mpm_ros {

/// The number that the whole text is: "1e-1". None for any other text.
std::optional<double> number_in(const std::string& text);
/// A number, or a text that is one.
std::optional<double> number_of(const XmlRpc::XmlRpcValue& value);
/// true or false, or a text that says so, in letters of either case.
std::optional<bool> truth_of(const XmlRpc::XmlRpcValue& value);

/// The words between commas and blanks, with or without brackets around them: "[vx, j]".
std::vector<std::string> words_in(const std::string& text);
/// Changes to a scene: one, as run_scene --set takes it ("gravity=[0, 0, -1.62]"), several with commas or blanks
/// between them, or a list of them, each with or without quotes ("['time.end=0.5', 'gravity=[0, 0, -1.62]']"). Commas
/// and blanks within brackets and quotes belong to a value, and so does a blank or comma that no further "key.path="
/// follows.
std::vector<std::string> overrides_in(const std::string& text);

}  // namespace mpm_ros
