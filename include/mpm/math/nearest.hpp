// Finds the known word that is nearest to an unknown one, for helpful error messages.
#pragma once

#include <string>
#include <vector>

namespace mpm {

/// Least number of letters inserted, deleted, replaced or swapped with a neighbour that turn one word into the other.
int edit_distance(const std::string& a, const std::string& b);
/// The candidate nearest to `word`, or "" when none is near enough to be meant.
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);
/// "did you mean 'method'?", or "known here: a, b, c" when nothing is near.
std::string suggest(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace mpm
