// The record of what was chosen for a scene's `target`, which holds for that scene and that target alone.
//
// The text of a scene for which a choice was made has it in its keys, and under `target` beside them: `chosen`, what
// was set; `before`, what those keys were set to before; `asked`, the target that it was made for. Read again, the
// choice is not made anew. Where another target is asked for, what was chosen is undone and the target is open again; a
// key that was changed by itself since contradicts the record, which is refused.
#pragma once

#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"

namespace mpm {

/// The scene with `lines`, "key=value", set in it and recorded as the choice of its target, with what is expected of
/// it. @throws SceneError when a line does not fit
Scene with_chosen(const Scene& scene, const std::vector<std::string>& lines, double expected_pace,
                  double expected_error);

/// A scene with the choice of a recorded run of it, or why that is not to be had.
struct RecordedChoice {
  std::optional<Scene> scene;
  std::string why;  ///< difference from the run, where there is no scene
};
/// The choice that `recorded`, the text of a run, has, for a scene with the same text but for what was chosen, and with
/// the values that it was chosen from. A scene without a target, or with a choice of its own, comes back as it is.
RecordedChoice with_recorded_choice(const Scene& scene, const std::string& recorded);

/// The text of a scene without its target: what its steps cost depends on.
std::string text_without_target(const Scene& scene);

/// In a scene's tree: where its target is another than `chosen` was made for, takes that choice out again, but for keys
/// that have been set to something else since.
void reopen_other_target(const YAML::Node& root);
/// Fault of the record in `root`, a scene's tree, or empty. @param root has target.chosen, a list of texts
std::string fault_of_record(const YAML::Node& root);

}  // namespace mpm
