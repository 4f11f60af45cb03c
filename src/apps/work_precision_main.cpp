// rosrun mpm_ros work_precision [--quick | --full] [--suite S]… [--method M]… [--out DIR]: measures error against cost
// of every method. Wiring only; see mpm/study/work_precision.hpp.
//
// Exit codes: 0 done, 2 bad input.
#include <CLI/CLI.hpp>
#include <iostream>

#include "mpm/study/work_precision.hpp"
#include "mpm_ros/report/report_plots.hpp"

int main(int argc, char** argv) {
  mpm::study::StudyOptions options;
  options.folder = "work_precision";
  bool quick = false, charts = true;
  CLI::App app("Runs every method on problems with known answers, and charts error against cost.");
  auto* short_run = app.add_flag("--quick", quick, "some minutes; the default");
  app.add_flag("--full", options.full, "finer grids, every method on every problem, longer timing; an hour or more")
      ->excludes(short_run);
  app.add_option("--suite", options.suites, "run only this problem; may be repeated");
  app.add_option("--method", options.methods, "run only this method, such as cpdi/usavg/flip; may be repeated");
  app.add_option("--out", options.folder, "folder for work_precision.csv, summary.csv and the charts");
  app.add_flag("!--no-charts", charts, "tables only");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    mpm::study::run_study(options, [](const std::string& line) { std::cout << line << std::endl; });
    if (charts) mpm_ros::make_work_precision_plots(options.folder);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "work_precision: " << error.what() << "\n";
    return 2;
  }
}
