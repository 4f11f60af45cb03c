#include "mpm_ros/report/report.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>

#include "mpm/math/files_in_use.hpp"
#include "mpm/math/json_text.hpp"
#include "mpm/math/output_file.hpp"
#include "mpm_ros/message/files_of_run.hpp"
#include "mpm_ros/message/progress_bar.hpp"
#include "mpm_ros/report/recorded_run.hpp"
#include "mpm_ros/report/report_animation.hpp"
#include "mpm_ros/report/report_bag.hpp"
#include "mpm_ros/report/report_compare.hpp"
#include "mpm_ros/report/report_csv.hpp"
#include "mpm_ros/report/report_error.hpp"
#include "mpm_ros/report/report_json.hpp"
#include "mpm_ros/report/report_momentum.hpp"
#include "mpm_ros/report/report_plots.hpp"
#include "mpm_ros/report/report_same.hpp"
#include "mpm_ros/report/report_sweep.hpp"
#include "mpm_ros/report/report_tables.hpp"
#include "mpm_ros/sweep/study.hpp"

namespace mpm_ros {
namespace {

namespace fs = std::filesystem;

/// Pictures show the first, a middle, the last snapshot and that of the largest force.
constexpr std::size_t kSnapshotsOfPlots = 4;
/// Beside the tables, for the script that draws them.
constexpr const char* kFigures = "run.json";
constexpr const char* kStandardOutput = "-";

/// Told to stop, as by Ctrl-C.
class Stopped : public ReportError {
 public:
  Stopped() : ReportError("stopped") {}
};

/// Told before hours of reading, not after. Nothing is made yet: a report that fails leaves nothing behind.
void check_folder(const std::string& option, const fs::path& folder) {
  std::error_code error;
  fs::path there = fs::absolute(folder);
  while (!fs::exists(there, error) && there != there.root_path()) there = there.parent_path();
  if (!fs::is_directory(there, error) || access(there.c_str(), W_OK) != 0) {
    throw ReportError(fmt::format("{} {}: the folder cannot be written; choose another, or change its permissions",
                                  option, folder.string()));
  }
}

/// A recording must not be lost to a forgotten word: `--json A.bag B.bag`.
void check_file(const std::string& option, const std::string& path) {
  std::error_code error;
  if (is_bag(path)) throw ReportError(fmt::format("{} {}: is a bag; name a file for the figures", option, path));
  const fs::path folder = fs::absolute(path).parent_path();
  const bool there = fs::exists(path, error);
  if (fs::is_directory(path, error) || access(there ? path.c_str() : folder.c_str(), W_OK) != 0 ||
      !fs::is_directory(folder, error)) {
    throw ReportError(fmt::format("{} {}: cannot be written; check that the folder is there", option, path));
  }
}

void write_json(std::ostream& out, const nlohmann::ordered_json& json, const std::string& path) {
  out << mpm::json_text(json, 2) << std::endl;
  if (!out) throw ReportError(path + ": cannot be written; check the folder and the space on its disk");
}

void write_json(const std::string& path, const nlohmann::ordered_json& json) {
  write_whole(path, mpm::json_text(json, 2) + "\n");
}

/// Refuses a place in a sweep's folder, where its runs and what they are made of lie.
void check_outside(const Study& study, const std::string& option, const std::string& path) {
  if (path.empty() || path == kStandardOutput) return;
  const std::string file = mpm::behind_links(path), runs = mpm::behind_links(study.folder() + "/runs");
  for (const std::string& kept : {study.plan(), study.scene(), study.lock()}) {
    if (mpm::behind_links(kept) == file)
      throw ReportError(fmt::format("{} {}: is a file of the sweep; choose another name", option, path));
  }
  if (file == runs || file.compare(0, runs.size() + 1, runs + "/") == 0)
    throw ReportError(fmt::format("{} {}: lies among the runs of the sweep; choose another folder", option, path));
}

/// No output over a bag, or over another output.
void check_outputs(const ReportOptions& options) {
  if (is_study(options.bags.front())) {
    const Study study(options.bags.front());
    for (const auto& [option, path] :
         {std::pair("--json", options.json), {"--csv", options.csv}, {"--plots", options.plots}}) {
      check_outside(study, option, path);
    }
    return;
  }
  mpm::FilesInUse files;
  for (const std::string& bag : options.bags) reads_bag("the bag", bag, files);
  if (options.json != kStandardOutput) files.writes("--json", options.json);
  files.writes("--animate", options.animate);
  const std::string tables = fmt::format("{}|{}", kCsvFiles, kFigures);
  if (!options.csv.empty() && options.bags.size() > 1) {
    for (const std::string& label : labels_of(options.bags))
      files.writes_into("--csv", options.csv + "/" + label, tables);
  } else {
    files.writes_into("--csv", options.csv, tables);
  }
  files.writes_into("--plots", options.plots, ".*\\.png");
}

void check_options(const ReportOptions& options) {
  if (options.bags.empty()) throw ReportError("give a bag");
  if (options.same && options.bags.size() != 2) {
    throw ReportError(fmt::format("--same compares two bags, {} given; of a recording in parts, give the first part",
                                  options.bags.size()));
  }
  if (options.tolerance && !options.same) throw ReportError("--tolerance belongs to --same; give both");
  if (options.tolerance && !(*options.tolerance >= 0.0)) throw ReportError("--tolerance: must be 0 or more");
  if (!options.csv.empty()) check_folder("--csv", options.csv);
  if (!options.plots.empty()) check_folder("--plots", options.plots);
  if (!options.json.empty() && options.json != kStandardOutput) check_file("--json", options.json);
  check_outputs(options);
  if (options.animate.empty()) return;
  if (options.bags.size() > 1) throw ReportError("--animate: shows one run; give one bag");
  const fs::path file(options.animate);
  if (file.extension() != ".mp4" && file.extension() != ".gif") {
    throw ReportError(fmt::format("--animate {}: neither .mp4 nor .gif; name the file so", options.animate));
  }
  check_folder("--animate", fs::absolute(file).parent_path());
}

/// Reads one bag after the other, and writes the files of each.
class Reader {
 public:
  Reader(const ReportOptions& options, std::ostream& err, bool bar) : options_(options), err_(err), bar_(bar) {}

