// method.damping: a rate of the grid, or a map of what damps, where and how.
#include "mpm/sections/sections.hpp"
#include "mpm/step/damping_keys.hpp"

namespace mpm {

void read_damping(const Value& value, Scene& scene) {
  DampingDefinition& damping = scene.definition.method.damping;
  std::optional<Value> placement;
  if (value.is_map()) {
    const Map map = read_keys(value, damping_keys(), damping);
    if (const auto feedback = map.find("feedback")) read_keys(*feedback, feedback_keys(), damping.feedback.emplace());
    placement = map.find("placement");
    if (placement && !map.find("grid") && !map.find("feedback")) {
      placement->fail("it says where grid and feedback act, and neither is there; write one of them, or leave it out");
    }
  } else {
    damping.grid = value.function(kRate, FunctionPlaces::present, kNotNegative);
  }
  if (placement) return;
  damping.in_force = !damping.grid.uses_place();
  if (!damping.grid.is_zero() || damping.feedback) {
    scene.choices.emplace_back("method.damping.placement", damping.in_force
                                                               ? "force: on the nodes, before walls and tools act"
                                                               : "update: a rate of place is read at the particles");
  }
}

}  // namespace mpm
