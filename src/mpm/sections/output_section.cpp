// time and output: the end, the step's limits, sync points and snapshots.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "mpm/math/nearest.hpp"
#include "mpm/rules/section_keys.hpp"
#include "mpm/sections/section_tables.hpp"
#include "mpm/sections/sections.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace {

constexpr double kLongest = 1e9;                // [s], 32 years; 64 bits of nanoseconds last 292 years
constexpr std::int64_t kMostSync = 10'000'000;  // [ns], the longest that a command waits by default

/// Reads a time of whole nanoseconds.
std::int64_t read_nanoseconds(const Value& value) {
  const double time = value.positive(kTime);
  if (time > kLongest) value.fail(fmt::format("{:g} s is longer than {:g} s; write a shorter time", time, kLongest));
  const double exact = time / kNanosecond;
  const double whole = std::round(exact);
  // Within a hundred-thousandth of a nanosecond, or the last digits of a double.
  if (whole < 1.0 || std::abs(exact - whole) > std::max(1e-5, 1e-12 * exact)) {
    value.fail(fmt::format("{:.12g} s is not a whole number of nanoseconds; write {:.12g} s", time,
                           std::max(1.0, whole) * kNanosecond));
  }
  return static_cast<std::int64_t>(whole);
}

/// The largest of 1, 2, 5 times a power of ten that is not above `limit`.
std::int64_t round_down(double limit) {
  std::int64_t best = 1;
  for (std::int64_t power = 1; static_cast<double>(power) <= limit; power *= 10) {
    for (const std::int64_t digit : {1, 2, 5}) {
      if (static_cast<double>(digit * power) <= limit) best = digit * power;
    }
  }
  return best;
}

/// The largest period that divides `period` and is not above `limit` [ns], or 0 when all are far below.
std::int64_t largest_divisor(std::int64_t period, std::int64_t limit) {
  const std::int64_t fewest = (period + limit - 1) / limit;
  for (std::int64_t parts = fewest; parts <= 10 * fewest && parts <= period; ++parts) {
    if (period % parts == 0) return period / parts;
  }
  return 0;
}

void read_time(const Map& root, Scene& scene, std::optional<Value>& sync) {
  TimeDefinition& time = scene.definition.time;
  const auto section = root.find("time");
  if (!section) {
    scene.choices.emplace_back("time.end", "none: runs until it is stopped");
    return;
  }
  const Map map = read_keys(*section, time_keys(), time);
  if (!map.find("end")) scene.choices.emplace_back("time.end", "none: runs until it is stopped");
  sync = map.find("sync");
}

void choose_periods(const std::optional<Value>& sync_key, const std::optional<Value>& period_key,
                    const std::optional<Value>& first_key, Scene& scene) {
  TimeDefinition& time = scene.definition.time;
  const std::int64_t end_ns = nanoseconds_of(time.end);
  std::int64_t period = 0;
  if (period_key) {
    period = read_nanoseconds(*period_key);
  } else {
    period = time.end > 0.0 ? round_down(static_cast<double>(end_ns) / 50.0) : 20'000'000;
  }
  const std::int64_t first = first_key ? read_nanoseconds(*first_key) : 0;
  if (sync_key) {
    time.sync = read_nanoseconds(*sync_key);
    if (first % time.sync != 0) {
      first_key->fail(fmt::format("{:.9g} s is not a whole number of sync periods of {:.9g} s; write {:.12g} s",
                                  nearest_seconds(first), nearest_seconds(time.sync),
                                  nearest_seconds((first + time.sync - 1) / time.sync * time.sync)));
    }
    if (period % time.sync != 0) {
      const std::int64_t parts = std::max<std::int64_t>(1, (period + time.sync / 2) / time.sync);
      if (period_key) {
        period_key->fail(fmt::format("{:.9g} s is not a whole number of sync periods of {:.9g} s; write {:.12g} s",
                                     nearest_seconds(period), nearest_seconds(time.sync),
                                     nearest_seconds(parts * time.sync)));
      }
      period = parts * time.sync;
    }
  } else {
    std::int64_t limit = std::min(kMostSync, period);
    if (time.end > 0.0) limit = std::min(limit, std::max<std::int64_t>(1, end_ns / 100));
    const std::int64_t shared = std::gcd(period, first);
    time.sync = largest_divisor(shared, std::min(limit, shared));
    if (time.sync > 0 && 100 * time.sync < limit) {
      first_key->fail(
          fmt::format("{:.12g} s and the period of {:.12g} s share no sync period of about {:.9g} s; write "
                      "times that are multiples of one",
                      nearest_seconds(first), nearest_seconds(period), nearest_seconds(limit)));
    }
    if (time.sync == 0) {
      period_key->fail(fmt::format("{:.12g} s cannot be divided into sync periods of about {:.9g} s; write {:.12g} s",
                                   nearest_seconds(period), nearest_seconds(limit),
                                   nearest_seconds(round_down(static_cast<double>(period)))));
    }
    scene.choices.emplace_back(
        "time.sync",
        fmt::format("{:.9g} s: the largest period up to {:.9g} s that divides output.period{}",
                    nearest_seconds(time.sync), nearest_seconds(limit), first > 0 ? " and output.first" : ""));
  }
  if (!period_key) {
    scene.choices.emplace_back("output.period", fmt::format("{:.9g} s{}", nearest_seconds(period),
                                                            time.end > 0.0 ? ": 50 to 125 snapshots to the end" : ""));
  }
  scene.output.period = nearest_seconds(period);
  scene.output.period_chosen = !period_key;
  scene.output.first = nearest_seconds(first);
}

