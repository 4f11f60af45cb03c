// A map of where a method works: methods across, a parameter up, and in each cell whether the run held. Beside the
// cells each method has the value at which it was measured to break and the one that theory gives.
//
//   Map map("Courant number", {0.5, 1.0, 1.5});
//   map.column("dirac", {Outcome::stable, Outcome::stable, Outcome::fails}).breaks_at(1.31).theory(1.3066);
//   page.figure().panel("Free block", "", "").map(map);
#pragma once

#include <list>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace verification {

/// Of a run: it held, it broke, the solver refuses the combination, or it was not tried.
enum class Outcome { fails, stable, impossible, not_tried };

class MapColumn {
 public:
  MapColumn(const std::string& method, const std::vector<Outcome>& cells) {
    json_ = {{"method", method}, {"cells", nlohmann::json::array()}, {"breaks", nullptr}, {"theory", nullptr}};
    for (const Outcome cell : cells) json_["cells"].push_back(static_cast<int>(cell));
  }
  /// Where the method was found to break, in the parameter's unit.
  MapColumn& breaks_at(double value) { return set("breaks", value); }
  /// Where theory says that it breaks.
  MapColumn& theory(double value) { return set("theory", value); }
  /// A short text above the column: what is true of the method at any value.
  MapColumn& note(const std::string& text) {
    json_["note"] = text;
    return *this;
  }
  const nlohmann::json& json() const { return json_; }

 private:
  MapColumn& set(const char* key, double value) {
    json_[key] = value;
    return *this;
  }
  nlohmann::json json_;
};

class Map {
 public:
  /// `rows`: values of the parameter, ascending.
  Map(const std::string& parameter, std::vector<double> rows) : rows_(std::move(rows)) {
    json_ = {{"parameter", parameter}, {"rows", rows_}};
  }
  /// One outcome a row.
  MapColumn& column(const std::string& method, const std::vector<Outcome>& cells) {
    columns_.emplace_back(method, cells);
    return columns_.back();
  }
  /// A method that the solver refuses.
  MapColumn& impossible(const std::string& method) {
    return column(method, std::vector<Outcome>(rows_.size(), Outcome::impossible));
  }
  const std::vector<double>& rows() const { return rows_; }
  nlohmann::json json() const {
    nlohmann::json json = json_;
    json["columns"] = nlohmann::json::array();
    for (const MapColumn& column : columns_) json["columns"].push_back(column.json());
    return json;
  }

 private:
  std::vector<double> rows_;
  nlohmann::json json_;
  std::list<MapColumn> columns_;  // references to columns stay good
};

}  // namespace verification
