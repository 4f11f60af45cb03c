// Exchange between particles of soil and cells of the implicit step, a chunk of particles at a time. A
// particle's box is cut by the faces of the cells into up to eight pieces (implicit/soil_cells.hpp).
//
// About an axis a box is the section of a ring, cut off at r = 0, and its pieces are weighed with r, as the averages of
// the shape functions are (shape/radial_box.hpp). The mean of a straight line over r is exact, too: that of the line
// over the section, over the section's mean radius.
#include <algorithm>
#include <array>
#include <type_traits>

#include "mpm/kernel/soil_exchange.hpp"

namespace mpm {
namespace {

using mpm_kernel::SoilMotion;
using mpm_kernel::SoilParticles;
using mpm_kernel::SoilPlacesOf;
using mpm_kernel::SoilSums;

constexpr int kChunk = 64;
constexpr int kPadded = kChunk + 16;  ///< and what the last register writes beyond them

/// Cuts of the boxes of a chunk of particles along one axis, into a piece in each of two cells, of which one may
/// be empty: the lower cell, counted from the block's first one, the pieces' parts of the box, and their middles from
/// the lower faces of their cells.
template <class T>
struct Cuts {
  int cell[kPadded];
  T part[2][kPadded], middle[2][kPadded];

  void find(const double* x, int count, double origin, double inverse_cell, double corner, double half) {
    const double whole = 1.0 / (2.0 * half);
    for (int q = 0; q < count; ++q) {
      const double at = (x[q] - origin) * inverse_cell - corner;
      cut(q, at, at - half, at + half, whole);
    }
  }
  /// The box from `low` to `high` about `at`, in cells; `whole`: 1 over its width.
  inline __attribute__((always_inline)) void cut(int q, double at, double low, double high, double whole) {
    const soil::Cut<T> one(at, low, high, whole);
    cell[q] = one.cell;
    for (int piece = 0; piece < 2; ++piece) {
      part[piece][q] = one.part[piece];
      middle[piece][q] = one.middle[piece];
    }
  }
};

/// Along a radius, with which parts and middles of the pieces are weighed.
template <class T>
struct RadialCuts {
  T per_radius[2][kPadded];  ///< mean of 1 / r over the piece, times its part [1/m]
  T centre[2][kPadded];      ///< middle of the piece's section

  void find(Cuts<T>& cuts, const double* x, int count, double origin, double inverse_cell, double corner, double half) {
    const double axis = -(corner + origin * inverse_cell);
    for (int q = 0; q < count; ++q) {
      const double at = (x[q] - origin) * inverse_cell - corner;
      const double low = std::max(at - half, axis), high = at + half, box = 0.5 * (low + high) - axis;
      cuts.cut(q, box + axis, low, high, 1.0 / (high - low));
      for (int piece = 0; piece < 2; ++piece) {
        const double section = cuts.part[piece][q], from_face = cuts.middle[piece][q];
        const double width = section * (high - low), radius = from_face + cuts.cell[q] + piece - axis;
        centre[piece][q] = static_cast<T>(from_face);
        per_radius[piece][q] = static_cast<T>(section / box * inverse_cell);
        cuts.part[piece][q] = static_cast<T>(section * radius / box);
        cuts.middle[piece][q] = static_cast<T>(from_face + width * width / (12.0 * radius));
      }
    }
  }
};
struct NoRadius {};

/// Cuts of a chunk of particles along each axis.
template <class Geometry, class T>
struct Boxes {
  Cuts<T> along[Geometry::kDim];
  std::conditional_t<Geometry::kHoop, RadialCuts<T>, NoRadius> radial;

  void find(const SoilParticles<T>& set, int begin, int count, const int* corner) {
    constexpr int kFirst = Geometry::kHoop ? 1 : 0;
    if constexpr (Geometry::kHoop) {
      radial.find(along[0], set.x[0] + begin, count, set.origin[0], set.inverse_cell[0], corner[0], set.half[0]);
    }
    for (int k = kFirst; k < Geometry::kDim; ++k) {
      along[k].find(set.x[k] + begin, count, set.origin[k], set.inverse_cell[k], corner[k], set.half[k]);
    }
  }
};

/// Place of the two cells along an axis among the cells around a block: what they add to the number of the block, and
/// to that of the cell inside it.
struct Spot {
  int block[2], local[2];

