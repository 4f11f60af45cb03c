// A map of where methods work: methods across, a parameter upwards, and in each cell the outcome of the run. Beside its
// cells each method has the value at which it was measured to break and the value that theory gives.
//
//   Map map("Courant number", {0.5, 1.0, 1.5});
//   map.column("dirac", {Outcome::stable, Outcome::stable, Outcome::fails}).breaks_at(1.31).theory(1.3066);
//   page.figure().panel("Free block", "", "").map(map);
#pragma once

#include <list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace verification {

/// Outcome of a run: it failed, it was stable, the solver refuses the combination, or it was not tried.
enum class Outcome { fails, stable, impossible, not_tried };

class MapColumn {
 public:
  MapColumn(std::string method, std::vector<Outcome> cells) : method_(std::move(method)), cells_(std::move(cells)) {}
  /// The value at which the method was measured to break, in the parameter's unit.
  MapColumn& breaks_at(double value) {
    breaks_ = value;
    return *this;
  }
  /// The value at which the method breaks by theory, in the parameter's unit.
  MapColumn& theory(double value) {
    theory_ = value;
    return *this;
  }
  /// A short text above the column about the method at any value.
  MapColumn& note(const std::string& text) {
    note_ = text;
    return *this;
  }
  nlohmann::json json() const;

 private:
  std::string method_, note_;
  std::vector<Outcome> cells_;
  std::optional<double> breaks_, theory_;
};

class Map {
 public:
  /// `rows`: values of the parameter, ascending.
  Map(std::string parameter, std::vector<double> rows);
  /// Adds a column with one outcome for each row.
  MapColumn& column(const std::string& method, const std::vector<Outcome>& cells);
  /// Adds the column of a method that the solver refuses.
  MapColumn& impossible(const std::string& method);
  const std::vector<double>& rows() const { return rows_; }
  nlohmann::json json() const;

 private:
  std::string parameter_;
  std::vector<double> rows_;
  std::list<MapColumn> columns_;  // a list, so that references to columns stay valid
};

}  // namespace verification
