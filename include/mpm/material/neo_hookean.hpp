// Compressible neo-Hookean solid. W = K/2 [(J^2 - 1)/2 - ln J] + G/2 (I1 J^(-2/3) - 3), so
// sigma = K/2 (J - 1/J) I + G J^(-5/3) dev B. Weak in extreme stretch: K, G alone do not lock, and
// wave_speed() knows the volume ratio only, not that a stretch of lambda stiffens its own direction by lambda^2.
// Source: Nairn & Guilkey (2015) eq. (64); method reference 10.2.
#pragma once

#include <algorithm>
#include <cmath>

#include "mpm/material/definition.hpp"
#include "mpm/math/tensor.hpp"

namespace mpm {

class NeoHookean {
 public:
  static constexpr int kPlasticStrain = -1;  ///< which scalar of history it is, if any
  static constexpr int kPlasticWork = -1;
  static constexpr int kHistory = 0;

  NeoHookean(const NeoHookeanDefinition& d, double density)
      : density_(density), bulk_(d.elasticity.bulk()), shear_(d.elasticity.shear()) {}

  template <class T, class Matrix, class Symmetric>
  void update(const Matrix&, const Matrix& f, T, T j, Symmetric& tau, T* const*, int) const {
    const Symmetric b = left_cauchy_green(f);
    const T inverse_density = T(1.0 / density_);
    const T root = std::cbrt(j);
    const T deviatoric = T(shear_) / (root * root) * inverse_density;           // J sigma = G J^-2/3 dev B
    const T volumetric = T(0.5) * T(bulk_) * (j * j - T(1)) * inverse_density;  //         + K/2 (J^2-1) I
    tau = scale_shift(b, deviatoric, volumetric - deviatoric * trace(b) / T(3));
  }

  template <class Matrix, class Symmetric>
  double elastic_energy(const Matrix& f, const Symmetric&, double j) const {
    const double invariant = trace(left_cauchy_green(f)) / std::pow(j, 2.0 / 3.0);
    return (0.5 * bulk_ * (0.5 * (j * j - 1.0) - std::log(j)) + 0.5 * shear_ * (invariant - 3.0)) / density_;
  }

  /// Tangent at the volume ratio j: d sigma / d ln V = K/2 (J + 1/J), shear G J^(-5/3) at B = J^(2/3) I.
  double wave_speed(double j) const {
    const double bulk = 0.5 * bulk_ * (j + 1.0 / j);
    return std::sqrt((bulk + 4.0 / 3.0 * shear_ / j) * j / density_);
  }
  double density() const { return density_; }

 private:
  double density_, bulk_, shear_;
};

}  // namespace mpm
