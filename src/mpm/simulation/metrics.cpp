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

double statistic_of(const Simulation& simulation, const MetricDefinition& metric, std::vector<double>& values) {
  if (const int body = simulation.find_body(metric.body); body >= 0) return simulation.body_value(body, metric.field);
  simulation.particle_field(metric.field, values);
  const auto [first, last] = metric.body.empty() ? std::pair<std::uint64_t, std::uint64_t>{0, values.size()}
                                                 : simulation.body_ids(metric.body);
  const auto begin = values.begin() + first, end = values.begin() + last;
  const auto count = static_cast<double>(last - first);
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

void Simulation::sample_metrics() {
  State& s = *state_;
  const double now = 1e-9 * static_cast<double>(s.time);
  std::vector<double> values;
  for (std::size_t m = 0; m < s.definition.metrics.size(); ++m) {
    const MetricDefinition& metric = s.definition.metrics[m];
    // A sync point on the edge of the window is in it, round-off or not.
    if (!metric.rate || now < metric.rate->from - 1e-12 || now > metric.rate->to + 1e-12) continue;
    s.rates[m].add(now, statistic_of(*this, metric, values));
  }
}

std::vector<std::pair<std::string, double>> Simulation::metrics() const {
  std::vector<std::pair<std::string, double>> list;
  std::vector<double> values;
  for (std::size_t m = 0; m < state_->definition.metrics.size(); ++m) {
    const MetricDefinition& metric = state_->definition.metrics[m];
    list.emplace_back(metric.name, metric.rate ? state_->rates[m].slope() : statistic_of(*this, metric, values));
  }
  return list;
}

}  // namespace mpm
