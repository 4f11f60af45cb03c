#include "mpm_gpu/stages.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "mpm/kernel/kernels.hpp"
#include "mpm/modules/shipped_modules.hpp"
#include "mpm_gpu/damping.hpp"
#include "mpm_gpu/error.hpp"
#include "mpm_gpu/implicit_soil.hpp"
#include "mpm_gpu/leaving.hpp"
#include "mpm_gpu/liquid_volume.hpp"
#include "mpm_gpu/loads.hpp"
#include "mpm_gpu/mixture.hpp"
#include "mpm_gpu/near_bodies.hpp"
#include "mpm_gpu/near_rest.hpp"
#include "mpm_gpu/prescribed.hpp"

namespace mpm_gpu {
namespace {

/// True if the transfer is a mixture, in the words of mixture.hpp.
bool is_mixture(const mpm::MethodDefinition& method) {
  const bool flip = method.transfer.kind == mpm::TransferKind::flip;
  return flip && (method.transfer.flip != 1.0 || !method.damping.pic.is_zero());
}

/// Farthest that a particle may be beyond the nodes of its block, so that a tile holds its nodes [cells].
double reach_of(mpm::ShapeKind shape) { return (shape == mpm::ShapeKind::bspline3 ? 1.0 : 1.5) - mpm_kernel::kSlack; }

}  // namespace

Counting counting_of(const mpm::MethodDefinition& method) {
  if (method.damping.in_update() || method.damping.feedback) return Counting::damping;
  return is_mixture(method) ? Counting::slip : Counting::nothing;
}

template <class T>
void add_stages(Solver<T>& solver, const mpm::SimulationDefinition& d, const std::vector<mpm::ParticleSet>& sets,
                const std::vector<mpm::Law>& laws, const mpm::RunModules* modules) {
  const mpm::GridLayout layout(dimensions(d.geometry), d.grid.cell, d.grid.min, d.grid.max);
  mpm::Mechanics* mechanics = modules == nullptr ? nullptr : &modules->mechanics;
  const mpm::MethodDefinition& method = d.method;
  const auto is_liquid = [](const mpm::Law& law) { return traits_of(law).matter == mpm::Matter::liquid; };
  if (std::any_of(laws.begin(), laws.end(), is_liquid)) {  // first, as it changes the stress that others see
    auto* correction = modules == nullptr ? nullptr : modules->modules.template first<mpm::VolumeCorrection>();
    double cell = 1.0;
    for (int k = 0; k < layout.dim(); ++k) cell *= layout.cell(k);
    long awake = 0;
    for (const mpm::ParticleSet& set : sets) awake += set.awake();
    solver.add(
        std::make_unique<LiquidVolume<T>>(correction, laws, layout.dim(), d.across() * cell, awake, solver.passes()));
  }
  std::unique_ptr<NearRest<T>> rest;
  if (modules != nullptr && modules->rest != nullptr) {
    rest = std::make_unique<NearRest<T>>(*modules->rest, solver.grid(), reach_of(method.shape));
    solver.add(std::make_unique<UnrestAtBorder<T>>(*rest));
  }
  if (method.update == mpm::UpdateScheme::implicit) {
    auto* solve = modules == nullptr ? nullptr : modules->modules.template first<mpm::ImplicitSolve<T>>();
    if (solve == nullptr) throw GpuError("gpu: implicit steps are those of a simulation's modules");
    solver.add(std::make_unique<ImplicitSoil<T>>(*solve, sets, modules->rest, solver));
  } else if (modules != nullptr && modules->contact != nullptr) {
    solver.let_walls_act_again();
    solver.add(std::make_unique<NearBodies<T>>(*modules->contact, solver.grid()));
  }
  if (is_mixture(method)) solver.add(std::make_unique<Mixture<T>>(method.transfer, mechanics));
  if (method.damping.any()) {  // after the mixture, whose fraction its own replaces
    auto* control = modules == nullptr ? nullptr : modules->modules.template first<mpm::DampingControl>();
    if (control != nullptr) {
      solver.add(std::make_unique<Damping<T>>(*control, mechanics, layout));
    } else {
      solver.add(std::make_unique<Damping<T>>(method.damping, method.transfer.flip, sets, layout));
    }
  }
  if (!d.conditions.empty()) {
    auto* conditions = modules == nullptr ? nullptr : modules->modules.template first<mpm::VelocityConditions>();
    solver.add(std::make_unique<Prescribed<T>>(conditions, d.conditions, layout, solver.passes()));
  }
  if (d.grid.leave_limit > 0) {
    auto* leaving = modules == nullptr ? nullptr : modules->modules.template first<mpm::Leaving>();
    long particles = 0;
    for (const mpm::ParticleSet& set : sets) particles += set.size();
    solver.add(std::make_unique<PutsBack<T>>(leaving, d.grid.leave_limit, particles, layout, solver.passes()));
  }
  if (rest) solver.add(std::move(rest));
  std::optional<Tractions<T>> tractions;
  if (!d.tractions.empty()) {
    auto* stage = modules == nullptr ? nullptr : modules->modules.template first<mpm::FaceTractions>();
    if (stage == nullptr) throw GpuError("gpu: tractions are those of a simulation's modules");
    tractions.emplace(*stage, sets, layout, d.across(), solver.passes());
  }
  // Loads come last, since their work is of the velocities that all others leave.
  if (!d.body_forces.empty() || !d.particle_forces.empty() || tractions) {
    auto* book = modules == nullptr ? nullptr : modules->modules.template first<mpm::ParticleLoadStage>();
    solver.add(std::make_unique<Loads<T>>(particle_load_terms(d, sets), sets, layout, solver.passes(), book,
                                          std::move(tractions)));
  }
}

template void add_stages(Solver<double>&, const mpm::SimulationDefinition&, const std::vector<mpm::ParticleSet>&,
                         const std::vector<mpm::Law>&, const mpm::RunModules*);
template void add_stages(Solver<float>&, const mpm::SimulationDefinition&, const std::vector<mpm::ParticleSet>&,
                         const std::vector<mpm::Law>&, const mpm::RunModules*);

}  // namespace mpm_gpu
