// A message as a list of named numbers and words, for comparing two of them field by field.
#pragma once

#include <mpm_ros/BodyStates.h>
#include <mpm_ros/Command.h>
#include <mpm_ros/ContactForces.h>
#include <mpm_ros/Cracks.h>
#include <mpm_ros/GlobalQuantities.h>
#include <mpm_ros/RobotStates.h>
#include <mpm_ros/SolverState.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace mpm_ros {

/// One value of a message.
struct ComparedValue {
  std::string field;    ///< "blade force x"
  std::string kind;     ///< kind that it is measured with: "blade force" of each component
  double number = 0.0;  ///< value of a number
  std::string word;     ///< value of a word
};

/// All values but header, stamps, and what the wall clock makes, in a fixed order.
std::vector<ComparedValue> values_of(const ContactForces& message);
std::vector<ComparedValue> values_of(const BodyStates& message);
std::vector<ComparedValue> values_of(const SolverState& message);
std::vector<ComparedValue> values_of(const Command& message);
std::vector<ComparedValue> values_of(const GlobalQuantities& message);
std::vector<ComparedValue> values_of(const Cracks& message);
std::vector<ComparedValue> values_of(const RobotStates& message);

}  // namespace mpm_ros
