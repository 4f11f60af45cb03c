#include "particle_view.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <cmath>

#include "mpm/material/isochoric.hpp"

namespace mpm {
namespace {

Eigen::Matrix3d matrix_of(const Symmetric3<double>& s) {
  Eigen::Matrix3d m;
  m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
  return m;
}

/// 1/2 ln s, s symmetric and positive.
Symmetric3<double> half_logarithm(const Symmetric3<double>& s) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix_of(s));
  const Eigen::Vector3d logarithms = 0.5 * solver.eigenvalues().array().log();
  const Eigen::Matrix3d m = solver.eigenvectors() * logarithms.asDiagonal() * solver.eigenvectors().transpose();
  return {m(0, 0), m(1, 1), m(2, 2), m(1, 2), m(0, 2), m(0, 1)};
}

/// R of F = R U, as a vector.
Vec3 rotation_of(const Matrix3<double>& f) {
  Eigen::Matrix3d m;
  m << f.xx, f.xy, f.xz, f.yx, f.yy, f.yz, f.zx, f.zy, f.zz;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(svd.matrixU() * svd.matrixV().transpose()));
  return turn.angle() * turn.axis();
}

/// Constants by which elastic strain follows from stress.
struct PartsOf {
  SetView& view;

  void rate(const Elasticity& elasticity) const {
    view.parts = SetView::Parts::rate;
    view.bulk = elasticity.bulk();
    view.shear = elasticity.shear();
  }
  void isochoric(double shear) const {
    view.parts = SetView::Parts::isochoric;
    view.shear = shear;
  }
  void operator()(const DruckerPragerDefinition& law) const { rate(law.elasticity); }
  void operator()(const MohrCoulombDefinition& law) const { rate(law.elasticity); }
  void operator()(const MuIDefinition& law) const { rate(law.elasticity); }
  void operator()(const J2PlasticityDefinition& law) const { isochoric(law.elasticity.shear()); }
  void operator()(const JohnsonCookDefinition& law) const {
    isochoric(law.shear_modulus);
    view.heat_capacity = law.heat_capacity;
  }
  void operator()(const IdealGasDefinition& law) const {
    view.heat_capacity = law.pressure / (view.density * law.temperature * (law.heat_capacity_ratio - 1.0));
  }
  template <class Elastic>
  void operator()(const Elastic&) const {}
};

Symmetric3<double> elastic_strain(const SetView& set, const ParticleView& particle) {
  if (const auto* clay = std::get_if<CamClay>(&set.law)) return clay->elastic_strain(particle.cauchy, particle.j);
  if (const auto* sand = std::get_if<NorSand>(&set.law)) return sand->elastic_strain(particle.cauchy);
  if (set.parts == SetView::Parts::rate) {
    const double mean = trace(particle.cauchy) / 3.0;
    return scale_shift(particle.cauchy, 0.5 / set.shear, mean * (1.0 / (3.0 * set.bulk) - 0.5 / set.shear));
  }
  if (set.parts == SetView::Parts::isochoric) {
    const double scale = set.density / set.shear;
    const Symmetric3<double> deviator = scale_shift(particle.tau, scale, -scale * trace(particle.tau) / 3.0);
    const Symmetric3<double> b = scale_shift(deviator, 1.0, 1.0 + isochoric_excess(deviator));
    return scale_shift(half_logarithm(b), 1.0, std::log(particle.j) / 3.0);
  }
  return particle.total;
}

}  // namespace

SetView::SetView(const ParticleSet& particles, const Law& the_law, const MaterialDefinition& material, int number,
                 const GridLayout& layout, GeometryKind kind)
    : set(particles), law(the_law), index(number), geometry(kind), density(material.density) {
  for (int k = 0; k < layout.dim(); ++k) slot[layout.axis(k)] = k;
  std::visit(
      [this](const auto& l) {
        plastic_strain = l.kPlasticStrain;
        plastic_work = l.kPlasticWork;
        temperature = l.kTemperature;
        reference_temperature = l.reference_temperature();
        heat_fraction = l.heat_fraction();
      },
      law);
  std::visit(PartsOf{*this}, material.law);
}

void ParticleView::look(int particle, unsigned needs) {
  p = particle;
  if (needs == kNeedsNothing) return;
  const ParticleTensors tensors = particle_tensors(set.set, set.geometry, p);
  f = tensors.f;
  tau = tensors.tau;
  j = tensors.j;
  if ((needs & (kNeedsStress | kNeedsElastic)) != 0) cauchy = scale_shift(tau, set.density / j, 0.0);
  if ((needs & (kNeedsStrain | kNeedsElastic)) != 0) total = half_logarithm(left_cauchy_green(f));
  if ((needs & kNeedsElastic) != 0) elastic = elastic_strain(set, *this);
  if ((needs & kNeedsRotation) != 0) rotation = rotation_of(f);
}

}  // namespace mpm
