// The numbers of the summary: statistics of particle fields, or numbers of a rigid body, at the end of the run, or
// their rate of change or mean over a part of it; and formulas of those.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "mpm/math/nearest.hpp"
#include "mpm/ranks/of_all.hpp"
#include "state.hpp"

namespace mpm {
namespace {

/// Reads fields of particles as Simulation::read_fields().
using Read = std::function<void(const std::vector<std::string>&, std::vector<std::vector<double>>&)>;

/// Leaves the values of rows [first, last) whose particles' centres are in the region.
void keep_inside(const Read& read, const Box& region, std::size_t first, std::size_t last,
                 std::vector<double>& values) {
  std::vector<std::vector<double>> places;
  read({"x", "y", "z"}, places);
  std::size_t kept = 0;
  for (std::size_t p = first; p < last; ++p) {
    if (region.contains({places[0][p], places[1][p], places[2][p]})) values[kept++] = values[p];
  }
  values.resize(kept);
}

double reported(const Simulation& simulation, const MetricDefinition& metric) {
  for (const NamedNumber& number : simulation.numbers()) {
    if (number.name == metric.number) return number.value;
  }
  throw DefinitionError(fmt::format("metrics.{}: the run has no number '{}'; name another, or what would report it",
                                    metric.name, metric.number));
}

/// Statistic of numbers of which each rank has some. `ranks`: null for a process that is alone. Not a number of none.
double statistic(Statistic which, const double* begin, const double* end, Communicator* ranks) {
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  if (which == Statistic::sum) return sum_of_all(ranks, std::accumulate(begin, end, 0.0));
  const double count = sum_of_all(ranks, static_cast<double>(end - begin));
  if (count == 0.0) return std::numeric_limits<double>::quiet_NaN();
  if (which == Statistic::min) return -largest_of_all(ranks, begin == end ? kNone : -*std::min_element(begin, end));
  if (which == Statistic::max) return largest_of_all(ranks, begin == end ? kNone : *std::max_element(begin, end));
  double mean = 0.0;
  for (const double* it = begin; it != end; ++it) mean += *it;
  mean = sum_of_all(ranks, mean) / count;
  if (which == Statistic::mean) return mean;
  double squares = 0.0;
  for (const double* it = begin; it != end; ++it) squares += (*it - mean) * (*it - mean);
  return std::sqrt(sum_of_all(ranks, squares) / count);
}

/// Value by the metrics before it; not a number where one of them is none, or the result is not finite.
double value_of_formula(const MetricDefinition& metric, const std::vector<std::pair<std::string, double>>& before) {
  NamedConstants names = metric.constants;
  for (const auto& [name, value] : before) {
    if (meaning_in_expressions(name).empty()) names.emplace_back(name, value);
  }
  try {
    return Function::parse(metric.formula, {}, FunctionPlaces::present, names)(0.0);
  } catch (const FunctionError&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

double Simulation::statistic_of(const MetricDefinition& metric, std::vector<double>& values) const {
  if (!metric.number.empty()) return reported(*this, metric);
  if (const int body = find_body(metric.body); body >= 0) return body_value(body, metric.field);
  const Read read = [this](const std::vector<std::string>& names, std::vector<std::vector<double>>& columns) {
    read_fields(names, columns);
  };
  std::vector<std::vector<double>> columns(1);
  columns.front().swap(values);
  read({metric.field}, columns);
  values.swap(columns.front());
  const auto ids =
      metric.body.empty() ? std::pair<std::uint64_t, std::uint64_t>{0, particles()} : body_ids(metric.body);
  auto [first, last] = state_->rows_of(ids.first, ids.second);
  if (metric.region) {
    keep_inside(read, *metric.region, first, last, values);
    first = 0;
    last = values.size();
  }
  return statistic(metric.statistic, values.data() + first, values.data() + last, state_->ranks.get());
}

void LineFit::add(double t, double y) {
  // Updated means (Welford): no difference of large sums.
  ++count_;
  const double step = t - mean_t_;
  mean_t_ += step / count_;
  mean_y_ += (y - mean_y_) / count_;
  tt_ += step * (t - mean_t_);
  ty_ += step * (y - mean_y_);
}

double LineFit::slope() const { return count_ > 1 ? ty_ / tt_ : std::numeric_limits<double>::quiet_NaN(); }

bool is_wrench(const MetricDefinition& metric) {
  return metric.field.rfind("force_", 0) == 0 || metric.field.rfind("torque_", 0) == 0;
}

const std::vector<std::string>& Simulation::body_values() {
  static const std::vector<std::string> kNames = {
      "x",         "y",         "z",       "vx",      "vy",      "vz",       "wx",       "wy",       "wz",  "impulse_x",
      "impulse_y", "impulse_z", "force_x", "force_y", "force_z", "torque_x", "torque_y", "torque_z", "mass"};
  return kNames;
}

double Simulation::body_value(int body, const std::string& name) const {
  const auto& names = body_values();
  const auto place = std::find(names.begin(), names.end(), name) - names.begin();
  const RigidBody& rigid = rigid_body(body);
  if (place == static_cast<std::ptrdiff_t>(names.size())) {
    throw DefinitionError(
        fmt::format("rigid body '{}' has no number '{}'; {}", rigid.name(), name, suggest(name, names)));
  }
  if (name == "mass") return rigid.definition().free ? rigid.definition().free->mass : 0.0;
  const Vec3 impulse = -state_->impulse("contact/" + rigid.name());
  const auto& wrenches = state_->wrenches;
  const Wrench wrench = wrenches.empty() ? Wrench() : wrenches[static_cast<std::size_t>(body)].mean;
  const std::array<const Vec3*, 6> vectors = {
      &rigid.pose().position, &rigid.twist().linear, &rigid.twist().angular, &impulse, &wrench.force, &wrench.torque};
  return (*vectors[place / 3])[place % 3];
}

// As reports of contact have them: what was given over the time it took, torque about the origin as it moves.
void Simulation::State::find_wrenches() {
  const double now = seconds_of(time);
  const bool about_axis = axisymmetric(definition.geometry);
  for (std::size_t b = 0; b < wrenches.size(); ++b) {
    for (ContactReporter* reporter : reporters) {
      const ContactLedger* ledger = reporter->ledger_of(bodies[b]);
      if (ledger == nullptr) continue;
      const ContactSums& sums = ledger->sums();
      PeriodWrench& wrench = wrenches[b];
      if (now > wrench.time) {
        wrench.mean.force = (sums.impulse - wrench.impulse) / (now - wrench.time);
        wrench.mean.torque = (sums.angular_impulse - wrench.angular_impulse) / (now - wrench.time);
      }
      if (about_axis) wrench.mean = {Vec3(0.0, 0.0, wrench.mean.force.z()), Vec3::Zero()};
      wrench.time = now;
      wrench.impulse = sums.impulse;
      wrench.angular_impulse = sums.angular_impulse;
      break;
    }
  }
}

std::vector<NamedNumber> Simulation::numbers() const { return state_->numbers(); }

void Simulation::sample_metrics() {
  State& s = *state_;
  const double now = seconds_of(s.time);
  s.find_wrenches();
  std::vector<double> values;
  for (std::size_t m = 0; m < s.definition.metrics.size(); ++m) {
    const MetricDefinition& metric = s.definition.metrics[m];
    if (metric.over && now > metric.over->from + 1e-12 && now <= metric.over->to + 1e-12)
      s.rates[m].add(now, s.from_first(statistic_of(metric, values)));
    if (metric.at && s.rates[m].count() == 0 && now >= *metric.at - 1e-12) {
      s.rates[m].add(now, s.from_first(statistic_of(metric, values)));
    }
    // A sync point on the edge of the window is in it, round-off or not.
    if (!metric.rate || now < metric.rate->from - 1e-12 || now > metric.rate->to + 1e-12) continue;
    s.rates[m].add(now, s.from_first(statistic_of(metric, values)));
  }
}

std::vector<std::pair<std::string, double>> Simulation::metrics() const {
  std::vector<std::pair<std::string, double>> list;
  std::vector<double> values;
  for (std::size_t m = 0; m < state_->definition.metrics.size(); ++m) {
    const MetricDefinition& metric = state_->definition.metrics[m];
    const LineFit& over_time = state_->rates[m];
    double value = 0.0;
    if (!metric.formula.empty()) {
      value = value_of_formula(metric, list);
    } else if (metric.rate) {
      value = over_time.slope();
    } else if (metric.over) {
      value = over_time.count() > 0 ? over_time.mean() : std::numeric_limits<double>::quiet_NaN();
    } else if (metric.at && over_time.count() > 0) {
      value = over_time.mean();
    } else {
      value = state_->from_first(statistic_of(metric, values));
    }
    list.emplace_back(metric.name, value);
  }
  return list;
}

}  // namespace mpm
