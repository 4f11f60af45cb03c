// rosrun mpm_ros bag_report F.bag [--csv DIR] [--plots DIR] [--check]
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "mpm_ros/report/report.hpp"

int main(int argc, char** argv) {
  mpm_ros::ReportOptions options;
  CLI::App app("Tables, CSV files, pictures and checks of a run that the simulator or run_scene recorded.");
  app.add_option("bag", options.bag, "the bag")->required();
  app.add_option("--csv", options.csv, "write the tables as CSV files, with units in their headers, to this folder");
  app.add_option("--plots", options.plots, "draw pictures (PNG) to this folder");
  app.add_option("--snapshots", options.snapshots, "write at most so many particle snapshots")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{1}, std::size_t{10000}));
  app.add_option("--field", options.field, "particle field that colours the pictures");
  app.add_option("--namespace", options.name_space, "of the topics, when the bag holds several runs");
  app.add_flag("--check", options.check,
               "check the run: audit, energy, gaps in time, impulses; exit code 3 on failure");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    return mpm_ros::report(options, std::cout) ? 0 : 3;
  } catch (const std::exception& error) {
    std::cerr << "bag_report: " << error.what() << "\n";
    return 2;
  }
}
