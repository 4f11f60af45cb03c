#include "study/tool_force/places.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>

#include "study/suite.hpp"

namespace mpm::study::tool_force {
namespace {

constexpr double kSamePlace = 1e-9;  ///< part of a cell

/// Moves the coordinate `index` of a face that lies at `from`.
void move_face(YAML::Node corner, std::size_t index, double from, double to, double cell) {
  if (std::abs(corner[index].as<double>() - from) < kSamePlace * cell) corner[index] = to;
}

/// The place of z among the numbers of a vector in the scene.
std::size_t upright(const YAML::Node& root) { return root["grid"]["min"].size() - 1; }

double mean(const std::vector<ForceRow>& rows, double ForceRow::*member) {
  double sum = 0.0;
  for (const ForceRow& row : rows) sum += row.*member;
  return sum / static_cast<double>(rows.size());
}

}  // namespace

std::string moved(const Problem& problem, const std::string& scene, const Place& place) {
  for (std::size_t axis = 0; axis < place.size(); ++axis) {
    if (!(place[axis] >= 0.0 && place[axis] < 1.0))
      throw StudyError("a place within a cell is a part of it, from 0 to below 1");
    if (place[axis] > 0.0 && !problem.has_places[axis]) {
      throw StudyError("beside: " + problem.name + " is made on rows of nodes only along " + (axis == 0 ? "x" : "z") +
                       "; write 0 there");
    }
  }
  if (place == Place{}) return scene;
  YAML::Node root = YAML::Load(scene);
  YAML::Node grid = root["grid"];
  const double cell = grid["cell"].as<double>();
  for (std::size_t k = 0; k < place.size(); ++k) {
    if (place[k] == 0.0) continue;
    const std::size_t index = k == 0 ? 0 : upright(root);
    const double low = grid["min"][index].as<double>(), high = grid["max"][index].as<double>();
    const double lower = low - place[k] * cell, higher = high + (1.0 - place[k]) * cell;
    for (YAML::Node body : root["bodies"]) {
      YAML::Node box = body["shape"]["box"];
      move_face(box["min"], index, low, lower, cell);
      move_face(box["max"], index, high, higher, cell);
    }
    grid["min"][index] = lower;
    grid["max"][index] = higher;
  }
  return YAML::Dump(root);
}

std::vector<Place> five_places(const Problem& problem) {
  const auto [along_x, along_z] = problem.has_places;
  if (along_x && along_z) return {{0.0, 0.0}, {0.0, 0.25}, {0.0, 0.5}, {0.0, 0.75}, {0.5, 0.5}};
  std::vector<Place> places = {{0.0, 0.0}};
  for (const double part : {0.2, 0.4, 0.6, 0.8}) {
    if (along_x) places.push_back({part, 0.0});
    if (along_z) places.push_back({0.0, part});
  }
  return places;
}

ForceRow mean_of(const std::vector<ForceRow>& rows) {
  for (const ForceRow& row : rows) {
    if (row.status != "ok") return row;
  }
  ForceRow all = rows.front();
  all.places = static_cast<int>(rows.size());
  for (const auto member : {&ForceRow::force, &ForceRow::over_exact, &ForceRow::error, &ForceRow::lift,
                            &ForceRow::ripple, &ForceRow::scatter, &ForceRow::unloaded})
    all.*member = mean(rows, member);
  double squares = 0.0, time = 0.0, processor = 0.0;
  for (const ForceRow& row : rows) {
    squares += (row.over_exact - all.over_exact) * (row.over_exact - all.over_exact);
    if (std::abs(row.imbalance) > std::abs(all.imbalance)) all.imbalance = row.imbalance;
    processor += row.cpu_seconds;
    time += row.cpu_seconds * row.real_time_factor;
  }
  all.spread = std::sqrt(squares / static_cast<double>(rows.size()));
  all.cpu_seconds = processor;
  all.real_time_factor = time / processor;
  return all;
}

}  // namespace mpm::study::tool_force
