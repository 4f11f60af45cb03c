// All that a run remembers at a sync point, in one place for both directions (math/state_archive.hpp): a run that takes
// it on goes on to the bit like the one that gave it.
//
// Kept: every array of the particles as it lies in memory, the groups they were sorted into and the blocks of every
// field; what bodies, stages and the mechanics keep; the limits that the next period's step comes from; sums for
// reports. Not kept: nodal fields, and what else every step finds anew; `domain` and `next_x` of the particles, which a
// step writes before it reads them.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "mpm/particles/permute.hpp"
#include "mpm/simulation/simulation.hpp"
#include "state.hpp"
#include "state_hash.hpp"

namespace mpm {
namespace {

void serialise_scalars(StateArchive& archive, const char* name, std::vector<ParticleScalar>& scalars) {
  for (std::size_t c = 0; c < scalars.size(); ++c) {
    scalars[c].visit([&](auto& values) { archive.list(name + std::to_string(c), values); });
  }
}

void serialise_arrays(StateArchive& archive, const char* name, std::vector<PaddedArray<double>>& arrays) {
  for (std::size_t c = 0; c < arrays.size(); ++c) archive.list(name + std::to_string(c), arrays[c]);
}

/// All that says what it measures, and its name: a metric of a resumed run goes on where it is the same.
std::string identity_of(const MetricDefinition& metric) {
  std::string text = fmt::format("{}|{}|{}|{}|{}", metric.name, metric.number, static_cast<int>(metric.statistic),
                                 metric.field, metric.body);
  if (!metric.formula.empty()) text += "|= " + metric.formula;
  for (const auto& [constant, value] : metric.constants) text += fmt::format("|{}={}", constant, value);
  if (metric.rate) text += fmt::format("|rate {} {}", metric.rate->from, metric.rate->to);
  if (metric.over) text += fmt::format("|over {} {}", metric.over->from, metric.over->to);
  if (metric.at) text += fmt::format("|at {}", *metric.at);
  for (int axis = 0; metric.region && axis < 3; ++axis)
    text += fmt::format("|{} {}", metric.region->min[axis], metric.region->max[axis]);
  return text + "\n";
}

/// `now`: of the state that is read [s]. @throws DefinitionError for a metric that looks at an earlier time
void serialise_metrics(StateArchive& archive, const std::vector<MetricDefinition>& metrics, double now,
                       std::vector<LineFit>& fits) {
  const StateArchive::Group group(archive, "rates");
  const StateArchive::Same same(archive);
  std::string recorded;
  for (const MetricDefinition& metric : metrics) recorded += identity_of(metric);
  archive.value("metrics", recorded);
  if (!archive.reading()) return LineFit::serialise(archive, fits);
  std::vector<std::string> there;
  for (std::size_t begin = 0, end = 0; (end = recorded.find('\n', begin)) != std::string::npos; begin = end + 1)
    there.push_back(recorded.substr(begin, end + 1 - begin));
  std::vector<LineFit> read(there.size());
  LineFit::serialise(archive, read);
  for (std::size_t m = 0; m < metrics.size(); ++m) {
    const auto found = std::find(there.begin(), there.end(), identity_of(metrics[m]));
    fits[m] = found == there.end() ? LineFit() : read[static_cast<std::size_t>(found - there.begin())];
    if (found != there.end()) continue;
    const double from = metrics[m].rate   ? metrics[m].rate->from
                        : metrics[m].over ? metrics[m].over->from
                                          : metrics[m].at.value_or(now);
    if (from >= now - 1e-12) continue;
    throw DefinitionError(fmt::format(
        "metrics.{}: it looks at t = {:g} s, and the run goes on from {:g} s without it; write a later time, "
        "or leave it out",
        metrics[m].name, from, now));
  }
}

/// Keeps what metrics of force and torque remember. False where what is read was written without such metrics.
/// `rigid_bodies`: of the run. @throws DefinitionError for what is of another number of them
bool serialise_wrenches(StateArchive& archive, std::size_t rigid_bodies, std::vector<PeriodWrench>& wrenches) {
  const StateArchive::Group group(archive, "wrenches");
  const StateArchive::Same same(archive);
  std::vector<PeriodWrench> kept = wrenches;
  std::uint64_t bodies = kept.size();
  archive.value("bodies", bodies);
  if (bodies != 0 && bodies != rigid_bodies) {
    throw DefinitionError(fmt::format(
        "it holds the forces on {} rigid bodies, and the run has {}: the file is damaged; take an earlier one", bodies,
        rigid_bodies));
  }
  kept.resize(bodies);
  for (std::size_t b = 0; b < kept.size(); ++b) {
    const StateArchive::Group of_body(archive, std::to_string(b));
    archive.value("time", kept[b].time);
    archive.value("impulse", kept[b].impulse);
    archive.value("angular_impulse", kept[b].angular_impulse);
    archive.value("force", kept[b].mean.force);
    archive.value("torque", kept[b].mean.torque);
  }
  if (kept.size() != wrenches.size()) return wrenches.empty();
  wrenches = std::move(kept);
  return true;
}

/// Puts particles, all of them awake and here, in the order of their ids.
void put_in_order_of_ids(ParticleSet& set, int threads) {
  const std::vector<int> by_id = places_by_id(set, true);
  const std::vector<std::uint32_t> places(by_id.begin(), by_id.end());
  ParticleOrder order;
  order.be_as_in_memory(set);
  PermuteScratch scratch;
  permute(set, places.data(), order, places.size(), scratch, threads);
}

}  // namespace

void LineFit::serialise(StateArchive& archive, std::vector<LineFit>& fits) {
  archive.column("count", fits, &LineFit::count_);
  archive.column("mean_t", fits, &LineFit::mean_t_);
  archive.column("mean_y", fits, &LineFit::mean_y_);
  archive.column("tt", fits, &LineFit::tt_);
  archive.column("ty", fits, &LineFit::ty_);
}

void Simulation::State::serialise_particles(StateArchive& archive) {
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const StateArchive::Group group(archive, "particles_" + std::to_string(s));
    const StateArchive::Share share(archive);
    ParticleSet& set = sets[s];
    archive.list("id", set.id);
    serialise_arrays(archive, "x", set.x);
    serialise_scalars(archive, "v", set.v);
    serialise_scalars(archive, "f", set.f);
    serialise_scalars(archive, "tau", set.tau);
    serialise_scalars(archive, "history", set.history);
    serialise_scalars(archive, "mass", set.masses);
    serialise_scalars(archive, "surface", set.surface);
    serialise_scalars(archive, "affine", set.affine);
    std::uint64_t starts = set.start_x.size();  // whoever resumes may ask for other outputs
    archive.value("start_x/rows", starts);
    if (starts != 0 && starts != set.x.size()) {
      throw DefinitionError(
          fmt::format("it holds {} coordinates of the start of '{}', not {}: the file is damaged; take an earlier one",
                      starts, set.name, set.x.size()));
    }
    set.start_x.resize(starts);
    serialise_arrays(archive, "start_x", set.start_x);
    for (NamedScalar& scalar : set.brought) archive.list("brought/" + scalar.name, scalar.values);
    archive.list("side", set.side);
    if (archive.reading()) set.fit_scratch();
    if (archive.merging()) continue;  // sorted anew
    archive.list("begin", set.begin);
    archive.list("group", set.group);
    archive.list("group_begin", set.group_begin);
  }
}

