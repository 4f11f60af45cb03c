// Identities of axisymmetric shape functions for any particle position (method reference 1.1, axisymmetric column):
// sums over the nodes, balance of a tiled cylinder under uniform stress, and the planar limit far from the axis.
#include <algorithm>

#include "axisymmetric_check.hpp"

namespace mpm::test {
namespace axisymmetric_identities_test {

constexpr AxisRules kWhole = {AxisDomains::whole};

/// Mean radius of a ring's section, <r>, and of its mass, <r^2>/<r>, between two radii.
struct Means {
  double of_area, of_mass;
  Means(double a, double b) : of_area(0.5 * (a + b)), of_mass((a * a + a * b + b * b) / (1.5 * (a + b))) {}
};

// Method reference 1.1; `size`: the largest of value, gradient times cell and hoop function times cell, whose last
// digits limit the sums.
void expect_identities(const RingWeights& weights, const Place<2>& place, double mean, double of_mass, double size) {
  const RingSums sum(weights, place);
  const double cell = *std::min_element(place.cell.begin(), place.cell.end());
  const double value = 1e-14 * size, slope = value / cell;
  EXPECT_NEAR(sum.s, 1.0, value);
  EXPECT_NEAR(sum.t, 1.0 / mean, slope);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(sum.g[k], 0.0, slope);
    // Positions are up to 8 cells.
    EXPECT_NEAR(sum.r_g[k], k == 0 ? 1.0 : 0.0, 8 * value * place.cell[0] / cell);
    EXPECT_NEAR(sum.z_g[k], k == 1 ? 1.0 : 0.0, 8 * value * place.cell[1] / cell);
  }
  EXPECT_NEAR(sum.r_t, 1.0, 8 * value * place.cell[0] / cell);
  EXPECT_NEAR(sum.r_s, of_mass, 8 * value * place.cell[0]);
}

template <class Shape>
void check_product_identities(const AxisRules& rules) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    // Half of the domains touch the axis; radii begin at a fiftieth of a cell.
    const double r = i % 2 == 0 ? 0.02 + 0.5 * u(engine) : 0.02 + 6.0 * u(engine);
    const Place<2> place{{0.5, 0.8},
                         {0.5 * r, 4.0 * u(engine)},
                         {0.05 + 0.45 * u(engine), 0.05 + 0.45 * u(engine)},
                         {{0.8 + 0.2 * u(engine), 0.0}, {0.0, 1.0}}};
    double half = place.half[0] * place.cell[0];
    if constexpr (Shape::kStretches) half *= place.f[0][0];
    double a = place.x[0] - half, b = place.x[0] + half;
    if (rules.domains == AxisDomains::fitted && a < 0.0) {
      if (Shape::kStretches) b = 2.0 * place.x[0];
      a = 0.0;
    }
    const Means mean(a, b);
    // Values of a box that reaches across the axis have <r> in the denominator: half a cell squared over 0.02 x 0.05.
    const double size = rules.domains == AxisDomains::whole ? 500.0 : 50.0;
    expect_identities(product_weights<Shape>(place, rules), place, mean.of_area, mean.of_mass, size);
  }
}
TEST(AxisymmetricIdentities, OfUgimp) {
  check_product_identities<AxisymmetricUgimp<double>>({});
  check_product_identities<AxisymmetricUgimp<double>>(kWhole);
}
TEST(AxisymmetricIdentities, OfStretchingUgimp) {
  check_product_identities<AxisymmetricUgimpStretch<double>>({});
  check_product_identities<AxisymmetricUgimpStretch<double>>(kWhole);
}

// For a point both means are its radius.
TEST(AxisymmetricIdentities, OfDirac) {
  std::mt19937 engine(2);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const Place<2> place{{0.5, 0.8}, {0.01 + 3.0 * u(engine), 4.0 * u(engine)}, {0.25, 0.25}, {{1, 0}, {0, 1}}};
    const RingWeights weights = product_weights<AxisymmetricDirac<double>>(place);
    expect_identities(weights, place, place.x[0], place.x[0], 50.0);
    for (const auto& [node, w] : weights) EXPECT_NEAR(w.t, w.s / place.x[0], 1e-14 / place.x[0]);
  }
}

/// Shrinks half vectors [m] to a domain that at most touches the axis.
double fit(const Place<2>& place, double (&d)[2][2]) {
  place.domain(d);
  const double reach = std::abs(d[0][0]) + std::abs(d[1][0]);
  const double scale = std::min(1.0, place.x[0] / reach);
  for (auto& vector : d) {
    for (double& component : vector) component *= scale;
  }
  return scale;
}

// For a parallelogram <r> is the particle's radius and <r^2>/<r> = r + (d_1r^2 + d_2r^2) / (3 r). Shrunk by both half
// vectors together it stays on its side of the axis, for corners of either sign of d_1r d_2r (method reference, erratum
// 14).
template <template <int> class Points>
void check_domain_identities() {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> r(0.02, 3.0), near(0.02, 0.3);
  int shrunk[2] = {};
  for (int i = 0; i < 2000; ++i) {
    Place<2> place = random_place<2>(engine);
    place.x[0] = i % 2 == 0 ? near(engine) : r(engine);
    place.x[1] += 2.0;
    double d[2][2];
    if (fit(place, d) < 1.0) ++shrunk[d[0][0] * d[1][0] < 0.0];
    const double of_mass = place.x[0] + (d[0][0] * d[0][0] + d[1][0] * d[1][0]) / (3.0 * place.x[0]);
    const RingWeights weights = domain_weights<Points>(place);
    double steepest = 1.0;  // a shrunk domain has gradients as large as the cell over its size
    for (const auto& [node, w] : weights) {
      EXPECT_TRUE(node[0] >= 0 || std::abs(w.s) + std::abs(w.t) < 1e-12) << "beyond the axis";
      for (const double g : w.g) steepest = std::max(steepest, std::abs(g) * place.cell[0]);
      steepest = std::max(steepest, w.t * place.cell[0]);
    }
    expect_identities(weights, place, place.x[0], of_mass, 20.0 * steepest);
  }
  EXPECT_GT(shrunk[0], 100);
  EXPECT_GT(shrunk[1], 100);
}
TEST(AxisymmetricIdentities, OfCpdi) { check_domain_identities<AxisymmetricCpdi>(); }
TEST(AxisymmetricIdentities, OfQcpdi) { check_domain_identities<AxisymmetricQcpdi>(); }

