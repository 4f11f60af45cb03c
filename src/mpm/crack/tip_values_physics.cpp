// Additions of transport to the data of a run around a crack's tip (tip_physics.hpp).
#include <cmath>

#include "mpm/crack/tip_values.hpp"

namespace mpm {
namespace {

/// Least determinant of the gradient of centres, 1 inside even material, that still gives a gradient.
constexpr double kLeastCentres = 0.25;

}  // namespace

void TipValues::add_water(std::size_t s, std::uint32_t p, const Matrix3<double>& f, double j) {
  const TipPhysics& physics = parts_.physics[s];
  auto& to = numbers_[s];
  const double water = parts_.sets[s].brought[physics.pressure].values[p];
  const Symmetric3<double>& b = physics.pores.biot;
  const double storage = physics.undrained ? physics.pores.capacity(water) : 0.0, squeezed = physics.squeezed(f, j);
  to[stress_xx][p] -= b.xx * water;
  to[stress_zz][p] -= b.zz * water;
  to[stress_xz][p] -= b.xz * water;
  if (axisymmetric(parts_.geometry)) to[stress_hoop][p] -= b.yy * water;
  to[energy][p] -= water * (squeezed + 0.5 * storage * water);
  to[pressure][p] = water;
  to[content][p] = squeezed + storage * water;
}

// Nodal means are those of material whose centre is not the node, beside a crack up to 0.75 cells off: the gradient of
// the centres, found alike, takes that out.
void TipValues::find_slopes() {
  std::vector<ParticleSet>& sets = parts_.sets;
  constexpr Number kOf[5] = {place_x, place_z, free, pressure, content};
  for (std::size_t f = 0; f < marks_.size() && static_cast<int>(f) < parts_.chosen.fields_of(first_); ++f) {
    Grid& grid = *parts_.fields[first_ + static_cast<int>(f)];
    component_.resize(grid.blocks.size());
    for (int n = 0; n < 5; ++n) {
      for (int b = 0; b < grid.blocks.size(); ++b) {
        if (marks_[f][b] == 0) continue;
        const int nodes = grid.layout.nodes_per_block();
        for (int node = 0; node < nodes; ++node) {
          const double mass = nodal_[f][one].at(b, one, node);
          const double sum = nodal_[f][kOf[n] / 2].at(b, kOf[n] % 2, node);
          component_.at(b, 0, node) = mass > 0.0 ? sum / mass : 0.0;
        }
      }
      taken_.assign(sets.size(), {});
      for (std::size_t s = 0; s < sets.size(); ++s) {
        if (sets[s].field != first_) continue;
        for (std::size_t k = 0; k < 2; ++k) {
          PaddedArray<double>& to = gradients_[s][n][k];
          if (to.size() != sets[s].id.size()) to.assign(sets[s].id.size(), 0.0);
          taken_[s][k] = to.data();
        }
      }
      transfer_->gradient(first_ + static_cast<int>(f), component_, taken_, &marks_[f]);
    }
  }
}

void TipValues::add_physics(std::size_t s, std::uint32_t p, AreaSample& sample) const {
  const TipPhysics& physics = parts_.physics[s];
  const auto& of = gradients_[s];
  // Chain rule at nodes: q,k = sum of (q by the centre c) c,k.
  const double xx = of[0][0][p], xz = of[0][1][p], zx = of[1][0][p], zz = of[1][1][p];
  const double det = xx * zz - xz * zx;
  const auto slope = [&](int n) -> Vec2 {
    const double x = of[n][0][p], z = of[n][1][p];
    if (!(det > kLeastCentres)) return {x, z};
    return {(zz * x - zx * z) / det, (xx * z - xz * x) / det};
  };
  // Derivatives of J are those by undeformed coordinates.
  const auto& g = sample.values.gradient;
  const auto undeformed = [&](const Vec2& q) -> Vec2 {
    return {q[0] * (1.0 + g[0][0]) + q[1] * g[1][0], q[0] * g[0][1] + q[1] * (1.0 + g[1][1])};
  };
  const double grown = numbers_[s][free][p], water = numbers_[s][pressure][p];
  sample.values.free = grown;
  sample.values.pressure = water;
  sample.content = numbers_[s][content][p];
  const Vec2 by_free = undeformed(slope(2)), by_pressure = undeformed(slope(3)), by_content = undeformed(slope(4));
  sample.free_force = (traces_[s][p] - 3.0 * energies_[s][p]) / (1.0 + grown) * by_free;
  sample.pressure_slope = by_pressure;
  sample.eigenstrain_slope = Vec2::Zero();
  for (int k = 0; k < 2; ++k) {
    sample.eigenstrain_slope[k] = physics.eigenstrain(by_pressure[k], by_content[k], by_free[k]);
  }
}

}  // namespace mpm
