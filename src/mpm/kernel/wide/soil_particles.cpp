// What particles of soil and cells of the implicit step give to each other, a chunk of particles at a time. A
// particle's box is cut by the faces of the cells into up to eight pieces (implicit/soil_cells.hpp).
#include <algorithm>
#include <array>

#include "mpm/kernel/soil_cells.hpp"
#include "mpm/kernel/soil_lanes.hpp"
#include "mpm/kernel/stress.hpp"

namespace mpm {
namespace {

using mpm_kernel::SoilMotion;
using mpm_kernel::SoilParticles;
using mpm_kernel::SoilPlacesOf;
using mpm_kernel::SoilSums;

constexpr double kThinnest = 1e-5;   ///< part of a box: a piece that is thinner is none
constexpr double kDensest = 0.02;    ///< logarithmic volume: the most that is remembered of soil that is too dense
constexpr double kMostStrain = 0.2;  ///< of volume, that a step may give a particle
constexpr int kChunk = 64;
constexpr int kPadded = kChunk + 16;  ///< and what the last register writes beyond them

/// Pieces of a box along one axis: cells counted from the block's first, parts of the box, middles from the lower face.
struct Cut {
  int count = 1, cell[2];
  double part[2], middle[2];
};

Cut cut(double x, double half) {
  constexpr int kShift = 64;
  const double low = x - half, high = x + half;
  const int i = static_cast<int>(low + kShift) - kShift, j = static_cast<int>(high + kShift) - kShift;
  Cut one;
  one.cell[0] = i;
  one.part[0] = 1.0;
  one.middle[0] = x - i;
  if (i == j) return one;
  const double above = (high - j) / (2.0 * half);
  if (above >= 1.0 - kThinnest) {
    one.cell[0] = j;
    one.middle[0] = x - j;
  } else if (above > kThinnest) {
    one.count = 2;
    one.part[0] = 1.0 - above;
    one.middle[0] = 0.5 * (low + j) - i;
    one.cell[1] = j;
    one.part[1] = above;
    one.middle[1] = 0.5 * (high - j);
  }
  return one;
}

/// visit(block around, cell inside it, part of the box, middle along world axes) for each piece of a particle.
template <int Dim, class T, class Visit>
void each_piece(const SoilParticles<T>& set, int p, const int* corner, Visit&& visit) {
  Cut cuts[3];
  for (int k = 0; k < Dim; ++k) {
    cuts[k] = cut((set.x[k][p] - set.origin[k]) * set.inverse_cell[k] - corner[k], set.half[k]);
  }
  static_assert(mpm_kernel::kTileEdge - 2 * mpm_kernel::kTileMargin == 4,
                "the numbers below are of blocks of four nodes");
  const auto block_of = [](int cell) { return std::clamp((cell + 4) >> 2, 0, 2); };
  for (int a = 0; a < cuts[0].count; ++a) {
    const int x = cuts[0].cell[a];
    for (int b = 0; b < cuts[1].count; ++b) {
      const int y = cuts[1].cell[b];
      const double part = cuts[0].part[a] * cuts[1].part[b];
      const int block = 3 * block_of(x) + block_of(y), local = 4 * (x & 3) + (y & 3);
      if constexpr (Dim == 2) {
        visit(block, local, part, {cuts[0].middle[a], 0.0, cuts[1].middle[b]});
      } else {
        for (int c = 0; c < cuts[2].count; ++c) {
          const int z = cuts[2].cell[c];
          visit(3 * block + block_of(z), 4 * local + (z & 3), part * cuts[2].part[c],
                {cuts[0].middle[a], cuts[1].middle[b], cuts[2].middle[c]});
        }
      }
    }
  }
}

using Middle = std::array<double, 3>;

template <class Geometry, class W>
auto velocity_gradient(const W (&l)[3][3]) {
  if constexpr (Geometry::kDim == 3) {
    return Matrix3<W>{l[0][0], l[0][1], l[0][2], l[1][0], l[1][1], l[1][2], l[2][0], l[2][1], l[2][2]};
  } else {
    return MatrixPlane<W>{l[0][0], l[0][2], l[2][0], l[2][2], W(0.0)};
  }
}

template <class Geometry, class W>
auto in_geometry(const Symmetric3<W>& s) {
  if constexpr (Geometry::kDim == 3) {
    return s;
  } else {
    return SymmetricPlane<W>{s.xx, s.zz, s.xz, s.yy};
  }
}

template <class T>
struct Rows {
  typedef T Sixteen __attribute__((vector_size(16 * sizeof(T)), aligned(sizeof(T)), may_alias));
  typedef T Eight __attribute__((vector_size(8 * sizeof(T)), aligned(sizeof(T)), may_alias));
};

template <class Geometry, class T>
void gather(const SoilParticles<T>& set, int first, int last, const int* corner, const SoilPlacesOf<T>& places) {
  using W = Wide<T>;
  using Sixteen = typename Rows<T>::Sixteen;
  static_assert(sizeof(SoilSums<T>) == 16 * sizeof(T));
  alignas(64) T numbers[10][kPadded];  // volume, r, opening, left, dilates
  for (int begin = first; begin < last; begin += kChunk) {
    const int count = std::min(kChunk, last - begin);
    for (int q = 0; q < count; q += W::kLanes) {
      const int p = begin + q, lanes = count - q;
      const W j = determinant(Geometry::load_matrix(WideReader<T>{set.f, lanes}, p));
      const auto tau = full(Geometry::load_symmetric(WideReader<T>{set.tau, lanes}, p));
      const W mass = set.masses != nullptr ? W::load_first(set.masses + p, lanes) : W(set.mass);
      const W scale = -(W(set.density) / j);  // compression is positive
      const W xx = scale * tau.xx, yy = scale * tau.yy, zz = scale * tau.zz, shear = scale * W(1.0 / kRoot2);
      const W opening = W::load_first(set.opening + p, lanes);
      const W left = max(W(1.0) - W(set.per_strain) * W::load_first(set.strain + p, lanes), W(0.0));
      const W dilates = left * max(min(W(set.dilation_start) - W(set.dilation_slope) * j, W(1.0)), W(0.0));
      (mass * W(1.0 / set.density) * j).store(numbers[0] + q);
      (W(kRoot3) * (xx + yy + zz)).store(numbers[1] + q);
      (W(kRoot2) * (xx - yy)).store(numbers[2] + q);
      (W(kRoot6) * (zz + zz - xx - yy)).store(numbers[3] + q);
      (shear * tau.yz).store(numbers[4] + q);
      (shear * tau.xz).store(numbers[5] + q);
      (shear * tau.xy).store(numbers[6] + q);
      opening.store(numbers[7] + q);
      left.store(numbers[8] + q);
      // Soil that has opened has room to dilate into.
      select(opening > W(0.0), W(0.0), dilates).store(numbers[9] + q);
    }
    for (int q = 0; q < count; ++q) {
      alignas(64) T row[16];
      for (int i = 1; i < 10; ++i) row[6 + i] = numbers[i][q];
      each_piece<Geometry::kDim>(set, begin + q, corner, [&](int block, int local, double part, const Middle& m) {
        row[0] = T(1);
        row[1] = static_cast<T>(m[0]);
        row[2] = static_cast<T>(m[1]);
        row[3] = static_cast<T>(m[2]);
        row[4] = static_cast<T>(m[0] * m[1]);
        row[5] = static_cast<T>(m[0] * m[2]);
        row[6] = static_cast<T>(m[1] * m[2]);
        auto& to = *reinterpret_cast<Sixteen*>(places.sums[block] + local);
        to += static_cast<T>(part * static_cast<double>(numbers[0][q])) * *reinterpret_cast<const Sixteen*>(row);
      });
    }
  }
}

template <class Geometry, class T>
void take(const SoilParticles<T>& set, int first, int last, const int* corner, const SoilPlacesOf<T>& places,
          double dt) {
  using W = Wide<T>;
  using Eight = typename Rows<T>::Eight;
  constexpr int kNumbers = 18;
  static_assert(sizeof(SoilMotion<T>) >= 24 * sizeof(T));
  alignas(64) T numbers[kNumbers][kPadded] = {};
  for (int begin = first; begin < last; begin += kChunk) {
    const int count = std::min(kChunk, last - begin);
    for (int q = 0; q < count; ++q) {
      Eight sums[3] = {};
      each_piece<Geometry::kDim>(set, begin + q, corner, [&](int block, int local, double part, const Middle&) {
        const Eight* from = reinterpret_cast<const Eight*>(places.motion[block] + local);
        for (int i = 0; i < 3; ++i) sums[i] += static_cast<T>(part) * from[i];
      });
      for (int i = 0; i < kNumbers; ++i) numbers[i][q] = sums[i / 8][i % 8];
    }
    for (int q = 0; q < count; q += W::kLanes) {
      const int p = begin + q, lanes = count - q;
      const auto number = [&](int i) { return W::load(numbers[i] + q); };
      W l[3][3];
      for (int c = 0; c < 3; ++c) {
        for (int k = 0; k < 3; ++k) l[c][k] = number(3 * c + k) * W(dt);
      }
      const W trace_l = l[0][0] + l[1][1] + l[2][2];
      const W excess = (trace_l - max(min(trace_l, W(kMostStrain)), W(-kMostStrain))) * W(1.0 / Geometry::kDim);
      for (int k = 0; k < 3; ++k) {
        if (Geometry::kDim == 3 || k != 1) l[k][k] -= excess;
      }
      const W r0 = W(kRoot3) * number(9), r1 = W(kRoot2) * number(10), r2 = W(kRoot6) * number(11);
      const Symmetric3<W> cauchy{-(r0 + r1 - r2),         -(r0 - r1 - r2),         -(r0 + r2 + r2),
                                 W(-kRoot2) * number(12), W(-kRoot2) * number(13), W(-kRoot2) * number(14)};
      const auto old = Geometry::load_matrix(WideReader<T>{set.f, lanes}, p);
      const auto tau_old = Geometry::load_symmetric(WideReader<T>{set.tau, lanes}, p);
      const W j_old = determinant(old);
      const auto du = velocity_gradient<Geometry>(l);
      const auto now = product(exponential(du, 2), old);
      const W j = determinant(now);
      const auto tau = scale_shift(rotate(in_geometry<Geometry>(cauchy), du), j * W(1.0 / set.density), W(0.0));
      const auto stored = [&](const auto& s, W volume) {  // elastic energy of a mass unit
        const W mean = trace(s) * W(1.0 / 3.0), deviator = squared_norm(scale_shift(s, W(1.0), -mean));
        return W(set.density) / volume * (mean * mean * W(0.5 / set.bulk) + deviator * W(0.25 / set.shear));
      };
      const W work = W(dt / set.density) * number(17) * j_old - (stored(tau, j) - stored(tau_old, j_old));
      const W opening = W::load_first(set.opening + p, lanes) + W(dt / kRoot3) * number(15);
      Geometry::store_matrix(now, WideWriter<T>{set.f, lanes}, p);
      Geometry::store_symmetric(tau, WideWriter<T>{set.tau, lanes}, p);
      max(opening, W(-kDensest)).store_first(set.opening + p, lanes);
      (W::load_first(set.strain + p, lanes) + W(dt / kRoot2) * number(16)).store_first(set.strain + p, lanes);
      (W::load_first(set.work + p, lanes) + work).store_first(set.work + p, lanes);
    }
  }
}

}  // namespace

template <class T>
mpm_kernel::SoilPasses<T> soil_passes(int axes) {
  if (axes == 3) return {&gather<Solid, T>, &take<Solid, T>};
  return {&gather<PlaneStrain, T>, &take<PlaneStrain, T>};
}

template mpm_kernel::SoilPasses<double> soil_passes(int axes);
template mpm_kernel::SoilPasses<float> soil_passes(int axes);

}  // namespace mpm
