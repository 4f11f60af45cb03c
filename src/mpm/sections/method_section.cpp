// units, grid, method: the discretisation of space and the scheme of a step.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mpm/advice/implicit_choice.hpp"
#include "mpm/material/law.hpp"
#include "mpm/math/lanes.hpp"
#include "mpm/rules/method_rules.hpp"
#include "mpm/rules/method_text.hpp"
#include "mpm/rules/section_keys.hpp"
#include "mpm/sections/section_tables.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

// A grid is a whole number of cells, within this part of a cell, since 0.1 is not a binary number.
constexpr double kWholeCells = 1e-6;
// Largest number of cells along an axis: node numbers have 32 bits, and there are layers around the domain.
constexpr double kMostGridCells = 1e8;

// The transfer of soil that flows, of what columns that fall, discs that are pressed in and blades meet
// (doc/method_keys.md).
const Transfer kTransferOfSoil = [] {
  Transfer transfer;
  transfer.flip = 0.6;
  transfer.mixed = 2;
  transfer.every = 5;
  return transfer;
}();

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
    if (!(cells < kMostGridCells)) {
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

Transfer read_transfer(const Value& value) {
  Transfer transfer;
  if (value.is_text()) {
    std::vector<std::string> words = words_of(kTransferNames);
    words.emplace_back("pic");
    const std::size_t found = value.choice(words);
    if (words[found] == "pic") {
      transfer.flip = 0.0;
      return transfer;
    }
    transfer.kind = static_cast<TransferKind>(found);
    if (transfer.kind == TransferKind::xpic || transfer.kind == TransferKind::fmpm) {
      value.fail(fmt::format("give its order, as in {{{}: 2}}", value.text()));
    }
    return transfer;
  }
  if (value.is_map() && value.node()["flip"] && value.node().size() > 1) {
    const Map map(value, {"flip", "xpic", "every"});
    transfer.flip = map.at("flip").non_negative(kPlain);
    if (const auto order = map.find("xpic")) transfer.mixed = order->integer();
    if (const auto every = map.find("every")) transfer.every = every->integer();
    return transfer;
  }
  const auto [key, number] = only_key(value, {"flip", "xpic", "fmpm"});
  if (key == "flip") {
    transfer.flip = number.non_negative(kPlain);
  } else {
    transfer.kind = key == "xpic" ? TransferKind::xpic : TransferKind::fmpm;
    transfer.order = number.integer();
  }
  return transfer;
}

/// Reports a fault at the deepest part of its key that the scene contains.
[[noreturn]] void refuse(const Value& method, const MethodFault& fault) {
  Value at = method;
  for (std::size_t start = 0; start < fault.key.size() && at.is_map();) {
    const std::size_t dot = std::min(fault.key.find('.', start), fault.key.size());
    const std::string part = fault.key.substr(start, dot - start);
    const YAML::Node node = at.node()[part];
    if (!node) break;
    at = at.child(node, part);
    start = dot + 1;
  }
  at.fail(fault.text);
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

void read_axis(const Value& value, Scene& scene) {
  if (!axisymmetric(scene.definition.geometry)) value.fail("only an axisymmetric scene has an axis; leave it out");
  read_keys(value, axis_keys(), scene.definition.method.axis);
}

AutoMethod read_auto(const Value& value, const Scene& scene) {
  AutoMethod asked;
  asked.names_more = value.node().size() > 0;
  const Map map = read_keys(value, auto_keys(), asked);
  const auto turn = map.find("turn");
  if (turn && scene.definition.geometry == GeometryKind::line) turn->fail("nothing turns in a line; leave it out");
  const auto error = map.find("error");
  const auto cost = map.find("cost");
  if (error && cost) cost->fail("a budget is an error or a cost, not both; leave one out");
  if (error) asked.budget = {error->positive(kPlain), {}};
  if (cost) asked.budget = {{}, cost->positive(kPlain)};
  return asked;
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
  const Map map(root.at("grid"), {"cell", "min", "max", "leave"});
  grid.cell = read_cell(map.at("cell"), scene);
  grid.min = map.at("min").vector(kLength);
  const Value max = map.at("max");
  grid.max = max.vector(kLength);
  check_extent(max, scene);
  if (const auto leave = map.find("leave")) {
    const Value limit = Map(*leave, {"limit"}).at("limit");
    if (limit.integer() < 0) limit.fail("a number of particles; write 0 or more");
    grid.leave_limit = static_cast<std::uint64_t>(limit.integer());
  }
  // Along axes that the grid lacks there is one cell about 0, as thick as the scene (a square for a line).
  const GeometryKind geometry = scene.definition.geometry;
  const double width = planar(geometry) ? scene.definition.thickness : std::sqrt(scene.definition.area);
  for (const int axis : axes_beside(geometry)) {
    grid.cell[axis] = width;
    grid.min[axis] = -0.5 * width;
    grid.max[axis] = 0.5 * width;
  }
}

/// Chooses a transfer, which the scene does not name, where plain FLIP would leave noise: where cracks grow and where
/// soil flows, unless damping has a `part_of_pic` already. Returns whether it did.
bool calm(const Map& root, bool part_of_pic, Scene& scene) {
  Transfer& transfer = scene.definition.method.transfer;
  if (cracks_may_grow(root)) {
    transfer = Transfer{TransferKind::xpic, 1.0, 2};
    scene.choices.emplace_back("method.transfer",
                               "xpic 2: growing cracks set waves free, which flip leaves on the particles as noise");
    return true;
  }
  const auto& materials = scene.definition.materials;
  const auto soil = [](const auto& material) { return traits_of(material).matter == Matter::soil; };
  if (part_of_pic || std::none_of(materials.begin(), materials.end(), soil)) return false;
  transfer = kTransferOfSoil;
  scene.choices.emplace_back(
      "method.transfer",
      fmt::format("{}: plain flip leaves noise in soil that flows, which shakes heaps and the force on tools",
                  transfer_text(transfer)));
  return true;
}

std::optional<AutoMethod> read_method(const Map& root, Scene& scene) {
  MethodDefinition& method = scene.definition.method;
  const auto section = root.find("method");
  if (!section || section->is_text()) {
    if (section) section->choice({"auto"});
    method.particles_per_direction = 2;
    scene.choices.emplace_back("method.particles_per_cell", "two along each edge");
    AutoMethod all;
    all.keep_transfer = calm(root, false, scene);
    return all;
  }
  const Map map = read_keys(*section, method_keys(), method);
  std::optional<AutoMethod> chosen_later;
  if (const auto value = map.find("auto")) chosen_later = read_auto(*value, scene);
  const auto shape = map.find("shape"), update = map.find("update");
  if (!update && !chosen_later) {
    scene.choices.emplace_back("method.update", "usavg: strain updated in both halves of a step, least dissipation");
  }
  const auto transfer = map.find("transfer");
  const auto damping = map.find("damping");
  const bool part_of_pic = damping && damping->is_map() && damping->node()["pic"];
  const bool implicit = method.update == UpdateScheme::implicit;
  if (implicit && !transfer) {
    method.transfer = transfer_of_implicit();
    scene.choices.emplace_back(
        "method.transfer", fmt::format("{}: what implicit steps were measured with", transfer_text(method.transfer)));
  }
  const bool kept = transfer.has_value() || implicit || calm(root, part_of_pic, scene);
  if (transfer) {
    method.transfer = read_transfer(*transfer);
  } else if (!kept && !chosen_later) {
    scene.choices.emplace_back("method.transfer", "flip: no numerical viscosity; write {flip: 0.99} to calm noise");
  }
  if (chosen_later) {
    chosen_later->keep_shape = shape.has_value();
    chosen_later->keep_update = update.has_value();
    chosen_later->keep_transfer = kept;
    chosen_later->names_transfer = transfer.has_value() || part_of_pic;
  }
  if (damping) read_damping(*damping, scene);
  if (const auto axis = map.find("axis")) read_axis(*axis, scene);
  read_particles(map, scene);
  // Parts that are still to be chosen have their defaults here, which are compatible with every valid combination.
  if (const auto fault = method_fault(method, scene.definition.geometry)) refuse(*section, *fault);
  return chosen_later;
}

}  // namespace mpm
