// All that a run remembers at a sync point, in one place for both directions (math/state_archive.hpp): a run that takes
// it on goes on to the bit like the one that gave it.
//
// Kept: every array of the particles as it lies in memory, the groups they were sorted into and the blocks of every
// field; what bodies, stages and the mechanics keep; the limits that the next period's step comes from; sums for
// reports. Not kept: nodal fields, and what else every step finds anew; `domain` and `next_x` of the particles, which a
// step writes before it reads them.
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
    serialise_scalars(archive, "affine", set.affine);
    std::uint64_t starts = set.start_x.size();  // whoever resumes may ask for other outputs
    archive.value("start_x/rows", starts);
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
  if (archive.reading()) failed = true;  // until all has been read
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
  archive.set_generation(fields.front()->blocks.generation());  // of all: they are rebuilt together
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
  {
    const StateArchive::Group group(archive, "rates");
    const StateArchive::Same same(archive);
    LineFit::serialise(archive, rates);
    for (std::size_t b = 0; b < wrenches.size(); ++b) {
      const StateArchive::Group of_body(archive, "wrench_" + std::to_string(b));
      archive.value("time", wrenches[b].time);
      archive.value("impulse", wrenches[b].impulse);
      archive.value("angular_impulse", wrenches[b].angular_impulse);
      archive.value("force", wrenches[b].mean.force);
      archive.value("torque", wrenches[b].mean.torque);
    }
  }
  if (archive.reading() && over && !archive.merging()) {
    over->meet_as_read(fields);
    if (choice) choice->find_places();
  }
  if (archive.merging()) {
    if (over) over->divide(sets);
    sort(1e-9 * static_cast<double>(time));
  }
  if (archive.reading()) failed = false;
}

void Simulation::serialise(StateArchive& archive) {
  state_->serialise(archive);
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
