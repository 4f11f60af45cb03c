// The name that a misspelt one was meant for.
#pragma once

#include <string>
#include <vector>

namespace mpm_ros {

/// The known name with the smallest edit distance to `name`; empty when there is none at all.
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);
/// "; did you mean 'blade'?", or empty when nothing is known.
std::string did_you_mean(const std::string& name, const std::vector<std::string>& known);

}  // namespace mpm_ros
