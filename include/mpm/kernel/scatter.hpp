// Scatters: a particle at a time, lanes are (node along the last axis, component). A particle's contribution to a row
// of nodes, three or five, is an outer product, made once and added to all rows (9 of three in a solid, 3 in a plane)
// with the weights of the other axes.
// The sums of a run of particles with one nearest node stay in registers; they go to the tile when the node changes.
//
// What a particle brings was computed with particles in the lanes, and passes through a buffer in cache: components are
// turned there (interleave), weights are read as numbers.
// Weak: the fourth node of a row and, of a force, the fourth component are carried as zeros, since a register is a
// power of two: 9 of 16 lanes of a force do work.
#pragma once

#include "mpm/kernel/chunks.hpp"
#include "mpm/kernel/interleave.hpp"
#include "mpm/kernel/weights.hpp"

namespace mpm {

/// Four components of a row of nodes (and of a node or two more, zero, where a register has room) in registers.
template <class T, int Nodes>
struct NodeRow {
  using W = Wide<T>;
  using B = Backend<T>;
  static constexpr int kLanes = W::kLanes;
  static constexpr int kRegisters = (4 * Nodes + kLanes - 1) / kLanes;
  W r[kRegisters];

  /// `weight[node]` times `component`, of four.
  static NodeRow outer(const T (&weight)[Nodes][kBuffer], int p, const T* component) {
    NodeRow row;
    if constexpr (kLanes > 4) {
      const W all(B::repeat(component));
      for (int k = 0; k < kRegisters; ++k) row.r[k] = weights(weight, p, k) * all;
    } else {
      for (int k = 0; k < kRegisters; ++k) {
        row.r[k] = W(B::set(weight[k * kLanes / 4][p])) * W::load(component + k * kLanes % 4);
      }
    }
    return row;
  }
  /// this += a * number
  void add(const NodeRow& a, T number) {
    for (int k = 0; k < kRegisters; ++k) r[k] += W(W::B::set(number)) * a.r[k];
  }
  void add(const NodeRow& a) {
    for (int k = 0; k < kRegisters; ++k) r[k] += a.r[k];
  }
  void subtract(const NodeRow& a) {
    for (int k = 0; k < kRegisters; ++k) r[k] -= a.r[k];
  }
  NodeRow times(T number) const {
    NodeRow row;
    for (int k = 0; k < kRegisters; ++k) row.r[k] = W(B::set(number)) * r[k];
    return row;
  }
  static NodeRow zero() {
    NodeRow row;
    for (int k = 0; k < kRegisters; ++k) row.r[k] = W(0.0);
    return row;
  }
  void add_to(T* to) const {
    for (int k = 0; k < kRegisters; ++k) (W::load(to + k * kLanes) + r[k]).store(to + k * kLanes);
  }

 private:
  // Four lanes a node, from the first node of register k on; zero beyond the last.
  static W weights(const T (&weight)[Nodes][kBuffer], int p, int k) {
    W w(0.0);
    for (int l = kLanes - 4; l >= 0; l -= 4) {
      const int node = (k * kLanes + l) / 4;
      if (node < Nodes) w = select(WideMask<T>::first(l + 4), W(B::set(weight[node][p])), w);
    }
    return w;
  }
};

template <class T, int Dim, int kNodes, bool Rings>
class Scatter {
  using W = Wide<T>;
  using AllWeights = Weights<T, Dim, kNodes, Rings>;
  using Row = NodeRow<T, kNodes>;
  static constexpr int kFirst = Dim == 1 ? 1 : kNodes;   ///< rows along the first axis, if that is not the last one
  static constexpr int kSecond = Dim == 3 ? kNodes : 1;  ///< and along the second
  /// Nodes along the second axis whose sums are kept in registers at a time.
  static constexpr int kBatch = kNodes == 3 && 3 * kSecond * Row::kRegisters <= 20 ? kSecond : 1;

 public:
  /// Four numbers of every particle of a chunk, by S.
  static void values(const AllWeights& w, const ChunkValues<T>& from, int count, T* tile) {
    alignas(64) T across[kSecond * kFirst][kBuffer];  // S of the axes but the last, [second][first]
    find_across(w, count, across);
    each_run(w, count, tile, [&](int p, int end, int j0, Row(&sum)[kBatch][kFirst]) {
      for (; p < end; ++p) {
        const Row row = Row::outer(w.s[Dim - 1], p, from.v + 4 * p);
#pragma GCC unroll 3
        for (int j = 0; j < kBatch; ++j) {
#pragma GCC unroll 5
          for (int i = 0; i < kFirst; ++i) sum[j][i].add(row, across[kFirst * (j0 + j) + i][p]);
        }
      }
    });
  }

