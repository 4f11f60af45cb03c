// The numbers of the summary: statistics of particle fields, or numbers of a rigid body, at the end of the run or their
// rate of change over a part of it.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mpm/math/nearest.hpp"
#include "state.hpp"

namespace mpm {
namespace {

/// Leaves the values of particles [first, last) whose centres are in the region.
void keep_inside(const Simulation& simulation, const Box& region, std::uint64_t first, std::uint64_t last,
                 std::vector<double>& values) {
  std::array<std::vector<double>, 3> places;
  for (int axis = 0; axis < 3; ++axis) {
    static constexpr std::array<const char*, 3> kPlaces = {"x", "y", "z"};
    simulation.particle_field(kPlaces.at(axis), places.at(axis));
  }
  if (values.empty()) return;  // on another rank than the first
  std::size_t kept = 0;
  for (std::uint64_t p = first; p < last; ++p) {
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

/// Over several ranks it is known on the first alone.
double statistic_of(const Simulation& simulation, const MetricDefinition& metric, std::vector<double>& values) {
  if (!metric.number.empty()) return reported(simulation, metric);
  if (const int body = simulation.find_body(metric.body); body >= 0) return simulation.body_value(body, metric.field);
  simulation.particle_field(metric.field, values);
  const auto [first, last] = metric.body.empty() ? std::pair<std::uint64_t, std::uint64_t>{0, values.size()}
                                                 : simulation.body_ids(metric.body);
  if (metric.region) keep_inside(simulation, *metric.region, first, last, values);
  if (simulation.ranks() != nullptr && !simulation.ranks()->first()) return 0.0;
  const auto begin = metric.region ? values.begin() : values.begin() + first;
  const auto end = metric.region ? values.end() : values.begin() + last;
  if (begin == end) return std::numeric_limits<double>::quiet_NaN();
  const auto count = static_cast<double>(end - begin);
  if (metric.statistic == Statistic::min) return *std::min_element(begin, end);
  if (metric.statistic == Statistic::max) return *std::max_element(begin, end);
  double mean = 0.0;
  for (auto it = begin; it != end; ++it) mean += *it;
  mean /= count;
  if (metric.statistic == Statistic::mean) return mean;
  double squares = 0.0;
  for (auto it = begin; it != end; ++it) squares += (*it - mean) * (*it - mean);
  return std::sqrt(squares / count);
}

}  // namespace

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

const std::vector<std::string>& Simulation::body_values() {
  static const std::vector<std::string> kNames = {"x",  "y",  "z",  "vx",        "vy",        "vz",
                                                  "wx", "wy", "wz", "impulse_x", "impulse_y", "impulse_z"};
  return kNames;
}

double Simulation::body_value(int body, const std::string& name) const {
  const auto& names = body_values();
  const auto place = std::find(names.begin(), names.end(), name) - names.begin();
  const RigidBody& rigid = rigid_body(body);
  const Vec3 impulse = -state_->impulse("contact/" + rigid.name());
  const std::array<const Vec3*, 4> vectors = {&rigid.pose().position, &rigid.twist().linear, &rigid.twist().angular,
                                              &impulse};
  if (place == static_cast<std::ptrdiff_t>(names.size())) {
    throw DefinitionError(
        fmt::format("rigid body '{}' has no number '{}'; {}", rigid.name(), name, suggest(name, names)));
  }
  return (*vectors[place / 3])[place % 3];
}

std::vector<NamedNumber> Simulation::numbers() const { return state_->numbers(); }

void Simulation::sample_metrics() {
  State& s = *state_;
  const double now = 1e-9 * static_cast<double>(s.time);
  std::vector<double> values;
  for (std::size_t m = 0; m < s.definition.metrics.size(); ++m) {
    const MetricDefinition& metric = s.definition.metrics[m];
    if (metric.at && s.rates[m].count() == 0 && now >= *metric.at - 1e-12) {
      s.rates[m].add(now, s.from_first(statistic_of(*this, metric, values)));
    }
    // A sync point on the edge of the window is in it, round-off or not.
    if (!metric.rate || now < metric.rate->from - 1e-12 || now > metric.rate->to + 1e-12) continue;
    s.rates[m].add(now, s.from_first(statistic_of(*this, metric, values)));
  }
}

std::vector<std::pair<std::string, double>> Simulation::metrics() const {
  std::vector<std::pair<std::string, double>> list;
  std::vector<double> values;
  for (std::size_t m = 0; m < state_->definition.metrics.size(); ++m) {
    const MetricDefinition& metric = state_->definition.metrics[m];
    const LineFit& over_time = state_->rates[m];
    double value = 0.0;
    if (metric.rate) {
      value = over_time.slope();
    } else if (metric.at && over_time.count() > 0) {
      value = over_time.mean();
    } else {
      value = state_->from_first(statistic_of(*this, metric, values));
    }
    list.emplace_back(metric.name, value);
  }
  return list;
}

}  // namespace mpm
