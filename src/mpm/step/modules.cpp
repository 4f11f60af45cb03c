#include "mpm/step/modules.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "mpm/loop/profile.hpp"

namespace mpm {
namespace {

template <class Context>
using AtHook = void (StageWith<Context>::*)(Context&);

/// In the order of Hook.
template <class Context>
constexpr std::array<AtHook<Context>, kHooks> kAtHook = {
    &StageWith<Context>::run_begun,      &StageWith<Context>::step_begun,      &StageWith<Context>::momentum_gathered,
    &StageWith<Context>::before_strain,  &StageWith<Context>::forces_gathered, &StageWith<Context>::momentum_updated,
    &StageWith<Context>::velocity_found, &StageWith<Context>::increment_found, &StageWith<Context>::grid_advanced};

/// Name that an archive takes for a group.
std::string group_name(std::string name) {
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

}  // namespace

void Modules::add_entry(Entry entry) {
  list_.push_back(entry.module.get());
  entries_.push_back(std::move(entry));
  put_in_order();
}

void Modules::put_in_order() {
  const auto ranks = [](const Entry& entry, Hook hook) -> std::optional<Ranks> {
    if (entry.across != nullptr) return entry.across->ranks(hook);
    if (entry.in_field != nullptr) return entry.in_field->ranks(hook);
    return std::nullopt;
  };
  for (int h = 0; h < kHooks; ++h) {
    std::vector<Call>& calls = calls_[h];
    calls.clear();
    bool contact = false;
    for (const Entry& entry : entries_) {
      const auto at = ranks(entry, static_cast<Hook>(h));
      if (!at) continue;
      contact = contact || is_contact(at->first);
      calls.push_back({at->first, entry.across, entry.in_field, entry.field});
      if (at->again) calls.push_back({*at->again, entry.across, entry.in_field, entry.field});
    }
    if (!contact) {
      const auto idle = [](const Call& call) { return mends_contact(call.rank); };
      calls.erase(std::remove_if(calls.begin(), calls.end(), idle), calls.end());
    }
    std::stable_sort(calls.begin(), calls.end(), [](const Call& a, const Call& b) { return a.rank < b.rank; });
  }
}

void Modules::carry_out(const Call& call, std::size_t hook, StepContext& context) {
  const TimeProfile::Part part(
      [&] { return "module: " + (call.across != nullptr ? call.across->name() : call.in_field->name()); });
  if (call.across != nullptr) {
    (call.across->*kAtHook<StepContext>[hook])(context);
  } else {
    FieldContext own{*context.fields[call.field], context.dt, context.start, context.strain_at_start,
                     context.works_at_end};
    (call.in_field->*kAtHook<FieldContext>[hook])(own);
  }
}

void Modules::act(Hook hook, StepContext& context) const {
  const auto h = static_cast<std::size_t>(hook);
  for (const Call& call : calls_[h]) carry_out(call, h, context);
}

void Modules::act(Hook hook, Rank rank, StepContext& context) const {
  const auto h = static_cast<std::size_t>(hook);
  for (const Call& call : calls_[h]) {
    if (call.rank == rank) carry_out(call, h, context);
  }
}

void Modules::accounts(std::vector<ImpulseAccount>& list) const {
  std::vector<ImpulseAccount> all;
  for (const Module* module : list_) {
    const std::size_t first = all.size();
    module->accounts(all);
    for (std::size_t i = first; i < all.size() && !counts(*module); ++i) all[i] = {all[i].name};
  }
  for (ImpulseAccount& account : all) {
    const auto same = std::find_if(list.begin(), list.end(), [&](const auto& a) { return a.name == account.name; });
    if (same == list.end()) {
      list.push_back(std::move(account));
    } else {
      same->impulse += account.impulse;
      same->exchanged += account.exchanged;
    }
  }
}

void Modules::energies(EnergyReport& report) const {
  for (const Module* module : list_) {
    report.weigh(counts(*module) ? 1.0 : 0.0);
    module->energies(report);
  }
  report.weigh(1.0);
}

std::vector<NamedNumber> Modules::numbers() const {
  std::vector<NamedNumber> list;
  for (const Module* module : list_) {
    const std::size_t first = list.size();
    module->numbers(list);
    for (std::size_t i = first; i < list.size() && !counts(*module); ++i) list[i].value = 0.0;
  }
  return list;
}

const Module* Modules::find(const std::string& name) const {
  const auto own = [&](const Module* module) { return module->name() == name; };
  const auto found = std::find_if(list_.begin(), list_.end(), own);
  return found == list_.end() ? nullptr : *found;
}

std::string StepLimit::text() const {
  if (by != nullptr) return by->limit_text(*this);
  return std::isfinite(dt) ? "sync period" : "nothing";
}

void Modules::serialise(StateArchive& archive) {
  std::set<std::string> taken;
  for (Module* module : list_) {
    const std::string name = group_name(module->name());
    std::string unique = name;
    for (int copy = 2; !taken.insert(unique).second; ++copy) unique = name + "_" + std::to_string(copy);
    const StateArchive::Group group(archive, unique);
    const StateArchive::Same same(archive, module->same_on_all_ranks());
    module->serialise(archive);
  }
}

}  // namespace mpm
