// uGIMP against values by quadrature (test/data/ugimp.csv, 135 rows) and its identities.
#include "mpm/shape/ugimp.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>

#include "mpm/grid/grid_layout.hpp"
#include "mpm/kernel/weights.hpp"
#include "test_files.hpp"

namespace ugimp_test {

using mpm::GridLayout;
using mpm::Ugimp;

struct Axis {
  double cell, l_p, particle, node;
};

// Shape function and physical gradient along one axis, 0 beyond the three nodes.
std::pair<double, double> evaluate(const Axis& axis) {
  const double cells = axis.particle / axis.cell;
  const int nearest = GridLayout::nearest(cells);
  const Ugimp<double> shape(cells - nearest, {0.5 * axis.l_p, 1.0 / axis.cell});
  const int place = static_cast<int>(std::lround(axis.node / axis.cell)) - nearest + 1;
  if (place < 0 || place > 2) return {0.0, 0.0};
  return {shape.s[place], shape.g[place]};
}

TEST(Ugimp, MatchesQuadratureRowByRow) {
  std::ifstream file(data_file("ugimp.csv"));
  ASSERT_TRUE(file);
  int rows = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::vector<double> v;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) v.push_back(std::stod(cell));
    const int dim = static_cast<int>(v[0]);
    ASSERT_EQ(v.size(), static_cast<std::size_t>(2 + 5 * dim)) << line;
    double s[3], g[3], value = 1.0;
    for (int k = 0; k < dim; ++k) {
      std::tie(s[k], g[k]) = evaluate({v[1 + 4 * k], v[2 + 4 * k], v[3 + 4 * k], v[4 + 4 * k]});
      value *= s[k];
    }
    // 1e-12 relative to max(1, |value|): method reference 13.
    EXPECT_NEAR(value, v[1 + 4 * dim], 1e-12) << line;
    for (int k = 0; k < dim; ++k) {
      double gradient = g[k];
      for (int m = 0; m < dim; ++m) gradient *= m == k ? 1.0 : s[m];
      const double expected = v[2 + 4 * dim + k];
      EXPECT_NEAR(gradient, expected, 1e-12 * std::max(1.0, std::abs(expected))) << line;
    }
    ++rows;
  }
  EXPECT_EQ(rows, 135);
}

TEST(Ugimp, ReproducesConstantsAndLinearFields) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> offset(-0.5, 0.5), half(0.05, 0.5);
  for (int i = 0; i < 1000; ++i) {
    const double x = offset(engine), cell = 0.3;
    const Ugimp<double> w(x, {half(engine), 1.0 / cell});
    EXPECT_NEAR(w.s[0] + w.s[1] + w.s[2], 1.0, 1e-15);
    EXPECT_NEAR(w.g[0] + w.g[1] + w.g[2], 0.0, 1e-14);
    EXPECT_NEAR(w.s[2] - w.s[0], x, 1e-15);
    EXPECT_NEAR((w.g[2] - w.g[0]) * cell, 1.0, 1e-14);
  }
}

// The weights of a register of particles are at the right nodes: the sum of x_i S is x_p, the sum of x_i G is 1.
TEST(Weights, FindTheirNodesInTheTile) {
  const GridLayout layout(3, {0.1, 0.2, 0.25}, {-1.0, 0.0, 2.0}, {3.0, 4.0, 6.0});
  const double place[3][2] = {{0.431, 0.478}, {1.97, 2.02}, {3.08, 3.13}};  // two particles of one block
  mpm::GridView grid{};
  mpm::SetView<double> set{};
  mpm::BlockView block{};
  for (int k = 0; k < 3; ++k) {
    grid.origin[k] = layout.origin(k);
    grid.inverse_cell[k] = layout.inverse_cell(k);
    set.half[k] = 0.25;
    set.x[k] = place[k];
    block.corner[k] = GridLayout::nearest(layout.in_cells(k, place[k][0])) / 4 * 4 - mpm_kernel::kTileMargin;
  }
  mpm::Weights<double, 3, 3, false> w;
  mpm::WeightMaker<double, 3, Ugimp>::fill<mpm::Beside::gradient>(grid, block, set, 0, 2, &w);
  for (int p = 0; p < 2; ++p) {
    const int nearest[3] = {w.node[p] / 64, w.node[p] / 8 % 8, w.node[p] % 8};
    for (int k = 0; k < 3; ++k) {
      double x = 0.0, gradient = 0.0;
      for (int n = 0; n < 3; ++n) {
        const double node = layout.origin(k) + (block.corner[k] + nearest[k] + n - 1) * layout.cell(k);
        x += w.s[k][n][p] * node;
        gradient += w.g[k][n][p] * node;
      }
      EXPECT_NEAR(x, place[k][p], 1e-13);
      EXPECT_NEAR(gradient, 1.0, 1e-13);
    }
  }
}

}  // namespace ugimp_test
