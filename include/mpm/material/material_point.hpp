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

  /// Advances F = exp(du) F with `du` = grad v dt, where grad v is constant over `dt` [s]. `growth`: of that, along
  /// each axis, the strain that brings no stress, as heat brings.
  void advance(const Matrix3<double>& du, double dt, double growth = 0.0);
  /// From now on water fills pores and cannot leave: cauchy() is total stress. `biot`: part of the pressure that the
  /// skeleton feels; `modulus`: Q of the water [Pa].
  void close_pores(double biot, double modulus);

  const Law& law() const { return law_; }
  const Matrix3<double>& f() const { return f_; }                       ///< that the law sees
  double j() const { return determinant(f_) * free_ * free_ * free_; }  ///< J of all the deformation
  const Symmetric3<double>& tau() const { return tau_; }  ///< Kirchhoff stress over initial density [J/kg]
  Symmetric3<double> cauchy() const;                      ///< total stress [Pa]
  double pore_pressure() const;                           ///< gained since the pores were closed [Pa]
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
  double free_ = 1.0;  ///< stretch that brings no stress: all the deformation over f_
  double biot_ = 0.0, modulus_ = 0.0, closed_j_ = 1.0;
};

}  // namespace mpm
