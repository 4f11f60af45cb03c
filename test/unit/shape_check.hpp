// Tools for the tests of shape functions: the weights of a particle at every node that it reaches, from a stencil along
// each axis or from a set of points, and the identities that hold for all shape functions (method reference 1.1).
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "test_files.hpp"

namespace mpm::test {

/// Rows of test/data/`name`; lines that begin with # are skipped.
inline std::vector<std::vector<double>> table_rows(const std::string& name) {
  std::ifstream file(data_file(name));
  EXPECT_TRUE(file) << name;
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::stringstream stream(line);
    rows.emplace_back();
    for (std::string cell; std::getline(stream, cell, ',');) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

/// A particle among nodes at multiples of the cell. Lengths in [m].
template <int Dim>
struct Place {
  std::array<double, Dim> cell, x;
  std::array<double, Dim> half;  ///< half-widths of the undeformed box [cells]
  double f[Dim][Dim];            ///< deformation gradient

  /// Half vectors of the domain [m].
  void domain(double (&d)[Dim][Dim]) const {
    for (int k = 0; k < Dim; ++k) {
      for (int c = 0; c < Dim; ++c) d[k][c] = f[c][k] * half[k] * cell[k];
    }
  }
};

/// Value and gradient [1/m] at one node.
template <int Dim>
struct Weight {
  double s = 0.0;
  std::array<double, Dim> g{};
};

/// Weights by the node's number along each axis; a node without an entry has weight 0.
template <int Dim>
using NodeWeights = std::map<std::array<int, Dim>, Weight<Dim>>;

/// N values and N gradients [1/m] at the nodes from nearest - N/2.
struct Along {
  int nearest;
  std::vector<double> s, g;
};

inline int nearest_node(double cells) { return static_cast<int>(std::floor(cells + 0.5)); }

/// Weights of a product of stencils; `along(k)` is the stencil on axis k.
template <int Dim, class AlongAxis>
NodeWeights<Dim> stencil_weights(const AlongAxis& along) {
  std::array<Along, Dim> axes;
  int count = 1;
  for (int k = 0; k < Dim; ++k) {
    axes[k] = along(k);
    count *= static_cast<int>(axes[k].s.size());
  }
  NodeWeights<Dim> weights;
  for (int i = 0; i < count; ++i) {
    std::array<int, Dim> node, place;
    for (int k = 0, rest = i; k < Dim; ++k) {
      const int size = static_cast<int>(axes[k].s.size());
      place[k] = rest % size;
      node[k] = axes[k].nearest - size / 2 + place[k];
      rest /= size;
    }
    Weight<Dim>& weight = weights[node];
    weight.s = 1.0;
    weight.g.fill(1.0);
    for (int k = 0; k < Dim; ++k) {
      weight.s *= axes[k].s[place[k]];
      for (int m = 0; m < Dim; ++m) weight.g[m] *= m == k ? axes[k].g[place[k]] : axes[k].s[place[k]];
    }
  }
  return weights;
}

/// Values of the stencil `shape` at `cells`.
template <class Shape>
Along along_axis(const Shape& shape, double cells) {
  return {nearest_node(cells), {std::begin(shape.s), std::end(shape.s)}, {std::begin(shape.g), std::end(shape.g)}};
}

/// Weights of a set of points: S = sum of w_a N(x_a), G = sum of N(x_a) g_a with the hat N.
template <int Dim, class Points>
NodeWeights<Dim> point_weights(const Place<Dim>& particle) {
  double d[Dim][Dim], offset[Points::kPoints][Dim], g[Points::kPoints][Dim];
  particle.domain(d);
  Points::offsets(d, offset);
  Points::gradients(d, g);
  NodeWeights<Dim> weights;
  for (int a = 0; a < Points::kPoints; ++a) {
    std::array<int, Dim> low;
    std::array<double, Dim> beyond;
    for (int k = 0; k < Dim; ++k) {
      const double cells = (particle.x[k] + offset[a][k]) / particle.cell[k];
      low[k] = static_cast<int>(std::floor(cells));
      beyond[k] = cells - low[k];
    }
    for (int corner = 0; corner < 1 << Dim; ++corner) {
      std::array<int, Dim> node = low;
      double hat = 1.0;
      for (int k = 0; k < Dim; ++k) {
        const int up = corner >> k & 1;
        node[k] += up;
        hat *= up == 1 ? beyond[k] : 1.0 - beyond[k];
      }
      Weight<Dim>& weight = weights[node];
      weight.s += Points::weight(a) * hat;
      for (int k = 0; k < Dim; ++k) weight.g[k] += g[a][k] * hat;
    }
  }
  return weights;
}

/// Checks that the sum of S is 1, that of G is 0, and that linear fields keep value and gradient. `value`, `gradient`:
/// round-off of sums of S and of G. Positions are relative to the particle's nearest node, so they are a few cells at
/// most.
template <int Dim>
void check_identities(const NodeWeights<Dim>& weights, const Place<Dim>& particle, double value, double gradient) {
  double one = 0.0;
  std::array<double, Dim> zero{}, x{};
  double identity[Dim][Dim] = {};
  for (const auto& [node, weight] : weights) {
    one += weight.s;
    for (int k = 0; k < Dim; ++k) {
      const int from_nearest = node[k] - nearest_node(particle.x[k] / particle.cell[k]);
      x[k] += from_nearest * particle.cell[k] * weight.s;
      zero[k] += weight.g[k];
      for (int m = 0; m < Dim; ++m) identity[k][m] += from_nearest * particle.cell[k] * weight.g[m];
    }
  }
  EXPECT_NEAR(one, 1.0, value);
  for (int k = 0; k < Dim; ++k) {
    EXPECT_NEAR(zero[k], 0.0, gradient);
    EXPECT_NEAR(x[k], particle.x[k] - nearest_node(particle.x[k] / particle.cell[k]) * particle.cell[k], value);
    for (int m = 0; m < Dim; ++m) EXPECT_NEAR(identity[k][m], k == m ? 1.0 : 0.0, gradient);
  }
}

/// A random particle: unequal cells, boxes of 1/10 to 1 cell, and a deformation that leaves at least a quarter of the
/// volume.
template <int Dim>
Place<Dim> random_place(std::mt19937& engine) {
  std::uniform_real_distribution<double> x(-2.0, 2.0), half(0.05, 0.5), strain(-0.7, 0.7);
  constexpr std::array<double, 3> kCells = {0.5, 0.8, 0.3};
  Place<Dim> place;
  double determinant;
  do {
    for (int k = 0; k < Dim; ++k) {
      place.cell[k] = kCells[k];
      place.x[k] = x(engine);
      place.half[k] = half(engine);
      for (int c = 0; c < Dim; ++c) place.f[k][c] = (k == c ? 1.0 : 0.0) + strain(engine);
    }
    const auto& f = place.f;
    if constexpr (Dim == 1) {
      determinant = f[0][0];
    } else if constexpr (Dim == 2) {
      determinant = f[0][0] * f[1][1] - f[0][1] * f[1][0];
    } else {
      determinant = f[0][0] * (f[1][1] * f[2][2] - f[1][2] * f[2][1]) -
                    f[0][1] * (f[1][0] * f[2][2] - f[1][2] * f[2][0]) +
                    f[0][2] * (f[1][0] * f[2][1] - f[1][1] * f[2][0]);
    }
  } while (determinant < 0.25);
  return place;
}

/// A row of a table of point sets: the particle, and its weight at one node.
template <int Dim>
struct TableRow {
  Place<Dim> particle;
  std::array<int, Dim> node;
  Weight<Dim> expected;
};

/// Rows of dimension Dim in test/data/`name`: per axis cell, l_p, particle, node; F by rows; S; G.
template <int Dim>
std::vector<TableRow<Dim>> point_table(const std::string& name) {
  std::vector<TableRow<Dim>> table;
  for (const std::vector<double>& v : table_rows(name)) {
    if (static_cast<int>(v[0]) != Dim) continue;
    EXPECT_EQ(v.size(), static_cast<std::size_t>(2 + 5 * Dim + Dim * Dim));
    TableRow<Dim> row;
    const double *const deformation = &v[1 + 4 * Dim], *const found = deformation + Dim * Dim;
    row.expected.s = found[0];
    for (int k = 0; k < Dim; ++k) {
      row.particle.cell[k] = v[1 + 4 * k];
      row.particle.half[k] = 0.5 * v[2 + 4 * k];
      row.particle.x[k] = v[3 + 4 * k];
      row.node[k] = static_cast<int>(std::lround(v[4 + 4 * k] / v[1 + 4 * k]));
      row.expected.g[k] = found[1 + k];
      for (int c = 0; c < Dim; ++c) row.particle.f[k][c] = deformation[Dim * k + c];
    }
    table.push_back(row);
  }
  return table;
}

/// Checks every row to 1e-12 relative to max(1, |value|), as method reference 13 suggests.
template <int Dim, class Points>
void check_table(const std::string& name, int rows) {
  const auto table = point_table<Dim>(name);
  EXPECT_EQ(static_cast<int>(table.size()), rows);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto& [particle, node, expected] = table[i];
    const Weight<Dim> found = point_weights<Dim, Points>(particle)[node];
    EXPECT_NEAR(found.s, expected.s, 1e-12) << name << " row " << i;
    for (int k = 0; k < Dim; ++k) {
      EXPECT_NEAR(found.g[k], expected.g[k], 1e-12 * std::max(1.0, std::abs(expected.g[k]))) << name << " row " << i;
    }
  }
}

}  // namespace mpm::test
