#include "mpm_ros/sweeping/sweep_layout.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>

#include "mpm/math/files_in_use.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm/sweep/plan.hpp"
#include "mpm_ros/record/run_outputs.hpp"
#include "mpm_ros/record/scene_files.hpp"
#include "mpm_ros/run/run_scene_options.hpp"

namespace mpm_ros {
namespace {

namespace fs = std::filesystem;

void make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw SweepError(fmt::format("{}: the folder cannot be made ({}); choose another", path, error.message()));
}

/// Keeps what is in the folder: a study is laid out in a new one, an empty one, or its own.
void check_free(const Study& study) {
  std::error_code ignored;
  if (fs::exists(study.lock(), ignored) || !fs::exists(study.folder(), ignored)) return;
  if (fs::is_directory(study.folder(), ignored) && fs::is_empty(study.folder(), ignored)) return;
  throw SweepError(fmt::format("{}: is there, and no study; choose a new folder with --out", study.folder()));
}

/// The plan as it lies in its study: its scene is the copy beside it.
std::string plan_text(const mpm::sweep::Plan& plan) {
  YAML::Node root = YAML::Load(plan.text);
  root["scene"] = "scene.yaml";
  return YAML::Dump(root) + "\n";
}

void write_if_new(const std::string& path, const std::string& text) {
  if (read_whole(path) != text) write_whole(path, text);
}

/// A study in whose folder the plan, or what it names, lies already is not written over that.
void check_not_read(const mpm::sweep::Plan& plan, const std::string& plan_path, const Study& study,
                    const std::string& base, const std::vector<std::string>& scenes) {
  mpm::FilesInUse files;
  files.reads("the plan", plan_path);
  files.reads("the scene of the plan", plan.scene);
  for (const std::string& file : files_read_by(base, plan.scene)) files.reads("a file that the scene reads", file);
  const auto writes = [&](const std::string& path, const std::string& text) {
    std::error_code ignored;
    if (fs::exists(path, ignored) && read_whole(path) != text) files.writes("--out", path);
  };
  writes(study.plan(), plan_text(plan));
  writes(study.scene(), base);
  for (std::size_t run = 0; run < scenes.size(); ++run)
    writes(study.of_run(static_cast<int>(run) + 1, "scene.yaml"), scenes[run]);
}

}  // namespace

Study study_of(const std::string& plan, const std::string& out) {
  if (!out.empty()) return Study(out);
  std::error_code ignored;
  if (fs::is_directory(plan, ignored)) return Study(plan);
  return Study(fs::path(plan).stem().string());
}

LaidOut lay_out(const std::string& plan_path, const Study& study, const std::function<bool(double)>& told) {
  std::error_code ignored;
  const bool again = fs::is_directory(plan_path, ignored);
  if (again && !is_study(plan_path))
    throw SweepError(fmt::format("{}: is no study; name a plan, or the folder of a sweep", plan_path));
  const mpm::sweep::Plan plan = mpm::sweep::read_plan(again ? Study(plan_path).plan() : plan_path);
  const int runs = plan.runs();
  if (study.there() && study.runs() > runs) {
    throw SweepError(fmt::format("{}: has {} runs, the plan {}; choose another folder with --out", study.folder(),
                                 study.runs(), runs));
  }
  check_free(study);
  LaidOut laid_out;
  laid_out.runs = runs;
  std::vector<std::string> scenes;
  for (int run = 1; run <= runs; ++run) {
    if (told(static_cast<double>(run - 1) / runs)) throw mpm::StoppedError("stopped");
    const bool final = study.result(run).final();
    mpm::sweep::ResolvedRun resolved = mpm::sweep::resolve(plan, run, [final](const mpm::Scene& scene) {
      check_fields(output_options(scene));
      if (!final) mpm::sweep::check_build(scene);
    });
    if (final && read_whole(study.of_run(run, "scene.yaml")) != resolved.text) {
      throw SweepError(
          fmt::format("{}: was made with another scene than the plan now has for run {}; choose another "
                      "folder with --out",
                      study.of_run(run), run));
    }
    laid_out.memory = std::max(laid_out.memory, resolved.memory);
    laid_out.has_metrics = laid_out.has_metrics || !resolved.scene.definition.metrics.empty();
    scenes.push_back(std::move(resolved.text));
  }
  const std::string base = mpm::sweep::base_scene(plan);
  if (!again) check_not_read(plan, plan_path, study, base, scenes);
  make_folder(study.folder());
  const FileLock lock = FileLock::take(study.lock());
  write_if_new(study.scene(), base);
  for (int run = 1; run <= runs; ++run) {
    make_folder(study.of_run(run));
    write_if_new(study.of_run(run, "scene.yaml"), scenes[static_cast<std::size_t>(run - 1)]);
  }
  write_if_new(study.plan(), plan_text(plan));
  return laid_out;
}

}  // namespace mpm_ros
