// From the messages of a run back to the library's plain values; conversions.hpp has the other direction.
#pragma once

#include <mpm_ros/BodyStates.h>
#include <mpm_ros/Command.h>

#include <cstdint>
#include <string>
#include <vector>

#include "mpm/definition/report.hpp"
#include "mpm_ros/csv/csv_tables.hpp"

namespace mpm_ros {

std::vector<mpm::BodyState> body_states_of(const BodyStates& message);
/// "velocity", "pose" or "wrench".
std::string command_kind_name(std::uint8_t kind);
/// `time` [ns] since the start.
CommandRow command_row_of(std::int64_t time, const Command& message);

}  // namespace mpm_ros
