// Axisymmetric shape functions against values by quadrature (test/data/axisymmetric_*.csv), the closed forms of Nairn &
// Guilkey (2015) and the planar functions; single numbers and registers agree. Identities are in
// axisymmetric_identities_test.cpp.
#include <algorithm>

#include "axisymmetric_check.hpp"
#include "lanes.hpp"

namespace mpm::test {
namespace axisymmetric_shapes_test {

constexpr AxisRules kWhole = {AxisDomains::whole};
constexpr AxisRules kPlanar = {AxisDomains::fitted, AxisFunctions::planar};

// Radial functions alone: S, dS per half cell and T.
std::array<double, 3> radial_values(double l_p, int node, double particle, double cell, const AxisRules& rules = {}) {
  const double cells = node + 0.5 * particle;
  const int nearest = nearest_node(cells), place = node - nearest + 1;
  if (place < 0 || place > 2) return {};
  const auto radial =
      AxisymmetricUgimp<double>::radial(cells - nearest, static_cast<double>(nearest), 0.5 * l_p, 1.0 / cell, rules);
  return {radial.s[place], 0.5 * cell * radial.g[place], radial.t[place]};
}

// 1e-12 relative to max(1, |value|): method reference 13.
void expect_row(double found, double expected, const std::string& of) {
  EXPECT_NEAR(found, expected, 1e-12 * std::max(1.0, std::abs(expected))) << of;
}

TEST(AxisymmetricUgimp, MatchesQuadratureRowByRow) {
  const auto rows = table_rows("axisymmetric_ugimp.csv");
  EXPECT_EQ(rows.size(), 316U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::vector<double>& v = rows[i];
    const auto found = radial_values(v[0], static_cast<int>(v[1]), v[2], v[3]);
    const std::string of = "row " + std::to_string(i);
    for (int n = 0; n < 3; ++n) expect_row(found[n], v[4 + n], of + ", value " + std::to_string(n));
  }
}

template <template <int> class Points>
void check_domain_table(const std::string& name, std::size_t count) {
  const auto rows = table_rows(name);
  EXPECT_EQ(rows.size(), count);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::vector<double>& v = rows[i];
    const Place<2> place{{v[1], v[5]}, {v[3], v[7]}, {0.5 * v[2], 0.5 * v[6]}, {{v[9], v[10]}, {v[11], v[12]}}};
    const std::array<int, 2> node = {static_cast<int>(std::lround(v[4] / v[1])),
                                     static_cast<int>(std::lround(v[8] / v[5]))};
    const RingWeight found = domain_weights<Points>(place)[node];
    const std::string of = name + " row " + std::to_string(i);
    expect_row(found.s, v[13], of);
    expect_row(found.g[0], v[14], of);
    expect_row(found.g[1], v[15], of);
    expect_row(found.t, v[16], of);
  }
}
TEST(AxisymmetricCpdi, MatchesQuadratureRowByRow) { check_domain_table<AxisymmetricCpdi>("axisymmetric_cpdi.csv", 54); }
TEST(AxisymmetricQcpdi, MatchesQuadratureRowByRow) {
  check_domain_table<AxisymmetricQcpdi>("axisymmetric_qcpdi.csv", 12);
}

// Method reference 3.3: integration by parts gives G_r + T = [r N] / D between the ends of the box.
TEST(AxisymmetricUgimp, GradientAndHoopFunctionAreTheEnds) {
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> radius(0.0, 5.0), l_p(0.1, 1.0);
  const double cell = 0.5;
  for (int i = 0; i < 1000; ++i) {
    const double r = i % 2 == 0 ? 0.1 * radius(engine) : radius(engine), half = 0.5 * l_p(engine);
    for (const AxisRules& rules : {AxisRules{}, kWhole}) {
      const double a = rules.domains == AxisDomains::whole ? r - half : std::max(0.0, r - half), b = r + half;
      if (a + b < 0.02) continue;
      const int nearest = nearest_node(r);
      const auto w =
          AxisymmetricUgimp<double>::radial(r - nearest, static_cast<double>(nearest), half, 1.0 / cell, rules);
      for (int n = 0; n < 3; ++n) {
        const double node = nearest + n - 1;
        const auto hat = [&](double x) { return std::max(0.0, 1.0 - std::abs(x - node)); };
        const double expected = (b * hat(b) - a * hat(a)) / (0.5 * (b * b - a * a)) / cell;
        EXPECT_NEAR(w.g[n] + w.t[n], expected, 1e-12 / (a + b)) << r << " " << half;
      }
    }
  }
}

// Nairn & Guilkey (2015) eq. (19) and (24) for whole domains; their (68) and (27) for T.
std::array<double, 3> closed_form(double l, int node, double x, double cell) {
  const double q = 2.0 * node + x;
  std::array<double, 3> value{};
  if (x > -2.0 - l && x < -2.0 + l) {
    value[0] = (2 + l + x) * (2 + l + x) / (8 * l) * (1 - (2 * (1 - l) + x) / (3 * q));
    value[1] = (2 + l + x) / (4 * l) * (1 - (2 - l + x) / (2 * q));
  } else if (x >= -2.0 + l && x < -l) {
    value[0] = 0.5 * (2 + x) + l * l / (6 * q);
    value[1] = 0.5;
  } else if (x >= -l && x < l) {
    value[0] = ((4 - l) * l - x * x) / (4 * l) + x * (x * x - 3 * l * l) / (12 * l * q);
    value[1] = -x / (2 * l) - (l * l - x * x) / (4 * l * q);
  } else if (x >= l && x < 2.0 - l) {
    value[0] = 0.5 * (2 - x) - l * l / (6 * q);
    value[1] = -0.5;
  } else if (x >= 2.0 - l && x < 2.0 + l) {
    value[0] = (2 + l - x) * (2 + l - x) / (8 * l) * (1 + (2 * (1 - l) - x) / (3 * q));
    value[1] = -(2 + l - x) / (4 * l) * (1 + (2 - l - x) / (2 * q));
  }
  const double cells = node + 0.5 * x;
  const int nearest = nearest_node(cells), place = node - nearest + 1;
  const Ugimp<double> plane(cells - nearest, {0.5 * l, 1.0 / cell});
  if (place >= 0 && place <= 2) value[2] = 2.0 / (cell * q) * plane.s[place];
  return value;
}

// Closed forms contain 1 / q, here up to 50, where a box reaches across the axis.
TEST(AxisymmetricUgimp, WholeDomainsAreThePapersClosedForms) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  int across = 0;
  for (int i = 0; i < 4000; ++i) {
    const double l = 0.05 + 0.95 * u(engine), r = i % 2 == 0 ? 0.01 + 0.5 * u(engine) : 0.01 + 5.0 * u(engine);
    across += r < 0.5 * l;
    for (int node = nearest_node(r) - 2; node <= nearest_node(r) + 2; ++node) {
      const double x = 2.0 * (r - node);
      const auto found = radial_values(l, node, x, 0.5, kWhole), expected = closed_form(l, node, x, 0.5);
      for (int n = 0; n < 3; ++n) EXPECT_NEAR(found[n], expected[n], 1e-12 * (1.0 + 1.0 / r)) << l << " " << r;
    }
  }
  EXPECT_GT(across, 500);
}

