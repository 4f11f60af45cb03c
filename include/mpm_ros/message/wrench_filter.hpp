// Low-pass filter of a wrench, each component by itself: Butterworth's of second order, made digital by the bilinear
// transform with its cutoff in place (Oppenheim & Schafer, Discrete-Time Signal Processing, 7.1). Unity at rest, -3 dB
// at the cutoff, 40 dB a decade beyond; it lags by sqrt(2)/(2 pi cutoff) at low frequencies. Starts from no force.
#pragma once

#include <cmath>

#include "mpm/math/constants.hpp"
#include "mpm/math/state_archive.hpp"
#include "mpm/rigid/motion.hpp"

namespace mpm_ros {

class WrenchFilter {
 public:
  /// `cutoff` [Hz] in (0, 1/(2 period)), `period` [s] of the samples.
  WrenchFilter(double cutoff, double period) {
    const double k = std::tan(mpm::kPi * cutoff * period), scale = 1.0 / (1.0 + kRoot2 * k + k * k);
    in_ = k * k * scale;
    out1_ = 2.0 * (k * k - 1.0) * scale;
    out2_ = (1.0 - kRoot2 * k + k * k) * scale;
  }
  /// The next sample; gives the filtered one.
  mpm::Wrench filter(const mpm::Wrench& sample) {
    return {filter(sample.force, force_), filter(sample.torque, torque_)};
  }
  void serialise(mpm::StateArchive& archive) {
    archive.value("force_first", force_.first);
    archive.value("force_second", force_.second);
    archive.value("torque_first", torque_.first);
    archive.value("torque_second", torque_.second);
  }

 private:
  static constexpr double kRoot2 = 1.41421356237309504880;

  /// Memory of a vector's filter (direct form II, transposed).
  struct Memory {
    mpm::Vec3 first = mpm::Vec3::Zero(), second = mpm::Vec3::Zero();
  };
  mpm::Vec3 filter(const mpm::Vec3& sample, Memory& memory) const {
    const mpm::Vec3 result = in_ * sample + memory.first;
    memory.first = 2.0 * in_ * sample - out1_ * result + memory.second;
    memory.second = in_ * sample - out2_ * result;
    return result;
  }

  double in_ = 0.0;                 ///< weight of the present sample and the last but one; the last has twice that
  double out1_ = 0.0, out2_ = 0.0;  ///< weights of the last result and of the one before it
  Memory force_, torque_;
};

}  // namespace mpm_ros
