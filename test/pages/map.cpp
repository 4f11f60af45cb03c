#include "map.hpp"

#include <nlohmann/json.hpp>
#include <utility>

namespace verification {

nlohmann::json MapColumn::json() const {
  nlohmann::json json = {
      {"method", method_}, {"cells", nlohmann::json::array()}, {"breaks", nullptr}, {"theory", nullptr}};
  for (const Outcome cell : cells_) json["cells"].push_back(static_cast<int>(cell));
  if (breaks_) json["breaks"] = *breaks_;
  if (theory_) json["theory"] = *theory_;
  if (!note_.empty()) json["note"] = note_;
  return json;
}

Map::Map(std::string parameter, std::vector<double> rows) : parameter_(std::move(parameter)), rows_(std::move(rows)) {}

MapColumn& Map::column(const std::string& method, const std::vector<Outcome>& cells) {
  columns_.emplace_back(method, cells);
  return columns_.back();
}

MapColumn& Map::impossible(const std::string& method) {
  return column(method, std::vector<Outcome>(rows_.size(), Outcome::impossible));
}

nlohmann::json Map::json() const {
  nlohmann::json json = {{"parameter", parameter_}, {"rows", rows_}, {"columns", nlohmann::json::array()}};
  for (const MapColumn& column : columns_) json["columns"].push_back(column.json());
  return json;
}

}  // namespace verification
