#include "mpm_ros/aim/judged_tools.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "mpm/advice/target_choice.hpp"

namespace mpm_ros {

using mpm::pace::ToolInGround;

namespace {

const char* name_of(std::optional<mpm::pace::ToolUse> use) {
  return use ? mpm::pace::kToolUseNames[static_cast<int>(*use)] : "tool of unknown use";
}

}  // namespace

std::string JudgedTools::text() const {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < all.size(); ++i) {
    texts.push_back(names[i].empty()
                        ? fmt::format("{:.3g} m of a {}", all[i].length, name_of(all[i].use))
                        : fmt::format("{:.3g} m of '{}', a {}", all[i].length, names[i], name_of(all[i].use)));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

JudgedTools judged_tools(const mpm::Scene& scene, const std::optional<mpm::pace::Rehearsal>& rehearsal,
                         const mpm::pace::ForceErrors& errors) {
  const mpm::pace::Target& target = *scene.target;
  const mpm::GeometryKind geometry = scene.definition.geometry;
  const bool implicit = scene.definition.method.update == mpm::UpdateScheme::implicit;
  const std::optional<mpm::pace::Ground> ground = mpm::ground_of(scene.definition);
  JudgedTools tools;
  if (rehearsal) {
    const auto works = [](const mpm::pace::ToolAtWork& tool) { return tool.use.has_value(); };
    const bool any_works = std::any_of(rehearsal->tools.begin(), rehearsal->tools.end(), works);
    for (const mpm::pace::ToolAtWork& tool : rehearsal->tools) {
      if (any_works && !works(tool)) continue;  // a floor or an anvil, beside what moves
      const auto use = target.use ? target.use : tool.use;
      tools.all.push_back({use, ground, target.length.value_or(tool.length(use))});
      tools.names.push_back(scene.definition.rigid_bodies[tool.body].name);
    }
  }
  const double whole = target.length.value_or(target.extent);
  if (tools.all.empty()) {
    tools.all.push_back({target.use, ground, whole});
    tools.names.emplace_back();
  }
  // Depth that a blade will dig is not known if no rehearsal found it in the ground.
  const bool has_length = target.length || !tools.names.front().empty() || target.use == mpm::pace::ToolUse::plate;
  for (ToolInGround& tool : tools.all) {
    if (has_length && tool.use && ground && errors.covers(tool, geometry, implicit)) continue;
    tools.unknown = fmt::format("a {} in {}{}", name_of(tool.use),
                                ground ? mpm::pace::kGroundNames[static_cast<int>(*ground)] : "other material",
                                mpm::dimensions(geometry) == 3 ? ", in space" : "");
    if (target.force_error) {
      const char* remedy =
          tool.use && has_length
              ? "leave target out, or write target.real_time"
              : "if commands will move it, write target.tool (blade, plate or wheel) and target.length";
      throw mpm::SceneError(
          fmt::format("{}: target.force_error: no error was measured for {}, so none can be promised; {}", scene.path,
                      tools.unknown, remedy));
    }
    const bool known_ground = errors.covers({{}, ground, whole}, geometry, implicit);
    tool = {{}, known_ground ? ground : std::nullopt, whole};
  }
  return tools;
}

}  // namespace mpm_ros
