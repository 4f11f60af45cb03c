// The interpolator of shape functions that are sums over points of a deformed domain (CPDI): points and their gradients
// are made with particles in the lanes, nodes are read and written a particle at a time, as vectors of two nodes'
// components. interpolator.hpp says what it has.
//
// Weak: about half the speed of uGIMP in a solid. A domain is that of the step's start through the whole step: gathered
// with another one than it was scattered with, momentum would be lost.
// Source: Sadeghirad, Brannon & Burghardt (2011); method reference 2.5 to 2.7.
#pragma once

#include "mpm/kernel/affine.hpp"
#include "mpm/kernel/chunks.hpp"
#include "mpm/kernel/domain.hpp"

namespace mpm {

template <class T, int Dim, template <int> class Points>
class PointInterpolator {
  using W = Wide<T>;
  using Set = SetView<T>;
  using Four = typename PointVectors<T>::Four;
  using Frame = Domains<T, Dim, Points>;
  static constexpr int kPoints = Points<Dim>::kPoints;

 public:
  using Number = T;
  static constexpr int kDim = Dim;
  static constexpr int kNodes = 3;  ///< nodes that a particle's own place has to leave room for
  static constexpr bool kRings = Points<Dim>::kAxisymmetric;
  static constexpr bool kOutgrows = true;
  template <int Fields>
  using Source = PointTiles<T, Dim, Fields>;
  using Sink = ScatterTile<T, Dim>;

  PointInterpolator(const GridView& grid, const BlockView& block, const Set& set)
      : block_(block), set_(set), frame_(grid, block, set) {}

  // Points reach all of the tile.
  static BlockView reach(BlockView block) {
    block.loose = true;
    return block;
  }

  static void note_domains(const Set& set, int owner) {
    for (int c = 0; c < Dim * Dim; ++c) note_domain(set, owner, set.f[c], set.domain[c]);
  }
  // As the next step will have them: with the deformation of now.
  static bool outgrown(const GridView& grid, const BlockView& block, const Set& set_view) {
    Set set = set_view;
    for (int c = 0; c < Dim * Dim; ++c) set.domain[c] = set.f[c];
    const int first = static_cast<int>(set.group[set.group_begin[block.owner]]);
    const int end = static_cast<int>(set.group[set.group_begin[block.owner + 1]]);
    return Frame(grid, block, set).outgrown(first, end - first);
  }

  template <class Visit>
  void each_chunk(Visit&& visit) {
    const int end = static_cast<int>(set_.group[set_.group_begin[block_.owner + 1]]);
    for (int p = static_cast<int>(set_.group[set_.group_begin[block_.owner]]); p < end; p += kDomainChunk) {
      chunk_ = {p, end - p < kDomainChunk ? end - p : kDomainChunk, 0, 0};
      visit(chunk_);
    }
  }
  // Values, gradients and moments are all made of the points.
  void fill(Beside) { frame_.fill(chunk_.first, chunk_.count); }
  W cells(int k, int q) const { return frame_.cells(k, q); }

  template <int Fields>
  [[gnu::noinline]] int gather(const Source<Fields>& from, T (*to)[kBuffer]) const {
    for (int q = 0; q < chunk_.count; ++q) {
      Four sum[Source<Fields>::kTiles] = {};
      for (int a = 0; a < kPoints; ++a) {
        const CellPoint<T, Dim> at = frame_.point(a, q);
        const T weight = frame_.weight(a, q);
        for (int i = 0; i < Source<Fields>::kTiles; ++i) sum[i] += weight * from.tile[i].at(at);
      }
      for (int c = 0; c < Fields; ++c) to[c][q] = sum[c / Dim][c % Dim];
    }
    for (int c = 0; c < Fields; ++c) W(0.0).store(to[c] + chunk_.count);  // clears what the last register has beyond it
    return 0;
  }

  template <int Fields>
  [[gnu::noinline]] void gradient(const Source<Fields>& from, mpm_kernel::ChunkGradients<T>& to) const {
    static_assert(Source<Fields>::kTiles == 1);
    for (int q = 0; q < chunk_.count; ++q) {
      Four by_axis[Dim] = {};  // the gradient along each
      T hoop = 0;
      for (int a = 0; a < kPoints; ++a) {
        const Four v = from.tile[0].at(frame_.point(a, q));
        for (int k = 0; k < Dim; ++k) by_axis[k] += frame_.gradient(a, k, q) * v;
        if constexpr (kRings) hoop += frame_.hoop(a, q) * v[0];
      }
      if constexpr (kRings) to.l[mpm_kernel::kHoopGradient][q] = hoop;
      for (int c = 0; c < Fields; ++c) {
        for (int k = 0; k < Dim; ++k) to.l[c * Dim + k][q] = by_axis[k][c];
      }
    }
  }

  [[gnu::noinline]] void gather_affine(const Source<Dim>& velocity) const {
    for (int q = 0; q < chunk_.count; ++q) {
      mpm::gather_affine<Dim, kPoints>(frame_, q, velocity.tile[0], set_, chunk_.first + q);
    }
  }

  template <int Fields>
  void gather_at_place(const Source<Fields>& from, int c, T* to) const {
    for (int q = 0; q < chunk_.count; ++q) to[q] = from.tile[c / Dim].at(frame_.centre(q))[c % Dim];
  }

  [[gnu::noinline]] void spread(const ChunkValues<T>& from, Sink& to) const {
    for (int q = 0; q < chunk_.count; ++q) {
      const Four value = four(from.v, q);
      for (int a = 0; a < kPoints; ++a) spread_point(frame_.point(a, q), frame_.weight(a, q) * value, to.data());
    }
  }
  template <bool Hoop = kRings>
  [[gnu::noinline]] void spread_gradient(const mpm_kernel::ChunkStresses<T>& from, Sink& to) const {
    for (int q = 0; q < chunk_.count; ++q) {
      Four column[Dim];
      for (int k = 0; k < Dim; ++k) column[k] = four(from.column[k], q);
      for (int a = 0; a < kPoints; ++a) {
        Four f{};
        for (int k = 0; k < Dim; ++k) f += frame_.gradient(a, k, q) * column[k];
        if constexpr (Hoop) f[0] += frame_.hoop(a, q) * from.column[mpm_kernel::kHoopColumn][4 * q];
        spread_point(frame_.point(a, q), f, to.data());
      }
    }
  }
  [[gnu::noinline]] void spread_affine(const ChunkValues<T>& from, Sink& to) const {
    for (int q = 0; q < chunk_.count; ++q) {
      mpm::spread_affine<Dim, kPoints>(frame_, q, four(from.v, q), set_, chunk_.first + q, to.data());
    }
  }

 private:
  static Four four(const T* from, int q) {
    Four value;
    __builtin_memcpy(&value, from + 4 * q, sizeof(value));
    return value;
  }

  const BlockView& block_;
  const Set& set_;
  Frame frame_;
  ParticleChunk chunk_{};
};

}  // namespace mpm