/// Reads a quantity by its name, or {quantity: NAME, body: NAME}.
GlobalQuantity read_global_quantity(const Value& value, const Scene& scene) {
  GlobalQuantity quantity;
  if (!value.is_map()) {
    quantity.name = value.text();
    if (const std::string problem = problem_of(quantity); !problem.empty()) value.fail(problem);
    return quantity;
  }
  const Map map(value, {"quantity", "body"});
  const Value name = map.at("quantity");
  quantity.name = name.text();
  if (const auto body = map.find("body")) {
    quantity.body = body->text();
    const bool rigid = of_rigid_body(quantity);
    std::vector<std::string> names;
    if (rigid) {
      for (const RigidBodyDefinition& one : scene.definition.rigid_bodies) names.push_back(one.name);
    } else {
      for (const BodyDefinition& one : scene.bodies) names.push_back(one.name);
    }
    if (std::find(names.begin(), names.end(), quantity.body) == names.end()) {
      body->fail(fmt::format("no {} body '{}'; {}", rigid ? "rigid" : "deformable", quantity.body,
                             suggest(quantity.body, names)));
    }
  }
  if (const std::string problem = problem_of(quantity); !problem.empty()) name.fail(problem);
  return quantity;
}

void read_global(const Map& map, Scene& scene) {
  if (const auto list = map.find("global")) {
    for (const Value& one : list->elements()) scene.output.global.push_back(read_global_quantity(one, scene));
  }
  const auto period = map.find("global_period");
  if (!period) return;
  if (scene.output.global.empty()) period->fail("there is no output.global whose period this is; add a list of names");
}

}  // namespace

double read_sync_periods(const Value& value, const Scene& scene) {
  const std::int64_t time = read_nanoseconds(value), sync = scene.definition.time.sync;
  if (time % sync == 0) return nearest_seconds(time);
  const std::int64_t parts = std::max<std::int64_t>(1, (time + sync / 2) / sync);
  value.fail(fmt::format("{:.9g} s is not a whole number of sync periods of {:.9g} s; write {:.12g} s",
                         nearest_seconds(time), nearest_seconds(sync), nearest_seconds(parts * sync)));
}

Box read_particle_region(const Value& value) {
  const Map map(value, {"min", "max"});
  const Box box{map.at("min").vector(kLength), map.at("max").vector(kLength)};
  if (box.empty()) value.fail("max is below min along an axis; write the lower corner as min");
  return box;
}

std::string read_particle_field(const Value& value) {
  const std::string field = value.text();
  std::vector<std::string> names;
  for (const auto& [name, unit] : Simulation::particle_fields()) names.push_back(name);
  if (std::find(names.begin(), names.end(), field) == names.end()) {
    value.fail(fmt::format("no particle field '{}'; {}", field, suggest(field, names)));
  }
  return field;
}

void read_time_and_output(const Map& root, Scene& scene) {
  OutputDefinition& output = scene.output;
  for (const int axis : axes_of(scene)) output.particle_fields.push_back(std::string("v") + axis_name(axis));
  output.particle_fields.insert(output.particle_fields.end(), {"p", "j"});
  std::optional<Value> sync, period, first;
  read_time(root, scene, sync);
  std::optional<Value> global_period, ground;
  if (const auto section = root.find("output")) {
    const Map map = read_keys(*section, output_keys(), output);
    period = map.find("period");
    first = map.find("first");
    if (const auto fields = map.find("particle_fields")) {
      output.particle_fields.clear();
      for (const Value& field : fields->elements()) output.particle_fields.push_back(read_particle_field(field));
    }
    if (const auto region = map.find("particle_region")) output.particle_region = read_particle_region(*region);
    read_global(map, scene);
    global_period = map.find("global_period");
    ground = map.find("terrain");
  }
  choose_periods(sync, period, first, scene);
  if (global_period) scene.output.global_period = read_sync_periods(*global_period, scene);
  if (ground) read_ground_output(*ground, scene);
}

}  // namespace mpm