  // Columns by G. Rows (i, j): S_x (S_y G_z tau_z + G_y S_z tau_y) + G_x S_y S_z tau_x. Since S sums to 1 and G to 0,
  // what all three nodes of an axis get together is cheaper than what the middle one gets: the middle sum is the total,
  // less the outer two in the end. `Hoop`, of rings: and T S_z tau_y, T the hoop function.
  template <bool Hoop>
  static void columns(const AllWeights& weights, const mpm_kernel::ChunkStresses<T>& from, int count, T* tile) {
    each_run(weights, count, tile, [&](int p, int end, int j0, Row(&sum)[kBatch][kFirst]) {
      for (; p < end; ++p) {
        const Row along = Row::outer(weights.g[Dim - 1], p, from.column[Dim - 1] + 4 * p);
        if constexpr (Dim == 1) {
          sum[0][0].add(along);
          continue;
        }
        const Row first = Row::outer(weights.s[Dim - 1], p, from.column[0] + 4 * p);
        if constexpr (Dim == 3) {
          const Row second = Row::outer(weights.s[Dim - 1], p, from.column[1] + 4 * p);
#pragma GCC unroll 3
          for (int j = 0; j < kBatch; ++j) {
            if (kBatch == 3 && j == 1) {
              add_along_first(weights, p, along, first, sum[1]);
            } else {
              Row u = along.times(weights.s[1][j0 + j][p]);
              u.add(second, weights.g[1][j0 + j][p]);
              add_along_first(weights, p, u, first.times(weights.s[1][j0 + j][p]), sum[j]);
            }
          }
        } else if constexpr (Dim == 2) {
          add_along_first(weights, p, along, first, sum[0]);
          if constexpr (Hoop) {
            const Row hoop = Row::outer(weights.s[Dim - 1], p, from.column[mpm_kernel::kHoopColumn] + 4 * p);
            T all = 0;
            for (int i = 0; i < kFirst; ++i) all += weights.t[i][p];
            for (int i = 0; i < kFirst; ++i) sum[0][i].add(hoop, i == 1 ? all : weights.t[i][p]);
          }
        }
      }
      if constexpr (Dim > 1 && kNodes == 3) {
        for (int j = 0; j < kBatch; ++j) leave_middle(sum[j][0], sum[j][1], sum[j][2]);
        for (int i = 0; kBatch == 3 && i < 3; ++i) leave_middle(sum[0][i], sum[1][i], sum[2][i]);
      }
    });
  }

 private:
  static void load(const T (&from)[kNodes][kBuffer], int q, W (&to)[kNodes]) {
    for (int n = 0; n < kNodes; ++n) to[n] = W::load(from[n] + q);
  }
  static void find_across(const AllWeights& w, int count, T (&across)[kSecond * kFirst][kBuffer]) {
    for (int q = 0; q < count; q += W::kLanes) {
      if constexpr (Dim == 1) {
        W(1.0).store(across[0] + q);
        continue;
      }
      W first[kNodes], second[kNodes];
      load(w.s[0], q, first);
      if constexpr (Dim == 3) load(w.s[1], q, second);
      for (int j = 0; j < kSecond; ++j) {
        for (int i = 0; i < kFirst; ++i) (Dim == 3 ? first[i] * second[j] : first[i]).store(across[kFirst * j + i] + q);
      }
    }
  }
  static void add_along_first(const AllWeights& weights, int p, const Row& by_s, const Row& by_g, Row (&sum)[kFirst]) {
    if constexpr (kNodes == 3) {
      sum[1].add(by_s);
#pragma GCC unroll 2
      for (int i = 0; i < 3; i += 2) {
        sum[i].add(by_s, weights.s[0][i][p]);
        sum[i].add(by_g, weights.g[0][i][p]);
      }
    } else {
#pragma GCC unroll 5
      for (int i = 0; i < kFirst; ++i) {
        sum[i].add(by_s, weights.s[0][i][p]);
        sum[i].add(by_g, weights.g[0][i][p]);
      }
    }
  }
  static void leave_middle(const Row& before, Row& total, const Row& after) {
    total.subtract(before);
    total.subtract(after);
  }

  // accumulate(first, end, second axis' first node, sums) for every run of particles with one nearest node; then the
  // sums go to the tile.
  template <class Accumulate>
  static void each_run(const AllWeights& w, int count, T* tile, Accumulate&& accumulate) {
    constexpr int kReach = kNodes / 2;
    constexpr int kCorner = kReach * (Dim == 3 ? kTileEdge * kTileEdge + kTileEdge + 1 : Dim == 2 ? kTileEdge + 1 : 1);
    for (int p = 0; p < count;) {
      int end = p + 1;
      while (end < count && w.node[end] == w.node[p]) ++end;
      T* corner = tile + 4 * (w.node[p] - kCorner);
      for (int j0 = 0; j0 < kSecond; j0 += kBatch) {
        Row sum[kBatch][kFirst];
        for (int j = 0; j < kBatch; ++j) {
          for (int i = 0; i < kFirst; ++i) sum[j][i] = Row::zero();
        }
        accumulate(p, end, j0, sum);
        for (int j = 0; j < kBatch; ++j) {
          for (int i = 0; i < kFirst; ++i) sum[j][i].add_to(corner + row_offset(i, j0 + j));
        }
      }
      p = end;
    }
  }
  static constexpr int row_offset(int i, int j) {
    return 4 * (Dim == 3 ? (i * kTileEdge + j) * kTileEdge : i * kTileEdge);
  }
};

}  // namespace mpm
