// A block's surroundings in cache: 8 nodes along each axis, the block and two nodes beyond it on each side. Copied in
// from the blocks of the grid before particles gather, added out after they scatter; the passes in between never see
// the block table. While no particle has left the block, stencils of three touch only six nodes along an axis: rows
// outside these are left out.
//
// Copying is a function of its own, called once a block: passes share it, and a compiler takes it once.
//
// Two layouts. What is gathered lies a component at a time, a row of 8 nodes along the last axis together; what is
// scattered lies a node at a time, its components together, padded to four.
#pragma once

#include "mpm/kernel/kernels.hpp"
#include "mpm/kernel/wide.hpp"

// Vectors of eight numbers where registers are shorter: how they are passed concerns callers in other files only.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace mpm {

using mpm_kernel::BlockView;
using mpm_kernel::kTileEdge;

/// The node that a stencil of `Nodes` is laid around, at least and at most: a particle's nearest node, in the block or
/// (loose) one node beyond it. A stencil of five has no room beyond the block: there it is laid around the block's last
/// node, and its own outermost weight is zero up to half a cell farther.
template <int Nodes = 3>
constexpr double lowest_nearest(bool loose) {
  return loose && Nodes == 3 ? 1.0 : 2.0;
}
template <int Nodes = 3>
constexpr double highest_nearest(bool loose) {
  return kTileEdge - 1 - lowest_nearest<Nodes>(loose);
}

template <int Dim>
struct TileShape {
  static constexpr int kRows = Dim == 3 ? 64 : Dim == 2 ? 8 : 1;
  static constexpr int kBlockNodes = Dim == 3 ? 64 : Dim == 2 ? 16 : 4;
  static constexpr int kFirst[2] = {1, 0},
                       kEnd[2] = {7, 8};  ///< rows in use along an axis: of a tight block, of a loose one

  /// visit(row of the tile, the three blocks that it runs through, its first node in each).
  template <class Visit>
  static void each_row(const BlockView& block, Visit&& visit) {
    if constexpr (Dim == 1) {
      visit(0, block.neighbours, 0);
      return;
    }
    const int first = kFirst[block.loose], end = kEnd[block.loose];
    if constexpr (Dim == 3) {
      for (int i = first; i < end; ++i) {
        for (int j = first; j < end; ++j) {
          visit(i * kTileEdge + j, block.neighbours + (part(i) * 3 + part(j)) * 3, (within(i) * 4 + within(j)) * 4);
        }
      }
    } else if constexpr (Dim == 2) {
      for (int i = first; i < end; ++i) visit(i, block.neighbours + part(i) * 3, within(i) * 4);
    }
  }

 private:
  // Along an axis a tile is two nodes of the block before, four of the block, two of the block after it.
  static constexpr int part(int node) { return (node + 2) / 4; }
  static constexpr int within(int node) { return (node + 2) % 4; }
};

/// True if a row of a tile fits into a register of doubles.
constexpr bool kRowInRegister = Backend<double>::kLanes >= kTileEdge;

/// A row of a nodal field's component: 8 nodes, of which the middle four and the first and last two lie in three
/// blocks.
struct FieldRow {
  typedef double Two __attribute__((vector_size(16)));
  typedef double Four __attribute__((vector_size(32)));
  typedef double Eight __attribute__((vector_size(64)));

  template <class V>
  static V read(const double* from) {
    V v;
    __builtin_memcpy(&v, from, sizeof(V));
    return v;
  }
  template <class V>
  static void add(double* to, V v) {
    v += read<V>(to);
    __builtin_memcpy(to, &v, sizeof(V));
  }
  static Eight load(const double* before, const double* middle, const double* after) {
    const Four ends = __builtin_shufflevector(read<Two>(before + 2), read<Two>(after), 0, 1, 2, 3);
    return __builtin_shufflevector(ends, read<Four>(middle), 0, 1, 4, 5, 6, 7, 2, 3);
  }
};

/// `Fields` components to gather from, and beside each node's value the step to the next one along the last axis.
template <class T, int Dim, int Fields>
struct GatherTile {
  using Shape = TileShape<Dim>;
  typedef T Values __attribute__((vector_size(kTileEdge * sizeof(T))));
  struct Row {
    Values value;
    Values step;  ///< value[z + 1] - value[z]; without a meaning for the last
  };
  alignas(64) Row rows[Fields][Shape::kRows];
  T beyond[kTileEdge];  ///< read by a register that is two rows long (16 lanes of single precision), and not used

