// The figures of the tables as JSON, for scripts. doc/analysis.md lists the keys; units are SI.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "mpm_ros/report/recorded_run.hpp"

namespace mpm_ros {

/// Counts up when a key changes its meaning or goes away.
constexpr int kReportSchema = 1;

/// One run; begins with "schema". What is not finite is null.
nlohmann::ordered_json report_json(const RecordedRun& run);
/// One run as above; several as {"schema": …, "runs": [ … ]}.
nlohmann::ordered_json report_json(const std::vector<RecordedRun>& runs);

/// Its `size`, `time` [s] and `vector`.
nlohmann::ordered_json json_of(const Extreme& value);

}  // namespace mpm_ros
