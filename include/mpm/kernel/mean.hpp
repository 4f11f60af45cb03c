// Volume changes and pressures averaged over the grid, against locking: material that hardly changes its volume cannot
// follow the many particles of a cell, each of which asks for its own, so it becomes too stiff and its pressures
// alternate. With A = S M^-1 S^T m, to the nodes and back, the velocity gradient's trace becomes A tr(grad v) and the
// mean stress that makes forces A p. A is self-adjoint in the particles' masses, so forces and strains stay conjugate:
// the work of the one is the energy of the other.
//
// Traces and means are over the grid's axes, so that plane strain stays plane; of rings, over the hoop direction too.
// Weak: two more passes for each strain and each force; pressures are less sharp.
// Source: nodal averaging of volume changes, Bonet & Burton (1998); the adjoint for the force is ours.
#pragma once

#include "mpm/kernel/kernels.hpp"
#include "mpm/kernel/wide.hpp"

namespace mpm {

template <class T, int Dim, bool Rings = false>
struct Mean {
  using W = Wide<T>;
  static constexpr double kPart = 1.0 / (Dim + (Rings ? 1 : 0));

  /// tr(grad v), of a register of particles at place q of a chunk.
  static W dilatation(const mpm_kernel::ChunkGradients<T>& gradients, int q) {
    W trace(0.0);
    for (int k = 0; k < Dim; ++k) trace += W::load(gradients.l[k * (Dim + 1)] + q);
    if constexpr (Rings) trace += W::load(gradients.l[mpm_kernel::kHoopGradient] + q);
    return trace;
  }
  static void set_dilatation(mpm_kernel::ChunkGradients<T>& gradients, int q, W wanted) {
    const W change = (wanted - dilatation(gradients, q)) * W(kPart);
    const auto add = [&](T* to) { (W::load(to) + change).store(to); };
    for (int k = 0; k < Dim; ++k) add(gradients.l[k * (Dim + 1)] + q);
    if constexpr (Rings) add(gradients.l[mpm_kernel::kHoopGradient] + q);
  }
  /// -m times the mean stress, of one particle.
  static T mean(const mpm_kernel::ChunkStresses<T>& stresses, int q) {
    T sum = 0;
    for (int k = 0; k < Dim; ++k) sum += stresses.column[k][4 * q + k];
    if constexpr (Rings) sum += stresses.column[mpm_kernel::kHoopColumn][4 * q];
    return sum * static_cast<T>(kPart);
  }
  static void set_mean(mpm_kernel::ChunkStresses<T>& stresses, int q, T wanted) {
    const T change = wanted - mean(stresses, q);
    for (int k = 0; k < Dim; ++k) stresses.column[k][4 * q + k] += change;
    if constexpr (Rings) stresses.column[mpm_kernel::kHoopColumn][4 * q] += change;
  }
};

}  // namespace mpm
