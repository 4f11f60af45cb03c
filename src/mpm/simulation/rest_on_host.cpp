#include "rest_on_host.hpp"

#include "mpm/kernel/kernels.hpp"
#include "state.hpp"

namespace mpm {

void RestOnHost::begin_step(StepContext& context) {
  context_ = &context;
  all_ = left_ = false;
}

void RestOnHost::act(Hook hook) {
  if (hook == Hook::momentum_gathered && sleep_.looks_next()) device_->fetch(sets_, Device::Numbers::velocity);
  if (hook == Hook::forces_gathered && sleep_.needs_forces()) {
    device_->fetch(sets_, Device::Numbers::motion);
    sleep_.find_forces(*context_);
  }
  modules_.act(hook, hook == Hook::momentum_updated ? Rank::at_rest : Rank::asleep, *context_);
  if (hook == Hook::momentum_gathered) all_ = sleep_.needs_all_nodes() || sleep_.needs_forces();
}

void RestOnHost::find_loose() {
  constexpr double kBeside = 0.5 - mpm_kernel::kSlack;
  for (auto& grid : fields_) {
    const GridLayout& layout = grid->layout;
    grid->loose.assign(grid->blocks.owners(), 0);
    for (int owner = 0; owner < grid->blocks.owners(); ++owner) {
      const std::array<int, 3>& block = grid->blocks.block(grid->blocks.owner_block(owner));
      const int at = grid->first_owner + owner;
      const auto is_beside = [&](const ParticleSet& set, std::uint32_t p) {
        for (int k = 0; k < layout.dim(); ++k) {
          const double cells = layout.in_cells(k, set.x[k][p]) - kBlockEdge * block[k];
          if (!(cells >= -kBeside && cells <= kBlockEdge - 1 + kBeside)) return true;
        }
        return false;
      };
      for (const ParticleSet& set : sets_) {
        for (std::uint32_t p = set.begin[at]; p < set.begin[at + 1] && grid->loose[owner] == 0; ++p)
          grid->loose[owner] = is_beside(set, p) ? 1 : 0;
      }
    }
  }
}

// Begins anew on the device where some have fallen asleep or woken, with those that are awake then.
void Simulation::State::sort_beside_device(double now) {
  const bool changes = rest_on_host->has_work_for_sort();
  fetch(changes ? Device::Numbers::all : Device::Numbers::motion);
  rest_on_host->find_loose();
  if (changes) {
    ask_device([&] {
      for (Module* module : modules.list()) module->learn(*device);
    });
  }
  sort_here(now);
  if (!sets.front().sorts_by_id) return;  // nobody has fallen asleep or woken
  ask_device([&] { device->take(sets); });
  for (const Module* module : modules.list()) module->teach(*device);
}

}  // namespace mpm
