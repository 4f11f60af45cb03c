#include "mpm_ros/report/report_json.hpp"

#include <nlohmann/json.hpp>

#include "mpm/math/nanoseconds.hpp"
#include "mpm_ros/message/audit_limit.hpp"
#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/quantities.hpp"
#include "mpm_ros/report/report_robots.hpp"

namespace mpm_ros {
namespace {

using Json = nlohmann::ordered_json;

Json array(const mpm::Vec3& vector) { return {vector.x() + 0.0, vector.y() + 0.0, vector.z() + 0.0}; }  // no -0

/// First and last time, or null.
Json span(const std::optional<std::pair<std::int64_t, std::int64_t>>& contact) {
  if (!contact) return nullptr;
  return {mpm::nearest_seconds(contact->first), mpm::nearest_seconds(contact->second)};
}

/// The figures of a contact, each under the key that its line in quantities.cpp gives it.
Json contact_json(const ContactStatistics& known) {
  Json json = Json::object();
  for (const NumberStatistics& number : known.numbers) {
    const auto plain = [&number](const mpm::Vec3& value) { return number.vector ? array(value) : Json(value.x()); };
    for (const Figure& figure : number.figures) {
      if (figure.key.empty()) continue;
      if (figure.of == Figure::Of::peak) json[figure.key] = json_of(number.peak);
      if (figure.of == Figure::Of::largest) json[figure.key] = number.peak.norm;
      if (figure.of == Figure::Of::mean) json[figure.key] = plain(known.mean(number));
      if (figure.of == Figure::Of::end) json[figure.key] = plain(number.end);
    }
  }
  json["contact"] = span(known.contact);
  return json;
}

Json body_json(const BodyStatistics& body) {
  Json json = contact_json(body);
  if (body.first) {
    json["position"] = {{"start", array(body.first->position)},
                        {"end", array(body.last.position)},
                        {"min", array(body.range.min)},
                        {"max", array(body.range.max)}};
    json["largest_turn"] = body.largest_turn;
  }
  return json;
}

Json energy_json(const SolverState& state) {
  Json json;
  for (const EnergyFigure& energy : energies_of(state)) json[energy.key] = energy.value;
  return json;
}

Json audit_json(const RecordedRun& run) {
  const SolverState& last = run.statistics.last_state();
  Json impulses = Json::object();
  mpm::Vec3 sum = mpm::Vec3::Zero();
  for (const Impulse& impulse : last.impulses) {
    impulses[impulse.name] = array(from_message(impulse.impulse));
    sum += from_message(impulse.impulse);
  }
  const mpm::Vec3 change = from_message(last.momentum) - from_message(last.initial_momentum);
  return {{"impulses", impulses},
          {"sum", array(sum)},
          {"change", array(change)},
          {"exchanged", last.momentum_exchanged},
          {"residual", last.momentum_error},
          {"worst_residual", run.statistics.worst_audit()},
          {"limit", audit_limit(run.scene.precision)}};
}

}  // namespace

Json json_of(const Extreme& value) {
  return {{"size", value.norm}, {"time", mpm::nearest_seconds(value.time)}, {"vector", array(value.vector)}};
}

Json report_json(const RecordedRun& run) {
  const RunStatistics& statistics = run.statistics;
  const SolverState& last = statistics.last_state();
  Json json;
  json["schema"] = kReportSchema;
  json["bag"] = run.path;
  json["label"] = run.label;
  json["namespace"] = run.name_space;
  json["scene"] = run.scene_name();
  json["method"] = run.scene.method;
  json["version"] = run.info ? run.info->version : "";
  json["isa"] = run.info ? run.info->isa : "";
  json["duration"] = last.time;
  json["end"] = run.scene.end ? Json(*run.scene.end) : Json(nullptr);
  json["steps"] = last.steps;
  json["dt"] = {{"min", last.dt_min},
                {"max", last.dt_max},
                {"last", last.dt},
                {"courant", last.courant},
                {"limited_by", last.dt_limited_by}};
  json["real_time_factor"] = last.real_time_factor;
  json["particles"] = last.particles;
  json["returned"] = last.particles_returned;
  json["min_j"] = statistics.smallest_j();
  json["min_j_end"] = last.min_j;
  json["state_hash"] = last.state_hash;
  json["failed"] = static_cast<bool>(last.failed);
  json["failure"] = last.failure;
  json["energy"] = {{"start", energy_json(*statistics.first_state())}, {"end", energy_json(last)}};
  json["audit"] = audit_json(run);
  json["bodies"] = Json::object();
  for (const BodyStatistics& body : statistics.body_statistics()) json["bodies"][body.name] = body_json(body);
  json["contact_pairs"] = Json::object();
  for (const ContactStatistics& pair : statistics.pair_statistics()) {
    json["contact_pairs"][pair.name] = contact_json(pair);
  };
  json["robots"] = robots_json(statistics.robot_statistics());
  json["global_quantities"] = Json::object();
  for (const GlobalStatistics& one : statistics.global_statistics()) {
    json["global_quantities"][one.name] = {
        {"unit", one.unit}, {"start", one.first}, {"end", one.last}, {"min", one.least}, {"max", one.most}};
  }
  json["commands"] = Json::array();
  for (const auto& [key, value] : statistics.commands()) {
    json["commands"].push_back({{"body", key.first},
                                {"kind", key.second},
                                {"applied", value.count},
                                {"first", mpm::nearest_seconds(value.first)},
                                {"last", mpm::nearest_seconds(value.last)},
                                {"late", value.late}});
  }
  const std::vector<std::int64_t>& snapshots = statistics.snapshots();
  json["snapshots"] = {
      {"count", snapshots.size()}, {"first", nullptr}, {"last", nullptr}, {"fields", run.particle_fields}};
  if (!snapshots.empty()) {
    json["snapshots"]["first"] = mpm::nearest_seconds(snapshots.front());
    json["snapshots"]["last"] = mpm::nearest_seconds(snapshots.back());
  }
  json["gaps"] = run.gaps;
  json["notes"] = run.notes;
  json["checks"] = Json::array();
  for (const CheckResult& check : run.checks) {
    json["checks"].push_back({{"name", check.name},
                              {"result", !check.made ? "not made" : (check.passed ? "ok" : "failed")},
                              {"detail", check.detail}});
  }
  return json;
}

Json report_json(const std::vector<RecordedRun>& runs) {
  if (runs.size() == 1) return report_json(runs.front());
  Json json;
  json["schema"] = kReportSchema;
  json["runs"] = Json::array();
  for (const RecordedRun& run : runs) json["runs"].push_back(report_json(run));
  return json;
}

}  // namespace mpm_ros
