// Scatters: a particle at a time, lanes are (node along the last axis, component). A particle's contribution to a row of
// three nodes is an outer product, made once and added to 9 rows (3 in a plane) with the weights of the other axes. The
// sums of a run of particles with one nearest node stay in registers; they go to the tile when the node changes.
//
// What a particle brings was computed with particles in the lanes, and passes through a buffer in cache: weights of the
// last axis and components are turned there (interleave), the other weights are read as numbers.
// Weak: the fourth node of a row and, of a force, the fourth component are carried as zeros, since a register is a power
// of two: 9 of 16 lanes of a force do work.
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

/// Lane l of register R of a row: its node, its component.
template <int N, int R>
struct NodeOf {
  static constexpr int at(int l) { return (R * N + l) / 4; }
};
struct ComponentOf {
  static constexpr int at(int l) { return l % 4; }
};

/// Four components of three nodes (and of a fourth, zero, where a register has room) in registers.
template <class T>
struct NodeRow {
  using W = Wide<T>;
  static constexpr int kLanes = W::kLanes;
  static constexpr int kRegisters = (12 + kLanes - 1) / kLanes;
  W r[kRegisters];

  /// `nodes`: of each of four nodes; `components`: of each of four components.
  static NodeRow outer(const T* nodes, const T* components) {
    NodeRow row;
    if constexpr (kLanes > 4) {
      const W all = W::load(nodes), repeated = W::load(components);
      const W c = shuffle<ComponentOf>(repeated, repeated);
      row.r[0] = shuffle<NodeOf<kLanes, 0>>(all, all) * c;
      if constexpr (kRegisters > 1) row.r[1] = shuffle<NodeOf<kLanes, 1>>(all, all) * c;
    } else {
      for (int k = 0; k < kRegisters; ++k) {
        row.r[k] = W(nodes[k * kLanes / 4]) * W::load(components + k * kLanes % 4);
      }
    }
    return row;
  }
  /// this += a * number
  void add(const NodeRow& a, T number) {
    for (int k = 0; k < kRegisters; ++k) r[k] += W(W::B::set(number)) * a.r[k];
  }
  static NodeRow zero() {
    NodeRow row;
    for (int k = 0; k < kRegisters; ++k) row.r[k] = W(0.0);
    return row;
  }
  void add_to(T* to) const {
    for (int k = 0; k < kRegisters; ++k) (W::load(to + k * kLanes) + r[k]).store(to + k * kLanes);
  }
};

constexpr int kChunk = 64;             ///< particles that pass through a buffer at a time
constexpr int kBuffer = kChunk + 16;   ///< and what the last register writes beyond them

template <class T, int Dim, template <class> class Shape>
class Scatter {
  using W = Wide<T>;
  using AllWeights = Weights<T, Dim, Shape>;
  using Row = NodeRow<T>;
  static constexpr int kSecond = Dim == 3 ? 3 : 1;  ///< nodes along the second axis, if that is not the last one
  /// Nodes along the second axis whose sums are kept in registers at a time.
  static constexpr int kBatch = 3 * kSecond * Row::kRegisters <= 20 ? kSecond : 1;

  /// The first node of each particle's rows.
  struct Place {
    int first[kBuffer];
    void set(const AllWeights& w, int q) {
      typedef int Numbers __attribute__((vector_size(4 * W::kLanes)));
      constexpr int kCorner = Dim == 3 ? kTileEdge * kTileEdge + kTileEdge + 1 : kTileEdge + 1;
      const Numbers numbers = __builtin_convertvector((w.node() - W(kCorner)).v, Numbers);
      __builtin_memcpy(first + q, &numbers, sizeof(numbers));
    }
    int run_end(int p, int count) const {
      int end = p + 1;
      while (end < count && first[end] == first[p]) ++end;
      return end;
    }
  };

 public:
  /// Up to four scalars of every particle, by S.
  struct Values {
    Place place;
    alignas(64) T across[kSecond * 3][kBuffer];  ///< S of the axes but the last, [second][first]
    alignas(64) T last[4 * kBuffer];             ///< S of the last axis, by particle
    alignas(64) T value[4 * kBuffer];            ///< by particle

