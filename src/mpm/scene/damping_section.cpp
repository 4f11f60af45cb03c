// method.damping: a rate of the grid, or a map of what damps, where and how.
#include "mpm/scene/sections.hpp"

namespace mpm {
namespace {

constexpr Dimension kGain{-2, 0, 0, 0};

/// A function; of a plain number more is known than that it can be read.
Function read_part(const Value& value, const Dimension& dimension) {
  Function function = value.function(dimension);
  if (function.is_constant()) value.non_negative(dimension);
  return function;
}

FeedbackDefinition read_feedback(const Value& value) {
  const Map map(value, {"gain", "target", "limit", "of"}, {});
  FeedbackDefinition feedback;
  if (const auto gain = map.find("gain")) feedback.gain = gain->positive(kGain);
  if (const auto target = map.find("target")) feedback.target = read_part(*target, kEnergy);
  if (const auto limit = map.find("limit")) feedback.limit = limit->positive(kRate);
  if (const auto of = map.find("of")) {
    feedback.of =
        of->choice({"grid", "particle"}) == 0 ? FeedbackDefinition::Of::grid : FeedbackDefinition::Of::particle;
  }
  return feedback;
}

}  // namespace

void read_damping(const Value& value, Scene& scene) {
  DampingDefinition& damping = scene.definition.method.damping;
  std::optional<Value> placement;
  if (value.is_map()) {
    const Map map(value, {"grid", "particle", "pic", "placement", "feedback"});
    if (const auto grid = map.find("grid")) damping.grid = read_part(*grid, kRate);
    if (const auto particle = map.find("particle")) damping.particle = read_part(*particle, kRate);
    if (const auto pic = map.find("pic")) damping.pic = read_part(*pic, kPlain);
    if (const auto feedback = map.find("feedback")) damping.feedback = read_feedback(*feedback);
    placement = map.find("placement");
    if (placement && !map.find("grid") && !map.find("feedback")) {
      placement->fail("it says where grid and feedback act, and neither is there; write one of them, or leave it out");
    }
  } else {
    damping.grid = read_part(value, kRate);
  }
  if (placement) {
    damping.in_force = placement->choice({"update", "force"}) == 1;
    return;
  }
  damping.in_force = !damping.grid.uses_place();
  if (!damping.grid.is_zero() || damping.feedback) {
    scene.choices.emplace_back("method.damping.placement", damping.in_force
                                                               ? "force: on the nodes, before walls and tools act"
                                                               : "update: a rate of place is read at the particles");
  }
}

}  // namespace mpm
