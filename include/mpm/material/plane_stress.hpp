// Plane stress for any law: the strain along y of an increment is the one that leaves no stress along y.
//
// The law is evaluated repeatedly from the state at the increment's start, with different values of the strain along y,
// e = (grad v dt)_yy: first e = 0, then a step with the stiffness c^2 of the fastest wave, then the secant through the
// last two. tau_yy rises with e, so its signs bracket the root. A secant step that leaves the bracket is replaced by
// the bracket's middle, and so is every second one after kManySteps. Where tau_yy does not rise (soil that has opened),
// steps grow until it does.
//
// Lanes iterate together until all have found their e. A lane that has found it keeps it, so it gets the same bits as
// it would alone. A lane with NaN is left as it is; the caller checks J.
//
// Weak: the law is evaluated three or four times in an elastic step, more where it begins to flow. A stress that cannot
// be brought to zero within one increment stays in tau_yy, and the next increment continues from there: a thickness
// that would change by more than kMost, or the jump in the stress of opened soil that closes. The wave speed that
// limits the time step is that of a solid: a wave in a plate is slower, by sqrt(1 - 2 nu) / (1 - nu) where the material
// is unstrained. Source: de Borst (1991), Eng. Comput. 8, 23-33, for finding the free strain beside any law; he takes
// Newton's steps with the law's tangent, which laws here do not have.
#pragma once

#include <type_traits>

#include "mpm/material/increment.hpp"
#include "mpm/math/exponential.hpp"
#include "mpm/math/lanes.hpp"

namespace mpm {

/// Tolerance of tau_yy relative to c^2, and of e. Double precision: a strain of 1e-12, far below the strains of a scene
/// and far above the round-off of a law, 1e-15. Single precision: 2e-7, the last digit of a deformation gradient.
template <class Scalar>
inline constexpr double kFreeStress = std::is_same_v<Scalar, double> ? 1e-12 : 2e-7;

/// Advances a law over one increment in plane stress. `du`: rows d v_i / d x_j dt, i and j of x, z. `terms`: terms of
/// the exponential, in the plane and along y. `old_f`, `j_old`: deformation gradient at the start, with yy, and its
/// determinant. `stress` [J/kg] and `history` are in at the start and out at the end. `now_f`, `j`: out.
template <class Law, class T>
void plane_stress_update(const Law& law, const T (&du)[2][2], int terms, const MatrixPlane<T>& old_f, T dt,
                         SymmetricPlane<T>& stress, T* history, MatrixPlane<T>& now_f, T j_old, T& j) {
  constexpr int kSteps = 30, kManySteps = 6;
  constexpr double kMost = 0.5;     // largest |e| of an increment
  constexpr double kGrowth = 10.0;  // largest ratio of a step to the one before
  const SymmetricPlane<T> old_stress = stress;
  T old_history[Law::kHistory + 1];
  for (int h = 0; h < Law::kHistory; ++h) old_history[h] = history[h];

  const T speed = law.wave_speed(old_f, old_stress, j_old), stiffness = speed * speed;
  const T tolerance(kFreeStress<ScalarOf<T>>);
  T e(0.0), low(-kMost), high(kMost);
  auto open = e <= T(0.0);  // lanes that have not found their e; at first all of them
  T slope = stiffness, before(0.0), step(0.0);
  for (int i = 0;; ++i) {
    const MatrixPlane<T> gradient{du[0][0], du[0][1], du[1][0], du[1][1], e};
    const MatrixPlane<T> df = exponential(gradient, terms);
    now_f = product(df, old_f);
    j = determinant(now_f);
    stress = old_stress;
    for (int h = 0; h < Law::kHistory; ++h) history[h] = old_history[h];
    law.update(Increment<T, MatrixPlane<T>>{gradient, df, now_f, j_old, j, dt}, stress, history);
    if (i == kSteps) return;

    const T miss = stress.yy;
    open = open & (abs(miss) > tolerance * stiffness);
    if (!any(open)) return;
    low = select(miss < T(0), e, low);
    high = select(miss > T(0), e, high);
    if (i > 0) {
      const T secant = (miss - before) / step;
      slope = select(secant > T(0), secant, T(0));
    }
    const T reach = T(kGrowth) * max(abs(step), abs(miss) / stiffness);
    const T next = e - min(max(miss / slope, -reach), reach);
    auto inside = (next > low) & (next < high);
    if (i >= kManySteps && i % 2 == 0) inside = inside & ((low <= T(-kMost)) | (high >= T(kMost)));
    const T kept = select(inside, next, T(0.5) * (low + high));
    open = open & (abs(kept - e) > tolerance);
    if (!any(open)) return;
    before = select(open, miss, before);
    step = select(open, kept - e, step);
    e = select(open, kept, e);
  }
}

}  // namespace mpm
