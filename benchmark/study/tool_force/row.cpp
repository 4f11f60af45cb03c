#include "study/tool_force/row.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "mpm/math/json_text.hpp"

namespace mpm::study::tool_force {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kKnown[] = {"exact", "bounds", "estimate"};

std::string cell(double value, const char* pattern) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(pattern), value) : "-";
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json of_row(const ForceRow& row) {
  Json json;
  json["problem"] = row.problem;
  json["cells"] = row.cells;
  json["variant"] = row.variant;
  json["status"] = row.status;
  json["message"] = row.message;
  json["contact"] = row.contact;
  json["shape"] = row.shape;
  json["update"] = row.update;
  json["transfer"] = row.transfer;
  json["law"] = row.law;
  json["average_dilatation"] = row.average_dilatation;
  json["particles"] = row.particles;
  json["steps"] = row.steps;
  json["force"] = number(row.force);
  json["over_exact"] = number(row.over_exact);
  json["places"] = row.places;
  json["spread"] = number(row.spread);
  json["error"] = number(row.error);
  json["lift"] = number(row.lift);
  json["ripple"] = number(row.ripple);
  json["scatter"] = number(row.scatter);
  json["unloaded"] = number(row.unloaded);
  json["imbalance"] = number(row.imbalance);
  json["cpu_seconds"] = number(row.cpu_seconds);
  json["real_time_factor"] = number(row.real_time_factor);
  json["curve"] = row.curve;
  return json;
}

}  // namespace

std::string table_header() {
  return fmt::format("{:<20}{:>6}{:>9}{:>8}{:>8}{:>8}{:>8}{:>9}{:>9}{:>8}{:>9}{:>8}{:>8}  {}", "problem", "cells",
                     "F/exact", "spread", "error", "lift", "ripple", "scatter", "unloaded", "energy", "cpu [s]", "rtf",
                     "steps", "variant");
}

std::string table_line(const ForceRow& row) {
  std::string line =
      fmt::format("{:<20}{:>6g}{:>9}{:>8}{:>8}{:>8}{:>8}{:>9}{:>9}{:>8}{:>9}{:>8}{:>8}  {}", row.problem, row.cells,
                  cell(row.over_exact, "{:.3f}"), cell(row.spread, "{:.3f}"), cell(row.error, "{:.3f}"),
                  cell(row.lift, "{:.3f}"), cell(row.ripple, "{:.3f}"), cell(row.scatter, "{:.3f}"),
                  cell(row.unloaded, "{:.3f}"), cell(row.imbalance, "{:.3f}"), cell(row.cpu_seconds, "{:.3g}"),
                  cell(row.real_time_factor, "{:.3g}"), row.steps, row.variant);
  if (row.status != "ok") line += fmt::format("  {}: {}", row.status, row.message);
  return line;
}

void write_json(std::ostream& out, const std::vector<ForceRow>& rows) {
  Json json;
  for (const Problem& problem : problems()) {
    Json one;
    one["name"] = problem.name;
    one["title"] = problem.title;
    one["text"] = problem.text;
    one["answer"] = problem.answer_text;
    one["known"] = kKnown[static_cast<int>(problem.known)];
    one["lower"] = problem.answer.lower;
    one["upper"] = problem.answer.upper;
    one["from"] = problem.from;
    one["to"] = problem.to;
    json["problems"].push_back(one);
  }
  json["rows"] = Json::array();
  for (const ForceRow& row : rows) json["rows"].push_back(of_row(row));
  out << json_text(json, 1) << '\n';
}

}  // namespace mpm::study::tool_force