  Spot(int cell, int per_block, int per_cell) {
    static_assert(mpm_kernel::kTileEdge - 2 * mpm_kernel::kTileMargin == 4,
                  "the numbers below are of blocks of four nodes");
    for (int a = 0; a < 2; ++a) {
      block[a] = per_block * std::clamp((cell + a + 4) >> 2, 0, 2);
      local[a] = per_cell * ((cell + a) & 3);
    }
  }
};

/// visit(block around, cell inside it, pieces along each axis) for each of the pieces of a particle, empty ones too.
template <class Geometry, class T, class Visit>
inline __attribute__((always_inline)) void each_piece(const Boxes<Geometry, T>& boxes, int q, Visit&& visit) {
  if constexpr (Geometry::kDim == 2) {
    const Spot x(boxes.along[0].cell[q], 3, 4), z(boxes.along[1].cell[q], 1, 1);
    for (int a = 0; a < 2; ++a) {
      for (int c = 0; c < 2; ++c) visit(x.block[a] + z.block[c], x.local[a] + z.local[c], a, c, 0);
    }
  } else {
    const Spot x(boxes.along[0].cell[q], 9, 16), y(boxes.along[1].cell[q], 3, 4), z(boxes.along[2].cell[q], 1, 1);
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b < 2; ++b) {
        for (int c = 0; c < 2; ++c) {
          visit(x.block[a] + y.block[b] + z.block[c], x.local[a] + y.local[b] + z.local[c], a, b, c);
        }
      }
    }
  }
}

template <class T>
struct Rows {
  typedef T Sixteen __attribute__((vector_size(16 * sizeof(T)), aligned(sizeof(T)), may_alias));
  typedef T Eight __attribute__((vector_size(8 * sizeof(T)), aligned(sizeof(T)), may_alias));
  using Truth = decltype(Sixteen{} < Sixteen{});
};

/// Factors of the numbers of SoilSums for a piece along an axis: its part of the box, and in those lanes that are
/// moments along the axis its middle as well.
template <class T>
inline __attribute__((always_inline)) typename Rows<T>::Sixteen factors(const Cuts<T>& cuts, int q, int piece,
                                                                        typename Rows<T>::Truth moments) {
  using Sixteen = typename Rows<T>::Sixteen;
  const T part = cuts.part[piece][q];
  return moments ? Sixteen{} + part * cuts.middle[piece][q] : Sixteen{} + part;
}

/// Along a radius: with 1 / r in the lanes of y, and that of x z in the lane of the stress yz, which is none.
template <class T>
inline __attribute__((always_inline)) typename Rows<T>::Sixteen over_radius(typename Rows<T>::Sixteen f,
                                                                            const RadialCuts<T>& cuts, int q,
                                                                            int piece) {
  using Sixteen = typename Rows<T>::Sixteen;
  using Truth = typename Rows<T>::Truth;
  constexpr Truth kOne = {0, 0, -1, 0, 0, 0, -1}, kLine = {0, 0, 0, 0, -1, 0, 0, 0, 0, 0, -1};
  const T one = cuts.per_radius[piece][q];
  f = kOne ? Sixteen{} + one : f;
  return kLine ? Sixteen{} + one * cuts.centre[piece][q] : f;
}

template <class Geometry, class T>
void gather(const SoilParticles<T>& set, int first, int last, const int* corner, const SoilPlacesOf<T>& places) {
  using W = Wide<T>;
  using Sixteen = typename Rows<T>::Sixteen;
  static_assert(sizeof(SoilSums<T>) == 16 * sizeof(T));
  constexpr int kDim = Geometry::kDim;
  constexpr bool kHoop = Geometry::kHoop, kWithY = kDim == 3 || kHoop;
  constexpr bool kMoments[7] = {true, true, kWithY, true, kWithY, true, kWithY};  // 1, x, y, z, xy, xz, yz
  using Truth = typename Rows<T>::Truth;
  constexpr Truth kX = {0, -1, 0, 0, -1, -1}, kY = {0, 0, -1, 0, -1, 0, -1};
  constexpr Truth kZ = {0, 0, 0, -1, 0, -1, -1, 0, 0, 0, kHoop ? -1 : 0};
  const Truth moments[3] = {kX, kDim == 3 ? kY : kZ, kZ};
  // Empty pieces may lie where no cells are.
  Sixteen nowhere[kDim == 3 ? 64 : 16] = {};
  Sixteen* to[27];
  for (int n = 0; n < (kDim == 3 ? 27 : 9); ++n) {
    to[n] = places.sums[n] != nullptr ? reinterpret_cast<Sixteen*>(places.sums[n]) : nowhere;
  }
  Boxes<Geometry, T> boxes;
  alignas(64) T numbers[10][kPadded];  // volume, r, opening, left, dilates
  alignas(64) T rows[kChunk][16];
  for (int begin = first; begin < last; begin += kChunk) {
    const int count = std::min(kChunk, last - begin);
    for (int q = 0; q < count; q += W::kLanes) {
      const int p = begin + q, lanes = count - q;
      W of[soil::kNumbers];
      soil::numbers_of<Geometry>(set, p, lanes, of);
      for (int i = 0; i < soil::kNumbers; ++i) of[i].store(numbers[i] + q);
    }
    for (int q = 0; q < count; ++q) {
      const T volume = numbers[0][q];
      for (int i = 0; i < 7; ++i) rows[q][i] = kMoments[i] ? volume : T(0);
      for (int i = 1; i < 10; ++i) rows[q][6 + i] = volume * numbers[i][q];
    }
    boxes.find(set, begin, count, corner);
    for (int q = 0; q < count; ++q) {
      const Sixteen row = *reinterpret_cast<const Sixteen*>(rows[q]);
      Sixteen along[3][2];
      for (int k = 0; k < kDim; ++k) {
        for (int piece = 0; piece < 2; ++piece) along[k][piece] = factors(boxes.along[k], q, piece, moments[k]);
      }
      if constexpr (kHoop) {
        for (int piece = 0; piece < 2; ++piece) along[0][piece] = over_radius(along[0][piece], boxes.radial, q, piece);
      }
      each_piece(boxes, q, [&](int block, int local, int a, int b, int c) {
        Sixteen product = row * along[0][a] * along[1][b];
        if constexpr (kDim == 3) product *= along[2][c];
        to[block][local] += product;
      });
    }
  }
}

