#include "mpm_ros/run/run_files.hpp"

#include "mpm_ros/record/scene_files.hpp"
#include "mpm_ros/run/run_scene_checkpoint.hpp"

namespace mpm_ros {

void reads_scene(const mpm::Scene& scene, mpm::FilesInUse& files) {
  files.reads("the scene that is run", scene.path);
  for (const std::string& file : files_read_by(scene.text, scene.path))
    files.reads("a file that the scene reads", file);
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
  if (!options.terrain.empty()) {
    files.writes("--terrain", options.terrain);
    files.writes("--terrain", options.terrain + ".part");
  }
  files.writes_into("--csv", options.csv, kCsvFiles);
  files.writes_into("--vtk", options.vtk, kVtkFiles);
}

}  // namespace mpm_ros
