// The nodes that a load on a particle acts on: those of its domain, or those of the hat function at its centre.
// Expected values are averages of hat functions over boxes, from their antiderivative (GIMP notes (1.21), (1.22)).
#include "mpm/mechanics/particle_loads.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "mpm/kernel/select.hpp"
#include "mpm/mechanics/continuum.hpp"
#include "mpm/mechanics/scalar_transfers.hpp"

namespace mpm {
namespace particle_loads_test {

constexpr double kCell = 0.1, kHalf = 0.25;  // [m]; half edge of a box [cells]

// Integral from -infinity of the hat function about 0.
double below(double u) {
  if (u < 0.0) return 0.5 * std::pow(std::max(0.0, 1.0 + u), 2);
  return 1.0 - 0.5 * std::pow(std::max(0.0, 1.0 - u), 2);
}

double share(LoadSpread spread, double x, int node) {
  const double u = x / kCell - node;
  if (spread == LoadSpread::center) return std::max(0.0, 1.0 - std::abs(u));
  return (below(u + kHalf) - below(u - kHalf)) / (2.0 * kHalf);
}

template <class T>
struct Plane {
  Plane() : fields(make_fields(GridLayout(2, Vec3::Constant(kCell), Vec3::Zero(), Vec3::Ones()))) {
    const std::vector<std::array<double, 2>> places = {{0.52, 0.41}, {0.43, 0.55}, {0.349, 0.601}};
    ParticleSet set;
    set.name = "soil";
    set.mass = 0.25;
    set.precision = sizeof(T) == 4 ? Precision::float32 : Precision::float64;
    set.half = {kHalf, kHalf, 0.0};
    set.highest = {10.0, 10.0, 0.0};
    set.first_id = 5;
    const std::size_t n = places.size();
    set.id.resize(n);
    set.x.resize(2);
    for (auto& x : set.x) x.resize(n);
    for (std::size_t p = 0; p < n; ++p) {
      set.id[p] = 5 + static_cast<std::uint32_t>(p);
      for (int k = 0; k < 2; ++k) set.x[k][p] = places[p][k];
    }
    set.v = zeros(2, set.precision, n);
    set.f = zeros(5, set.precision, n);
    set.tau = zeros(4, set.precision, n);
    sets.push_back(std::move(set));
    const auto outside =
        Sorter(1, kernel_grouping(kernel_table<T>(ShapeKind::ugimp, GeometryKind::plane_strain, Isa::plain)))
            .sort(sets, fields);
    EXPECT_FALSE(outside);
    std::fill_n(grid.force.data(), grid.blocks.size() * 2 * grid.layout.nodes_per_block(), 0.0);
  }
  static std::vector<ParticleScalar> zeros(int components, Precision precision, std::size_t count) {
    return std::vector<ParticleScalar>(components, ParticleScalar(precision, count));
  }
  LoadTransfers transfers() {
    const auto of = [&](ShapeKind shape) {
      return make_scalar_transfer(kernel_table<T>(shape, GeometryKind::plane_strain, Isa::plain), fields, sets, 2);
    };
    return {of(ShapeKind::ugimp), of(ShapeKind::dirac)};
  }
  Fields fields;
  Grid& grid = *fields.front();
  std::vector<ParticleSet> sets;
};

template <class T>
class Spread : public testing::Test {};
using Precisions = testing::Types<double, float>;
TYPED_TEST_SUITE(Spread, Precisions);

// 3 N along x on the domains of two particles, together with 2 m/s^2 along z at the centres of all particles.
TYPED_TEST(Spread, GoesToTheNodesThatItShould) {
  using T = TypeParam;
  Plane<T> plane;
  std::map<std::uint32_t, std::array<double, 2>> places;
  for (int p = 0; p < 3; ++p) places[plane.sets[0].id[p]] = {plane.sets[0].x[0][p], plane.sets[0].x[1][p]};
  ParticleLoadTerm pull, push;
  pull.kind = ParticleLoadTerm::Kind::particle_force;
  pull.set = 0;
  pull.value[0] = Function(3.0);
  pull.factor = 1.0 / plane.sets[0].mass;
  pull.chosen = {1, 0, 1};
  push.value[2] = Function(2.0);
  push.spread = LoadSpread::center;
  const auto loads = make_particle_loads(plane.transfers(), plane.fields, plane.sets, {pull, push}, 2);
  StepContext context{plane.fields, 1e-3, 0.0};
  loads->forces_gathered(context);
  const Grid& grid = plane.grid;
  for (int b = 0; b < grid.blocks.size(); ++b) {
    for (int n = 0; n < grid.layout.nodes_per_block(); ++n) {
      const auto node = grid.layout.node(grid.blocks.block(b), n);
      double x = 0.0, z = 0.0;
      for (const auto& [id, place] : places) {
        const auto at = [&](LoadSpread spread) {
          return share(spread, place[0], node[0]) * share(spread, place[1], node[1]);
        };
        if (id != 6) x += 3.0 * at(LoadSpread::domain);
        z += 2.0 * plane.sets[0].mass * at(LoadSpread::center);
      }
      // Round-off of weights of order 1 and forces of order 3 N in the precision of the particles.
      const double digit = sizeof(T) == 4 ? 1e-5 : 1e-13;
      EXPECT_NEAR(grid.force.at(b, 0, n), x, digit) << "block " << b << ", node " << n;
      EXPECT_NEAR(grid.force.at(b, 1, n), z, digit) << "block " << b << ", node " << n;
    }
  }
  std::vector<ImpulseAccount> accounts;
  loads->accounts(accounts);
  ASSERT_EQ(accounts.size(), 2u);
  EXPECT_EQ(accounts[0].name, "body_force");
  EXPECT_NEAR(accounts[0].impulse.z(), 3 * 0.25 * 2.0 * 1e-3, 1e-17);
  EXPECT_EQ(accounts[1].name, "particle_force");
  EXPECT_NEAR(accounts[1].impulse.x(), 2 * 3.0 * 1e-3, 1e-17);
}

}  // namespace particle_loads_test
}  // namespace mpm
