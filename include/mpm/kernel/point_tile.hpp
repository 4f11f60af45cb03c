// Hat functions at single points of a tile: what a point of a particle's domain takes from the nodes of its cell, and
// gives to them. Nodes lie with their four components together, so two nodes along the last axis are one vector, and a
// point's cell is one such pair (line), two (plane) or four.
#pragma once

#include "mpm/kernel/tile.hpp"

namespace mpm {

template <class T>
struct PointVectors {
  typedef T Four __attribute__((vector_size(4 * sizeof(T))));
  typedef T Pair __attribute__((vector_size(8 * sizeof(T))));

  static Pair load(const T* from) {
    Pair v;
    __builtin_memcpy(&v, from, sizeof(v));
    return v;
  }
  static void add(T* to, Pair v) {
    v += load(to);
    __builtin_memcpy(to, &v, sizeof(v));
  }
  static Four lower(Pair v) { return __builtin_shufflevector(v, v, 0, 1, 2, 3); }
  static Four upper(Pair v) { return __builtin_shufflevector(v, v, 4, 5, 6, 7); }
  static Pair pair(Four a, Four b) { return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7); }
};

/// Place of a point: the lower corner of its cell in the tile, and its distance along each edge, 0 to 1.
template <class T, int Dim>
struct CellPoint {
  int node;
  T along[Dim];

  /// visit(first of two nodes along the last axis, weight of the pair, place of the pair along the axes but the last).
  template <class Visit>
  void each_pair(Visit&& visit) const {
    if constexpr (Dim == 1) {
      visit(node, T(1), 0, 0);
    } else if constexpr (Dim == 2) {
      visit(node, T(1) - along[0], 0, 0);
      visit(node + kTileEdge, along[0], 1, 0);
    } else {
      for (int i = 0; i < 2; ++i) {
        const T first = i == 0 ? T(1) - along[0] : along[0];
        visit(node + i * kTileEdge * kTileEdge, first * (T(1) - along[1]), i, 0);
        visit(node + (i * kTileEdge + 1) * kTileEdge, first * along[1], i, 1);
      }
    }
  }
};

/// Up to four components to gather from.
template <class T, int Dim>
struct PointTile {
  using Shape = TileShape<Dim>;
  using Four = typename PointVectors<T>::Four;
  using Pair = typename PointVectors<T>::Pair;
  alignas(64) T nodes[4 * (Shape::kRows * kTileEdge + 1)];

  template <int Components>
  [[gnu::noinline]] void load(const double* field, const BlockView& block) {
    Shape::each_row(block, [&](int row, const int* blocks, int node) {
      const double* part[3];
      for (int b = 0; b < 3; ++b)
        part[b] = field + blocks[b] * (Components * static_cast<long>(Shape::kBlockNodes)) + node;
      T* to = nodes + 4 * row * kTileEdge;
      for (int c = 0; c < Components; ++c) {
        const int at = c * Shape::kBlockNodes;
        for (int z = 0; z < 2; ++z) to[4 * z + c] = static_cast<T>(part[0][at + z + 2]);
        for (int z = 0; z < 4; ++z) to[4 * (z + 2) + c] = static_cast<T>(part[1][at + z]);
        for (int z = 0; z < 2; ++z) to[4 * (z + 6) + c] = static_cast<T>(part[2][at + z]);
      }
      for (int c = Components; c < 4; ++c) {
        for (int z = 0; z < kTileEdge; ++z) to[4 * z + c] = T(0);
      }
    });
  }

  Four at(const CellPoint<T, Dim>& point) const {
    using V = PointVectors<T>;
    Pair sum{};
    point.each_pair([&](int node, T weight, int, int) { sum += weight * V::load(nodes + 4 * node); });
    const Four low = V::lower(sum);
    return low + point.along[Dim - 1] * (V::upper(sum) - low);
  }
};

/// As many tiles as it takes for `Fields` components, at most Dim of them in each.
template <class T, int Dim, int Fields>
struct PointTiles {
  static constexpr int kTiles = (Fields + Dim - 1) / Dim;
  PointTile<T, Dim> tile[kTiles];

  /// Copies the `components` of a nodal field into the components `first`, …, of which the first of a tile is one.
  template <int Components>
  void load(const double* field, const BlockView& block, int first) {
    tile[first / Dim].template load<Components>(field, block);
  }
};

/// Adds `value` to the nodes around the point, by their hat functions.
template <class T, int Dim>
void spread_point(const CellPoint<T, Dim>& point, typename PointVectors<T>::Four value, T* nodes) {
  using V = PointVectors<T>;
  const auto high = point.along[Dim - 1] * value;
  const auto both = V::pair(value - high, high);
  point.each_pair([&](int node, T weight, int, int) { V::add(nodes + 4 * node, weight * both); });
}

}  // namespace mpm
