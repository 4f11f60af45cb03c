#include "mpm_ros/run/run_scene_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <utility>

#include "mpm/math/output_file.hpp"
#include "mpm/ranks/lists.hpp"
#include "mpm/simulation/threads.hpp"
#include "mpm/terrain/ground_map.hpp"
#include "mpm/yaml/units.hpp"
#include "mpm_ros/run/run_scene_checkpoint.hpp"

namespace mpm_ros {
namespace {

/// Makes a file that is not there yet, and takes it away again. Why that cannot be done; empty if it can.
std::string problem_of_new_file(const std::string& path) {
  std::ofstream file;
  std::string problem = mpm::open_output(file, path);
  file.close();
  if (problem.empty()) std::remove(path.c_str());
  return problem;
}

/// The recorded scene, to where the recording ends.
mpm::Scene recorded_scene(const RunSceneOptions& options, const Rerun& rerun) {
  mpm::Scene scene = mpm::parse_scene(rerun.info.scene_text, rerun.info.scene_path, options.set);
  // Gives a run that failed the time to fail again.
  const std::int64_t after = rerun.failed ? 2 * scene.definition.time.sync : 0;
  scene.definition.time.end = mpm::seconds_of(rerun.end + after);
  return scene;
}

}  // namespace

RunSceneOptions own_part(const RunSceneOptions& options) {
  RunSceneOptions own = options;
  if (!options.ranks) return own;
  if (!options.ranks->first()) {
    for (std::string* written : {&own.bag, &own.csv, &own.vtk, &own.summary, &own.out}) written->clear();
  }
  return own;
}

void check_alike(const RunSceneOptions& options, const mpm::Scene& scene) {
  if (!options.ranks) return;
  const auto differs = [&](const std::string& text) {
    const std::vector<mpm::Communicator::Bytes> all =
        options.ranks->gather(mpm::bytes_of(std::vector<char>(text.begin(), text.end())));
    return std::find_if(all.begin(), all.end(), [&](const auto& other) { return other != all.front(); }) - all.begin();
  };
  const auto isa = differs(mpm::isa_name(instruction_set(options))), text = differs(scene.text);
  if (isa < options.ranks->size()) {
    throw mpm::SceneError(
        fmt::format("--isa: rank {} has another instruction set than the first, which rounds otherwise: write --isa "
                    "avx2, or another one that all machines have",
                    isa));
  }
  if (text < options.ranks->size()) {
    throw mpm::SceneError(fmt::format(
        "{}: rank {} reads another scene than the first: have the same files on all machines", scene.path, text));
  }
}

mpm::Isa instruction_set(const RunSceneOptions& options) {
  try {
    return mpm::choose_isa(options.isa);
  } catch (const mpm::IsaError& error) {
    throw mpm::SceneError(fmt::format("--isa: {}", error.what()));
  }
}

void check_device(const RunSceneOptions& options) {
  try {
    mpm::check_device(options.device, options.ranks ? options.ranks->size() : 1);
  } catch (const mpm::DeviceError& error) {
    throw mpm::SceneError(fmt::format("--device {}: {}", options.device.word, error.what()));
  }
}

mpm::Scene scene_to_run(const RunSceneOptions& options, const std::optional<Rerun>& rerun) {
  instruction_set(options);
  check_device(options);
  mpm::Scene scene = rerun ? recorded_scene(options, *rerun) : scene_of(options);
  if (options.end.empty()) return scene;
  // The sync and output periods stay the scene's: a shorter run is the beginning of the longer one, bit for bit.
  double end = 0.0;
  try {
    end = mpm::parse_quantity(options.end, mpm::kTime);
  } catch (const mpm::UnitError& error) {
    throw mpm::SceneError(fmt::format("--end: {}", error.what()));
  }
  // The shortest period between sync points is a nanosecond, and 64 bits of them last 292 years.
  if (!(end >= 1e-9 && end <= 1e9))
    throw mpm::SceneError(
        fmt::format("--end: '{}' is not between 1e-9 s and 1e9 s; write a time such as 0.5", options.end));
  scene.definition.time.end = end;
  return scene;
}

void try_file(const std::string& option, const std::string& path) {
  if (path.empty()) return;
  std::string problem = mpm::refused_output(path);
  if (problem.empty()) problem = problem_of_new_file(mpm::behind_links(path) + ".part");
  if (!problem.empty()) throw mpm::SceneError(fmt::format("{} {}: cannot be written: {}", option, path, problem));
}

mpm::GroundOutput ground_at_end(const mpm::Scene& scene) {
  const mpm::SimulationDefinition& definition = scene.definition;
  const auto refuse = [&](const std::string& what) {
    throw mpm::SceneError(fmt::format("--terrain: {}: {}", scene.path, what));
  };
  if (!mpm::planar(definition.geometry) && definition.geometry != mpm::GeometryKind::solid)
    refuse("only planar and solid scenes have ground; leave it out");
  mpm::GroundOutput ground = scene.output.ground.value_or(mpm::GroundOutput());
  if (!scene.output.ground) ground.resolution = mpm::ground_resolution(definition.grid);
  try {
    mpm::ground_raster(definition.grid, definition.geometry, ground.resolution);
  } catch (const mpm::Error& error) {
    refuse(fmt::format("{} as output.terrain.resolution", error.what()));
  }
  return ground;
}

void try_folder(const std::string& option, const std::string& folder) {
  if (folder.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw mpm::SceneError(
        fmt::format("{} {}: the folder cannot be made: {}; choose another", option, folder, error.message()));
  }
  if (const std::string problem = problem_of_new_file(folder + "/mpm_ros.part"); !problem.empty())
    throw mpm::SceneError(fmt::format("{} {}: no file can be made in the folder: {}", option, folder, problem));
}

void read_split(const std::string& text, BagOptions& bag) {
  if (text.empty()) return;
  const std::size_t unit = text.find_last_of("0123456789. ");
  const std::string last = unit == std::string::npos ? text : text.substr(unit + 1);
  double size = 0.0;
  std::string rest;
  for (const auto& [name, bytes] : {std::pair<const char*, double>{"kB", 1e3}, {"MB", 1e6}, {"GB", 1e9}}) {
    if (last != name) continue;
    if (mpm::split_number(text, size, rest) && size * bytes >= 1.0 && size * bytes < 1e15) {
      bag.split_size = static_cast<std::uint64_t>(size * bytes);
      return;
    }
  }
  double time = 0.0;
  try {
    if (!last.empty()) time = mpm::parse_quantity(text, mpm::kTime);
  } catch (const mpm::UnitError&) {
    // Neither a size nor a time.
  }
  if (!(time > 0.0 && time < 1e9)) {
    throw mpm::SceneError(fmt::format(
        "--bag-split: '{}' is neither a size nor a time with its unit; write one such as 500 MB or 10 s", text));
  }
  bag.split_duration = mpm::nanoseconds_of(time);
}

std::string thread_warning(int threads) {
  const auto processors = static_cast<int>(mpm::own_processors().count());
  if (threads <= processors) return {};
  return fmt::format(
      "{} threads on {} processor{}: they wait for each other, and the run is slower than with --threads {}", threads,
      processors, processors == 1 ? "" : "s", processors);
}

void check_fields(const OutputOptions& output) {
  const std::string problem = problem_of(output.particles);
  if (!problem.empty()) throw mpm::SceneError(fmt::format("output: {}", problem));
}

void check_not_there(const RunSceneOptions& options) {
  std::error_code ignored;
  if (options.bag != "auto" && std::filesystem::exists(options.bag, ignored)) {
    throw mpm::SceneError(fmt::format("--bag {}: holds the run so far; choose another name", options.bag));
  }
  for (const auto& [option, folder] : {std::pair("--csv", options.csv), std::pair("--vtk", options.vtk)}) {
    if (folder.empty() || !std::filesystem::exists(folder, ignored)) continue;
    if (std::filesystem::is_directory(folder, ignored) && std::filesystem::is_empty(folder, ignored)) continue;
    throw mpm::SceneError(fmt::format("{} {}: holds the run so far; choose another name", option, folder));
  }
}

}  // namespace mpm_ros
