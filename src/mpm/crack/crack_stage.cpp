#include "mpm/crack/crack_stage.hpp"

#include <cmath>

#include "mpm/crack/periodic_reach.hpp"

namespace mpm {
namespace {

constexpr const char* kEnds[] = {"start", "end"};

std::string tip_number(int crack, int end, const TipNumber& number) {
  return "crack " + std::to_string(crack) + " " + kEnds[end] + " " + number.name;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> crack_numbers(int number) {
  std::vector<std::pair<std::string, std::string>> list{{"crack length " + std::to_string(number), "m"},
                                                        {"debonded crack length " + std::to_string(number), "m"}};
  for (int end = 0; end < 2; ++end) {
    for (const TipNumber& of : kTipNumbers) {
      if (of.name != nullptr) list.emplace_back(tip_number(number, end, of), of.unit);
    }
  }
  return list;
}

void CrackStage::run_begun(StepContext&) {
  parts_->chosen->choose();
  parts_->tips->find_materials();
  if (!parts_->tractions->any()) return;
  parts_->tips->find_growing(parts_->faces);
  parts_->tractions->begin(*parts_->masses, *parts_->sets, parts_->faces);
}

// Energies of particles and of what acts on them belong together between two steps only.
void CrackStage::step_begun(StepContext& context) {
  parts_->tips->find_energies(context.start + context.dt);
  parts_->chosen->choose();
}

void CrackStage::forces_gathered(StepContext& context) {
  parts_->tips->heat(context.dt);
  if (!parts_->tractions->any()) return;
  parts_->tips->find_growing(parts_->faces);
  parts_->tractions->add_forces(parts_->faces);
}

void CrackStage::before_strain(StepContext& context) {
  const double start = context.strain_at_start, part = start > 0.0 && start < 1.0 ? start : 1.0;
  parts_->tips->find_growing(parts_->growing);
  parts_->jumps->move(parts_->growing, parts_->chosen->nodes(), part * context.dt);
}

void CrackStage::grid_advanced(StepContext& context) {
  const double end = context.start + context.dt;
  const double periods = std::round(end / parts_->sync);
  const bool at_sync = std::abs(end - periods * parts_->sync) < 0.5 * context.dt;
  const bool grows = parts_->tips->growth_due(end);
  try {
    if (at_sync || grows) parts_->tips->find(end);
    parts_->motion->move(*parts_->tractions, context.dt);
    parts_->jumps->forget_growth();
    if (grows) parts_->tips->grow(end, context.dt);
    if (parts_->tractions->any()) parts_->tractions->find(end);
  } catch (const FractureError& error) {
    throw ModuleError(error.what());
  } catch (const CrackError& error) {
    throw ModuleError(error.what());
  }
  const std::string fault = periodic_fault(parts_->cracks, context.layout(), parts_->contour);
  if (!fault.empty()) throw ModuleError(fault);
}

void CrackStage::limit_step(const PeriodAhead& period, StepLimit& limit) const {
  const double shortest = parts_->tractions->shortest_time();
  if (!(shortest > 0.0)) return;
  StepLimit own;
  own.dt = 2.0 * period.cfl * shortest;
  own.by = this;
  limit.tighten(own);
}

void CrackStage::numbers(std::vector<NamedNumber>& list) const {
  const auto once = [this](double value) { return parts_->counts ? value : 0.0; };
  for (std::size_t c = 0; c < parts_->cracks.size(); ++c) {
    const Chain& chain = parts_->cracks[c].chain;
    const int crack = static_cast<int>(c), number = crack + 1;
    list.push_back({"crack length " + std::to_string(number), "m", once(chain.length())});
    list.push_back({"debonded crack length " + std::to_string(number), "m",
                    once(chain.open_length([&](int point) { return parts_->tractions->law_at(crack, point) < 0; }))});
  }
  list.push_back({"crack misfits", "1", static_cast<double>(parts_->chosen->misfits())});
  list.push_back({"crack moves stopped", "1", once(static_cast<double>(parts_->motion->stopped()))});
  for (const CrackTip& tip : tips()) {
    for (const TipNumber& of : kTipNumbers) {
      if (of.name != nullptr) list.push_back({tip_number(tip.crack + 1, tip.end, of), of.unit, once(of.of(tip))});
    }
  }
}

void CrackStage::serialise(StateArchive& archive) {
  for (std::size_t c = 0; c < parts_->cracks.size(); ++c) {
    const StateArchive::Same same(archive);
    const StateArchive::Group group(archive, "crack_" + std::to_string(c));
    parts_->cracks[c].chain.serialise(archive);
  }
  parts_->chosen->serialise(archive);
  const StateArchive::Same same(archive);
  parts_->jumps->serialise(archive);
  parts_->motion->serialise(archive);
  parts_->tractions->serialise(archive);
  parts_->tips->serialise(archive);
}

void CrackStage::hashed(std::vector<double>& numbers) const {
  for (const Crack& crack : parts_->cracks) crack.chain.hashed(numbers);
  parts_->tractions->hashed(numbers);
}

}  // namespace mpm
