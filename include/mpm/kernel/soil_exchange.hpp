// Exchange between a particle of soil and the cells of the implicit step: how its box is cut by the faces of cells into
// up to eight pieces, what it gives to a cell by a piece, and what it takes (implicit/soil_cells.hpp). One source for
// the processor, which takes a register of particles at once, and for devices. Weak: soil_cells.hpp.
#pragma once

#include <algorithm>

#include "mpm/kernel/soil_cells.hpp"
#include "mpm/kernel/stress.hpp"

namespace mpm::soil {

using mpm_kernel::kOverRoot2;
using mpm_kernel::kOverRoot3;
using mpm_kernel::kOverRoot6;
using mpm_kernel::SoilMotion;
using mpm_kernel::SoilParticles;
using mpm_kernel::SoilSums;

constexpr int kNumbers = 10;         ///< numbers that a particle gives: volume, r, opening, left, dilates
constexpr int kMotionNumbers = 18;   ///< numbers that it takes, those of SoilMotion
constexpr double kThinnest = 1e-5;   ///< part of a box: a piece that is thinner is none
constexpr double kDensest = 0.02;    ///< logarithmic volume: the most that is remembered of soil that is too dense
constexpr double kMostStrain = 0.2;  ///< strain of volume that a step may give a particle

/// Cut of a box along one axis, into a piece in each of two cells, of which one may be empty.
template <class T>
struct Cut {
  int cell;              ///< lower cell
  T part[2], middle[2];  ///< the pieces' parts of the box, and their middles from the lower faces of their cells