  /// Copies the `components` of a nodal field into the tile's components `first`, ….
  template <int Components>
  [[gnu::noinline]] void load(const double* field, const BlockView& block, int first) {
    Shape::each_row(block, [&](int row, const int* blocks, int node) {
      const double* part[3];
      for (int b = 0; b < 3; ++b)
        part[b] = field + blocks[b] * (Components * static_cast<long>(Shape::kBlockNodes)) + node;
      for (int c = 0; c < Components; ++c) {
        const int at = c * Shape::kBlockNodes;
        Row& to = rows[first + c][row];
        if constexpr (kRowInRegister) {
          const FieldRow::Eight value = FieldRow::load(part[0] + at, part[1] + at, part[2] + at);
          const FieldRow::Eight next = __builtin_shufflevector(value, value, 1, 2, 3, 4, 5, 6, 7, 7);
          to = {__builtin_convertvector(value, Values), __builtin_convertvector(next - value, Values)};
        } else {
          double value[kTileEdge + 1];
          for (int z = 0; z < 2; ++z) value[z] = part[0][at + z + 2];
          for (int z = 0; z < 4; ++z) value[z + 2] = part[1][at + z];
          for (int z = 0; z < 2; ++z) value[z + 6] = part[2][at + z];
          value[kTileEdge] = value[kTileEdge - 1];
          for (int z = 0; z < kTileEdge; ++z) {
            to.value[z] = static_cast<T>(value[z]);
            to.step[z] = static_cast<T>(value[z + 1] - value[z]);
          }
        }
      }
    });
  }
};

/// Four components to scatter into.
template <class T, int Dim>
struct ScatterTile {
  using Shape = TileShape<Dim>;
  static constexpr int kWidth = 4;
  typedef T Node __attribute__((vector_size(kWidth * sizeof(T))));
  // A particle's row of nodes is written as whole registers: a node more, or a few, for the last row.
  static constexpr int kBeyond = 4;
  alignas(64) Node nodes[Shape::kRows * kTileEdge + kBeyond];

  T* data() { return reinterpret_cast<T*>(nodes); }

  [[gnu::noinline]] void clear(const BlockView& block) {
    Shape::each_row(block, [&](int row, const int*, int) {
      for (int z = 0; z < kTileEdge; ++z) nodes[row * kTileEdge + z] = Node{};
    });
    for (int z = 0; z < kBeyond; ++z) nodes[Shape::kRows * kTileEdge + z] = Node{};
  }

  /// Adds the tile's components `first`, … to the `Components` of a nodal field.
  template <int Components>
  [[gnu::noinline]] void add_to(double* field, const BlockView& block, int first) const {
    Shape::each_row(block, [&](int row, const int* blocks, int node) {
      const Node* from = nodes + row * kTileEdge;
      Field by_component[kWidth];
      if constexpr (kRowInRegister) turn(from, by_component);
      double* part[3];
      for (int b = 0; b < 3; ++b)
        part[b] = field + blocks[b] * (Components * static_cast<long>(Shape::kBlockNodes)) + node;
      for (int c = 0; c < Components; ++c) {
        const int at = c * Shape::kBlockNodes, k = first + c;
        if constexpr (kRowInRegister) {
          const Field value = by_component[k];
          FieldRow::add(part[0] + at + 2, __builtin_shufflevector(value, value, 0, 1));
          FieldRow::add(part[1] + at, __builtin_shufflevector(value, value, 2, 3, 4, 5));
          FieldRow::add(part[2] + at, __builtin_shufflevector(value, value, 6, 7));
        } else {
          for (int z = 0; z < 2; ++z) part[0][at + z + 2] += from[z][k];
          for (int z = 0; z < 4; ++z) part[1][at + z] += from[z + 2][k];
          for (int z = 0; z < 2; ++z) part[2][at + z] += from[z + 6][k];
        }
      }
    });
  }

 private:
  using Field = FieldRow::Eight;

  // Eight nodes of four components to four components of eight nodes.
  static void turn(const Node* from, Field (&to)[kWidth]) {
    typedef T Nodes __attribute__((vector_size(2 * kWidth * sizeof(T))));
    Field pair[4];
    for (int z = 0; z < 4; ++z) {
      Nodes nodes;
      __builtin_memcpy(&nodes, from + 2 * z, sizeof(nodes));
      pair[z] = __builtin_convertvector(nodes, Field);
    }
    const Field low01 = __builtin_shufflevector(pair[0], pair[1], 0, 4, 8, 12, 1, 5, 9, 13);
    const Field low23 = __builtin_shufflevector(pair[2], pair[3], 0, 4, 8, 12, 1, 5, 9, 13);
    const Field high01 = __builtin_shufflevector(pair[0], pair[1], 2, 6, 10, 14, 3, 7, 11, 15);
    const Field high23 = __builtin_shufflevector(pair[2], pair[3], 2, 6, 10, 14, 3, 7, 11, 15);
    to[0] = __builtin_shufflevector(low01, low23, 0, 1, 2, 3, 8, 9, 10, 11);
    to[1] = __builtin_shufflevector(low01, low23, 4, 5, 6, 7, 12, 13, 14, 15);
    to[2] = __builtin_shufflevector(high01, high23, 0, 1, 2, 3, 8, 9, 10, 11);
    to[3] = __builtin_shufflevector(high01, high23, 4, 5, 6, 7, 12, 13, 14, 15);
  }
};

}  // namespace mpm
