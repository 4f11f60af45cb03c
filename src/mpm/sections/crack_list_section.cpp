// cracks.list: where a crack lies, what its ends are, and how its faces act on each other.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "mpm/crack/chain_shape.hpp"
#include "mpm/crack/crack_keys.hpp"
#include "mpm/math/constants.hpp"
#include "mpm/math/input_file.hpp"
#include "mpm/math/nearest.hpp"
#include "mpm/rigid/surface.hpp"
#include "mpm/rules/section_keys.hpp"
#include "mpm/sections/sections.hpp"
#include "mpm/terrain/height_file.hpp"

namespace mpm {
namespace {

constexpr double kLeastSegment = 0.1, kMostSegment = 2.0;  // [cells]
constexpr double kMostSegments = 1e4;
const std::vector<std::string> kShapes = {"points", "line", "arc", "file", "parts"};

/// A chain is cut after this check, so that a length by mistake ends in an error and not in all of the memory.
void check_length(const Value& value, double length, double segment) {
  if (length <= kMostSegments * segment) return;
  value.fail(fmt::format("{:g} m are more than {:g} segments of {:g} m; write a shorter crack", length, kMostSegments,
                         segment));
}

void check_count(const Value& value, std::size_t points) {
  if (static_cast<double>(points) <= kMostSegments + 1.0) return;
  value.fail(fmt::format("{} points make more than {:g} segments, the most of a crack; write fewer points", points,
                         kMostSegments));
}

std::vector<Vec2> cut(const Value& value, const std::vector<Vec2>& corners, double segment) {
  double length = 0.0;
  for (std::size_t i = 1; i < corners.size(); ++i) length += (corners[i] - corners[i - 1]).norm();
  if (!(length > 0.0)) {
    value.fail("all its points lie in one place; a crack has a length, such as [[0, 0.5], [0.2, 0.5]]");
  }
  check_length(value, length, segment);
  return subdivided(corners, segment);
}

std::vector<Vec2> read_corners(const Value& value) {
  std::vector<Vec2> corners;
  for (const Value& corner : value.elements()) corners.push_back(read_plane_vector(corner, kLength));
  check_count(value, corners.size());
  if (corners.size() < 2) {
    value.fail(fmt::format("{}; a crack has two points or more, such as [[0, 0.5], [0.2, 0.5]]",
                           corners.empty() ? "no point" : "one point"));
  }
  return corners;
}

std::vector<Vec2> read_arc(const Value& value, double segment) {
  const Map map(value, {"centre", "radius", "from", "to"});
  const Vec2 centre = read_plane_vector(map.at("centre"), kLength);
  const double radius = map.at("radius").positive(kLength);
  const double from = map.at("from").number(kAngle), to = map.at("to").number(kAngle);
  const double turn = std::abs(to - from);
  if (!(turn > 0.0)) map.at("to").fail("the arc ends where it begins; write another angle");
  if (turn > 2.0 * kPi * (1.0 + 1e-12)) map.at("to").fail("the arc goes round more than once; 360 deg at most");
  check_length(value, radius * turn, segment);
  return arc_points(centre, radius, from, to, segment);
}

/// Lines of x and z, numbers in the scene's units. @throws SceneError
std::vector<Vec2> read_point_file(const Value& value) {
  std::string path = path_from_scene(value);
  HeightTable table;
  bool empty = false;
  std::string refused;
  try {
    path = resolve_resource(path);
    std::ifstream stream;
    refused = open_input(stream, path);
    empty = refused.empty() && stream.peek() == std::ifstream::traits_type::eof();
    if (refused.empty() && !empty) table = read_number_text(stream, path, kTextLimit);
  } catch (const Error& error) {
    value.fail(error.what());
  }
  if (!refused.empty()) value.fail(fmt::format("{}: {}", path, refused));
  if (empty) value.fail(fmt::format("{}: it is empty; write lines of x and z, two or more", path));
  if (table.columns != 2) value.fail(fmt::format("{}: {} numbers a line; write two, x and z", path, table.columns));
  check_count(value, static_cast<std::size_t>(table.rows));
  if (table.rows < 2) value.fail(fmt::format("{}: one point; a crack has two or more", path));
  const double unit = value.context().units.factor(kLength);
  std::vector<Vec2> corners;
  for (int row = 0; row < table.rows; ++row) {
    corners.emplace_back(unit * table.values[static_cast<std::size_t>(2 * row)],
                         unit * table.values[static_cast<std::size_t>(2 * row + 1)]);
    if (!corners.back().allFinite()) value.fail(fmt::format("{}: a number is not finite", path));
  }
  return corners;
}

/// The one shape among the keys of `map`.
std::pair<std::string, Value> chosen_shape(const Map& map, const std::vector<std::string>& shapes) {
  std::vector<std::string> found;
  for (const std::string& shape : shapes) {
    if (map.find(shape)) found.push_back(shape);
  }
  if (found.empty()) map.fail("says not where it is; write points, line, arc or file");
  if (found.size() > 1) {
    map.at(found[1]).fail(fmt::format("a second shape beside {}; leave one out, or join them as parts", found[0]));
  }
  return {found[0], map.at(found[0])};
}

std::vector<Vec2> read_chain_shape(const std::pair<std::string, Value>& shape, double segment) {
  const auto& [kind, value] = shape;
  if (kind == "points") return cut(value, read_corners(value), segment);
  if (kind == "file") return cut(value, read_point_file(value), segment);
  if (kind == "arc") return read_arc(value, segment);
  if (kind == "line") {
    const Map line(value, {"from", "to"});
    return cut(value, {read_plane_vector(line.at("from"), kLength), read_plane_vector(line.at("to"), kLength)},
               segment);
  }
  const std::vector<std::string> simple(kShapes.begin(), kShapes.end() - 1);
  std::vector<std::vector<Vec2>> parts;
  for (const Value& part : value.elements()) {
    parts.push_back(read_chain_shape(chosen_shape(Map(part, simple), simple), segment));
  }
  if (parts.empty()) value.fail("no part; write one or more of line, arc, points and file");
  return joined(parts);
}

std::vector<Vec2> read_chain(const Map& map, const Scene& scene) {
  const double cell = scene.definition.smallest_cell();
  double segment = 0.5;
  if (const auto written = map.find("segment")) {
    segment = written->positive(kPlain);
    if (segment < kLeastSegment || segment > kMostSegment) {
      written->fail(fmt::format("segments of {:g} cells; write {:g} to {:g}, best about 0.5", segment, kLeastSegment,
                                kMostSegment));
    }
  }
  const auto shape = chosen_shape(map, kShapes);
  std::vector<Vec2> points = read_chain_shape(shape, segment * cell);
  check_count(shape.second, points.size());
  if (const std::string fault = line_fault(points, cell); !fault.empty()) shape.second.fail(fault);
  const GridDefinition& grid = scene.definition.grid;
  for (const Vec2& point : points) {
    if (point.x() >= grid.min.x() && point.x() <= grid.max.x() && point.y() >= grid.min.z() &&
        point.y() <= grid.max.z()) {
      continue;
    }
    shape.second.fail(fmt::format("the point ({:g}, {:g}) m is not in the grid; end the crack in it, or enlarge grid",
                                  point.x(), point.y()));
  }
  return points;
}

CrackFaces read_faces(const Value& value) {
  CrackFaces faces;
  if (value.is_text()) {
    value.choice({"ignored"});
    faces.ignored = true;
    return faces;
  }
  std::vector<std::string> keys = contact_law_keys().names();
  for (const std::string& key : face_keys().names()) keys.push_back(key);
  const Map map(value, keys);
  faces.law = read_contact_law(map, false);
  read_keys(map, face_keys(), faces);
  if (faces.law.kind == ContactLaw::Kind::interface && faces.detection == CrackFaces::Detection::positions) {
    map.at("detection").fail("an interface follows displacements; leave it out");
  }
  const auto position = map.find("position");
  if (position && faces.detection != CrackFaces::Detection::positions) {
    position->fail("a distance that faces touch at is for detection: positions; leave it out");
  }
  return faces;
}

void read_end(const Map& map, const char* key, const Scene& scene, CrackEnd& end, std::string& material) {
  const auto value = map.find(key);
  if (!value) return;
  if (!value->is_map()) {
    end = static_cast<CrackEnd>(value->choice({kCrackEndNames.begin(), kCrackEndNames.end()}));
    return;
  }
  const Value name = only_key(*value, {"tip"}).second;
  end = CrackEnd::tip;
  material = name.text();
  std::vector<std::string> known;
  for (const MaterialDefinition& one : scene.definition.materials) known.push_back(one.name);
  if (std::find(known.begin(), known.end(), material) == known.end()) {
    name.fail(fmt::format("no material '{}'; {}", material, suggest(material, known)));
  }
}

void check_tractions(const Map& map, const CrackDefinition& crack) {
  for (const char* key : {"traction", "traction_of_growth"}) {
    const auto value = map.find(key);
    if (!value) continue;
    if (crack.fixed)
      value->fail("the faces of a fixed crack are not followed, so they have no tractions; leave it out");
    if (!crack.faces.smooth()) {
      value->fail("faces with a law of tractions are smooth where they meet; leave out faces, or this");
    }
  }
}

}  // namespace

CrackDefinition read_crack(const Value& value, const Scene& scene) {
  CrackDefinition crack;
  const Map map = read_keys(value, crack_keys(), crack);
  const CracksDefinition& cracks = scene.definition.cracks;
  crack.name = map.at("name").name();
  crack.where = value.where();
  if (const auto body = map.find("body")) {
    crack.body = read_body(*body, scene);
    const auto& ignored = cracks.ignored_by;
    if (std::find(ignored.begin(), ignored.end(), crack.body) != ignored.end()) {
      body->fail(fmt::format("'{}' heeds no crack by cracks.ignored_by; leave it out in one of the two", crack.body));
    }
  }
  crack.points = read_chain(map, scene);
  read_end(map, "start", scene, crack.ends[0], crack.tip_materials[0]);
  read_end(map, "end", scene, crack.ends[1], crack.tip_materials[1]);
  const auto thickness = map.find("thickness");
  if (thickness && axisymmetric(scene.definition.geometry)) {
    thickness->fail("about an axis a crack goes all the way round; leave it out");
  }
  if (const auto faces = map.find("faces")) crack.faces = read_faces(*faces);
  if (const auto traction = map.find("traction")) crack.traction = read_traction_name(*traction, cracks.laws);
  if (const auto traction = map.find("traction_of_growth")) {
    crack.traction_of_growth = read_traction_name(*traction, cracks.laws);
  }
  check_tractions(map, crack);
  return crack;
}

}  // namespace mpm
