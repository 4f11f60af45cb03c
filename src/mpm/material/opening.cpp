#include "mpm/material/opening.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

constexpr double kFade = 0.1;  ///< part of the limit over which dilation fades

}  // namespace

DilationEnd::DilationEnd(double limit) : start_(1.0), slope_(0.0) {
  if (std::isinf(limit)) return;
  slope_ = 1.0 / (kFade * limit);
  start_ = (1.0 + limit) * slope_;
}

double flow_stiffness(const PrincipalValues& p, const PrincipalValues& q, double h) {
  const auto bound = [&](double weight) {
    double largest = 0.0;
    for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(weight * p[i] - q[i] / weight));
    return largest * largest / (4.0 * h);
  };
  // It has one minimum over the logarithm of the weight. The range has room for a bulk modulus of 1e4 G.
  constexpr int kSteps = 24;
  double low = -5.0, high = 5.0;
  for (int n = 0; n < kSteps; ++n) {
    const double third = (high - low) / 3.0;
    if (bound(std::exp(low + third)) < bound(std::exp(high - third))) {
      high -= third;
    } else {
      low += third;
    }
  }
  return bound(std::exp(0.5 * (low + high)));
}

}  // namespace mpm
