#include "mpm_ros/run/run_scene.hpp"

#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "mpm/scene/explain.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/scene/units.hpp"
#include "mpm_ros/message/progress_bar.hpp"
#include "mpm_ros/run/run.hpp"
#include "mpm_ros/run/run_scene_checkpoint.hpp"
#include "mpm_ros/run/run_scene_csv.hpp"
#include "mpm_ros/run/run_scene_summary.hpp"

namespace mpm_ros {
namespace {

/// @throws mpm::SceneError that names the option
mpm::Isa instruction_set(const RunSceneOptions& options) {
  try {
    return mpm::choose_isa(options.isa);
  } catch (const mpm::IsaError& error) {
    throw mpm::SceneError(fmt::format("--isa: {}", error.what()));
  }
}

/// Before the summary is opened: what is refused here leaves that of an earlier run as it is.
mpm::Scene load(const RunSceneOptions& options) {
  instruction_set(options);
  mpm::Scene scene = scene_of(options);
  if (options.end.empty()) return scene;
  // The sync and output periods stay the scene's: a shorter run is the beginning of the longer one, bit for bit.
  double end = 0.0;
  try {
    end = mpm::parse_quantity(options.end, mpm::kTime);
  } catch (const mpm::UnitError& error) {
    throw mpm::SceneError(fmt::format("--end: {}", error.what()));
  }
  if (!(end > 0.0))
    throw mpm::SceneError(fmt::format("--end: '{}' is not greater than 0; write a time such as 0.5", options.end));
  scene.definition.time.end = end;
  return scene;
}

/// Opened before the run: a path that cannot be written is told before hours of work.
std::ofstream open_summary(const std::string& path) {
  std::ofstream file;
  if (path.empty()) return file;
  file.open(path);
  if (!file)
    throw mpm::SceneError(fmt::format("--summary {}: cannot be written; check that the folder is there", path));
  return file;
}

void check_fields(const OutputOptions& output) {
  const std::string problem = problem_of(output.particles);
  if (!problem.empty()) throw mpm::SceneError(fmt::format("output: {}", problem));
}

/// The run with its sinks, from beginning to end.
class OfflineRun {
 public:
  explicit OfflineRun(const RunSceneOptions& options)
      : scene_(load(options)),
        checkpoints_(options, scene_.definition.time.sync),
        summary_(open_summary(options.summary)) {
    if (!(scene_.definition.time.end > 0.0)) {
      throw mpm::SceneError(
          fmt::format("{}: time.end: the scene has no end; give one with --end, or --set time.end=2", scene_.path));
    }
    RunOptions run_options;
    run_options.threads = options.threads;
    run_options.isa = options.isa;
    run_options.output = output_options(scene_);
    check_fields(run_options.output);
    if (!options.bag.empty()) run_options.bag = bag_path(options.bag, scene_.definition.name, 1);
    if (!options.end.empty()) run_options.parameters = fmt::format("end: {:.17g}\n", scene_.definition.time.end);
    if (!options.resume.empty()) resume_from(options.resume, run_options);
    if (!options.csv.empty())
      csv_ = std::make_unique<CsvSink>(options.csv, stamps_, mpm::axisymmetric(scene_.definition.geometry));
    run_ = std::make_unique<Run>(scene_, run_options, stamps_, csv_.get());
  }

  RunSceneResult go(std::ostream& out, std::ostream& err, bool bar, const std::function<bool()>& stop_requested) {
    const mpm::Simulation& simulation = run_->simulation();
    for (const std::string& warning : simulation.warnings()) err << "warning: " << warning << "\n";
    for (const std::string& note : simulation.notes()) err << note << "\n";
    const mpm::EnergyReport start_energy = simulation.state().energy;
    ProgressBar progress(err, bar);
    const double end = static_cast<double>(run_->end());
    const auto where = [&] {
      return fmt::format("t = {:.4g} of {:.4g} s", static_cast<double>(simulation.time()) / 1e9, end / 1e9);
    };
    RunSceneResult result = RunSceneResult::done;
    try {
      run_->begin();
      while (!run_->ended() && !stop_requested()) {
        run_->advance();
        checkpoints_.at_sync(*run_, err);
        progress.show(static_cast<double>(simulation.time()) / end, where);
      }
      progress.clear();
      if (!run_->ended())
        err << fmt::format("stopped at t = {:g} s, before the end\n", static_cast<double>(simulation.time()) / 1e9);
      run_->finish();
    } catch (const mpm::PhysicsError& error) {
      progress.clear();
      err << "run_scene: " << error.what() << "\n";
      run_->fail(error.what());
      checkpoints_.at_failure(*run_, error.what(), err);
      result = RunSceneResult::physics_failed;
    }
    if (csv_) csv_->close();
    const RunSummary summary(scene_, simulation, start_energy, run_->outputs().contacts());
    out << summary.text();
    write(summary);
    if (!run_->bag().empty()) out << "  bag " << run_->bag() << "\n";
    if (result == RunSceneResult::done) checkpoints_.at_end(*run_, out);
    return result;
  }

 private:
  void write(const RunSummary& summary) {
    if (!summary_.is_open()) return;
    summary_ << summary.json().dump(2) << "\n";
    summary_.close();
    if (!summary_) throw mpm::SceneError("--summary: cannot be written; check the space on its disk");
  }

  const mpm::Scene scene_;
  RunSceneCheckpoints checkpoints_;
  std::ofstream summary_;
  const Stamps stamps_;
  std::unique_ptr<CsvSink> csv_;
  std::unique_ptr<Run> run_;
};

}  // namespace

void list_scenes(std::ostream& out) {
  for (const auto& [name, line] : mpm::shipped_scenes()) out << fmt::format("{:<26} {}\n", name, line);
}

void explain_scene(const RunSceneOptions& options, std::ostream& out) {
  const mpm::Scene scene = load(options);
  mpm::SimulationDefinition built = mpm::build(scene);
  out << mpm::explain(scene, built);
  const mpm::Simulation simulation(std::move(built), {options.threads, instruction_set(options)});
  out << fmt::format("kernels: instruction set {}, {} thread{}\n", simulation.isa(), simulation.threads(),
                     simulation.threads() == 1 ? "" : "s");
  for (const std::string& warning : simulation.warnings()) out << "warning: " << warning << "\n";
  for (const std::string& note : simulation.notes()) out << note << "\n";
}

RunSceneResult run_scene(const RunSceneOptions& options, std::ostream& out, std::ostream& err, bool bar,
                         const std::function<bool()>& stop_requested) {
  try {
    return OfflineRun(options).go(out, err, bar, stop_requested);
  } catch (const mpm::PhysicsError& error) {
    err << "run_scene: " << error.what() << "\n";
    return RunSceneResult::physics_failed;
  } catch (const mpm::Error& error) {
    err << "run_scene: " << error.what() << "\n";
  } catch (const BagError& error) {
    err << "run_scene: " << error.what() << "\n";
  } catch (const CsvError& error) {
    err << "run_scene: " << error.what() << "\n";
  }
  return RunSceneResult::bad_input;
}

}  // namespace mpm_ros
