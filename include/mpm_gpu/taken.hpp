// Sums of what particles lose in their update, to PIC and to damping, as the solver's own advance of them counts it
// (mpm_kernel::Moved). Numbers of each particle are kept where somebody asks for the sums alone.
#pragma once

namespace mpm_gpu {

/// Numbers that are kept: none, the energy of PIC alone, or that and what damping takes.
enum class Counting : int { nothing, slip, damping };

/// Sums over particles.
struct Taken {
  double slip = 0.0;              ///< kinetic energy that PIC took [J]
  double drag_energy = 0.0;       ///< the same of damping [J]
  double grid_kinetic = 0.0;      ///< sum of m |v0|^2 / 2, v0 the grid's velocity that is damped [J]
  double particle_kinetic = 0.0;  ///< the same of the particles' own [J]
  double drag[3] = {};            ///< momentum that damping took [N s]

  constexpr Taken& operator+=(const Taken& other) {
    slip += other.slip;
    drag_energy += other.drag_energy;
    grid_kinetic += other.grid_kinetic;
    particle_kinetic += other.particle_kinetic;
    for (int k = 0; k < 3; ++k) drag[k] += other.drag[k];
    return *this;
  }
};

constexpr int taken_numbers(Counting counting, int dim) {
  return counting == Counting::nothing ? 0 : counting == Counting::slip ? 1 : 4 + dim;
}
/// Returns what particle i of `count` lost.
constexpr Taken taken_by(const double* taken, Counting counting, int dim, long count, long i) {
  Taken one;
  if (counting == Counting::nothing) return one;
  one.slip = taken[i];
  if (counting == Counting::slip) return one;
  one.drag_energy = taken[count + i];
  one.grid_kinetic = taken[2 * count + i];
  one.particle_kinetic = taken[3 * count + i];
  for (int k = 0; k < dim; ++k) one.drag[k] = taken[(4 + k) * count + i];
  return one;
}

}  // namespace mpm_gpu