// Eq. (68), (69) at any radius, with T = S / r.
TEST(AxisymmetricUgimp, PlanarFunctionsAreThoseOfThePlane) {
  std::mt19937 engine(6);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const double half = 0.05 + 0.45 * u(engine), r = 0.02 + 4.0 * u(engine), cell = 0.5;
    const int nearest = nearest_node(r);
    const Ugimp<double> plane(r - nearest, {half, 1.0 / cell});
    const auto w =
        AxisymmetricUgimp<double>::radial(r - nearest, static_cast<double>(nearest), half, 1.0 / cell, kPlanar);
    for (int n = 0; n < 3; ++n) {
      EXPECT_NEAR(w.s[n], plane.s[n], 1e-14);
      EXPECT_NEAR(w.g[n], plane.g[n], 1e-13 / half / cell);
      EXPECT_NEAR(w.t[n], plane.s[n] / (r * cell), 1e-13 / (r * cell));
    }
  }
}

template <template <int> class Points, class Plane>
void check_planar_points() {
  std::mt19937 engine(7);
  for (int i = 0; i < 500; ++i) {
    Place<2> place = random_place<2>(engine);
    place.x = {std::abs(place.x[0]) + 0.02, place.x[1] + 2.0};
    auto rings = domain_weights<Points>(place, true);
    for (const auto& [node, weight] : point_weights<2, Plane>(place)) {
      const RingWeight found = rings[node];
      EXPECT_NEAR(found.s, weight.s, 1e-14);
      EXPECT_NEAR(found.t, weight.s / place.x[0], 1e-13 / place.x[0]);
      // Gradients of up to 1e3, as in shape_points_test.cpp.
      for (int k = 0; k < 2; ++k) EXPECT_NEAR(found.g[k], weight.g[k], 1e-12 * (1.0 + std::abs(weight.g[k])));
    }
  }
}
TEST(AxisymmetricCpdi, PlanarFunctionsAreThoseOfThePlane) { check_planar_points<AxisymmetricCpdi, Cpdi<2>>(); }
TEST(AxisymmetricQcpdi, PlanarFunctionsAreThoseOfThePlane) { check_planar_points<AxisymmetricQcpdi, Qcpdi<2>>(); }

