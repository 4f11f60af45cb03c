// Scatters: a particle at a time, lanes are (node along the last axis, component). A particle's contribution to a row
// of three nodes is an outer product, made once and added to 9 rows (3 in a plane) with the weights of the other axes.
// The sums of a run of particles with one nearest node stay in registers; they go to the tile when the node changes.
//
// What a particle brings was computed with particles in the lanes, and passes through a buffer in cache: components are
// turned there (interleave), weights are read as numbers.
// Weak: the fourth node of a row and, of a force, the fourth component are carried as zeros, since a register is a
// power of two: 9 of 16 lanes of a force do work.
#pragma once

#include "mpm/kernel/weights.hpp"

namespace mpm {

/// Lane l: lane l of a and of b in turn; of their lower or upper halves.
template <int N, bool Upper>
struct Alternate {
  static constexpr int at(int l) { return (l % 2) * N + l / 2 + (Upper ? N / 2 : 0); }
};
/// The same by pairs of lanes.
template <int N, bool Upper>
struct AlternatePairs {
  static constexpr int at(int l) { return (l / 2 % 2) * N + l / 4 * 2 + l % 2 + (Upper ? N / 2 : 0); }
};

/// to[4 l + k] = lane l of a_k.
template <class T>
void interleave(T* to, Wide<T> a0, Wide<T> a1, Wide<T> a2, Wide<T> a3) {
  constexpr int N = Wide<T>::kLanes;
  const Wide<T> low01 = shuffle<Alternate<N, false>>(a0, a1), high01 = shuffle<Alternate<N, true>>(a0, a1);
  const Wide<T> low23 = shuffle<Alternate<N, false>>(a2, a3), high23 = shuffle<Alternate<N, true>>(a2, a3);
  if constexpr (N == 2) {
    low01.store(to);
    low23.store(to + N);
    high01.store(to + 2 * N);
    high23.store(to + 3 * N);
  } else {
    shuffle<AlternatePairs<N, false>>(low01, low23).store(to);
    shuffle<AlternatePairs<N, true>>(low01, low23).store(to + N);
    shuffle<AlternatePairs<N, false>>(high01, high23).store(to + 2 * N);
    shuffle<AlternatePairs<N, true>>(high01, high23).store(to + 3 * N);
  }
}

/// Four components of three nodes (and of a fourth, zero, where a register has room) in registers.
template <class T>
struct NodeRow {
  using W = Wide<T>;
  using B = Backend<T>;
  static constexpr int kLanes = W::kLanes;
  static constexpr int kRegisters = (12 + kLanes - 1) / kLanes;
  W r[kRegisters];

  /// `weight[node]` times `component`, of four.
  static NodeRow outer(const T (&weight)[3][kBuffer], int p, const T* component) {
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
  // Four lanes a node, from the first node of register k on; zero beyond the third.
  static W weights(const T (&weight)[3][kBuffer], int p, int k) {
    W w(0.0);
    for (int l = kLanes - 4; l >= 0; l -= 4) {
      const int node = (k * kLanes + l) / 4;
      if (node < 3) w = select(WideMask<T>::first(l + 4), W(B::set(weight[node][p])), w);
    }
    return w;
  }
};

template <class T, int Dim, template <class> class Shape>
class Scatter {
  using W = Wide<T>;
  using AllWeights = Weights<T, Dim, Shape>;
  using Row = NodeRow<T>;
  static constexpr int kSecond = Dim == 3 ? 3 : 1;  ///< nodes along the second axis, if that is not the last one
  /// Nodes along the second axis whose sums are kept in registers at a time.
  static constexpr int kBatch = 3 * kSecond * Row::kRegisters <= 20 ? kSecond : 1;

 public:
  /// Up to four scalars of every particle of a chunk, by S.
  struct Values {
    alignas(64) T across[kSecond * 3][kBuffer];  ///< S of the axes but the last, [second][first]
    alignas(64) T value[4 * kBuffer];            ///< by particle

