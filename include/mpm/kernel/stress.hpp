// Strain and stress of a chunk of particles of one body: F <- exp(grad v dt) F and the body's law, a register of
// particles at a time. The law is chosen once a chunk, from a table made of the closed list of laws; inside the loop
// there is no call and no branch on it.
// Source: Nairn & Guilkey (2015) eq. (9), (64); method reference 7.
#pragma once

#include <variant>

#include "mpm/kernel/scatter.hpp"
#include "mpm/material/law.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/math/exponential.hpp"

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

template <class Geometry, template <class> class Shape, class T>
class Stress {
  using W = Wide<T>;
  static constexpr int kDim = Geometry::kDim;

 public:
  using Stresses = typename Scatter<T, kDim, Shape>::Stresses;
  /// Velocity gradients of a chunk [1/s].
  struct Gradients {
    alignas(64) T l[kDim][kDim][kBuffer];
  };
  using Update = int (*)(const SetView<T>&, int first, int count, const Gradients&, const mpm_kernel::StrainSettings&,
                         Stresses*);

  /// Particles [first, first + count); with `out`, the columns of -m tau too. Returns the place in the chunk of the
  /// first particle whose J is not positive, or `count`.
  template <class LawType>
  [[gnu::flatten]] static int update(const SetView<T>& set_view, int first, int count, const Gradients& gradients,
                                     const mpm_kernel::StrainSettings& settings, Stresses* out) {
    const SetView<T> set = set_view;
    const LawType law = *static_cast<const LawType*>(set.law);
    const W dt(settings.dt), mass(-set.mass);
    int bad = count;
    for (int q = 0; q < count; q += W::kLanes) {
      const int p = first + q, lanes = count - q;
      W l[kDim][kDim];
      for (int c = 0; c < kDim; ++c) {
        for (int k = 0; k < kDim; ++k) l[c][k] = W::load(gradients.l[c][k] + q) * dt;
      }
      const auto du = Geometry::gradient(l);
      const auto old = Geometry::load_matrix(WideReader<T>{set.f, lanes}, p);
      const auto df = exponential(du, settings.terms);
      const W j_old = determinant(old);
      auto now = product(df, old);
      if constexpr (LawType::kForgetsShape) now = Geometry::dilatation(j_old * determinant(df));
      const W j = determinant(now);
      auto stress = Geometry::load_symmetric(WideReader<T>{set.tau, lanes}, p);
      W history[LawType::kHistory + 1];
      for (int h = 0; h < LawType::kHistory; ++h) history[h] = W::load_first(set.history[h] + p, lanes);
      law.update(Increment<W, std::decay_t<decltype(du)>>{du, df, now, j_old, j, dt}, stress, history);
      Geometry::store_matrix(now, WideWriter<T>{set.f, lanes}, p);
      Geometry::store_symmetric(stress, WideWriter<T>{set.tau, lanes}, p);
      for (int h = 0; h < LawType::kHistory; ++h) history[h].store_first(set.history[h] + p, lanes);
      if (out != nullptr) {
        for (int k = 0; k < kDim; ++k) {
          W column[kDim];
          Geometry::column(stress, k, column);
          for (int c = 0; c < kDim; ++c) column[c] *= mass;
          out->set_column(k, q, column);
        }
      }
      const unsigned failed = WideMask<T>::first(lanes).bits() & ~(j > W(0.0)).bits();
      if (failed != 0 && bad == count) bad = q + __builtin_ctz(failed);
    }
    return bad;
  }

  static Update of_law(int kind) { return Table<Law>::updates[kind]; }

 private:
  template <class Laws>
  struct Table;
  template <class... Laws>
  struct Table<std::variant<Laws...>> {
    static constexpr Update updates[] = {&update<Laws>...};
  };
};

}  // namespace mpm
