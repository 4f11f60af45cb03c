#include "mpm_ros/run/run_files.hpp"

#include <filesystem>

#include "mpm_ros/message/bag_parts.hpp"
#include "mpm_ros/run/run_scene_checkpoint.hpp"
#include "mpm_ros/run/scene_files.hpp"

namespace mpm_ros {
namespace {

/// `text` as a regular expression that matches it alone.
std::string literal(const std::string& text) {
  std::string pattern;
  for (const char c : text) {
    if (std::string("^$\\.*+?()[]{}|/").find(c) != std::string::npos) pattern += '\\';
    pattern += c;
  }
  return pattern;
}

}  // namespace

void reads_scene(const mpm::Scene& scene, mpm::FilesInUse& files) {
  files.reads("the scene that is run", scene.path);
  for (const std::string& file : files_read_by(scene.text, scene.path))
    files.reads("a file that the scene reads", file);
}

void reads_bag(const std::string& what, const std::string& bag, mpm::FilesInUse& files) {
  if (bag.empty()) return;
  for (const std::string& part : parts_of(bag)) files.reads(what, part);
}

void writes_bag(const std::string& option, const std::string& bag, mpm::FilesInUse& files) {
  if (bag.empty() || bag == "auto") return;
  files.writes(option, bag);
  const std::filesystem::path path(bag);
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  files.writes_into(option, folder.string(),
                    literal(path.stem().string()) + "_part[0-9]+" + literal(path.extension().string()));
}

void check_outputs(const RunSceneOptions& options, const mpm::Scene& scene) {
  mpm::FilesInUse files;
  reads_scene(scene, files);
  reads_bag("the recording that is run again", options.from_bag, files);
  if (!options.checkpoint.empty()) {
    for (const std::string& file :
         {options.checkpoint, part_of_checkpoint(options.checkpoint), failed_checkpoint(options.checkpoint)})
      files.writes("--checkpoint", file);
  }
  files.reads("the checkpoint that the run goes on from", options.resume);
  writes_bag("--bag", options.bag, files);
  if (!options.summary.empty()) {
    files.writes("--summary", options.summary);
    files.writes("--summary", options.summary + ".part");
  }
  files.writes_into("--csv", options.csv, kCsvFiles);
  files.writes_into("--vtk", options.vtk, kVtkFiles);
}

}  // namespace mpm_ros
