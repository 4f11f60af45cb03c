// A single piece of material, whose law is driven along a path of strain as for a particle in the solver.
#pragma once

#include <vector>

#include "mpm/material/law.hpp"
#include "mpm/math/tensor.hpp"

namespace mpm {

class MaterialPoint {
 public:
  /// Starts at rest and undeformed; without stress, except where the law has one then, as a gas does. @throws
  /// MaterialError
  explicit MaterialPoint(const MaterialDefinition& material);

  /// Advances F = exp(du) F with `du` = grad v dt, where grad v is constant over `dt` [s].
  void advance(const Matrix3<double>& du, double dt);

  const Law& law() const { return law_; }
  const Matrix3<double>& f() const { return f_; }
  double j() const { return determinant(f_); }
  const Symmetric3<double>& tau() const { return tau_; }  ///< Kirchhoff stress over initial density [J/kg]
  Symmetric3<double> cauchy() const;                      ///< [Pa]
  /// The history scalar of this index; 0 for index -1.
  double history(int index) const { return index < 0 ? 0.0 : history_[index]; }
  double plastic_strain() const;  ///< [-]
  double plastic_work() const;    ///< [J/kg]
  double elastic_energy() const;  ///< [J/kg]
  double temperature() const;     ///< [K]; 0 where the law has none
  double wave_speed() const;      ///< [m/s]

 private:
  Law law_;
  double density_;
  Matrix3<double> f_ = Matrix3<double>::identity();
  Symmetric3<double> tau_{};
  std::vector<double> history_;
};

}  // namespace mpm
