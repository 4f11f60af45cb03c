// The mechanics of the deformable bodies on the grid: runs the kernels over the blocks, colour by colour, and the
// passes over nodes between them. What a kernel does, and the story of a step, are in kernel/kernels.hpp.
#pragma once

#include <memory>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/grid/node_choice.hpp"
#include "mpm/kernel/kernels.hpp"
#include "mpm/material/law.hpp"
#include "mpm/mechanics/damping.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/ranks/halo.hpp"
#include "mpm/shape/axis_rules.hpp"
#include "mpm/shape/kind.hpp"
#include "mpm/step/mechanics.hpp"
#include "mpm/step/transfer.hpp"

namespace mpm {

/// Settings of the kernels that hold for the whole run.
struct ContinuumSettings {
  Transfer transfer;
  bool average_dilatation = false;            ///< volume changes and pressures averaged over the grid (kernel/mean.hpp)
  AxisMotion axis_motion = AxisMotion::mean;  ///< motion of rings
  int gradient_terms = 2;                     ///< number of terms of exp(grad v dt)
  Vec3 gravity = Vec3::Zero();                ///< [m/s^2]
  int threads = 1;
  DampingControl* damping = nullptr;  ///< damping of a scene that has any; outlives the mechanics
  NodeChoice* choice = nullptr;  ///< choice of a field at every node by particles; may be null; outlives the mechanics
  Halo* halo = nullptr;  ///< exchange with ranks that give to the same nodes; may be null; outlives the mechanics
};

/// `kernels`: of the sets' precision, T double or float. `laws`: of each set; `fields`, sets and laws outlive the
/// result. Sets have what the kernels keep on particles (prepare()).
template <class T>
std::unique_ptr<Mechanics> make_mechanics(const mpm_kernel::KernelTable<T>& kernels, Fields& fields,
                                          std::vector<ParticleSet>& sets, const std::vector<Law>& laws,
                                          const ContinuumSettings& settings);

/// Makes room on the particles for what kernels and transfer keep there: domains, affine matrices.
void prepare(ParticleSet& set, ShapeKind shape, const Transfer& transfer);

/// Grouping of particles for these kernels (step/sorter.hpp).
template <class T>
Grouping kernel_grouping(const mpm_kernel::KernelTable<T>& kernels);

}  // namespace mpm
