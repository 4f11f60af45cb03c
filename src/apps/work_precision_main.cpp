// rosrun mpm_ros work_precision [--quick | --full] [--suite S]… [--method M]… [--out DIR]: measures error against cost
// of every method. `--suite tool_force` is a suite of its own, of forces on tools, with --problem, --cells, --vary and
// --set. Wiring only; see benchmark/study/work_precision.hpp and benchmark/study/tool_force/run.hpp.
//
// Exit codes: 0 done, 2 bad input.
#include <CLI/CLI.hpp>
#include <iostream>

#include "mpm_ranks/make_ranks.hpp"
#include "mpm_ros/report/report_plots.hpp"
#include "mpm_ros/run/stop_signals.hpp"
#include "study/suite.hpp"
#include "study/tool_force/run.hpp"
#include "study/work_precision.hpp"

namespace {

std::string suites_text() {
  std::string names;
  for (const mpm::study::Suite& suite : mpm::study::suites()) names += suite.name + ", ";
  return "run only this problem: " + names + "or tool_force, alone; may be repeated";
}

}  // namespace

int main(int argc, char** argv) {
  mpm_ros::ignore_file_limit();
  mpm::study::StudyOptions options;
  options.folder = "work_precision";
  bool quick = false, charts = true;
  CLI::App app("Runs every method on problems with known answers, and charts error against cost.");
  auto* short_run = app.add_flag("--quick", quick, "some minutes; the default");
  app.add_flag("--full", options.full, "finer grids, every method on every problem, longer timing; an hour or more")
      ->excludes(short_run);
  app.add_option("--suite", options.suites, suites_text());
  app.add_option("--method", options.methods, "run only this method, such as cpdi/usavg/flip; may be repeated");
  app.add_option("--out", options.folder, "folder for work_precision.csv, summary.csv and the charts");
  app.add_flag("!--no-charts", charts, "tables only");
  mpm::study::tool_force::ForceOptions force;
  app.add_option("--problem", force.problems, "tool_force: run only this problem; may be repeated");
  app.add_option("--cells", force.cells, "tool_force: run with these numbers of cells, such as 4,8")->delimiter(',');
  app.add_option("--vary", force.vary,
                 "tool_force: run with each of these values, such as contact.method=points|nodes; all combinations of "
                 "several")
      ->allow_extra_args(false);
  app.add_option("--set", force.set, "tool_force: change the scenes, as run_scene does; may be repeated")
      ->allow_extra_args(false);
  app.add_flag("--places", force.places,
               "tool_force: the mean and the spread of five places within a cell for each row");
  app.add_flag("--scenes", force.only_write, "tool_force: write the scenes to the folder of --out and run none");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    mpm::refuse_ranks("a study");
    const auto tell = [](const std::string& line) { std::cout << line << std::endl; };
    if (options.suites == std::vector<std::string>{"tool_force"}) {
      force.full = options.full;
      force.folder = options.folder;
      mpm::study::tool_force::run_tool_force(force, tell);
      return 0;
    }
    mpm::study::run_study(options, tell);
    if (charts) mpm_ros::make_work_precision_plots(options.folder);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "work_precision: " << error.what() << "\n";
    return 2;
  }
}
