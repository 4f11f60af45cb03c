// Strain and stress of a chunk of particles of one body: F <- exp(grad v dt) F and the body's law, a register of
// particles at a time. The law is chosen once a body, from a table made of the closed list of laws, and called
// once a chunk; inside the loop there is no call and no branch on it. Nothing here depends on the shape function. A law
// knows nothing of free strain: it is taken off before, and put back after (free_strain.hpp).
// Source: Nairn & Guilkey (2015) eq. (9), (64); method reference 7.
#pragma once

#include <type_traits>

#include "mpm/kernel/chunks.hpp"
#include "mpm/kernel/free_strain.hpp"
#include "mpm/kernel/interleave.hpp"
#include "mpm/kernel/kernels.hpp"
#include "mpm/kernel/wide_math.hpp"
#include "mpm/material/increment.hpp"
#include "mpm/material/plane_stress.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/math/exponential.hpp"

// A law is inlined into its loop. Not with sanitizers: what is inlined is instrumented again, for minutes a file.
#if defined(__SANITIZE_ADDRESS__)
#define MPM_FLATTEN
#else
#define MPM_FLATTEN [[gnu::flatten]]
#endif

namespace mpm {

/// Reads registers as Geometry::load_* want them: arrays[component][particle].
template <class T>
struct WideReader {
  T* const* arrays;
  int count;
  struct Component {
    const T* from;
    int count;
    Wide<T> operator[](int p) const { return Wide<T>::load_first(from + p, count); }
  };
  Component operator[](int c) const { return {arrays[c], count}; }
};

/// Writes them as Geometry::store_* do.
template <class T>
struct WideWriter {
  T* const* arrays;
  int count;
  struct Place {
    T* to;
    int count;
    void operator=(Wide<T> value) const { value.store_first(to, count); }
  };
  struct Component {
    T* to;
    int count;
    Place operator[](int p) const { return {to + p, count}; }
  };
  Component operator[](int c) const { return {arrays[c], count}; }
};

template <class Geometry, class T>
class Stress {
  using W = Wide<T>;
  using Set = mpm_kernel::SetView<T>;
  using Columns = mpm_kernel::ChunkStresses<T>;
  static constexpr int kDim = Geometry::kDim;
  /// The strain along y is found with the law, from what the plane's strain leaves of the free one.
  static constexpr bool kFreeThickness = std::is_same_v<Geometry, PlaneStress>;

 public:
  /// `gradients.l[c]` is where component c of the first particle's is, as in mpm_kernel::ChunkGradients.
  template <class LawType, class Gradients>
  static int update(const Set& set, int first, int count, const Gradients& gradients,
                    const mpm_kernel::StrainSettings& settings, Columns* out) {
    if (set.free_strain != nullptr) return update_growing<LawType>(set, first, count, gradients, settings, out);
    return update_plain<LawType>(set, first, count, gradients, settings, out);
  }

  /// Columns of the stress as it is, whatever the law.
  static void columns(const Set& set, int first, int count, Columns& out) {
    for (int q = 0; q < count; q += W::kLanes) {
      const W mass = mass_of<Geometry::kHoop>(set, first + q, count - q);
      put_columns(Geometry::load_symmetric(WideReader<T>{set.tau, count - q}, first + q), -mass, q, out);
    }
  }

 private:
  // Two functions, so that the loop of material that does not grow has no part of the other.
  template <class LawType, class Gradients>
  MPM_FLATTEN static int update_plain(const Set& set, int first, int count, const Gradients& gradients,
                                      const mpm_kernel::StrainSettings& settings, Columns* out) {
    return update_each<LawType, false>(set, first, count, gradients, settings, out);
  }
  template <class LawType, class Gradients>
  [[gnu::cold]] static int update_growing(const Set& set, int first, int count, const Gradients& gradients,
                                          const mpm_kernel::StrainSettings& settings, Columns* out) {
    return update_each<LawType, true>(set, first, count, gradients, settings, out);
  }