void Simulation::State::serialise_grid(StateArchive& archive) {
  int first_owner = 0;
  for (std::size_t f = 0; f < fields.size() && !archive.merging(); ++f) {
    const StateArchive::Group group(archive, "field_" + std::to_string(f));
    Grid& grid = *fields[f];
    std::vector<std::uint64_t> owners;
    for (int owner = 0; owner < grid.blocks.owners(); ++owner) {
      owners.push_back(grid.blocks.key(grid.blocks.owner_block(owner)));
    }
    archive.list("owners", owners);
    archive.value("first_owner", grid.first_owner);
    if (archive.reading()) {
      grid.first_owner = first_owner;  // each rank has its own
      grid.rebuild(owners, threads);
    }
    first_owner += grid.blocks.owners();
    archive.list("loose", grid.loose);
  }
}

void Simulation::State::serialise_limit(StateArchive& archive, const char* name, StepLimit& kept) {
  const StateArchive::Group group(archive, name);
  std::string by = kept.by == nullptr ? "" : kept.by->name();
  archive.value("dt", kept.dt);
  archive.value("by", by);
  archive.value("part", kept.part);
  archive.value("speed", kept.speed);
  archive.value("place", kept.place);
  archive.value("foreseen", kept.foreseen);
  if (archive.reading()) kept.by = by == mechanics->name() ? mechanics.get() : modules.find(by);
}

