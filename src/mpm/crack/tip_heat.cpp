#include "mpm/crack/tip_heat.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {

int heated_steps(double growth, double wave_speed, double step) {
  constexpr double kRoundOff = 1e-12;  ///< so that five steps of a fifth are five
  constexpr double kMost = 1e9;
  return static_cast<int>(std::clamp(std::floor(growth / (wave_speed * step) * (1.0 + kRoundOff)), 1.0, kMost));
}

void TipHeat::add(double part, double release_rate, double front, double growth, int steps) {
  left_ += part * release_rate * front * growth;
  steps_ = std::max(steps_, steps);
}

double TipHeat::take(double step) {
  if (steps_ == 0) return 0.0;
  const double heat = left_ / steps_;
  left_ = --steps_ == 0 ? 0.0 : left_ - heat;
  return heat / step;
}

void TipHeat::serialise(StateArchive& archive) {
  archive.value("left", left_);
  archive.value("steps", steps_);
}

}  // namespace mpm
