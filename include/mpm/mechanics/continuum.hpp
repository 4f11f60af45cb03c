// The mechanics of the deformable bodies on the grid: runs the kernels over the blocks, colour by colour, and the
// passes over nodes between them. What a kernel does, and the story of a step, are in kernel/kernels.hpp.
#pragma once

#include <memory>
#include <vector>

#include "mpm/kernel/isa.hpp"
#include "mpm/kernel/kernels.hpp"
#include "mpm/material/law.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/step/mechanics.hpp"

namespace mpm {

/// What the kernels are told once.
struct ContinuumSettings {
  double flip = 1.0;            ///< FLIP fraction
  int gradient_terms = 2;       ///< of exp(grad v dt)
  Vec3 gravity = Vec3::Zero();  ///< [m/s^2]
  int threads = 1;
  Isa isa = Isa::plain;  ///< must be available
};

/// Kernels of a planar (`dim` 2, plane strain) or solid (`dim` 3) scene with uGIMP, in the sets' precision, which is
/// the same for all. `laws`: of each set; both outlive the result.
std::unique_ptr<Mechanics> make_mechanics(int dim, std::vector<ParticleSet>& sets, const std::vector<Law>& laws,
                                          const ContinuumSettings& settings);

/// How its particles have to be grouped (step/sorter.hpp).
Grouping kernel_grouping(int dim, Precision precision, Isa isa);

/// The same with kernels of any shape function, which outlive the result. T: double or float, the sets' precision.
template <class T>
std::unique_ptr<Mechanics> make_mechanics(const mpm_kernel::KernelTable<T>& kernels, std::vector<ParticleSet>& sets,
                                          const std::vector<Law>& laws, const ContinuumSettings& settings);
template <class T>
Grouping kernel_grouping(const mpm_kernel::KernelTable<T>& kernels);

}  // namespace mpm
