// Meaning of the options of run_scene, each checked before anything is run or written.
#pragma once

#include <optional>
#include <string>

#include "mpm/kernel/isa.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm_ros/record/bag_recorder.hpp"
#include "mpm_ros/record/run_outputs.hpp"
#include "mpm_ros/run/rerun.hpp"
#include "mpm_ros/run/run_scene.hpp"

namespace mpm_ros {

/// Options of this rank: on others than the first there is nothing to write.
RunSceneOptions own_part(const RunSceneOptions& options);
/// @throws mpm::SceneError on all ranks if one has read another scene than the first, or computes otherwise
void check_alike(const RunSceneOptions& options, const mpm::Scene& scene);
/// @throws mpm::SceneError that names the option
mpm::Isa instruction_set(const RunSceneOptions& options);
/// Looks whether there is the processor that is asked for. @throws mpm::SceneError that names the option
void check_device(const RunSceneOptions& options);
/// The scene, or that of the recording, to the end that was asked for. @throws mpm::Error
mpm::Scene scene_to_run(const RunSceneOptions& options, const std::optional<Rerun>& rerun);
/// Warning if more threads are asked for than there are processors; else empty.
std::string thread_warning(int threads);
/// @throws mpm::SceneError for particle fields that are none
void check_fields(const OutputOptions& output);
/// Tries whether the file can be written, and leaves it as it is: what cannot be is told before hours of work. An empty
/// path is none. @throws mpm::SceneError
void try_file(const std::string& option, const std::string& path);
/// Definition of the map of --terrain: the scene's own maps, or the whole ground at the grid's cells. @throws
/// mpm::SceneError for a scene without ground
mpm::GroundOutput ground_at_end(const mpm::Scene& scene);
/// Makes the folder that an option names, and tries whether files can be made in it. @throws mpm::SceneError
void try_folder(const std::string& option, const std::string& folder);
/// Reads where a part of the bag ends: "500 MB" or "10 s". @throws mpm::SceneError
void read_split(const std::string& text, BagOptions& bag);
/// Checks that a run that goes on keeps what it has recorded. @throws mpm::SceneError for a name that holds it
void check_not_there(const RunSceneOptions& options);

}  // namespace mpm_ros