    void set(const AllWeights& w, int q, W v0, W v1, W v2, W v3) {
      place.set(w, q);
      for (int j = 0; j < kSecond; ++j) {
        for (int i = 0; i < 3; ++i) (Dim == 3 ? w.s[0][i] * w.s[1][j] : w.s[0][i]).store(across[3 * j + i] + q);
      }
      interleave(last + 4 * q, w.s[Dim - 1][0], w.s[Dim - 1][1], w.s[Dim - 1][2], W(0.0));
      interleave(value + 4 * q, v0, v1, v2, v3);
    }
  };

  static void scatter(const Values& from, int count, T* tile) {
    each_run(from.place, count, tile, [&](int p, int end, int j0, Row (&sum)[kBatch][3]) {
      for (; p < end; ++p) {
        const Row row = Row::outer(from.last + 4 * p, from.value + 4 * p);
#pragma GCC unroll 3
        for (int j = 0; j < kBatch; ++j) {
#pragma GCC unroll 3
          for (int i = 0; i < 3; ++i) sum[j][i].add(row, from.across[3 * (j0 + j) + i][p]);
        }
      }
    });
  }

  /// Internal force: columns of -m tau, by G.
  struct Stresses {
    Place place;
    alignas(64) T s[Dim - 1][3][kBuffer], g[Dim - 1][3][kBuffer];  ///< of the axes but the last
    alignas(64) T s_last[4 * kBuffer], g_last[4 * kBuffer];        ///< of the last axis, by particle
    alignas(64) T column[Dim][4 * kBuffer];                        ///< force through a face, by particle

    void set(const AllWeights& w, int q) {
      place.set(w, q);
      for (int k = 0; k < Dim - 1; ++k) {
        for (int n = 0; n < 3; ++n) {
          w.s[k][n].store(s[k][n] + q);
          w.g[k][n].store(g[k][n] + q);
        }
      }
      interleave(s_last + 4 * q, w.s[Dim - 1][0], w.s[Dim - 1][1], w.s[Dim - 1][2], W(0.0));
      interleave(g_last + 4 * q, w.g[Dim - 1][0], w.g[Dim - 1][1], w.g[Dim - 1][2], W(0.0));
    }
    void set_column(int k, int q, const W (&c)[Dim]) {
      if constexpr (Dim == 3) {
        interleave(column[k] + 4 * q, c[0], c[1], c[2], W(0.0));
      } else {
        interleave(column[k] + 4 * q, c[0], c[1], W(0.0), W(0.0));
      }
    }
  };

  // Rows (i, j): S_x (S_y G_z tau_z + G_y S_z tau_y) + G_x S_y S_z tau_x.
  static void scatter(const Stresses& from, int count, T* tile) {
    each_run(from.place, count, tile, [&](int p, int end, int j0, Row (&sum)[kBatch][3]) {
      for (; p < end; ++p) {
        const Row along = Row::outer(from.g_last + 4 * p, from.column[Dim - 1] + 4 * p);
        const Row first = Row::outer(from.s_last + 4 * p, from.column[0] + 4 * p);
        if constexpr (Dim == 3) {
          const Row second = Row::outer(from.s_last + 4 * p, from.column[1] + 4 * p);
#pragma GCC unroll 3
          for (int j = 0; j < kBatch; ++j) {
            Row u = Row::zero(), w = Row::zero();
            u.add(along, from.s[1][j0 + j][p]);
            u.add(second, from.g[1][j0 + j][p]);
            w.add(first, from.s[1][j0 + j][p]);
            add_along_first(from, p, u, w, sum[j]);
          }
        } else {
          add_along_first(from, p, along, first, sum[0]);
        }
      }
    });
  }

 private:
  static void add_along_first(const Stresses& from, int p, const Row& by_s, const Row& by_g, Row (&sum)[3]) {
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) {
      sum[i].add(by_s, from.s[0][i][p]);
      sum[i].add(by_g, from.g[0][i][p]);
    }
  }

  // accumulate(first, end, second axis' first node, sums) for every run of particles with one nearest node; then the
  // sums go to the tile.
  template <class Accumulate>
  static void each_run(const Place& place, int count, T* tile, Accumulate&& accumulate) {
    for (int p = 0; p < count;) {
      const int end = place.run_end(p, count);
      T* corner = tile + 4 * place.first[p];
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