  RecordedRun read(const std::string& path, const std::string& label) {
    RunBag bag(path, options_.name_space);
    const bool particles = !bag.particle_fields().empty();
    const bool pictures = !options_.plots.empty() || !options_.animate.empty();
    std::string field;
    if (pictures && particles) field = choose_field(bag.particle_fields(), options_.field);
    if (!options_.animate.empty() && !particles) {
      throw ReportError(
          fmt::format("--animate: {} holds no particle snapshot; record {}/particles", path, bag.name_space()));
    }

    RecordedRun run;
    run.path = path;
    run.label = label;
    run.name_space = bag.name_space();
    run.info = bag.info();
    if (run.info) run.scene = scene_facts(*run.info);
    run.particle_fields = bag.particle_fields();

    RunChecks checks(run.info ? run.info->sync_period : 0.0, run.scene.precision, bag.missing(),
                     run.scene.axisymmetric);
    std::vector<RunVisitor*> visitors = {&run.statistics, &checks};
    std::optional<MomentumCheck> momentum;
    if (options_.check) visitors.push_back(&momentum.emplace(run.info));
    std::optional<FieldRange> range;
    if (!options_.animate.empty()) visitors.push_back(&range.emplace(field));
    const std::string folder = folder_of(label);
    std::optional<CsvExport> csv;
    if (!folder.empty()) visitors.push_back(&csv.emplace(folder, run.scene.axisymmetric));

    with_bar(label, [&](const Reading& reading) { bag.read(visitors, reading); });
    if (!run.statistics.first_state()) throw BagError(path + ": the run has no message; was it stopped at its start?");
    run.gaps = checks.gaps();
    run.notes = notes_on(run, bag.cut_short());
    if (options_.check) {
      run.checks = checks.results();
      run.checks.push_back(momentum->result());
    }
    if (csv) {
      csv->close();
      write_snapshots(bag, run, folder);
      write_json(folder + "/" + kFigures, report_json(run));
      folders_.push_back(folder);
    }
    if (range) animate(bag, run, *range, folder);
    return run;
  }

  /// Folders of the tables, one a bag; empty when none were written.
  const std::vector<std::string>& folders() const { return folders_; }

