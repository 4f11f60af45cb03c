#include "mpm/material/material_point.hpp"

#include <cmath>

#include "mpm/math/dimension.hpp"
#include "mpm/math/exponential.hpp"

namespace mpm {

namespace {

constexpr int kTerms = 12;  ///< terms of exp(du): exact to round-off for increments up to about 0.3

}  // namespace

MaterialPoint::MaterialPoint(const MaterialDefinition& material)
    : law_(make_law(material)), density_(material.density), history_(history_size(law_), 0.0) {
  advance({}, 1.0);  // a step without motion gives the stress at the start
}

void MaterialPoint::advance(const Matrix3<double>& du, double dt, double growth) {
  const Matrix3<double> stressed{du.xx - growth, du.xy, du.xz, du.yx,         du.yy - growth,
                                 du.yz,          du.zx, du.zy, du.zz - growth};
  const Matrix3<double> df = exponential(stressed, kTerms);
  const double j_old = determinant(f_);
  std::visit(
      [&](const auto& law) {
        f_ = law.kForgetsShape ? Solid::dilatation(j_old * determinant(df)) : product(df, f_);
        const Increment<double, Matrix3<double>> step{stressed, df, f_, j_old, determinant(f_), dt};
        law.update(step, tau_, history_.data());
      },
      law_);
  free_ *= std::exp(growth);
}

void MaterialPoint::close_pores(double biot, double modulus) {
  biot_ = biot;
  modulus_ = modulus;
  closed_j_ = j();
}

double MaterialPoint::pore_pressure() const { return modulus_ * biot_ * std::log(closed_j_ / j()); }

Symmetric3<double> MaterialPoint::cauchy() const {
  return scale_shift(tau_, density_ / determinant(f_), -biot_ * pore_pressure());
}

double MaterialPoint::plastic_strain() const {
  return std::visit([this](const auto& law) { return history(law.kPlasticStrain); }, law_);
}
double MaterialPoint::plastic_work() const {
  return std::visit([this](const auto& law) { return history(law.kPlasticWork); }, law_);
}
double MaterialPoint::elastic_energy() const {
  return std::visit(
      [this](const auto& law) {
        return law.elastic_energy(f_, tau_, determinant(f_)) - law.heat_fraction() * history(law.kPlasticWork);
      },
      law_);
}
double MaterialPoint::temperature() const {
  return std::visit(
      [this](const auto& law) {
        return law.kTemperature < 0 ? 0.0 : law.reference_temperature() + history(law.kTemperature);
      },
      law_);
}
double MaterialPoint::wave_speed() const {
  return std::visit([this](const auto& law) { return law.wave_speed(f_, tau_, determinant(f_)); }, law_);
}

}  // namespace mpm
