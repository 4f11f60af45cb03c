// Dirac, stretched uGIMP and B-splines: reference values, identities, limits, and folding at walls.
#include <algorithm>

#include "lanes.hpp"
#include "mpm/shape/bspline.hpp"
#include "mpm/shape/dirac.hpp"
#include "mpm/shape/ugimp.hpp"
#include "mpm/shape/ugimp_stretch.hpp"
#include "shape_check.hpp"

namespace mpm::test {
namespace shape_stencils_test {

static_assert(Dirac<double>::kNodes == 3 && Ugimp<double>::kNodes == 3 && UgimpStretch<double>::kNodes == 3);
static_assert(QuadraticSpline<double>::kNodes == 3 && CubicSpline<double>::kNodes == 5);
static_assert(UgimpStretch<double>::kStretches && !Ugimp<double>::kStretches && !Dirac<double>::kStretches);
static_assert(QuadraticSpline<double>::kFoldsAtWalls && CubicSpline<double>::kFoldsAtWalls);
static_assert(!Ugimp<double>::kFoldsAtWalls && !UgimpStretch<double>::kFoldsAtWalls && !Dirac<double>::kFoldsAtWalls);

template <template <class> class Shape, class T = double>
Shape<T> shape_at(T offset, double half, double stretch, double inverse_cell) {
  const typename Shape<T>::Axis axis(half, inverse_cell);
  if constexpr (Shape<T>::kStretches) {
    return Shape<T>(offset, Shape<T>::half(T(stretch), axis), axis);
  } else {
    return Shape<T>(offset, axis);
  }
}

template <template <class> class Shape, int Dim>
void check_stencil(unsigned seed) {
  std::mt19937 engine(seed);
  for (int i = 0; i < 1000; ++i) {
    const Place<Dim> place = random_place<Dim>(engine);
    const auto weights = stencil_weights<Dim>([&](int k) {
      const double cells = place.x[k] / place.cell[k];
      return along_axis(shape_at<Shape>(cells - nearest_node(cells), place.half[k], place.f[k][k], 1.0 / place.cell[k]),
                        cells);
    });
    // Values of order 1. Gradients: 1/(cell 0.3) times differences over boxes of 0.02 cell or more, which cost two
    // digits.
    check_identities<Dim>(weights, place, 1e-14, 1e-12);
  }
}

template <template <class> class Shape>
void check_all_dimensions() {
  check_stencil<Shape, 1>(11);
  check_stencil<Shape, 2>(12);
  check_stencil<Shape, 3>(13);
}

TEST(Dirac, ReproducesConstantsAndLinearFields) { check_all_dimensions<Dirac>(); }
TEST(Ugimp, ReproducesConstantsAndLinearFieldsInEveryDimension) { check_all_dimensions<Ugimp>(); }
TEST(UgimpStretch, ReproducesConstantsAndLinearFields) { check_all_dimensions<UgimpStretch>(); }
TEST(QuadraticSpline, ReproducesConstantsAndLinearFields) { check_all_dimensions<QuadraticSpline>(); }
TEST(CubicSpline, ReproducesConstantsAndLinearFields) { check_all_dimensions<CubicSpline>(); }

// Every node of the stencil, and zero beyond it, against the tables: 1e-12 as method reference 13 suggests.
template <template <class> class Spline>
void check_spline_table(int value, int slope) {
  const auto rows = table_rows("bspline.csv");
  EXPECT_EQ(rows.size(), 14U);
  for (const auto& row : rows) {
    const double cell = 0.25, cells = row[0];
    const int nearest = nearest_node(cells);
    const Spline<double> spline(cells - nearest, {0.25, 1.0 / cell});
    const int place = Spline<double>::kNodes / 2 - nearest;
    const bool reached = 0 <= place && place < Spline<double>::kNodes;
    EXPECT_NEAR(reached ? spline.s[place] : 0.0, row[value], 1e-12) << cells;
    EXPECT_NEAR(reached ? spline.g[place] * cell : 0.0, row[slope], 1e-12) << cells;
  }
}

TEST(QuadraticSpline, MatchesTheReferenceRowByRow) { check_spline_table<QuadraticSpline>(1, 2); }
TEST(CubicSpline, MatchesTheReferenceRowByRow) { check_spline_table<CubicSpline>(3, 4); }

// Offsets over the whole range, including its ends.
std::vector<double> offsets() {
  std::vector<double> all;
  for (int i = -500; i <= 500; ++i) all.push_back(0.001 * i);
  return all;
}

// Method reference 2.1: uGIMP with l_p = 1 is the quadratic B-spline.
TEST(QuadraticSpline, IsUgimpOfAWholeCell) {
  for (const double x : offsets()) {
    const QuadraticSpline<double> spline(x, {0.25, 4.0});
    const Ugimp<double> box(x, {0.5, 4.0});
    for (int n = 0; n < 3; ++n) {
      EXPECT_NEAR(spline.s[n], box.s[n], 1e-15);
      EXPECT_NEAR(spline.g[n], box.g[n], 1e-14);  // 1/cell is 4
    }
  }
}

// The box's average of a hat differs from the hat at the centre where a kink is inside: most when the particle is at
// the kink, by w/2 at the node and w/4 at its neighbours. Without a kink inside, both agree, including gradients.
TEST(Dirac, IsTheLimitOfUgimpOfASmallBox) {
  for (const double w : {1e-1, 1e-2, 1e-3, 1e-4}) {
    const double round_off = 1e-16 / w;  // differences of squares and of numbers, divided by the box
    double value = 0.0, gradient = 0.0;
    for (const double x : offsets()) {
      const Dirac<double> point(x, {w, 1.0});
      const Ugimp<double> box(x, {w, 1.0});
      for (int n = 0; n < 3; ++n) {
        EXPECT_NEAR(point.s[n], box.s[n], (n == 1 ? 0.5 : 0.25) * w + round_off);
        if (std::abs(x) < w) continue;
        value = std::max(value, std::abs(point.s[n] - box.s[n]));
        gradient = std::max(gradient, std::abs(point.g[n] - box.g[n]));
      }
    }
    EXPECT_LT(value, round_off) << w;
    EXPECT_LT(gradient, 2.0 * round_off) << w;
    EXPECT_NEAR(Ugimp<double>(0.0, {w, 1.0}).s[0], 0.25 * w, 1e-16);
  }
}

TEST(Dirac, OnANodeHasTheGradientOfTheCellAbove) {
  for (const double zero : {0.0, -0.0}) {
    const Dirac<double> point(zero, {0.25, 4.0});
    EXPECT_EQ(point.s[1], 1.0);
    EXPECT_EQ(point.g[0], 0.0);
    EXPECT_EQ(point.g[1], -4.0);
    EXPECT_EQ(point.g[2], 4.0);
  }
}

// Undeformed it is uGIMP; stretched, it is uGIMP of the longer box, with a half-width between a hundredth of a cell and
// half a cell.
TEST(UgimpStretch, IsUgimpOfItsBox) {
  const double w = 0.2, per_cell = 4.0;
  const UgimpStretch<double>::Axis axis(w, per_cell);
  const double cases[][2] = {{1.0, 0.2}, {1.5, 0.3},   {0.1, 0.02},  {-0.5, 0.1}, {2.5, 0.5},
                             {4.0, 0.5}, {0.05, 0.01}, {0.04, 0.01}, {0.0, 0.01}};
  for (const auto& [stretch, expected] : cases) {
    const double half = UgimpStretch<double>::half(stretch, axis);
    EXPECT_DOUBLE_EQ(half, expected) << stretch;
    for (const double x : offsets()) {
      const UgimpStretch<double> box(x, half, axis);
      const Ugimp<double> fixed(x, {half, per_cell});
      for (int n = 0; n < 3; ++n) {
        EXPECT_NEAR(box.s[n], fixed.s[n], 1e-15);  // sums are the same; constants may differ by an epsilon
        EXPECT_NEAR(box.g[n], fixed.g[n], 1e-14);
      }
    }
  }
}

// --- walls ------------------------------------------------------------------------------------------------------

/// Weights at every node of a stencil of a particle at `cells`, in a domain between nodes 0 and `high`; the cell is 1.
template <template <class> class Spline>
Spline<double> folded(double cells, int high) {
  const int nearest = nearest_node(cells);
  Spline<double> spline(cells - nearest, {0.25, 1.0});
  spline.fold(nearest, high - nearest);
  return spline;
}

template <template <class> class Spline>
void check_walls() {
  constexpr int kReach = Spline<double>::kNodes / 2;
  for (const int high : {1, 2, 3, 4, 5, 9}) {
    for (int i = 0; i <= 1000 * high; ++i) {
      const double cells = 0.001 * i;
      const int nearest = nearest_node(cells);
      const Spline<double> plain(cells - nearest, {0.25, 1.0}), spline = folded<Spline>(cells, high);
      double sum = 0.0, slopes = 0.0, place = 0.0, slope = 0.0;
      for (int n = 0; n < Spline<double>::kNodes; ++n) {
        const int node = nearest - kReach + n;
        if (node < 0 || node > high) {
          EXPECT_EQ(spline.s[n], 0.0);
          EXPECT_EQ(spline.g[n], 0.0);
        }
        EXPECT_GE(spline.s[n], -1e-16) << cells << " of " << high;  // zero up to a difference of numbers below 1
        if (nearest >= kReach && nearest <= high - kReach) {
          EXPECT_EQ(spline.s[n], plain.s[n]);
          EXPECT_EQ(spline.g[n], plain.g[n]);
        }
        sum += spline.s[n];
        slopes += spline.g[n];
        place += spline.s[n] * (n - kReach);
        slope += spline.g[n] * (n - kReach);
      }
      EXPECT_NEAR(sum, 1.0, 2e-15);
      EXPECT_NEAR(slopes, 0.0, 2e-15);
      EXPECT_NEAR(place, cells - nearest, 2e-15);
      EXPECT_NEAR(slope, 1.0, 4e-15);
    }
  }
}

TEST(QuadraticSpline, FoldedKeepsItsIdentities) { check_walls<QuadraticSpline>(); }
TEST(CubicSpline, FoldedKeepsItsIdentities) { check_walls<CubicSpline>(); }

// Interpolates a field of three or more nodal values at a particle.
template <template <class> class Spline>
std::pair<double, double> field(double cells, const std::vector<double>& nodes) {
  const Spline<double> spline = folded<Spline>(cells, static_cast<int>(nodes.size()) - 1);
  std::pair<double, double> sum{0.0, 0.0};
  for (int n = 0; n < Spline<double>::kNodes; ++n) {
    const int node = nearest_node(cells) - Spline<double>::kNodes / 2 + n;
    if (node < 0 || node >= static_cast<int>(nodes.size())) continue;
    sum.first += spline.s[n] * nodes[node];
    sum.second += spline.g[n] * nodes[node];
  }
  return sum;
}

// The gradient is the slope of the value, over kinks of its second or third derivative too: with a curvature of at most
// 20 for nodal values within 2, the slope over 2e-6 is off by 2e-5 at most where curvature jumps.
template <template <class> class Spline>
void check_slopes() {
  const std::vector<double> nodes = {0.7, -1.3, 0.4, 1.9, -0.8, 0.1};
  constexpr double kStep = 1e-6;
  for (int i = 1; i < 500; ++i) {
    const double cells = 0.01 * i;
    const double up = field<Spline>(cells + kStep, nodes).first, down = field<Spline>(cells - kStep, nodes).first;
    EXPECT_NEAR((up - down) / (2.0 * kStep), field<Spline>(cells, nodes).second, 2e-5) << cells;
  }
}

TEST(QuadraticSpline, FoldedHasTheSlopeOfItsValue) { check_slopes<QuadraticSpline>(); }
TEST(CubicSpline, FoldedHasTheSlopeOfItsValue) { check_slopes<CubicSpline>(); }

// As derived in the header: the hat within half a cell of a wall; 1 - x + x^3/6, x - x^3/3, x^3/6; the second moments.
TEST(QuadraticSpline, FoldedIsTheHatNextToAWall) {
  for (double x = 0.0; x < 0.4995; x += 0.001) {
    const auto low = folded<QuadraticSpline>(x, 4), high = folded<QuadraticSpline>(4.0 - x, 4);
    const Dirac<double> hat(x, {0.25, 1.0});
    for (int n = 0; n < 3; ++n) {
      EXPECT_NEAR(low.s[n], hat.s[n], 1e-15);
      EXPECT_NEAR(low.g[n], hat.g[n], 1e-15);
      EXPECT_NEAR(high.s[2 - n], hat.s[n], 1e-15);
    }
    EXPECT_NEAR(low.s[2] - x * x, x * (1.0 - x), 1e-15);
  }
}

TEST(CubicSpline, FoldedIsTheHeadersPolynomialNextToAWall) {
  for (double x = 0.0; x < 0.4995; x += 0.001) {
    const auto low = folded<CubicSpline>(x, 4);
    EXPECT_NEAR(low.s[2], 1.0 - x + x * x * x / 6.0, 1e-15);
    EXPECT_NEAR(low.s[3], x - x * x * x / 3.0, 1e-15);
    EXPECT_NEAR(low.s[4], x * x * x / 6.0, 1e-15);
    EXPECT_NEAR(low.s[3] + 4.0 * low.s[4] - x * x, x - x * x + x * x * x / 3.0, 2e-15);
  }
}

// A particle slightly past the wall gets the linear continuation of the field.
TEST(CubicSpline, BeyondAWallContinuesALinearField) {
  for (const double x : {-0.4, -0.1, -1e-9}) {
    const auto low = folded<CubicSpline>(x, 4), high = folded<CubicSpline>(4.0 - x, 4);
    EXPECT_EQ(low.s[0], 0.0);
    EXPECT_EQ(low.s[1], 0.0);
    EXPECT_NEAR(low.s[2] + low.s[3] + low.s[4], 1.0, 1e-15);
    EXPECT_NEAR(low.s[3] + 2.0 * low.s[4], x, 1e-15);
    EXPECT_NEAR(low.g[3] + 2.0 * low.g[4], 1.0, 1e-15);
    for (int n = 0; n < 5; ++n) EXPECT_NEAR(high.s[4 - n], low.s[n], 1e-15);
  }
}

// --- registers --------------------------------------------------------------------------------------------------

// Particles at -0.4, -0.1, 0.2 and 0.5 cells from their node, 0 to 3 nodes from the lower wall, 3 to 0 from the upper.
template <template <class> class Shape>
void check_lanes() {
  Four<double> offset, stretch, below;
  for (int i = 0; i < 4; ++i) {
    set_lane(offset, i, -0.4 + 0.3 * i);
    set_lane(stretch, i, 0.5 * i);
    set_lane(below, i, double(i));
  }
  using Together = Shape<Four<double>>;
  using Alone = Shape<double>;
  const auto fold = [](auto& shape, auto low, auto high) {
    if constexpr (Alone::kFoldsAtWalls) shape.fold(low, high);
  };
  const auto make = [](auto x, auto f) {
    using S = Shape<decltype(x)>;
    const typename S::Axis axis(0.25, 10.0);
    if constexpr (S::kStretches) return S(x, S::half(f, axis), axis);
    if constexpr (!S::kStretches) return S(x, axis);
  };
  Together together = make(offset, stretch);
  fold(together, below, Four<double>(3.0) - below);
  for (int i = 0; i < 4; ++i) {
    Alone alone = make(lane(offset, i), lane(stretch, i));
    fold(alone, double(i), 3.0 - i);
    auto single = make(float(lane(offset, i)), float(lane(stretch, i)));
    fold(single, float(i), 3.0F - float(i));
    for (int n = 0; n < Alone::kNodes; ++n) {
      EXPECT_EQ(lane(together.s[n], i), alone.s[n]);
      EXPECT_EQ(lane(together.g[n], i), alone.g[n]);
      // Epsilon of single precision, 25 times for a box of a hundredth of a cell; 1/cell is 10.
      EXPECT_NEAR(single.s[n], alone.s[n], 3e-6);
      EXPECT_NEAR(single.g[n], alone.g[n], 1e-4);
    }
  }
}

TEST(Lanes, OfStencilsAreAsNumbersAlone) {
  check_lanes<Dirac>();
  check_lanes<Ugimp>();
  check_lanes<UgimpStretch>();
  check_lanes<QuadraticSpline>();
  check_lanes<CubicSpline>();
}

}  // namespace shape_stencils_test
}  // namespace mpm::test