/// Numbers that a register of particles takes, the first of which is number q of its chunk.
template <class T>
struct MeanNumbers {
  const T (*numbers)[kPadded];
  int q;
  Wide<T> operator[](int i) const { return Wide<T>::load(numbers[i] + q); }
};

template <class Geometry, class T>
void take(const SoilParticles<T>& set, int first, int last, const int* corner, const SoilPlacesOf<T>& places,
          double dt) {
  using W = Wide<T>;
  using Eight = typename Rows<T>::Eight;
  constexpr int kNumbers = soil::kMotionNumbers;
  static_assert(sizeof(SoilMotion<T>) >= 24 * sizeof(T));
  constexpr int kDim = Geometry::kDim;
  static const SoilMotion<T> kNowhere[kDim == 3 ? 64 : 16] = {};
  const SoilMotion<T>* from[27];
  for (int n = 0; n < (kDim == 3 ? 27 : 9); ++n) {
    from[n] = places.motion[n] != nullptr ? places.motion[n] : kNowhere;
  }
  Boxes<Geometry, T> boxes;
  alignas(64) T numbers[kNumbers][kPadded] = {};
  alignas(64) T rows[kChunk][24];
  for (int begin = first; begin < last; begin += kChunk) {
    const int count = std::min(kChunk, last - begin);
    boxes.find(set, begin, count, corner);
    for (int q = 0; q < count; ++q) {
      Eight sums[3] = {};
      each_piece(boxes, q, [&](int block, int local, int a, int b, int c) {
        T part = boxes.along[0].part[a][q] * boxes.along[1].part[b][q];
        if constexpr (kDim == 3) part *= boxes.along[2].part[c][q];
        const Eight* cell = reinterpret_cast<const Eight*>(from[block] + local);
        for (int i = 0; i < 3; ++i) sums[i] += part * cell[i];
      });
      for (int i = 0; i < 3; ++i) *reinterpret_cast<Eight*>(rows[q] + 8 * i) = sums[i];
    }
    for (int i = 0; i < kNumbers; ++i) {
      for (int q = 0; q < count; ++q) numbers[i][q] = rows[q][i];
    }
    for (int q = 0; q < count; q += W::kLanes) {
      const int p = begin + q, lanes = count - q;
      soil::take_motion<Geometry>(set, p, lanes, MeanNumbers<T>{numbers, q}, dt);
    }
  }
}

}  // namespace

template <class T>
mpm_kernel::SoilPasses<T> soil_passes(mpm_kernel::CellKind kind) {
  switch (kind) {
    case mpm_kernel::CellKind::space:
      return {&gather<Solid, T>, &take<Solid, T>};
    case mpm_kernel::CellKind::plane:
      return {&gather<PlaneStrain, T>, &take<PlaneStrain, T>};
    case mpm_kernel::CellKind::rings:
      break;
  }
  return {&gather<Axisymmetric, T>, &take<Axisymmetric, T>};
}

template mpm_kernel::SoilPasses<double> soil_passes(mpm_kernel::CellKind kind);
template mpm_kernel::SoilPasses<float> soil_passes(mpm_kernel::CellKind kind);

}  // namespace mpm
