// The filter of wrenches against Butterworth's second order, |H|^2 = 1 / (1 + (f/fc)^4). Under the bilinear transform
// tan(pi f T) takes the place of f, which leaves the cutoff where it is.
#include "mpm_ros/message/wrench_filter.hpp"

#include <gtest/gtest.h>

#include <complex>

#include "mpm/math/constants.hpp"

namespace mpm_ros {
namespace wrench_filter_test {

using mpm::kPi;
constexpr double kPeriod = 1e-3, kCutoff = 20.0;

/// Response to a sine of that frequency [Hz] after the initial transient: the filtered signal is the real part of the
/// response times exp(i 2 pi f t). It is computed by projection over whole periods.
std::complex<double> response(double frequency) {
  WrenchFilter filter(kCutoff, kPeriod);
  const int settle = 2000, samples = 1000;  // the transient decays to exp(-sqrt(2) pi fc t) = 1e-77
  std::complex<double> sum = 0.0;
  for (int i = 0; i < settle + samples; ++i) {
    mpm::Wrench wrench;
    const double angle = 2.0 * kPi * frequency * kPeriod * i;
    wrench.force = {std::cos(angle), 0.0, 0.0};
    wrench.torque = {0.0, 2.0 * std::cos(angle), 0.0};
    const mpm::Wrench result = filter.filter(wrench);
    EXPECT_NEAR(result.torque.y(), 2.0 * result.force.x(), 1e-12);
    if (i >= settle) sum += 2.0 / samples * result.force.x() * std::polar(1.0, -angle);
  }
  return sum;
}

double gain_of(double frequency) {
  const double ratio = std::tan(kPi * frequency * kPeriod) / std::tan(kPi * kCutoff * kPeriod);
  return 1.0 / std::sqrt(1.0 + std::pow(ratio, 4));
}

TEST(WrenchFilter, IsMinusThreeDecibelAtTheCutoffAndAQuarterTurnBehind) {
  const std::complex<double> at_cutoff = response(kCutoff);
  EXPECT_NEAR(std::abs(at_cutoff), std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(std::arg(at_cutoff), -kPi / 2.0, 1e-9);
}

TEST(WrenchFilter, HasButterworthsGain) {
  for (const double frequency : {1.0, 5.0, 40.0, 200.0, 400.0}) {
    EXPECT_NEAR(std::abs(response(frequency)), gain_of(frequency), 1e-9) << frequency;
  }
}

TEST(WrenchFilter, LagsByItsDelayAtLowFrequency) {
  // The delay is sqrt(2)/(2 pi fc) = 11.25 ms; well below the cutoff the phase equals it to a relative (f/fc)^2.
  const double frequency = kCutoff / 20.0, delay = std::sqrt(2.0) / (2.0 * kPi * kCutoff);
  EXPECT_NEAR(std::arg(response(frequency)), -2.0 * kPi * frequency * delay, 2.5e-3 * 2.0 * kPi * frequency * delay);
}

TEST(WrenchFilter, ComesToAConstantForce) {
  WrenchFilter filter(kCutoff, kPeriod);
  mpm::Wrench wrench, result;
  wrench.force = {3.0, -2.0, 1.0};
  for (int i = 0; i < 1000; ++i) result = filter.filter(wrench);
  EXPECT_NEAR((result.force - wrench.force).norm(), 0.0, 1e-12);
}

}  // namespace wrench_filter_test
}  // namespace mpm_ros
