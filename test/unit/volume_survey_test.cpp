// Volumes, volume gradients, positions and displacement gradients at nodes against plain sums over particles, with
// weights of the reference functions (kernel_stencil.hpp).
#include <gtest/gtest.h>

#include <map>

#include "mpm/mechanics/nodal_volumes.hpp"
#include "mpm/mechanics/scalar_transfers.hpp"
#include "mpm/shape/ring.hpp"
#include "step_scene.hpp"

namespace mpm::test {
namespace volume_survey_test {

struct Sums {
  double volume = 0.0, start_volume = 0.0;
  std::array<double, 3> gradient{}, position{}, moved{};
  std::array<std::array<double, 3>, 3> slope{};
};

template <class Geometry, class T>
void compare(ShapeKind shape) {
  SCOPED_TRACE(std::string(shape_name(shape)) + " " + spoken_name(kGeometryKind<Geometry>));
  using Scene = StepScene<Geometry, T>;
  constexpr int kDim = Scene::kDim;
  Scene scene({shape, UpdateScheme::usavg, {TransferKind::flip, 1.0, 2}});
  ParticleSet& set = scene.set();
  set.start_x = set.x;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int p = 0; p < set.size(); ++p) {
    for (int k = 0; k < kDim; ++k) set.start_x[k][p] *= 1.0 + 0.1 * unit(random);
    for (std::size_t c = 0; c < set.f.size(); ++c) {
      const bool diagonal = c >= kDim * kDim || c % (kDim + 1) == 0;
      set.f[c].set(p, (diagonal ? 1.0 : 0.0) + 0.1 * unit(random));
    }
  }

  std::map<std::array<int, 3>, Sums> expected;
  for (int p = 0; p < set.size(); ++p) {
    const auto f = Geometry::load_matrix(set.f, p);
    // About an axis the area of a ring's section, now and at the start: method reference 8.1.
    const auto around = [](double radius) { return Geometry::kHoop ? kTurn * radius : 1.0; };
    const double whole = set.mass_of(p) / Scene::kDensity;
    const double volume = whole * determinant(f) / around(set.x[0][p]), start = whole / around(set.start_x[0][p]);
    const auto back = inverse(f, determinant(f));
    for (const NodeWeight& n : scene.stencil(p)) {
      Sums& at = expected[{n.at[0], n.at[1], n.at[2]}];
      at.volume += volume * n.s;
      at.start_volume += start * n.s;
      for (int k = 0; k < kDim; ++k) {
        at.gradient[k] += volume * n.g[k];
        at.position[k] += set.mass_of(p) * n.s * set.x[k][p];
        at.moved[k] += set.mass_of(p) * n.s * (set.x[k][p] - set.start_x[k][p]);
      }
      const double weight = set.mass_of(p) * n.s;
      at.slope[0][0] += weight * (1.0 - back.xx);
      if constexpr (kDim == 2) {
        at.slope[0][1] -= weight * back.xz, at.slope[1][0] -= weight * back.zx;
        at.slope[1][1] += weight * (1.0 - back.zz);
      } else if constexpr (kDim == 3) {
        at.slope[0][1] -= weight * back.xy, at.slope[1][2] -= weight * back.yz;
        at.slope[2][0] -= weight * back.zx, at.slope[2][2] += weight * (1.0 - back.zz);
      }
    }
  }

  // Domains that follow the deformation are fixed when a step begins.
  StepContext context = scene.context();
  scene.mechanics->scatter_momentum(context);
  std::vector<ParticleSet> sets{set};
  const auto survey = make_volume_survey(make_scalar_transfer(scene.kernels(), scene.fields, sets, 2), scene.fields,
                                         sets, {Scene::kDensity}, kGeometryKind<Geometry>, 2);
  NodalVolumes found(kDim, scene.grid.layout.nodes_per_block());
  const std::vector<std::uint8_t> marked(scene.grid.blocks.size(), 1);
  survey->survey(0, marked, {true, true, true, true}, found);
  double largest = 0.0, mass = 0.0;
  for (const auto& [at, sums] : expected) largest = std::max(largest, sums.volume);
  mass = largest * Scene::kDensity * (Geometry::kHoop ? kTurn : 1.0);
  // Round-off of sums of some ten terms in the particles' precision, relative to the largest. Gradients are of the size
  // of volume over cell.
  const double precision = sizeof(T) == 8 ? 1e-13 : 1e-5;
  int compared = 0;
  scene.each_node([&](int b, int n, const std::array<int, 3>& at) {
    const Sums& sums = expected[at];
    compared += sums.volume > 0.0;
    EXPECT_NEAR(found.volume.at(b, 0, n), sums.volume, precision * largest);
    EXPECT_NEAR(found.start_volume.at(b, 0, n), sums.start_volume, precision * largest);
    for (int k = 0; k < kDim; ++k) {
      EXPECT_NEAR(found.gradient.at(b, k, n), sums.gradient[k], 10 * precision * largest / Scene::kCell);
      EXPECT_NEAR(found.position.at(b, k, n), sums.position[k], 10 * precision * mass);
      EXPECT_NEAR(found.displacement.at(b, k, n), sums.moved[k], precision * mass);
    }
    EXPECT_NEAR(found.slope[0].at(b, 0, n), sums.slope[0][0], precision * mass);
    if constexpr (kDim == 2) {
      EXPECT_NEAR(found.slope[0].at(b, 1, n), sums.slope[0][1], precision * mass);
      EXPECT_NEAR(found.slope[1].at(b, 0, n), sums.slope[1][0], precision * mass);
      EXPECT_NEAR(found.slope[1].at(b, 1, n), sums.slope[1][1], precision * mass);
    } else if constexpr (kDim == 3) {
      EXPECT_NEAR(found.slope[0].at(b, 1, n), sums.slope[0][1], precision * mass);
      EXPECT_NEAR(found.slope[1].at(b, 2, n), sums.slope[1][2], precision * mass);
      EXPECT_NEAR(found.slope[2].at(b, 0, n), sums.slope[2][0], precision * mass);
      EXPECT_NEAR(found.slope[2].at(b, 2, n), sums.slope[2][2], precision * mass);
    }
  });
  EXPECT_GE(compared, 10);  // a line of 8 cells has 10 nodes
}

TEST(VolumeSurvey, IsThePlainSumOverParticles) {
  compare<Line, double>(ShapeKind::ugimp);
  compare<PlaneStrain, double>(ShapeKind::ugimp);
  compare<PlaneStress, double>(ShapeKind::bspline2);
  compare<PlaneStrain, double>(ShapeKind::qcpdi);
  compare<Axisymmetric, double>(ShapeKind::ugimp);
  compare<Axisymmetric, double>(ShapeKind::cpdi);
  compare<Solid, double>(ShapeKind::ugimp);
  compare<Solid, double>(ShapeKind::cpdi);
  compare<Solid, float>(ShapeKind::ugimp);
}

}  // namespace volume_survey_test
}  // namespace mpm::test
