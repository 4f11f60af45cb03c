// Gathers: lanes are particles, and a row of 8 nodes of one component is read for all of them at once.
//
// Where a row fits into a register (AVX-512, AVX2 in single precision) the particles share a column of nodes, and each
// lane picks its own nodes of the row; lanes stay full when particles lie irregularly. Where it does not, they
// share their nearest node, whose numbers are spread over the lanes. Particles that have moved on since they were
// sorted are gathered again with the others masked out, so groups need not be exact.
#pragma once

#include "mpm/kernel/weights.hpp"

namespace mpm {

/// Values that a row has at the nodes of a particle: the value at the nearest one, and the steps towards it from below
/// and on from it above, the nearer first. With them, since S sums to 1 and G to 0, a sum over three nodes is two
/// products: sum S v = v + S+ step+ - S- step-.
template <class T, int Nodes>
struct RowValues {
  Wide<T> value, below[Nodes / 2], above[Nodes / 2];
};

/// Reader of each lane's own nodes.
template <class T, int Nodes>
class ColumnReader {
  using W = Wide<T>;

 public:
  /// `last`: nearest node of each lane along the last axis.
  ColumnReader(W last, int) : at_(round_to_bits(last)) {}
  template <class Row>
  RowValues<T, Nodes> read(const Row& row) const {
    const W step = W::load(numbers(row.step));
    RowValues<T, Nodes> values;
    values.value = permute(W::load(numbers(row.value)), at_);
    for (int n = 0; n < Nodes / 2; ++n) {
      values.below[n] = permute(step, at_ - (n + 1));
      values.above[n] = permute(step, at_ + n);
    }
    return values;
  }

 private:
  template <class Values>
  static const T* numbers(const Values& values) {
    return reinterpret_cast<const T*>(&values);
  }
  typename W::Integers at_;
};

/// Reader of one node that all lanes share.
template <class T, int Nodes>
class NodeReader {
  using B = typename Wide<T>::B;

 public:
  NodeReader(Wide<T>, int node) : at_(node % kTileEdge) {}
  template <class Row>
  RowValues<T, Nodes> read(const Row& row) const {
    RowValues<T, Nodes> values;
    values.value = Wide<T>(B::set(row.value[at_]));
    for (int n = 0; n < Nodes / 2; ++n) {
      values.below[n] = Wide<T>(B::set(row.step[at_ - 1 - n]));
      values.above[n] = Wide<T>(B::set(row.step[at_ + n]));
    }
    return values;
  }

 private:
  int at_;
};

/// Weights of one register of particles. What is not used of them is not loaded, once optimised.
template <class T, int Dim, int kNodes, bool Rings>
struct LaneWeights {
  using W = Wide<T>;
  W s[Dim][kNodes], g[Dim][kNodes];
  W t[Rings ? kNodes : 1];  ///< values T of an axisymmetric shape function
  W here = W(1.0);          ///< 1 on a line, which has no axis across its only row: 0 where a lane is of another part
  LaneWeights(const Weights<T, Dim, kNodes, Rings>& w, int q) {
    for (int k = 0; k < Dim; ++k) {
      for (int n = 0; n < kNodes; ++n) {
        s[k][n] = W::load(w.s[k][n] + q);
        g[k][n] = W::load(w.g[k][n] + q);
      }
    }
    if constexpr (Rings) {
      for (int n = 0; n < kNodes; ++n) t[n] = W::load(w.t[n] + q);
    }
  }
  /// Zero where a lane is not in `which`.
  void keep(WideMask<T> which) {
    for (int n = 0; n < kNodes; ++n) {
      s[0][n] = select(which, s[0][n], W(0.0));
      g[0][n] = select(which, g[0][n], W(0.0));
      if constexpr (Rings) t[n] = select(which, t[n], W(0.0));
    }
    if constexpr (Dim == 1) here = select(which, here, W(0.0));
  }
  /// Weight of a row, S of the axes but the last.
  W across(int i, int j) const {
    if constexpr (Dim == 1) return here;
    if constexpr (Dim == 2) return s[0][i];
    if constexpr (Dim == 3) return s[0][i] * s[1][j];
  }
};

template <class T, int Dim, int kNodes, bool Rings>
class Gather {
  using W = Wide<T>;
  using Lanes = LaneWeights<T, Dim, kNodes, Rings>;
  using Values = RowValues<T, kNodes>;

