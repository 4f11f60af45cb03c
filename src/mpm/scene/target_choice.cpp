#include "mpm/scene/target_choice.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "mpm/math/build_info.hpp"
#include "mpm/scene/sections.hpp"

namespace mpm {
namespace {

constexpr int kMostTimes = 4;         ///< wider, or smaller, than the scene's own cell
constexpr double kOnLattice = 1e-6;   ///< of a spacing
constexpr double kLongestFace = 1e6;  ///< [cells]; beyond, a face is no face of a body

bool whole(double number) { return std::abs(number - std::round(number)) <= kOnLattice; }

/// Whether the faces of boxes that lie on the lattice of particles of the scene's own cell lie on the new one.
bool faces_fit(const Scene& scene, const Vec3& cell, int along) {
  const GridDefinition& grid = scene.definition.grid;
  for (const BodyDefinition& body : scene.bodies) {
    if (body.region.kind != Region::Kind::box) continue;
    for (const int axis : axes_of(scene)) {
      for (const double face : {body.region.box.min[axis], body.region.box.max[axis]}) {
        const double from = face - grid.min[axis];
        if (!(std::abs(from) < kLongestFace * grid.cell[axis])) continue;
        if (whole(from / particle_spacing(scene, axis)) && !whole(from * along / cell[axis])) return false;
      }
    }
  }
  return true;
}

/// "[0 m, 0.1 m]": components along the scene's axes.
std::string vector_text(const Scene& scene, const Vec3& vector) {
  std::string text;
  for (const int axis : axes_of(scene)) text += fmt::format("{}{:.15g} m", text.empty() ? "[" : ", ", vector[axis]);
  return text + "]";
}

double middle(const Scene& scene, int axis) {
  const GridDefinition& grid = scene.definition.grid;
  return 0.5 * (grid.min[axis] + grid.max[axis]);
}

std::string asymmetry_of_tool(const RigidBodyDefinition& body, double plane, double tolerance, int axis) {
  const auto says = [&](const char* what) { return fmt::format("rigid body '{}' {}", body.name, what); };
  if (body.free) return says("is free, and half of it would have half the mass and load; prescribe its motion");
  if (body.particles) return says("is made of particles, of which half would be modelled; leave out particles");
  if (std::abs(body.pose.position[axis] - plane) > tolerance) return says("does not lie on that plane; move it there");
  if (!body.velocity[static_cast<std::size_t>(axis)].is_zero()) return says("moves across that plane");
  for (int other = 0; other < 3; ++other) {
    if (other != axis && !body.rotation_rate[static_cast<std::size_t>(other)].is_zero())
      return says("turns out of that plane");
  }
  const Box bounds = body.surface->bounds();
  const bool upright = body.pose.orientation.isApprox(Quat::Identity());
  if (upright && std::abs(bounds.min[axis] + bounds.max[axis]) > tolerance)
    return says("reaches further on one side of that plane");
  return {};
}

/// The target of a recorded text, or nothing.
YAML::Node target_of(const std::string& text) {
  try {
    const YAML::Node root = YAML::Load(text);
    return root.IsMap() ? root["target"] : YAML::Node(YAML::NodeType::Undefined);
  } catch (const YAML::Exception&) {
    return YAML::Node(YAML::NodeType::Undefined);
  }
}

/// What is asked, without what was chosen.
std::string asked(const YAML::Node& target) {
  YAML::Node copy = YAML::Clone(target);
  copy.remove("chosen");
  copy.remove("expected");
  return YAML::Dump(copy);
}

Scene parsed_with(const Scene& scene, const std::string& text, const std::vector<std::string>& lines) {
  Scene chosen = parse_scene(text, scene.path, lines);
  chosen.definition.time.end = scene.definition.time.end;  // as --end has it
  // What was chosen before the text was written is in it as if it had been said.
  for (const auto& choice : scene.choices) {
    const auto same = [&](const auto& other) { return other.first == choice.first; };
    if (std::none_of(chosen.choices.begin(), chosen.choices.end(), same)) chosen.choices.push_back(choice);
  }
  return chosen;
}

}  // namespace

std::vector<std::pair<Vec3, int>> fitting_cells(const Scene& scene) {
  const SimulationDefinition& definition = scene.definition;
  const GridDefinition& grid = definition.grid;
  int shared = 0;
  for (const int axis : axes_of(scene)) {
    shared = std::gcd(shared, static_cast<int>(std::lround((grid.max[axis] - grid.min[axis]) / grid.cell[axis])));
  }
  const int own = definition.method.particles_per_direction;
  std::vector<std::pair<Vec3, int>> fitting = {{grid.cell, own}};
  const int most_along = dimensions(definition.geometry) == 3 ? 3 : 5;
  for (int parts = (shared + kMostTimes - 1) / kMostTimes; parts <= kMostTimes * shared; ++parts) {
    Vec3 cell = grid.cell;
    for (const int axis : axes_of(scene)) cell[axis] *= static_cast<double>(shared) / static_cast<double>(parts);
    if (parts == shared) cell = grid.cell;
    for (int along = 1; along <= most_along; ++along) {
      const bool is_own = parts == shared && along == own;
      if (!is_own && faces_fit(scene, cell, along)) fitting.emplace_back(cell, along);
    }
  }
  return fitting;
}

std::string asymmetry(const Scene& scene, int axis) {
  const SimulationDefinition& definition = scene.definition;
  const GridDefinition& grid = definition.grid;
  const double plane = middle(scene, axis), tolerance = 1e-6 * grid.cell[axis];
  const long cells = std::lround((grid.max[axis] - grid.min[axis]) / grid.cell[axis]);
  if (cells % 2 != 0) return fmt::format("the grid's middle is in a cell, of {}; make their number even", cells);
  const auto face = static_cast<std::size_t>(2 * axis);
  const WallDefinition &low = definition.walls[face], &high = definition.walls[face + 1];
  if (low.kind == WallKind::periodic) return "the grid is periodic along it; leave one of them out";
  if (low.kind != high.kind || low.hold != high.hold || low.friction.stick != high.friction.stick)
    return "the two faces of the grid differ; give them the same boundary";
  if (definition.gravity[axis] != 0.0) return "gravity pulls across that plane";
  if (!definition.conditions.empty() || !definition.body_forces.empty() || !definition.particle_forces.empty() ||
      !definition.tractions.empty())
    return "loads and velocity conditions are not halved; model the half by hand, with a face `symmetry`";
  for (const BodyDefinition& body : scene.bodies) {
    const Box& box = body.region.box;
    if (body.region.kind != Region::Kind::box || std::abs(box.min[axis] + box.max[axis] - 2.0 * plane) > tolerance)
      return fmt::format("body '{}' is no box whose middle lies on that plane; model the half by hand", body.name);
  }
  for (const RigidBodyDefinition& body : definition.rigid_bodies) {
    if (const std::string why = asymmetry_of_tool(body, plane, tolerance, axis); !why.empty()) return why;
  }
  return {};
}

std::vector<std::string> half_lines(const Scene& scene, int axis) {
  const double plane = middle(scene, axis);
  Vec3 corner = scene.definition.grid.min;
  corner[axis] = plane;
  std::vector<std::string> lines = {"grid.min=" + vector_text(scene, corner),
                                    fmt::format("boundaries.{}_min=symmetry", axis_name(axis))};
  for (const BodyDefinition& body : scene.bodies) {
    corner = body.region.box.min;
    corner[axis] = plane;
    lines.push_back(fmt::format("bodies.{}.shape.box.min={}", body.name, vector_text(scene, corner)));
  }
  return lines;
}

Scene with_chosen(const Scene& scene, const std::vector<std::string>& lines, double expected_pace,
                  double expected_error) {
  YAML::Node root = YAML::Load(scene.text);
  YAML::Node target = root["target"];
  target["chosen"] = lines;
  target["expected"]["real_time"] = fmt::format("{:.4g}", expected_pace);
  target["expected"]["force_error"] = fmt::format("{:.4g}", expected_error);
  return parsed_with(scene, YAML::Dump(root), lines);
}

Scene with_recorded_choice(const Scene& scene, const std::string& recorded) {
  if (!scene.target || scene.target->chosen) return scene;
  const YAML::Node here = target_of(scene.text), there = target_of(recorded);
  if (!there || !there.IsMap() || !there["chosen"] || asked(here) != asked(there)) return scene;
  YAML::Node root = YAML::Load(scene.text);
  root["target"] = there;
  return parsed_with(scene, YAML::Dump(root), there["chosen"].as<std::vector<std::string>>());
}

std::string text_without_target(const Scene& scene) {
  if (!scene.target) return scene.text;
  YAML::Node root = YAML::Load(scene.text);
  root.remove("target");
  return YAML::Dump(root);
}

pace::ForceErrors load_force_errors(const Scene& scene) {
  namespace fs = std::filesystem;
  std::string path;
  if (const char* variable = std::getenv("MPM_ROS_FORCE_ERRORS")) {
    path = variable;
  } else {
    const fs::path beside = source_folder() + "/config/force_errors.csv";
    std::error_code ignored;
    path = fs::is_regular_file(beside, ignored) ? beside.string() : installed_folder() + "/config/force_errors.csv";
  }
  std::ifstream file(path);
  if (!file) {
    throw SceneError(fmt::format(
        "{}: target: {} cannot be read; install it, or name a table of force errors in MPM_ROS_FORCE_ERRORS",
        scene.path, path));
  }
  try {
    return pace::read_force_errors(file);
  } catch (const pace::FiguresError& error) {
    throw SceneError(fmt::format("{}: target: {}: {}; take the table that is shipped", scene.path, path, error.what()));
  }
}

}  // namespace mpm
