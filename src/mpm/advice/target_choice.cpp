#include "mpm/advice/target_choice.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "mpm/material/law.hpp"
#include "mpm/math/build_info.hpp"
#include "mpm/math/input_file.hpp"
#include "mpm/scene/scene_parts.hpp"
#include "mpm/yaml/source.hpp"

namespace mpm {
namespace {

constexpr int kMostTimes = 4;         ///< wider, or smaller, than the scene's own cell
constexpr double kOnLattice = 1e-6;   ///< part of a spacing
constexpr double kLongestFace = 1e6;  ///< [cells]; beyond, a face is no face of a body

bool whole(double number) { return std::abs(number - std::round(number)) <= kOnLattice; }

/// Places of the ends of a body along an axis that are faces: not the uneven surface of ground.
std::vector<double> faces_of(const BodyDefinition& body, int axis) {
  if (body.region.kind == Region::Kind::box) return {body.region.box.min[axis], body.region.box.max[axis]};
  if (body.region.kind != Region::Kind::terrain) return {};
  const Box bounds = body.region.bounds();
  if (axis == 2) return {bounds.min[axis]};
  return {bounds.min[axis], bounds.max[axis]};
}

/// True if the faces of bodies that lie on the lattice of particles of the scene's own cell lie on the new one.
bool faces_fit(const Scene& scene, const Vec3& cell, int along) {
  const GridDefinition& grid = scene.definition.grid;
  for (const BodyDefinition& body : scene.bodies) {
    for (const int axis : axes_of(scene)) {
      for (const double face : faces_of(body, axis)) {
        const double from = face - grid.min[axis];
        if (!(std::abs(from) < kLongestFace * grid.cell[axis])) continue;
        if (whole(from / particle_spacing(scene, axis)) && !whole(from * along / cell[axis])) return false;
      }
    }
  }
  return true;
}

/// True if a shape is evaluated at points that follow grid.cell: a height_field from an expression, without `cells`.
bool follows_cell(const Scene& scene) {
  const YAML::Node root = YAML::Load(scene.text);
  for (const char* section : {"bodies", "rigid_bodies"}) {
    const YAML::Node bodies = root[section];
    for (std::size_t i = 0; bodies && i < bodies.size(); ++i) {
      const YAML::Node heights = node_at(bodies[i], "shape.height_field.heights");
      if (heights && heights.IsScalar() && !node_at(bodies[i], "shape.height_field.cells")) return true;
    }
  }
  return false;
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
  const bool only_own = follows_cell(scene);
  for (int parts = (shared + kMostTimes - 1) / kMostTimes; parts <= kMostTimes * shared; ++parts) {
    Vec3 cell = grid.cell;
    for (const int axis : axes_of(scene)) cell[axis] *= static_cast<double>(shared) / static_cast<double>(parts);
    if (parts == shared) cell = grid.cell;
    if (only_own && parts != shared) continue;
    for (int along = 1; along <= most_along; ++along) {
      const bool is_own = parts == shared && along == own;
      if (!is_own && faces_fit(scene, cell, along)) fitting.emplace_back(cell, along);
    }
  }
  return fitting;
}

std::optional<pace::Ground> ground_of(const SimulationDefinition& definition) {
  std::optional<pace::Ground> found;
  for (const MaterialDefinition& material : definition.materials) {
    const std::optional<double> friction = friction_angle(material.law);
    if (!friction) continue;
    const bool implicit = definition.method.update == UpdateScheme::implicit;
    if (implicit && traits_of(material).implicit != ImplicitSteps::measured) return std::nullopt;
    if (*friction > 0.0) return pace::Ground::sand;
    found = pace::Ground::clay;
  }
  return found;
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
  std::ifstream file;
  if (!open_input(file, path).empty()) {
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
