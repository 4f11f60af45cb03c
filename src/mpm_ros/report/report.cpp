#include "mpm_ros/report/report.hpp"

#include <algorithm>
#include <optional>
#include <ostream>
#include <vector>

#include "mpm_ros/report/report_bag.hpp"
#include "mpm_ros/report/report_check.hpp"
#include "mpm_ros/report/report_csv.hpp"
#include "mpm_ros/report/report_plots.hpp"
#include "mpm_ros/report/report_statistics.hpp"
#include "mpm_ros/report/report_tables.hpp"

namespace mpm_ros {
namespace {

/// Pictures show the first, a middle, the last snapshot and that of the largest force.
constexpr std::size_t kSnapshotsOfPlots = 4;

}  // namespace

bool report(const ReportOptions& options, std::ostream& out) {
  RunBag bag(options.bag, options.name_space);
  RunStatistics statistics;
  RunChecks checks(bag.info() ? bag.info()->sync_period : 0.0, bag.missing());
  std::vector<RunVisitor*> visitors = {&statistics, &checks};

  std::optional<TemporaryFolder> temporary;
  std::string folder = options.csv;
  if (folder.empty() && !options.plots.empty()) folder = temporary.emplace().path();
  std::optional<CsvExport> csv;
  if (!folder.empty()) visitors.push_back(&csv.emplace(folder));

  bag.read(visitors);
  if (!statistics.first_state()) throw BagError(options.bag + ": the run has no message; was it stopped at its start?");
  out << tables(bag, statistics, checks.gaps());
  const std::vector<CheckResult> results = checks.results();
  if (options.check) out << "\n" << check_lines(results);

  if (csv) {
    csv->close();
    const std::size_t most = options.csv.empty() ? kSnapshotsOfPlots : options.snapshots;
    SnapshotExport snapshots(folder);
    bag.read_snapshots(choose_snapshots(statistics.snapshots(), most, statistics.peak_time()), snapshots);
    snapshots.close();
    if (!options.csv.empty()) out << "\ntables    " << folder << "\n";
  }
  if (!options.plots.empty()) {
    make_plots({folder, options.plots, bag.info() ? bag.info()->scene : "", options.field});
    out << "pictures  " << options.plots << "\n";
  }
  const auto passed = [](const CheckResult& result) { return result.passed; };
  return !options.check || std::all_of(results.begin(), results.end(), passed);
}

}  // namespace mpm_ros