  Cut() = default;
  /// The box from `low` to `high` about `at`, in cells; `whole`: 1 over its width.
  inline __attribute__((always_inline)) Cut(double at, double low, double high, double whole) {
    constexpr int kShift = 64;
    const int i = static_cast<int>(low + kShift) - kShift;
    const double face = i + 1.0;  // between the two
    double above = std::max(high - face, 0.0) * whole;
    above = above < kThinnest ? 0.0 : above > 1.0 - kThinnest ? 1.0 : above;
    // A box in one cell has its own middle there.
    const double lower = above > 0.0 ? 0.5 * (low - face) + 1.0 : at - i;
    const double upper = above < 1.0 ? 0.5 * (high - face) : at - face;
    cell = i;
    part[0] = static_cast<T>(1.0 - above);
    part[1] = static_cast<T>(above);
    middle[0] = static_cast<T>(lower);
    middle[1] = static_cast<T>(upper);
  }
};

/// Logarithmic volume, of a law whose pressure is K (1 / j - j) / 2 (material/neo_hookean.hpp), that its pressure does
/// not account for.
template <class W>
W volume_beyond_pressure(W pressure, W j, double bulk) {
  return max(min(W(1.0 / bulk) * pressure + W(0.5) * (j - W(1.0) / j), W(kDensest)), W(-kDensest));
}

/// Numbers that particles give to their cells, of `lanes` particles from p on.
template <class Geometry, class T>
inline __attribute__((always_inline)) void numbers_of(const SoilParticles<T>& set, int p, int lanes,
                                                      Wide<T> (&to)[kNumbers]) {
  using W = Wide<T>;
  const W j = determinant(Geometry::load_matrix(WideReader<T>{set.f, lanes}, p));
  const auto tau = full(Geometry::load_symmetric(WideReader<T>{set.tau, lanes}, p));
  const W mass = set.masses != nullptr ? W::load_first(set.masses + p, lanes) : W(set.mass);
  const W scale = -(W(set.density) / j);  // compression is positive
  const W xx = scale * tau.xx, yy = scale * tau.yy, zz = scale * tau.zz, shear = scale * W(1.0 / kOverRoot2);
  const W opening = set.opening != nullptr ? W::load_first(set.opening + p, lanes)
                                           : volume_beyond_pressure(W(1.0 / 3.0) * (xx + yy + zz), j, set.bulk);
  const W left = max(W(1.0) - W(set.per_strain) * W::load_first(set.strain + p, lanes), W(0.0));
  const W dilates = left * max(min(W(set.dilation_start) - W(set.dilation_slope) * j, W(1.0)), W(0.0));
  to[0] = mass * W(1.0 / set.density) * j;
  to[1] = W(kOverRoot3) * (xx + yy + zz);
  to[2] = W(kOverRoot2) * (xx - yy);
  to[3] = W(kOverRoot6) * (zz + zz - xx - yy);
  to[4] = Geometry::kHoop ? W(1.0) : shear * tau.yz;
  to[5] = shear * tau.xz;
  to[6] = shear * tau.xy;
  to[7] = opening;
  to[8] = left;
  // Soil that has opened has room to dilate into.
  to[9] = select(opening > W(0.0), W(0.0), dilates);
}

/// Adds a piece of a particle with these numbers to the sums of a cell: its parts of the box and middles along each
/// axis of the grid. The processor adds sixteen numbers at once (kernel/wide/soil_particles.cpp), to the same.
template <class Geometry, class T>
void add_piece(SoilSums<T>& sums, const T (&numbers)[kNumbers], const T* part, const T* middle) {
  static_assert(!Geometry::kHoop);
  constexpr bool kSolid = Geometry::kDim == 3;
  T volume = numbers[0] * part[0] * part[1];
  if constexpr (kSolid) volume *= part[2];
  const T x = middle[0], y = kSolid ? middle[1] : T(0), z = middle[Geometry::kDim - 1];
  const T place[6] = {x, y, z, x * y, x * z, y * z};
  sums.volume += volume;
  for (int i = 0; i < 6; ++i) sums.place[i] += volume * place[i];
  for (int i = 0; i < 6; ++i) sums.stress[i] += volume * numbers[1 + i];
  sums.opening += volume * numbers[7];
  sums.left += volume * numbers[8];
  sums.dilates += volume * numbers[9];
}

/// Adds what a part of a particle takes from a cell.
template <class T>
void add_motion(T (&sums)[kMotionNumbers], T part, const SoilMotion<T>& cell) {
  for (int i = 0; i < 9; ++i) sums[i] += part * cell.gradient[i];
  for (int i = 0; i < 6; ++i) sums[9 + i] += part * cell.stress[i];
  sums[15] += part * cell.opening;
  sums[16] += part * cell.shear;
  sums[17] += part * cell.power;
}

template <class Geometry, class W>
auto velocity_gradient(const W (&l)[3][3]) {
  if constexpr (Geometry::kDim == 3) {
    return Matrix3<W>{l[0][0], l[0][1], l[0][2], l[1][0], l[1][1], l[1][2], l[2][0], l[2][1], l[2][2]};
  } else {
    return MatrixPlane<W>{l[0][0], l[0][2], l[2][0], l[2][2], Geometry::kHoop ? l[1][1] : W(0.0)};
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

/// Strain, stress and history of `lanes` particles from p on, from the mean over their pieces of the cells' motion:
/// of[i] is number i of SoilMotion, in an array, or in what loads it where it is wanted.
template <class Geometry, class T, class Numbers>
inline __attribute__((always_inline)) void take_motion(const SoilParticles<T>& set, int p, int lanes, const Numbers& of,
                                                       double dt) {
  using W = Wide<T>;
  W l[3][3];
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < 3; ++k) l[c][k] = of[3 * c + k] * W(dt);
  }
  const W trace_l = l[0][0] + l[1][1] + l[2][2];
  constexpr bool kThree = Geometry::kDim == 3 || Geometry::kHoop;
  const W excess = (trace_l - max(min(trace_l, W(kMostStrain)), W(-kMostStrain))) * W(1.0 / (kThree ? 3 : 2));
  for (int k = 0; k < 3; ++k) {
    if (kThree || k != 1) l[k][k] -= excess;
  }
  const W r0 = W(kOverRoot3) * of[9], r1 = W(kOverRoot2) * of[10], r2 = W(kOverRoot6) * of[11];
  const Symmetric3<W> cauchy{-(r0 + r1 - r2),         -(r0 - r1 - r2),         -(r0 + r2 + r2),
                             W(-kOverRoot2) * of[12], W(-kOverRoot2) * of[13], W(-kOverRoot2) * of[14]};
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
  const W work = W(dt / set.density) * of[17] * j_old - (stored(tau, j) - stored(tau_old, j_old));
  Geometry::store_matrix(now, WideWriter<T>{set.f, lanes}, p);
  Geometry::store_symmetric(tau, WideWriter<T>{set.tau, lanes}, p);
  if (set.opening != nullptr) {
    const W opening = W::load_first(set.opening + p, lanes) + W(dt / kOverRoot3) * of[15];
    max(opening, W(-kDensest)).store_first(set.opening + p, lanes);
  }
  (W::load_first(set.strain + p, lanes) + W(dt * set.strain_of_shear) * of[16]).store_first(set.strain + p, lanes);
  (W::load_first(set.work + p, lanes) + work).store_first(set.work + p, lanes);
}

}  // namespace mpm::soil
