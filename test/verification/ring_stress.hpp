// Stress of a spinning disk of radius 1 m about the origin: the steady one, and the mean of a run in rings.
// Source: exact-solutions 5; with s = rho omega^2 / 8
//   sigma_r = (3 + n) s (R^2 - r^2), sigma_theta = s [(3 + n) R^2 - (1 + 3 n) r^2],
// n = nu in plane stress, nu / (1 - nu) in plane strain; for small strain.
#pragma once

#include <algorithm>
#include <cmath>

#include "page.hpp"
#include "scene_run.hpp"

namespace verification {

struct SteadyDisk {
  double density, rate;  // [kg/m^3], [rad/s]
  double ratio;          // n above
  double scale() const { return density * rate * rate / 8.0; }
  double radial(double r) const { return 1e-3 * (3.0 + ratio) * scale() * (1.0 - r * r); }                // [kPa]
  double hoop(double r) const { return 1e-3 * scale() * ((3.0 + ratio) - (1.0 + 3.0 * ratio) * r * r); }  // [kPa]
};

/// Stress in rings about the centre, the mean by mass over a turn: the disk also swings along its radius.
class RingStress {
 public:
  static constexpr int kRings = 10;
  void add(const mpm::Simulation& simulation) {
    const std::vector<double> x = field(simulation, "x"), z = field(simulation, "z");
    const std::vector<double> sxx = field(simulation, "sxx"), szz = field(simulation, "szz");
    const std::vector<double> sxz = field(simulation, "sxz"), mass = field(simulation, "mass");
    for (std::size_t p = 0; p < x.size(); ++p) {
      const double r2 = x[p] * x[p] + z[p] * z[p], r = std::sqrt(r2);
      const int ring = std::min(kRings - 1, static_cast<int>(r * kRings));
      const double radial = (x[p] * x[p] * sxx[p] + 2.0 * x[p] * z[p] * sxz[p] + z[p] * z[p] * szz[p]) / r2;
      mass_[ring] += mass[p];
      radius_[ring] += mass[p] * r;
      radial_[ring] += mass[p] * radial;
      hoop_[ring] += mass[p] * (sxx[p] + szz[p] - radial);
    }
  }
  Numbers radius() const { return mean(radius_, 1.0); }
  Numbers radial() const { return mean(radial_, 1e-3); }  // [kPa]
  Numbers hoop() const { return mean(hoop_, 1e-3); }
  /// Largest difference of a ring's stress from the exact one, in percent of the stress at the centre.
  double error(const SteadyDisk& exact) const {
    double worst = 0.0;
    for (int i = 0; i < kRings; ++i) {
      const double r = radius()[i];
      worst = std::max({worst, std::abs(radial()[i] - exact.radial(r)), std::abs(hoop()[i] - exact.hoop(r))});
    }
    return 100.0 * worst / exact.radial(0.0);
  }
  /// Mean of radial + hoop stress over the disk by mass [kPa].
  double mean_sum() const {
    double sum = 0.0, mass = 0.0;
    for (int i = 0; i < kRings; ++i) {
      sum += radial_[i] + hoop_[i];
      mass += mass_[i];
    }
    return 1e-3 * sum / mass;
  }

 private:
  Numbers mean(const Numbers& sum, double factor) const {
    Numbers values;
    for (int i = 0; i < kRings; ++i) values.push_back(factor * sum[i] / mass_[i]);
    return values;
  }
  Numbers mass_ = Numbers(kRings), radius_ = Numbers(kRings), radial_ = Numbers(kRings), hoop_ = Numbers(kRings);
};

}  // namespace verification
