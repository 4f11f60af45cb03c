#include "mpm_ros/run/run_scene_checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "mpm/advice/resumed_scene.hpp"
#include "mpm/advice/target_record.hpp"
#include "mpm/checkpoint/checkpoint.hpp"
#include "mpm/math/json_text.hpp"
#include "mpm/math/output_file.hpp"
#include "mpm/ranks/lists.hpp"
#include "mpm/ranks/of_all.hpp"
#include "mpm/yaml/units.hpp"
#include "mpm_ros/record/together.hpp"

namespace mpm_ros {

mpm::Scene with_choice_of(const mpm::Scene& scene, const std::string& path) {
  const std::string recorded = mpm::read_checkpoint(path).label.scene_text;
  if (!scene.target) return mpm::with_recorded_sync(scene, recorded);
  mpm::RecordedChoice choice = mpm::with_recorded_choice(scene, recorded);
  if (choice.scene) return mpm::with_recorded_sync(std::move(*choice.scene), recorded);
  throw mpm::CheckpointError(
      fmt::format("checkpoint {}: it is of another scene, or of another target: {}; resume with its own scene and what "
                  "was set in it, or run this one from its start",
                  path, choice.why));
}

mpm::Scene scene_of(const RunSceneOptions& options) {
  if (options.resume.empty()) return mpm::load_scene(options.scene, options.set);
  if (!options.scene.empty()) return with_choice_of(mpm::load_scene(options.scene, options.set), options.resume);
  const mpm::CheckpointAbout about = mpm::read_checkpoint(options.resume);
  return mpm::with_recorded_sync(mpm::parse_scene(about.label.scene_text, about.label.scene_path, options.set),
                                 about.label.scene_text);
}

void resume_from(const std::string& path, RunOptions& options) {
  const mpm::CheckpointAbout about = mpm::read_checkpoint(path);
  if (options.isa == "auto") options.isa = about.isa;
  options.resume = path;
  options.parameters += fmt::format("resumed_from: {}\nresumed_at: {:.9f}\n", mpm::json_text(nlohmann::json(path)),
                                    mpm::seconds_of(about.time));
}

std::string after_loss(const std::string& last, const std::string& how) {
  const std::string lost = "the state of the run is lost with the graphics processor; ";
  if (last.empty()) return lost + "no checkpoint was saved from which it could go on";
  return lost + fmt::format("the last checkpoint is {}, from which it goes on ({})", last, how);
}

std::string part_of_checkpoint(const std::string& path) { return path + ".part"; }

std::string failed_checkpoint(const std::string& path) {
  const std::filesystem::path file(path);
  return (file.parent_path() / (file.stem().string() + "_failed" + file.extension().string())).string();
}

RunSceneCheckpoints::RunSceneCheckpoints(const RunSceneOptions& options, std::int64_t sync_period)
    : path_(options.checkpoint), last_(options.resume), over_ranks_(options.ranks != nullptr) {
  if (!options.checkpoint_every.empty()) {
    if (path_.empty()) throw mpm::SceneError("--checkpoint-every: name the file too, with --checkpoint run.h5");
    double period = 0.0;
    try {
      period = mpm::parse_quantity(options.checkpoint_every, mpm::kTime);
    } catch (const mpm::UnitError& error) {
      throw mpm::SceneError(fmt::format("--checkpoint-every: {}", error.what()));
    }
    if (!(period > 0.0 && period < 1e9)) {
      throw mpm::SceneError(fmt::format(
          "--checkpoint-every: '{}' is not between 0 and 1e9 s; write a time such as 0.5 s", options.checkpoint_every));
    }
    const double periods = std::round(period * mpm::kNanosecondsOfSecond / static_cast<double>(sync_period));
    period_ = sync_period * std::max<std::int64_t>(1, static_cast<std::int64_t>(periods));
  }
  if (!path_.empty()) try_path(options.ranks.get());  // told before hours of work
}

void RunSceneCheckpoints::try_path(mpm::Communicator* ranks) const {
  const std::string part = part_of_checkpoint(path_);
  const bool first = mpm::is_first(ranks);
  together<mpm::SceneError>(ranks, [&] {
    if (first) make(part);
  });
  bool other = false;
  if (ranks != nullptr) {
    std::vector<std::uint64_t> made;
    if (first) made = {mpm::inode_of(part)};
    made = mpm::gather_list(*ranks, made);
    other = ranks->any(mpm::inode_of(part) != made.front());
  }
  if (first) std::remove(part.c_str());
  if (other) {
    throw mpm::SceneError(fmt::format(
        "--checkpoint {}: cannot be written by all ranks: it is not the same file on all of them; put it into a folder "
        "that all their machines share",
        path_));
  }
}

void RunSceneCheckpoints::make(const std::string& part) const {
  for (const std::string& name : {path_, part}) {
    if (const std::string refused = mpm::refused_output(name); !refused.empty())
      throw mpm::SceneError(fmt::format("--checkpoint {}: cannot be written: {}", name, refused));
  }
  std::FILE* file = std::fopen(part.c_str(), "ab");
  if (file == nullptr) {
    throw mpm::SceneError(
        fmt::format("--checkpoint {}: cannot be written: {}; check the folder and its permissions, or choose another",
                    path_, std::strerror(errno)));
  }
  std::fclose(file);
}

void RunSceneCheckpoints::at_sync(Run& run, std::ostream& err) {
  if (period_ == 0 || run.ended() || run.simulation().time() % period_ != 0) return;
  try {
    run.save(path_);
    last_ = path_;
  } catch (const mpm::CheckpointError& error) {
    err << "warning: " << error.what() << "\n";
  }
}

void RunSceneCheckpoints::at_end(Run& run, std::ostream& out) {
  if (path_.empty()) return;
  run.save(path_);
  out << fmt::format("  checkpoint {} at t = {:g} s\n", path_, mpm::seconds_of(run.simulation().time()));
}

void RunSceneCheckpoints::at_failure(Run& run, const std::string& reason, std::ostream& err) {
  if (run.state_lost()) {
    err << "run_scene: " << after_loss(last_, "--resume") << "\n";
    return;
  }
  if (path_.empty() || over_ranks_) return;
  const std::string failed = failed_checkpoint(path_);
  try {
    run.save(failed, {}, reason);
    err << fmt::format("run_scene: the state of the failure is in {}\n", failed);
  } catch (const mpm::CheckpointError& error) {
    err << "warning: " << error.what() << "\n";
  }
}

}  // namespace mpm_ros
