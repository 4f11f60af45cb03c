#include "particle_view.hpp"

#include <Eigen/SVD>
#include <cmath>

#include "mpm/material/isochoric.hpp"

namespace mpm {
namespace {

/// R of F = R U, as a vector.
Vec3 rotation_of(const Matrix3<double>& f) {
  Eigen::Matrix3d m;
  m << f.xx, f.xy, f.xz, f.yx, f.yy, f.yz, f.zx, f.zy, f.zz;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(svd.matrixU() * svd.matrixV().transpose()));
  return turn.angle() * turn.axis();
}

}  // namespace

SetView::SetView(const ParticleSet& particles, const Law& the_law, const MaterialDefinition& material, int number,
                 const GridLayout& layout, GeometryKind kind, const QuantityDefinition* heat,
                 const TransportMaterial* of_material)
    : set(particles), law(the_law), index(number), geometry(kind), density(material.density) {
  for (int k = 0; k < layout.dim(); ++k) slot[layout.axis(k)] = k;
  std::visit(
      [this](const auto& l) {
        plastic_strain = l.kPlasticStrain;
        plastic_work = l.kPlasticWork;
        temperature = l.kTemperature;
        reference_temperature = l.reference_temperature();
        heat_fraction = l.heat_fraction();
        heat_capacity = l.heat_capacity();
      },
      law);
  part_as_heat = heat_fraction;
  if (heat == nullptr || temperature >= 0) return;
  const std::string name = traits_of(heat->quantity).name;
  for (const NamedScalar& scalar : set.brought) {
    if (scalar.name == name) temperatures = scalar.values.data();
  }
  transported = of_material;
  reference_temperature = heat->reference;
  part_as_heat = of_material->heat_fraction;
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
  if ((needs & kNeedsElastic) != 0) {
    StressedPoint at{cauchy, tau, total, j};
    free = 0.0;
    if (set.set.free_strain >= 0) {
      const ParticleTensors seen = without_free_strain(set.set, p, tensors);
      at = {cauchy, seen.tau, half_logarithm(left_cauchy_green(seen.f)), seen.j};
      free = std::log1p(set.set.brought[set.set.free_strain + 1].values[p]);
    }
    elastic = std::visit([&](const auto& law) { return law.elastic_strain(at); }, set.law);
  }
  if ((needs & kNeedsRotation) != 0) rotation = rotation_of(f);
}

}  // namespace mpm