// A stretched box that begins at the axis keeps its particle in the centre, so its half-width is the particle's radius.
TEST(AxisymmetricUgimpStretch, FitsByShrinkingAboutTheParticle) {
  const double r = 0.3, half = 0.45;
  const auto fitted = AxisymmetricUgimpStretch<double>::radial(r, 0.0, half, 2.0, {});
  const auto small = AxisymmetricUgimp<double>::radial(r, 0.0, r, 2.0, {});
  for (int n = 0; n < 3; ++n) {
    EXPECT_EQ(fitted.s[n], small.s[n]);
    EXPECT_EQ(fitted.g[n], small.g[n]);
    EXPECT_EQ(fitted.t[n], small.t[n]);
  }
  const auto whole = AxisymmetricUgimpStretch<double>::radial(r, 0.0, half, 2.0, kWhole);
  EXPECT_LT(whole.s[0], 0.0);  // beyond the axis r is negative
}

template <class One, class Together>
void check_radial_lanes(const AxisRules& rules) {
  std::mt19937 engine(9);
  std::uniform_real_distribution<double> offset(-0.5, 0.5), half(0.05, 0.5);
  for (int i = 0; i < 100; ++i) {
    Four<double> x, node, w;
    for (int l = 0; l < 4; ++l) {
      set_lane(node, l, static_cast<double>((i + l) % 4));
      set_lane(x, l, (i + l) % 4 == 0 ? std::abs(offset(engine)) + 0.01 : offset(engine));
      set_lane(w, l, half(engine));
    }
    const auto together = Together::radial(x, node, w, Four<double>(2.0), rules);
    for (int l = 0; l < 4; ++l) {
      const auto alone = One::radial(lane(x, l), lane(node, l), lane(w, l), 2.0, rules);
      for (int n = 0; n < 3; ++n) {
        EXPECT_EQ(lane(together.s[n], l), alone.s[n]);
        EXPECT_EQ(lane(together.g[n], l), alone.g[n]);
        EXPECT_EQ(lane(together.t[n], l), alone.t[n]);
      }
    }
  }
}
template <class Points>
void check_point_lanes() {
  std::mt19937 engine(10);
  std::uniform_real_distribution<double> component(-0.2, 0.2), radius(0.7, 2.0);
  Four<double> d[2][2], r, weight[Points::kPoints], g[Points::kPoints][2];
  for (int l = 0; l < 4; ++l) {
    set_lane(r, l, radius(engine));
    for (int k = 0; k < 2; ++k) {
      for (int c = 0; c < 2; ++c) set_lane(d[k][c], l, (k == c ? 0.5 : 0.0) + component(engine));
    }
  }
  Points::radial(d, r, weight, g);
  for (int l = 0; l < 4; ++l) {
    double d_alone[2][2], w_alone[Points::kPoints], g_alone[Points::kPoints][2];
    for (int k = 0; k < 2; ++k) {
      for (int c = 0; c < 2; ++c) d_alone[k][c] = lane(d[k][c], l);
    }
    Points::radial(d_alone, lane(r, l), w_alone, g_alone);
    for (int a = 0; a < Points::kPoints; ++a) {
      EXPECT_EQ(lane(weight[a], l), w_alone[a]);
      for (int c = 0; c < 2; ++c) EXPECT_EQ(lane(g[a][c], l), g_alone[a][c]);
    }
  }
}
TEST(Lanes, OfAxisymmetricShapesAreAsNumbersAlone) {
  for (const AxisRules& rules : {AxisRules{}, kWhole, kPlanar}) {
    check_radial_lanes<AxisymmetricDirac<double>, AxisymmetricDirac<Four<double>>>(rules);
    check_radial_lanes<AxisymmetricUgimp<double>, AxisymmetricUgimp<Four<double>>>(rules);
    check_radial_lanes<AxisymmetricUgimpStretch<double>, AxisymmetricUgimpStretch<Four<double>>>(rules);
  }
  check_point_lanes<AxisymmetricCpdi<2>>();
  check_point_lanes<AxisymmetricQcpdi<2>>();
}

}  // namespace axisymmetric_shapes_test
}  // namespace mpm::test