    void set_weights(const AllWeights& w, int count) {
      for (int q = 0; q < count; q += W::kLanes) {
        W first[3], second[3];
        load(w.s[0], q, first);
        if constexpr (Dim == 3) load(w.s[1], q, second);
        for (int j = 0; j < kSecond; ++j) {
          for (int i = 0; i < 3; ++i) (Dim == 3 ? first[i] * second[j] : first[i]).store(across[3 * j + i] + q);
        }
      }
    }
    void set(int q, W v0, W v1, W v2, W v3) { interleave(value + 4 * q, v0, v1, v2, v3); }
  };

  static void scatter(const AllWeights& w, const Values& from, int count, T* tile) {
    each_run(w, count, tile, [&](int p, int end, int j0, Row(&sum)[kBatch][3]) {
      for (; p < end; ++p) {
        const Row row = Row::outer(w.s[Dim - 1], p, from.value + 4 * p);
#pragma GCC unroll 3
        for (int j = 0; j < kBatch; ++j) {
#pragma GCC unroll 3
          for (int i = 0; i < 3; ++i) sum[j][i].add(row, from.across[3 * (j0 + j) + i][p]);
        }
      }
    });
  }

  /// Internal force: columns of -m tau of every particle of a chunk, by G.
  struct Stresses {
    alignas(64) T column[Dim][4 * kBuffer];  ///< force through a face, by particle

    void set_column(int k, int q, const W (&c)[Dim]) {
      if constexpr (Dim == 3) {
        interleave(column[k] + 4 * q, c[0], c[1], c[2], W(0.0));
      } else {
        interleave(column[k] + 4 * q, c[0], c[1], W(0.0), W(0.0));
      }
    }
  };

  // Rows (i, j): S_x (S_y G_z tau_z + G_y S_z tau_y) + G_x S_y S_z tau_x. Since S sums to 1 and G to 0, what all three
  // nodes of an axis get together is cheaper than what the middle one gets: the middle sum is the total, less the outer
  // two in the end.
  static void scatter(const AllWeights& weights, const Stresses& from, int count, T* tile) {
    each_run(weights, count, tile, [&](int p, int end, int j0, Row(&sum)[kBatch][3]) {
      for (; p < end; ++p) {
        const Row along = Row::outer(weights.g[Dim - 1], p, from.column[Dim - 1] + 4 * p);
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
        } else {
          add_along_first(weights, p, along, first, sum[0]);
        }
      }
      for (int j = 0; j < kBatch; ++j) leave_middle(sum[j][0], sum[j][1], sum[j][2]);
      for (int i = 0; kBatch == 3 && i < 3; ++i) leave_middle(sum[0][i], sum[1][i], sum[2][i]);
    });
  }

 private:
  static void load(const T (&from)[3][kBuffer], int q, W (&to)[3]) {
    for (int n = 0; n < 3; ++n) to[n] = W::load(from[n] + q);
  }
  static void add_along_first(const AllWeights& weights, int p, const Row& by_s, const Row& by_g, Row (&sum)[3]) {
    sum[1].add(by_s);
#pragma GCC unroll 2
    for (int i = 0; i < 3; i += 2) {
      sum[i].add(by_s, weights.s[0][i][p]);
      sum[i].add(by_g, weights.g[0][i][p]);
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
    constexpr int kCorner = Dim == 3 ? kTileEdge * kTileEdge + kTileEdge + 1 : kTileEdge + 1;
    for (int p = 0; p < count;) {
      int end = p + 1;
      while (end < count && w.node[end] == w.node[p]) ++end;
      T* corner = tile + 4 * (w.node[p] - kCorner);
      for (int j0 = 0; j0 < kSecond; j0 += kBatch) {
        Row sum[kBatch][3];
        for (int j = 0; j < kBatch; ++j) {
          for (int i = 0; i < 3; ++i) sum[j][i] = Row::zero();
        }
        accumulate(p, end, j0, sum);
        for (int j = 0; j < kBatch; ++j) {
          for (int i = 0; i < 3; ++i) sum[j][i].add_to(corner + row_offset(i, j0 + j));
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
