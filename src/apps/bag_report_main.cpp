// rosrun mpm_ros bag_report F.bag... [--csv DIR] [--json F] [--plots DIR] [--animate F.mp4] [--check]
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <iostream>

#include "mpm_ros/report/report.hpp"
#include "mpm_ros/run/stop_signals.hpp"

namespace {

volatile std::sig_atomic_t stop_signal = 0;

void on_signal(int signal) { stop_signal = signal; }

}  // namespace

int main(int argc, char** argv) {
  mpm_ros::ReportOptions options;
  CLI::App app(
      "Tables, CSV files, JSON, pictures, an animation and checks of runs that the simulator or run_scene recorded.");
  app.add_option("bag", options.bags, "the bag; several bags are compared side by side; or the folder of a sweep")
      ->required();
  app.add_option("--csv", options.csv, "write the tables as CSV files, with units in their headers, to this folder");
  app.add_option("--json", options.json, "write the figures of the tables to this file; -: to standard output alone");
  app.add_option("--plots", options.plots, "draw pictures (PNG) to this folder");
  app.add_option("--animate", options.animate, "draw the particles in motion to this file, .mp4 (by ffmpeg) or .gif");
  app.add_option("--snapshots", options.snapshots, "largest number of particle snapshots to write as CSV")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{1}, std::size_t{10000}));
  app.add_option("--frames", options.frames, "largest number of frames of the animation")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{2}, std::size_t{10000}));
  app.add_option("--field", options.field, "particle field that colours the pictures");
  app.add_option("--namespace", options.name_space, "namespace of the topics, for a bag with several runs");
  app.add_flag("--check", options.check,
               "check the run: audit, energy, gaps in time, impulses; exit code 3 on failure");
  app.add_flag("--same", options.same,
               "compare two bags to the bit and report the first difference; exit code 3 if there is one");
  app.add_option("--tolerance", options.tolerance,
                 "for --same: largest difference of numbers, relative to their largest magnitude");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  // Temporary files are removed before the program ends.
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  mpm_ros::ignore_file_limit();
  options.stop_requested = [] { return stop_signal != 0; };
  const mpm_ros::ReportResult result = mpm_ros::run_report(options, std::cout, std::cerr, isatty(STDERR_FILENO) != 0);
  if (result == mpm_ros::ReportResult::stopped) {
    std::signal(stop_signal, SIG_DFL);
    std::raise(stop_signal);
  }
  return static_cast<int>(result);
}