// Far from the axis a ring is almost straight: S and G are as in the plane and T = S / r, up to a cell over the radius.
TEST(AxisymmetricIdentities, FarFromTheAxisThePlanes) {
  std::mt19937 engine(8);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  const double far = 1e6, cell = 1.0;
  for (int i = 0; i < 200; ++i) {
    const double offset = u(engine) - 0.5, half = 0.05 + 0.45 * u(engine);
    const Ugimp<double> plane(offset, {half, 1.0 / cell});
    const auto w = AxisymmetricUgimp<double>::radial(offset, far, half, 1.0 / cell, {});
    for (int n = 0; n < 3; ++n) {
      EXPECT_NEAR(w.s[n], plane.s[n], cell / far);
      EXPECT_NEAR(w.g[n], plane.g[n], cell / far / half);
      EXPECT_NEAR(w.t[n] * far, plane.s[n], 2.0 * cell / far);
    }
    const double d[2][2] = {{half, 0.1}, {-0.2 * half, 0.4}};
    double plane_g[4][2], ring_g[4][2], ring_w[4];
    Cpdi<2>::gradients(d, plane_g);
    AxisymmetricCpdi<2>::radial(d, far, ring_w, ring_g);
    for (int a = 0; a < 4; ++a) {
      EXPECT_NEAR(ring_w[a], 0.25, cell / far);
      for (int k = 0; k < 2; ++k) EXPECT_NEAR(ring_g[a][k], plane_g[a][k], cell / far / half);
    }
  }
}

// Uniform stress in a cylinder whose section is tiled: its force is zero at every node inside and on the axis, and R h
// at the free surface, since the integral of d(r N) is (method reference 1.1). Forces are per radian and unit of
// stress; with 8 x 8 cells sums are a few units.
template <class Of>
void check_tiling(int per_cell, double first_half, Of&& weights_of) {
  const double cell[2] = {0.5, 0.25};
  const int cells = 8;
  std::map<std::array<int, 2>, std::array<double, 2>> force;
  for (int i = 0; i < cells * per_cell; ++i) {
    for (int j = 0; j < cells * per_cell; ++j) {
      const double half = 0.5 / per_cell;
      const Place<2> place{{cell[0], cell[1]},
                           {(i + 0.5) / per_cell * cell[0], (j + 0.5) / per_cell * cell[1]},
                           {half * first_half, half},
                           {{1.0 / first_half, 0.0}, {0.0, 1.0}}};
      const double ring = place.x[0] * 4.0 * half * cell[0] * half * cell[1];
      for (const auto& [node, w] : weights_of(place)) {
        force[node][0] += ring * (w.g[0] + w.t);
        force[node][1] += ring * w.g[1];
      }
    }
  }
  for (const auto& [node, f] : force) {
    if (node[1] <= 0 || node[1] >= cells) continue;
    const double surface = node[0] == cells ? cells * cell[0] * cell[1] : 0.0;
    EXPECT_NEAR(f[0], surface, 1e-13) << node[0] << " " << node[1];
    EXPECT_NEAR(f[1], 0.0, 1e-13) << node[0] << " " << node[1];
  }
}
TEST(AxisymmetricIdentities, TiledDomainsBalance) {
  for (const int per_cell : {1, 2, 3}) {
    check_tiling(per_cell, 1.0, [](const Place<2>& p) { return product_weights<AxisymmetricUgimp<double>>(p); });
    // Boxes of four fifths of the size, stretched to fill the section again.
    check_tiling(per_cell, 0.8, [](const Place<2>& p) { return product_weights<AxisymmetricUgimpStretch<double>>(p); });
    check_tiling(per_cell, 0.8, [](const Place<2>& p) { return domain_weights<AxisymmetricCpdi>(p); });
    check_tiling(per_cell, 0.8, [](const Place<2>& p) { return domain_weights<AxisymmetricQcpdi>(p); });
  }
}

// A particle on the axis, where 1 / r is not finite, has finite weights whose sum is 1.
TEST(AxisymmetricIdentities, OnTheAxisAllIsFinite) {
  const Place<2> place{{0.5, 0.5}, {0.0, 1.1}, {0.25, 0.25}, {{1.0, 0.3}, {-0.2, 0.9}}};
  for (const RingWeights& weights :
       {product_weights<AxisymmetricDirac<double>>(place), product_weights<AxisymmetricUgimp<double>>(place),
        product_weights<AxisymmetricUgimpStretch<double>>(place), domain_weights<AxisymmetricCpdi>(place),
        domain_weights<AxisymmetricQcpdi>(place)}) {
    double sum = 0.0;
    for (const auto& [node, w] : weights) {
      EXPECT_TRUE(std::isfinite(w.s) && std::isfinite(w.g[0]) && std::isfinite(w.g[1]) && std::isfinite(w.t));
      sum += w.s;
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
}

}  // namespace axisymmetric_identities_test
}  // namespace mpm::test