void Simulation::State::serialise(StateArchive& archive) {
  if (device && !archive.reading()) {
    fetch();
    ask_device([&] {
      for (Module* module : modules.list()) module->learn(*device);
    });
    if (rest_on_host && !failed) {
      rest_on_host->find_loose();  // the order is that of the last sort, as on the processor
    } else if (moved_by_device && !failed) {
      // Sorted as a run on the processor has them, from an order that does not depend on when they were read before.
      for (ParticleSet& set : sets) put_in_order_of_ids(set, threads);
      sort(seconds_of(time));
    }
    moved_by_device = false;
  }
  if (archive.reading()) {
    failed = true;  // until all has been read
    fetched = Device::Numbers::all;
    moved_by_device = false;
  }
  archive.value("time", time);
  archive.value("steps", steps.steps);
  archive.value("dt_min", steps.dt_min);
  archive.value("dt_max", steps.dt_max);
  archive.value("dt_last", steps.dt_last);
  archive.value("courant", steps.courant);
  archive.value("divided", steps.divided);
  archive.value("initial_momentum", initial_momentum);
  archive.value("total_mass", total_mass);
  serialise_particles(archive);
  serialise_grid(archive);
  if (over && !archive.merging()) over->serialise(archive);
  archive.set_generation(fields.front()->blocks.generation());  // generation of all: they are rebuilt together
  {
    const StateArchive::Group group(archive, "mechanics");
    mechanics->serialise(archive);
  }
  {
    const StateArchive::Group group(archive, "modules");
    modules.serialise(archive);
  }
  {
    const StateArchive::Group group(archive, "gravity");
    const StateArchive::Same same(archive);
    gravity.serialise(archive);
  }
  serialise_limit(archive, "material_limit", material_limit);
  serialise_limit(archive, "previous_limit", previous_limit);
  serialise_limit(archive, "limit", limit);
  {
    const StateArchive::Group group(archive, "energy_watch");
    energy_watch.serialise(archive);
  }
  if (archive.reading() && renews_particles()) sizes.front() = sets.front().id.size();
  if (archive.reading() && over && !archive.merging()) {
    over->meet_as_read(fields);
    if (choice) choice->find_places();
  }
  if (archive.merging()) {
    if (over) over->divide(sets);
    sort_here(seconds_of(time));
  }
  if (archive.reading() && device) {
    begin_modules();
    device->take(sets);
    for (const Module* module : modules.list()) module->teach(*device);
  }
  if (archive.reading()) failed = false;
}

void Simulation::serialise(StateArchive& archive) {
  state_->serialise(archive);
  serialise_metrics(archive, state_->definition.metrics, seconds_of(state_->time), state_->rates);
  for (const MetricDefinition& metric : state_->definition.metrics) {
    if (!archive.reading() || find_body(metric.body) >= 0 || !metric.number.empty() || !metric.formula.empty())
      continue;
    try {
      state_->check_field(metric.field);  // the start's places are there only if the saved run had them
    } catch (const DefinitionError& error) {
      throw DefinitionError(fmt::format("metrics.{}: {}", metric.name, error.what()));
    }
  }
  if (!serialise_wrenches(archive, state_->bodies.size(), state_->wrenches)) {
    state_->find_wrenches();  // from here on
    for (PeriodWrench& wrench : state_->wrenches) wrench.mean = {};
  }
  double seconds = state_->wall.count();
  archive.value("wall", seconds);
  state_->wall = std::chrono::duration<double>(seconds);
}

std::uint64_t Simulation::memory_hash() {
  StateHash hash;
  state_->serialise(hash);
  return state_->over ? state_->over->hash_of_all(hash.value()) : hash.value();
}

}  // namespace mpm
