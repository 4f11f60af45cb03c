// The scene of a run that goes on from a checkpoint. What a run writes and measures, `output` and `metrics`, is not of
// its state, so a resumed one may have others; all else must be as it was.
#pragma once

#include <string>

#include "mpm/scene/scene.hpp"

namespace mpm {

/// First difference, in words, of the texts of two scenes (Scene::text) on which their states depend;
/// empty where one can go on as the other. A sync period that one of them alone says is left out.
std::string state_difference(const std::string& here, const std::string& there);

/// The same of a scene and the text of a recorded run of it, and of their sync periods, chosen ones as well.
/// @throws SceneError for a text that is no scene
std::string resumed_difference(const Scene& scene, const std::string& recorded);

/// `scene` with the sync period of the recorded run, which goes by its outputs where the scene does not say it. A scene
/// that cannot go on from there comes back as it is. @throws SceneError where its periods are not multiples of that one
Scene with_recorded_sync(Scene scene, const std::string& recorded);

}  // namespace mpm
