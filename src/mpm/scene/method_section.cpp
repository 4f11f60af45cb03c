// units, grid, method, boundaries: how the space is divided and stepped, and what its faces do.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mpm/math/lanes.hpp"
#include "mpm/scene/sections.hpp"

namespace mpm {
namespace {

// A grid is a whole number of cells; this much of a cell is forgiven, for 0.1 is not a binary number.
constexpr double kWholeCells = 1e-6;
// Node numbers along an axis are 32-bit in the grid's layout, with room for the layers around the domain.
constexpr double kMostCells = 1e8;

Vec3 read_cell(const Value& value, const Scene& scene) {
  if (value.is_text()) return Vec3::Constant(value.positive(kLength));
  const Vec3 cell = value.vector(kLength);
  for (const int axis : axes_of(scene)) {
    if (!(cell[axis] > 0.0)) value.fail(fmt::format("the cell size along {} is not greater than 0", axis_name(axis)));
  }
  return cell;
}

void check_extent(const Value& max, const Scene& scene) {
  const GridDefinition& grid = scene.definition.grid;
  for (const int axis : axes_of(scene)) {
    const double size = grid.max[axis] - grid.min[axis];
    const double cells = size / grid.cell[axis];
    if (!(size > 0.0)) {
      max.fail(fmt::format("{} = {} m is not above grid.min ({} m); put max above min", axis_name(axis), grid.max[axis],
                           grid.min[axis]));
    }
    if (!(cells < kMostCells)) {
      max.fail(fmt::format("{:.3g} cells along {}; make grid.cell larger or the grid smaller", cells, axis_name(axis)));
    }
    const double whole = std::max(1.0, std::round(cells));
    if (std::abs(cells - whole) > kWholeCells) {
      max.fail(fmt::format(
          "{:.6g} cells along {}; a grid is a whole number of cells: write max {} = {:.9g} m, or another cell", cells,
          axis_name(axis), axis_name(axis), grid.min[axis] + whole * grid.cell[axis]));
    }
  }
}

void read_transfer(const Value& value, MethodDefinition& method) {
  static const std::vector<Later> later = {{"xpic", "use flip, pic or {flip: 0.99}"},
                                           {"fmpm", "use flip, pic or {flip: 0.99}"},
                                           {"apic", "use flip, pic or {flip: 0.99}"}};
  if (value.is_text()) {
    method.transfer.flip = value.choice({"flip", "pic"}, later) == 0 ? 1.0 : 0.0;
    return;
  }
  const auto [key, fraction] = only_key(value, {"flip"}, later);
  method.transfer.flip = fraction.non_negative(kPlain);
  if (method.transfer.flip > 1.0)
    fraction.fail(fmt::format("'{}' is above 1; write a fraction from 0 (PIC) to 1 (FLIP)", fraction.text()));
}

void read_particles(const Map& method, Scene& scene) {
  const GeometryKind geometry = scene.definition.geometry;
  const int dim = dimensions(geometry);
  int& along = scene.definition.method.particles_per_direction;
  const auto value = method.find("particles_per_cell");
  if (!value) {
    along = 2;
    scene.choices.emplace_back("method.particles_per_cell", fmt::format("{}: two along each edge", 1 << dim));
    return;
  }
  const int wanted = value->integer();
  for (along = 1; along <= (dim == 3 ? 3 : 5); ++along) {
    if (wanted == whole_power(along, dim)) return;
  }
  static constexpr std::array<const char*, 3> kPossible = {"1, 2, 3, 4 or 5", "1, 4, 9, 16 or 25", "1, 8 or 27"};
  value->fail(
      fmt::format("{} is not possible; {} has {} particles a cell", wanted, scene_kind(geometry), kPossible[dim - 1]));
}

WallDefinition read_wall(const Value& value) {
  static const std::vector<Later> later = {{"absorbing", "use none, fixed, slip or {friction: 0.5}"},
                                           {"velocity", "use a rigid body with a motion"},
                                           {"periodic", "use none, fixed, slip or {friction: 0.5}"}};
  WallDefinition wall;
  if (value.is_text()) {
    static constexpr std::array kKinds = {WallKind::none, WallKind::fixed, WallKind::slip};
    wall.kind = kKinds.at(value.choice({"none", "fixed", "slip"}, later));
    return wall;
  }
  const auto [key, friction] = only_key(value, {"friction"}, later);
  wall.kind = WallKind::frictional;
  wall.friction = read_friction(friction);
  return wall;
}

}  // namespace

UnitSystem read_units(const Value& value) {
  try {
    if (value.is_text()) return parse_unit_system(value.text());
    const Map map(value, {"length", "mass", "time"});
    return make_unit_system(map.at("length").text(), map.at("mass").text(), map.at("time").text());
  } catch (const UnitError& error) {
    value.fail(error.what());
  }
}

FrictionLaw read_friction(const Value& value) {
  FrictionLaw law;
  if (value.is_text() && value.text() == "stick") {
    law.stick = true;
  } else {
    law.coefficient = value.non_negative(kPlain);
  }
  return law;
}

void read_grid(const Map& root, Scene& scene) {
  GridDefinition& grid = scene.definition.grid;
  const Map map(root.at("grid"), {"cell", "min", "max"});
  grid.cell = read_cell(map.at("cell"), scene);
  grid.min = map.at("min").vector(kLength);
  const Value max = map.at("max");
  grid.max = max.vector(kLength);
  check_extent(max, scene);
  // One cell beside the grid's axes, as thick as the scene (of a line a square), about 0.
  const GeometryKind geometry = scene.definition.geometry;
  const double width = planar(geometry) ? scene.definition.thickness : std::sqrt(scene.definition.area);
  for (const int axis : axes_beside(geometry)) {
    grid.cell[axis] = width;
    grid.min[axis] = -0.5 * width;
    grid.max[axis] = 0.5 * width;
  }
}

void read_method(const Map& root, Scene& scene) {
  MethodDefinition& method = scene.definition.method;
  const auto section = root.find("method");
  if (!section) {
    method.particles_per_direction = 2;
    scene.choices.emplace_back("method", "uGIMP, USAVG, FLIP, two particles along each edge of a cell: the defaults");
    return;
  }
  const Map map(*section,
                {"shape", "update", "transfer", "damping", "gradient_terms", "particles_per_cell", "precision"},
                {{"feedback_damping", "use damping"},
                 {"particle_damping", "use damping, or transfer {flip: 0.99}"},
                 {"leave_limit", "a particle that leaves the grid ends the run; use boundaries"}});
  if (const auto shape = map.find("shape")) {
    const std::string advice = "use ugimp";
    shape->choice({"ugimp"}, {{"dirac", advice},
                              {"classic", advice},
                              {"cpdi", advice},
                              {"lcpdi", advice},
                              {"qcpdi", advice},
                              {"bspline2", advice},
                              {"bspline3", advice},
                              {"gimp", "its uniform form is: write ugimp"}});
  }
  if (const auto update = map.find("update")) {
    const std::size_t kind =
        update->choice({"usavg", "usf"}, {{"usl", "use usavg or usf"}, {"musl", "use usavg or usf"}});
    method.update = kind == 0 ? UpdateScheme::usavg : UpdateScheme::usf;
  } else {
    scene.choices.emplace_back("method.update", "usavg: strain updated in both halves of a step, least dissipation");
  }
  if (const auto transfer = map.find("transfer")) {
    read_transfer(*transfer, method);
  } else {
    scene.choices.emplace_back("method.transfer", "flip: no numerical viscosity; write {flip: 0.99} to calm noise");
  }
  if (const auto damping = map.find("damping")) method.damping = damping->non_negative(kRate);
  if (const auto terms = map.find("gradient_terms")) {
    method.gradient_terms = terms->integer();
    // 1/13! is below double precision's last digit for any step that the wave speed allows.
    if (method.gradient_terms < 1 || method.gradient_terms > 12) terms->fail("write 1 to 12 terms; 2 is the default");
  }
  if (const auto precision = map.find("precision")) {
    method.precision = precision->choice({"double", "single"}) == 0 ? Precision::float64 : Precision::float32;
  }
  read_particles(map, scene);
}

void read_boundaries(const Map& root, Scene& scene) {
  const auto section = root.find("boundaries");
  if (!section) {
    scene.choices.emplace_back("boundaries", "none: a particle that reaches the edge of the grid ends the run");
    return;
  }
  const GeometryKind geometry = scene.definition.geometry;
  const std::vector<int> beside = axes_beside(geometry);
  std::vector<std::string> keys = {"all"};
  for (const char* name : kWallNames) keys.emplace_back(name);
  const Map map(*section, keys);
  for (std::size_t i = 0; i < kWallNames.size(); ++i) {
    const int axis = static_cast<int>(i / 2);
    const auto own = map.find(kWallNames[i]);
    if (std::find(beside.begin(), beside.end(), axis) != beside.end()) {
      if (own) own->fail(fmt::format("{} has no face along {}; leave it out", scene_kind(geometry), axis_name(axis)));
      continue;
    }
    if (const auto value = own ? own : map.find("all")) scene.definition.walls[i] = read_wall(*value);
  }
}

}  // namespace mpm
