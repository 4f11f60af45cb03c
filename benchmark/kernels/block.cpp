#include "block.hpp"

#include "mpm/math/dimension.hpp"
#include "mpm/scene/scene.hpp"

namespace bench {
namespace {

int dimension(const mpm::SimulationDefinition& definition) {
  return definition.geometry == mpm::GeometryKind::solid ? 3 : 2;
}

}  // namespace

Block::Block(const std::string& scene, const std::vector<std::string>& changes, mpm::Precision precision)
    : definition(mpm::build(mpm::load_scene(scene, changes))),
      fields(mpm::make_fields(
          mpm::GridLayout(dimension(definition), definition.grid.cell, definition.grid.min, definition.grid.max))),
      sets(1),
      law(mpm::make_law(definition.materials.front())) {
  const mpm::DeformableBody& body = definition.bodies.front();
  const std::size_t n = body.positions.size();
  mpm::ParticleSet& set = sets.front();
  set.precision = precision;
  set.id.resize(n);
  set.x.assign(dim(), mpm::PaddedArray<double>(n));
  set.v.assign(dim(), mpm::ParticleScalar(precision, n));
  for (int k = 0; k < dim(); ++k) {
    set.half[k] = 0.5 / definition.method.particles_per_direction;
    set.highest[k] = grid.layout.last_node(k);
    for (std::size_t p = 0; p < n; ++p) {
      set.x[k][p] = body.positions[p][grid.layout.axis(k)];
      set.v[k].set(p, body.velocities[p][grid.layout.axis(k)]);
    }
  }
  for (std::size_t p = 0; p < n; ++p) set.id[p] = static_cast<std::uint32_t>(p);
  make_of(definition.materials.front());
}

void Block::make_of(const mpm::MaterialDefinition& material) {
  law = mpm::make_law(material);
  mpm::ParticleSet& set = sets.front();
  const std::size_t n = set.id.size();
  const mpm::ParticleScalar zero(set.precision, n);
  set.mass = material.density * definition.bodies.front().particle_volume;
  set.f.assign(dim() == 3 ? mpm::Solid::kMatrix : mpm::PlaneStrain::kMatrix, zero);
  for (int k = 0; k < dim(); ++k) set.f[k * (dim() + 1)].assign(n, 1.0);  // rows in order
  set.tau.assign(dim() == 3 ? mpm::Solid::kSymmetric : mpm::PlaneStrain::kSymmetric, zero);
  set.history.assign(mpm::history_size(law), zero);
  grid.least_mass = 1e-30 * set.mass;
}

void Block::sort(int threads, const mpm::Grouping& grouping) {
  if (mpm::Sorter(threads, grouping).sort(sets, fields)) throw mpm::Error("a particle is outside the grid");
}

}  // namespace bench