  template <class LawType, bool Grows, class Gradients>
  static int update_each(const Set& set_view, int first, int count, const Gradients& gradients,
                         const mpm_kernel::StrainSettings& settings, Columns* out) {
    static_assert(std::is_trivially_copyable_v<LawType>, "laws cross the border between instruction sets as bytes");
    const Set set = set_view;
    const LawType law = *static_cast<const LawType*>(set.law);
    const W dt(settings.dt);
    int bad = count;
    for (int q = 0; q < count; q += W::kLanes) {
      const int p = first + q, lanes = count - q;
      fetch<LawType::kHistory>(set, p + mpm_kernel::kChunk);
      W l[kDim][kDim];
      for (int c = 0; c < kDim; ++c) {
        for (int k = 0; k < kDim; ++k) l[c][k] = W::load(gradients.l[c * kDim + k] + q) * dt;
      }
      auto old = Geometry::load_matrix(WideReader<T>{set.f, lanes}, p);
      auto stress = Geometry::load_symmetric(WideReader<T>{set.tau, lanes}, p);
      if constexpr (Grows) {
        const auto parts = FreeStrain<T>::parts(set, p, lanes, old, stress);
        old = parts.f;
        stress = parts.tau;
        for (int k = 0; k < kDim && kFreeThickness; ++k) l[k][k] = l[k][k] - parts.growth;
      }
      const W j_old = determinant(old);
      auto now = old;
      W j;
      W history[LawType::kHistory + 1];
      for (int h = 0; h < LawType::kHistory; ++h) history[h] = W::load_first(set.history[h] + p, lanes);
      if constexpr (std::is_same_v<Geometry, PlaneStress>) {
        plane_stress_update(law, l, settings.terms, old, dt, stress, history, now, j_old, j);
      } else {
        auto du = Geometry::gradient(l);
        if constexpr (Geometry::kHoop) du.yy = W::load(gradients.l[mpm_kernel::kHoopGradient] + q) * dt;
        if constexpr (Grows) du = FreeStrain<T>::less_growth(set, p, lanes, du);
        const auto df = exponential(du, settings.terms);
        now = product(df, old);
        if constexpr (LawType::kForgetsShape) now = Geometry::dilatation(j_old * determinant(df));
        j = determinant(now);
        law.update(Increment<W, std::decay_t<decltype(du)>>{du, df, now, j_old, j, dt}, stress, history);
      }
      if constexpr (Grows) {
        const auto whole =
            FreeStrain<T>::whole(set, p, lanes, Geometry::load_matrix(WideReader<T>{set.f, lanes}, p),
                                 Geometry::load_symmetric(WideReader<T>{set.tau, lanes}, p), now, stress);
        now = whole.f;
        stress = whole.tau;
      }
      Geometry::store_matrix(now, WideWriter<T>{set.f, lanes}, p);
      Geometry::store_symmetric(stress, WideWriter<T>{set.tau, lanes}, p);
      for (int h = 0; h < LawType::kHistory; ++h) history[h].store_first(set.history[h] + p, lanes);
      if (out != nullptr) put_columns(stress, -mass_of<Geometry::kHoop>(set, p, lanes), q, *out);
      const unsigned failed = WideMask<T>::first(lanes).bits() & ~(j > W(0.0)).bits();
      if (failed != 0 && bad == count) bad = q + __builtin_ctz(failed);
    }
    return bad;
  }

  /// Particles of the next chunk, whose lines would else be waited for: of a solid there are more of them than the
  /// processor fetches ahead by itself. Where a register is a line.
  template <int History>
  static void fetch(const Set& set, int p) {
    if constexpr (kDim < 3 || sizeof(W) < 64) return;
    for (int c = 0; c < 9; ++c) __builtin_prefetch(set.f[c] + p, 1);
    for (int c = 0; c < 6; ++c) __builtin_prefetch(set.tau[c] + p, 1);
    for (int h = 0; h < History; ++h) __builtin_prefetch(set.history[h] + p, 1);
  }

  template <class Symmetric>
  static void put_columns(const Symmetric& stress, W mass, int q, Columns& out) {
    for (int k = 0; k < kDim; ++k) {
      W column[kDim], four[4] = {W(0.0), W(0.0), W(0.0), W(0.0)};
      Geometry::column(stress, k, column);
      for (int c = 0; c < kDim; ++c) four[c] = column[c] * mass;
      interleave(out.column[k] + 4 * q, four[0], four[1], four[2], four[3]);
    }
    if constexpr (Geometry::kHoop) {
      interleave(out.column[mpm_kernel::kHoopColumn] + 4 * q, stress.yy * mass, W(0.0), W(0.0), W(0.0));
    }
  }
};

}  // namespace mpm
