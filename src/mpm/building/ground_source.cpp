#include "ground_source.hpp"

namespace mpm {

void SceneGround::add(const Box& bounds, GroundParticles& ground) const {
  filling_.each_in(bounds, [&](const FilledPlace& place) {
    ground.positions.push_back(place.centre);
    if (!filling_.cuts()) return;
    ground.parts.push_back(place.part);
    ground.surfaces.push_back(place.surface);
  });
}

}  // namespace mpm
