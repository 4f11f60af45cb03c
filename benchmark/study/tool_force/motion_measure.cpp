#include "study/tool_force/motion_measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mpm::study::tool_force {
namespace {

constexpr double kTooFast = 0.2;  // part of the speed of an elastic wave
constexpr double kSlower = 0.97;  // part of the particles that are slower than what falls

}  // namespace

void compare(double value, ForceRow& row) {
  const Bounds& answer = row.answer;
  row.force = value;
  row.over_exact = value / answer.upper;
  row.error = value > answer.upper   ? value / answer.upper - 1.0
              : value < answer.lower ? 1.0 - value / answer.lower
                                     : 0.0;
}

void check_speed(const Simulation& simulation, double wave_speed, std::vector<double>& values) {
  simulation.particle_field("speed", values);
  const double fastest = *std::max_element(values.begin(), values.end());
  if (fastest < kTooFast * wave_speed) return;
  throw PhysicsError(
      fmt::format("blown up: a particle moves at {:.3g} m/s, and an elastic wave at {:.3g} m/s", fastest, wave_speed));
}

double mean_velocity(const Simulation& simulation, std::vector<double>& values) {
  simulation.particle_field("vx", values);
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

void SeriesMeasure::look(Simulation& simulation) {
  check_speed(simulation, problem_.wave_speed, scratch_);
  const double time = seconds_of(simulation.time()), value = read_(simulation);
  if (time < problem_.from) return;
  time_.push_back(time);
  value_.push_back(value);
}

void SeriesMeasure::report(ForceRow& row) const {
  if (!done()) return;
  const double count = static_cast<double>(time_.size());
  const double mean = std::accumulate(value_.begin(), value_.end(), 0.0) / count;
  if (kind_ == Kind::mean) {
    compare(mean, row);
    for (std::size_t i = 0; i < time_.size(); ++i) row.curve.emplace_back(time_[i], value_[i] / row.answer.upper);
    return;
  }
  const double middle = std::accumulate(time_.begin(), time_.end(), 0.0) / count;
  double product = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < time_.size(); ++i) {
    product += (time_[i] - middle) * (value_[i] - mean);
    squares += (time_[i] - middle) * (time_[i] - middle);
  }
  compare(product / squares, row);
}

void CollapseMeasure::look(Simulation& simulation) {
  check_speed(simulation, problem_.wave_speed, scratch_);
  const auto rank = scratch_.begin() + static_cast<std::ptrdiff_t>(kSlower * static_cast<double>(scratch_.size()));
  std::nth_element(scratch_.begin(), rank, scratch_.end());
  last_time_ = seconds_of(simulation.time());
  last_speed_ = *rank;
  curve_.emplace_back(rate_ * last_time_ / problem_.answer.upper, last_speed_);
}

void CollapseMeasure::report(ForceRow& row) const {
  row.curve = curve_;
  if (done()) compare(rate_ * last_time_, row);
}

}  // namespace mpm::study::tool_force
