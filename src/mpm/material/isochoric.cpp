#include "mpm/material/isochoric.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace mpm {

Symmetric3<double> half_logarithm(const Symmetric3<double>& s) {
  Eigen::Matrix3d m;
  m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(m);
  const Eigen::Vector3d logarithms = 0.5 * solver.eigenvalues().array().log();
  const Eigen::Matrix3d l = solver.eigenvectors() * logarithms.asDiagonal() * solver.eigenvectors().transpose();
  return {l(0, 0), l(1, 1), l(2, 2), l(1, 2), l(0, 2), l(0, 1)};
}

Symmetric3<double> isochoric_strain(const Symmetric3<double>& tau, double j, double scale) {
  const Symmetric3<double> deviator = scale_shift(tau, scale, -scale * trace(tau) / 3.0);
  const Symmetric3<double> b = scale_shift(deviator, 1.0, 1.0 + isochoric_excess(deviator));
  return scale_shift(half_logarithm(b), 1.0, std::log(j) / 3.0);
}

}  // namespace mpm