 private:
  /// Folder for the tables of a bag; empty: nowhere.
  std::string folder_of(const std::string& label) {
    if (!options_.csv.empty()) return options_.bags.size() == 1 ? options_.csv : options_.csv + "/" + label;
    if (options_.plots.empty() && options_.animate.empty()) return {};
    if (!temporary_) temporary_ = std::make_unique<TemporaryFolder>();
    return temporary_->file(label);
  }

  void write_snapshots(RunBag& bag, const RecordedRun& run, const std::string& folder) {
    const bool compared = options_.bags.size() > 1;
    std::size_t most = options_.snapshots;
    if (options_.csv.empty()) most = compared || options_.plots.empty() ? 0 : kSnapshotsOfPlots;
    if (most == 0) return;
    SnapshotExport snapshots(folder);
    const RunStatistics& statistics = run.statistics;
    const std::set<std::size_t> chosen = choose_snapshots(statistics.snapshots(), most, statistics.peak_time());
    with_bar(run.label + ", snapshots",
             [&](const Reading& reading) { bag.read_snapshots(chosen, snapshots, reading); });
    snapshots.close();
  }

  void animate(RunBag& bag, const RecordedRun& run, const FieldRange& range, const std::string& folder) {
    const std::set<std::size_t> frames = choose_snapshots(run.statistics.snapshots(), options_.frames, std::nullopt);
    fs::create_directories(fs::absolute(options_.animate).parent_path());
    Animation animation(folder, options_.animate, range, frames.size());
    with_bar(run.label + ", animation",
             [&](const Reading& reading) { bag.read_snapshots(frames, animation, reading); });
    animation.close();
  }

  void with_bar(const std::string& what, const std::function<void(const Reading&)>& work) {
    ProgressBar bar(err_, bar_);
    work([&](double part) {
      if (options_.stop_requested && options_.stop_requested()) throw Stopped();
      bar.show(part, [&what] { return what; });
    });
    bar.clear();
  }

  const ReportOptions& options_;
  std::ostream& err_;
  bool bar_;
  std::unique_ptr<TemporaryFolder> temporary_;
  std::vector<std::string> folders_;
};

bool passed(const RecordedRun& run) {
  return std::all_of(run.checks.begin(), run.checks.end(), [](const CheckResult& check) { return check.passed; });
}

void print(const std::vector<RecordedRun>& runs, std::ostream& out) {
  out << (runs.size() == 1 ? tables(runs.front()) : comparison(runs));
  for (const RecordedRun& run : runs) {
    if (run.checks.empty()) continue;
    out << "\n";
    if (runs.size() > 1) out << "Checks of " << run.label << "\n";
    out << check_lines(run.checks);
  }
}

}  // namespace

bool report(const ReportOptions& options, std::ostream& out, std::ostream& err, bool bar) {
  check_options(options);
  if (is_study(options.bags.front())) return report_sweep(options, out);
  if (options.same) {
    RunBag a(options.bags[0], options.name_space), b(options.bags[1], options.name_space);
    return same_runs(a, b, options.tolerance, out);
  }
  const bool only_json = options.json == kStandardOutput;
  const std::vector<std::string> labels = labels_of(options.bags);
  Reader reader(options, err, bar);
  std::vector<RecordedRun> runs;
  for (std::size_t i = 0; i < options.bags.size(); ++i) runs.push_back(reader.read(options.bags[i], labels[i]));

  if (only_json) {
    write_json(out, report_json(runs), "--json");
  } else {
    print(runs, out);
    if (!options.json.empty()) write_json(options.json, report_json(runs));
    if (!options.csv.empty()) out << "\ntables    " << options.csv << "\n";
  }
  if (!options.plots.empty()) {
    make_plots({reader.folders(), options.plots, options.field});
    if (!only_json) out << "pictures  " << options.plots << "\n";
  }
  return std::all_of(runs.begin(), runs.end(), passed);
}

ReportResult run_report(const ReportOptions& options, std::ostream& out, std::ostream& err, bool bar) {
  try {
    return report(options, out, err, bar) ? ReportResult::done : ReportResult::check_failed;
  } catch (const std::exception& error) {
    // A script that was stopped with us has failed, too: that is not what there is to tell.
    if (options.stop_requested && options.stop_requested()) {
      err << "bag_report: stopped\n";
      return ReportResult::stopped;
    }
    err << "bag_report: " << error.what() << "\n";
    return ReportResult::bad_input;
  }
}

}  // namespace mpm_ros