 public:
  /// visit(reader, number of the middle row, weights) for the lanes [q, q + count) of a chunk, by parts that share a
  /// column or a node; the weights are zero where a lane is of another part. Returns how many parts there were.
  template <class Visit>
  static int each_part(const Weights<T, Dim, kNodes, Rings>& w, int q, int count, Visit&& visit) {
    using Reader = std::conditional_t<kByColumn<T>, ColumnReader<T, kNodes>, NodeReader<T, kNodes>>;
    const W place = W::load(w.place + q), last = W::load(w.last + q);
    const unsigned lanes = WideMask<T>::first(count).bits();
    unsigned left = lanes;
    int parts = 0, lane = 0;
    do {
      const WideMask<T> same = equal(place, W(W::B::set(w.place[q + lane])));
      const unsigned here = same.bits() & left;
      Lanes weights(w, q);
      if (here != lanes) weights.keep(same);
      visit(Reader(last, w.node[q + lane]), w.node[q + lane] / kTileEdge, weights);
      left &= ~here;
      lane = __builtin_ctz(left | 1U << 31);
      ++parts;
    } while (left != 0);
    return parts;
  }

  /// l[c][k] += the gradient of component c of the tile along axis k, GIMP notes (2.2).
  template <int Fields, class Tile, class Reader>
  static void gradient(const Tile& tile, const Reader& reader, int row, const Lanes& w, W (&l)[Fields][Dim]) {
    each_row(row, [&](int r, int i, int j) {
      W across[Dim];  // part of the row that each component of the gradient takes
      if constexpr (Dim == 3) {
        across[0] = w.g[0][i] * w.s[1][j];
        across[1] = w.s[0][i] * w.g[1][j];
        across[2] = w.s[0][i] * w.s[1][j];
      } else if constexpr (Dim == 2) {
        across[0] = w.g[0][i];
        across[1] = w.s[0][i];
      }
      for (int c = 0; c < Fields; ++c) {
        const Values at = reader.read(tile.rows[c][r]);
        const W plain = sum_of_s(w, at), along = sum_of_g(w, at);
        for (int k = 0; k < Dim - 1; ++k) l[c][k] += across[k] * plain;
        l[c][Dim - 1] += (Dim == 1 ? w.here : across[Dim - 1]) * along;
      }
    });
  }

  /// sum[c] += component c of the tile at the particles.
  template <int Fields, class Tile, class Reader>
  static void values(const Tile& tile, const Reader& reader, int row, const Lanes& w, W (&sum)[Fields]) {
    each_row(row, [&](int r, int i, int j) {
      W across = w.across(i, j);
      for (int c = 0; c < Fields; ++c) sum[c] += across * sum_of_s(w, reader.read(tile.rows[c][r]));
    });
  }

  /// sum += component `c` of the tile by what stands in HoopWeights in place of the radial values.
  template <class Tile, class Reader>
  static void by_hoop(const Tile& tile, int c, const Reader& reader, int row, const Lanes& w, W& sum) {
    each_row(row, [&](int r, int i, int) { sum += w.t[i] * sum_of_s(w, reader.read(tile.rows[c][r])); });
  }

 private:
  // Since the weights of a sum of S are 1 altogether, and of G 0, steps are all that the outer nodes add.
  static W sum_of_s(const Lanes& w, const Values& at) {
    const W(&s)[kNodes] = w.s[Dim - 1];
    if constexpr (kNodes == 3) {
      return (at.value + s[2] * at.above[0]) - s[0] * at.below[0];
    } else {
      return (at.value + (s[3] + s[4]) * at.above[0] + s[4] * at.above[1]) -
             ((s[1] + s[0]) * at.below[0] + s[0] * at.below[1]);
    }
  }
  static W sum_of_g(const Lanes& w, const Values& at) {
    const W(&g)[kNodes] = w.g[Dim - 1];
    if constexpr (kNodes == 3) {
      return g[2] * at.above[0] - g[0] * at.below[0];
    } else {
      return ((g[3] + g[4]) * at.above[0] + g[4] * at.above[1]) - ((g[1] + g[0]) * at.below[0] + g[0] * at.below[1]);
    }
  }

  // visit(row of the tile, its place along each axis but the last) for the rows around the middle one. Five rows along
  // an axis are a loop: unrolled, they would take a compiler minutes.
  template <class Visit>
  static void each_row(int middle, Visit&& visit) {
    if constexpr (Dim == 1) {
      visit(middle, 0, 0);
    } else if constexpr (kNodes == 3 && Dim == 3) {
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i) {
#pragma GCC unroll 3
        for (int j = 0; j < 3; ++j) visit(middle + (i - 1) * kTileEdge + j - 1, i, j);
      }
    } else if constexpr (kNodes == 3) {
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i) visit(middle + i - 1, i, 0);
    } else {
      constexpr int kReach = kNodes / 2;
      for (int i = 0; i < kNodes; ++i) {
        if constexpr (Dim == 3) {
          for (int j = 0; j < kNodes; ++j) visit(middle + (i - kReach) * kTileEdge + j - kReach, i, j);
        } else {
          visit(middle + i - kReach, i, 0);
        }
      }
    }
  }
};

}  // namespace mpm
