#include "energy_watch.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "state.hpp"

namespace mpm {
namespace {

constexpr double kStillSpeed = 1e-4;  ///< part of the speed of waves: slower particles may move by rounding alone

}  // namespace

EnergyWatch::Made EnergyWatch::look(const EnergyReport& energy, double least, std::uint64_t steps) {
  looked_ = steps;
  const double kinetic = energy.of("kinetic"), potential = energy.of("potential");
  const double work = energy.sum(NamedEnergy::Kind::work);
  if (!begun_) {
    begun_ = true;
    balance_ = energy.balance();
    own_ = kinetic + std::max(0.0, energy.total() - kinetic - potential);
    potential_ = potential;
    work_ = work;
  }
  const double fell = std::max(0.0, potential_ - potential), worked = std::max(0.0, work - work_);
  given_ = std::max(given_, own_ + fell + worked + least);
  Made made{kinetic, given_, energy.balance() - balance_, false};
  for (const NamedEnergy& loss : energy.list()) {  // a loss below zero is no loss, though it closes the balance
    if (loss.kind == NamedEnergy::Kind::dissipated) made.made += std::max(0.0, -loss.value);
  }
  made.too_much = made.kinetic > given_ && made.made > given_;
  return made;
}

void EnergyWatch::serialise(StateArchive& archive) {
  archive.value("begun", begun_);
  archive.value("looked", looked_);
  archive.value("balance", balance_);
  archive.value("own", own_);
  archive.value("potential", potential_);
  archive.value("work", work_);
  archive.value("given", given_);
}

void Simulation::State::watch_energy(double now, const StepLimit& found) {
  const double still = kStillSpeed * found.speed;
  const EnergyWatch::Made made = energy_watch.look(find_totals().energy, 0.5 * total_mass * still * still, steps.steps);
  if (!made.too_much) return;
  const bool implicit = definition.method.update == UpdateScheme::implicit;
  std::string remedy =
      implicit ? "lower time.step, or raise method.sweeps" : "lower time.cfl, or take a finer grid.cell";
  if (definition.method.update != UpdateScheme::usavg) remedy += ", or method.update: usavg";
  if (foreign_modules) remedy += "; or let modules of the program report the work that they do (Module::energies)";
  const std::string reason = fmt::format(
      "the run makes energy: {:.3g} J have no source and {:.3g} J are in motion, while {:.3g} J were there "
      "at the start, fell down or were given by tools and loads; the fastest",
      made.made, made.kinetic, made.given);
  check_together([&] {
    if (sets[found.part].awake() == 0) return;  // another rank has what is fastest
    const FastestParticle own = mechanics->fastest(found.part, layout().smallest_cell());
    if (over && own.rate * layout().smallest_cell() < (1.0 - 1e-9) * found.speed) return;
    fail(reason, {found.part, own.index}, now, remedy);
  });
}

}  // namespace mpm
