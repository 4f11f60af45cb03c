// Columns of particle fields (particle_field_table.cpp), as topics, bags, CSV files, metrics and global quantities read
// them: in order of id, all or some, on one process or gathered from several.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "mpm/loop/loop.hpp"
#include "particle_field_table.hpp"

namespace mpm {
namespace {

/// A field that is read: one of every run, or numbers that a module brought.
struct Chosen {
  const ParticleField* field = nullptr;
  std::string brought;
};

/// Values of a set, or null.
const double* brought_values(const ParticleSet& set, const std::string& name) {
  for (const NamedScalar& scalar : set.brought) {
    if (scalar.name == name) return scalar.values.data();
  }
  return nullptr;
}

bool chosen(const SetView& view, int p, const ParticleChoice& choice) {
  const ParticleSet& set = view.set;
  if (set.id[p] % static_cast<std::uint32_t>(choice.stride) != 0) return false;
  Vec3 place = choice.region ? choice.region->min : Vec3(Vec3::Zero());  // inside along what the grid has not
  for (int axis = 0; axis < 3; ++axis) {
    if (view.slot[axis] >= 0) place[axis] = set.x[view.slot[axis]][p];
  }
  return !choice.region || choice.region->contains(place);
}

/// Numbers those that are not negative.
void number_rows(std::vector<std::int64_t>& rows) {
  std::int64_t next = 0;
  for (std::int64_t& row : rows) {
    if (row >= 0) row = next++;
  }
}

// Row in which each particle is written: its number among the chosen ones in order of id, by id; -1: not chosen.
std::vector<std::int64_t> rows_of(const std::vector<SetView>& sets, std::size_t particles,
                                  const ParticleChoice& choice) {
  std::vector<std::int64_t> rows(particles, -1);
  for (const SetView& view : sets) {
    for (int p = 0; p < view.set.size(); ++p) {
      if (chosen(view, p, choice)) rows[view.set.id[p]] = 0;
    }
  }
  number_rows(rows);
  return rows;
}

/// `row(view, p)`: where a particle of a set goes in each column, or a negative number.
template <class T, class Row>
void fill(const std::vector<SetView>& sets, const std::vector<Chosen>& fields, int threads, const Row& row,
          std::vector<std::vector<T>>& columns) {
  unsigned needs = kNeedsNothing;
  for (const Chosen& chosen : fields) needs |= chosen.field == nullptr ? kNeedsNothing : chosen.field->needs;
  std::vector<T*> out;
  for (std::vector<T>& column : columns) out.push_back(column.data());
  std::vector<const double*> brought(fields.size());
  for (const SetView& view : sets) {
    for (std::size_t k = 0; k < fields.size(); ++k) brought[k] = brought_values(view.set, fields[k].brought);
    const auto value = [&](std::size_t k, const ParticleView& particle) {
      if (fields[k].field != nullptr) return fields[k].field->value(particle);
      return brought[k] == nullptr ? 0.0 : brought[k][particle.p];
    };
    for_parts("particles: fields for output", threads, view.set.size(), [&](int first, int end, int) {
      ParticleView particle{view};
      for (int p = first; p < end; ++p) {
        const std::int64_t at = row(view, p);
        if (at < 0) continue;
        particle.look(p, needs);
        for (std::size_t k = 0; k < fields.size(); ++k) out[k][at] = static_cast<T>(value(k, particle));
      }
    });
  }
}

}  // namespace

std::vector<SetView> Simulation::State::views() {
  std::vector<SetView> list;
  const QuantityDefinition* heat = definition.transport.find(Transported::temperature);
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const MaterialDefinition& material = find_material(definition, definition.bodies[s]);
    const auto place = static_cast<std::size_t>(&material - definition.materials.data());
    list.emplace_back(sets[s], laws[s], material, static_cast<int>(s), layout(), definition.geometry, heat,
                      heat == nullptr ? nullptr : &heat->materials[place]);
  }
  return list;
}

namespace {

[[noreturn]] void refuse(const std::string& name, const std::vector<SetView>& sets) {
  std::string known;
  const auto add = [&](const std::string& one) { known += known.empty() ? one : ", " + one; };
  for (const auto& [field, unit] : names_of_particle_fields()) add(field);
  for (const SetView& view : sets) {
    for (const NamedScalar& scalar : view.set.brought) add(scalar.name);
  }
  throw DefinitionError(fmt::format("no particle field is called '{}'; there are {}", name, known));
}

std::vector<Chosen> find_fields(const std::vector<std::string>& names, const std::vector<SetView>& sets) {
  std::vector<Chosen> fields;
  for (const std::string& name : names) {
    const auto has = [&](const SetView& view) { return brought_values(view.set, name) != nullptr; };
    const bool brought = std::any_of(sets.begin(), sets.end(), has);
    const ParticleField* field =
        brought ? nullptr : find_particle_field(name);  // field of a law, unless a module brings it
    fields.push_back({field, name});
    if (field == nullptr) {
      if (!brought) refuse(name, sets);
      continue;
    }
    if (!field->of_start) continue;
    for (const SetView& view : sets) {
      if (!view.set.start_x.empty()) continue;
      throw DefinitionError(fmt::format(
          "the particles of '{}' do not remember where they were at the start, which the field '{}' needs; choose it "
          "before the run begins",
          view.set.name, name));
    }
  }
  return fields;
}

/// Numbers of particles that these fields are made of.
Device::Numbers numbers_of(const std::vector<Chosen>& fields) {
  const auto more = [](const Chosen& chosen) {
    return chosen.field == nullptr || chosen.field->needs != kNeedsNothing;
  };
  return std::any_of(fields.begin(), fields.end(), more) ? Device::Numbers::all : Device::Numbers::motion;
}

std::int64_t by_id(const SetView& view, int p) { return view.set.id[p]; }

/// A field of this rank's own particles, one set after another.
template <class T>
void fill_own(const std::vector<SetView>& sets, const std::vector<Chosen>& fields, int threads,
              std::vector<std::vector<T>>& columns) {
  std::vector<std::int64_t> first;  // first row of each set
  std::int64_t size = 0;
  for (const SetView& view : sets) {
    first.push_back(size);
    size += view.set.size();
  }
  columns.resize(fields.size());
  for (std::vector<T>& column : columns) column.resize(static_cast<std::size_t>(size));
  fill(
      sets, fields, threads, [&](const SetView& view, int p) { return first[view.index] + p; }, columns);
}

std::vector<std::uint64_t> own_ids(const std::vector<SetView>& sets) {
  std::vector<std::uint64_t> ids;
  for (const SetView& view : sets) ids.insert(ids.end(), view.set.id.begin(), view.set.id.end());
  return ids;
}

/// A field of all particles by id, on the first rank; empty on the others.
std::vector<double> gather_column(Communicator& ranks, const std::vector<SetView>& sets, const Chosen& field,
                                  int threads, const std::vector<std::uint64_t>& ids, std::size_t particles) {
  std::vector<std::vector<double>> own;
  fill_own(sets, {field}, threads, own);
  std::vector<double> column(ranks.first() ? particles : 0);
  ranks.place(own.front(), ids, column.data(), column.size());
  return column;
}

/// Places in a list of ids in their ascending order.
template <class Ids>
std::vector<std::uint32_t> order_of(const Ids& ids) {
  std::vector<std::uint32_t> order(ids.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return ids[a] < ids[b]; });
  return order;
}

template <class T>
void put_in_order(const std::vector<std::uint32_t>& order, std::vector<T>& values) {
  const std::vector<T> before = values;
  for (std::size_t i = 0; i < order.size(); ++i) values[i] = before[order[i]];
}

/// As rows_of(), on the first rank; none on the others.
std::vector<std::int64_t> gather_rows(Communicator& ranks, const std::vector<SetView>& sets, std::size_t particles,
                                      const ParticleChoice& choice) {
  std::vector<std::uint64_t> ids;
  std::vector<double> own;
  for (const SetView& view : sets) {
    for (int p = 0; p < view.set.size(); ++p) {
      ids.push_back(view.set.id[p]);
      own.push_back(chosen(view, p, choice) ? 0.0 : -1.0);
    }
  }
  std::vector<double> all(ranks.first() ? particles : 0);
  ranks.place(own, ids, all.data(), all.size());
  std::vector<std::int64_t> rows(all.begin(), all.end());
  number_rows(rows);
  return rows;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> Simulation::particle_fields() { return names_of_particle_fields(); }

void Simulation::State::check_field(const std::string& name) { find_fields({name}, views()); }

bool Simulation::needs_start(const std::vector<std::string>& fields) {
  return std::any_of(fields.begin(), fields.end(), [](const std::string& name) {
    const ParticleField* field = find_particle_field(name);
    return field != nullptr && field->of_start;
  });
}

void Simulation::keep_start() {
  for (ParticleSet& set : state_->sets) {
    if (!set.start_x.empty()) continue;
    if (state_->time != 0) throw DefinitionError("where particles were at the start is not known any more");
    set.start_x = set.x;
  }
}

void Simulation::particle_field(const std::string& name, std::vector<float>& values) const {
  ParticleColumns columns;
  columns.values.emplace_back(std::move(values));
  read_particles({name}, {}, columns);
  values = std::move(columns.values.front());
}

void Simulation::particle_field(const std::string& name, std::vector<double>& values) const {
  if (state_->over) {
    const std::vector<SetView> sets = state_->views();
    values = gather_column(*state_->ranks, sets, find_fields({name}, sets).front(), state_->threads, own_ids(sets),
                           particles());
    return;
  }
  std::vector<std::vector<double>> columns;
  columns.emplace_back(std::move(values));
  read_fields({name}, columns);
  values = std::move(columns.front());
}

void Simulation::read_fields(const std::vector<std::string>& names, std::vector<std::vector<double>>& columns) const {
  const std::vector<SetView> sets = state_->views();
  const std::vector<Chosen> fields = find_fields(names, sets);
  state_->fetch(numbers_of(fields));
  if (state_->over) return fill_own(sets, fields, state_->threads, columns);
  if (state_->renews_particles()) {
    fill_own(sets, fields, state_->threads, columns);
    const std::vector<std::uint32_t> order = order_of(sets.front().set.id);
    for (std::vector<double>& column : columns) put_in_order(order, column);
    return;
  }
  columns.resize(fields.size());
  for (std::vector<double>& column : columns) column.resize(particles());
  fill(sets, fields, state_->threads, by_id, columns);
}

void Simulation::read_particles(const std::vector<std::string>& names, const ParticleChoice& choice,
                                ParticleColumns& columns) const {
  if (state_->renews_particles()) {
    read_own_particles(names, choice, columns);
    const std::vector<std::uint32_t> order = order_of(columns.ids);
    put_in_order(order, columns.ids);
    for (std::vector<float>& column : columns.values) put_in_order(order, column);
    return;
  }
  const std::vector<SetView> sets = state_->views();
  const std::vector<Chosen> fields = find_fields(names, sets);
  state_->fetch(numbers_of(fields));
  const bool whole = choice.stride == 1 && !choice.region;
  std::vector<std::int64_t> rows;
  columns.ids.clear();
  if (state_->over) {
    rows = gather_rows(*state_->ranks, sets, particles(), choice);
    for (std::size_t id = 0; id < rows.size(); ++id) {
      if (rows[id] >= 0) columns.ids.push_back(static_cast<std::uint32_t>(id));
    }
    const std::vector<std::uint64_t> ids = own_ids(sets);
    columns.values.assign(fields.size(), {});
    for (std::size_t k = 0; k < fields.size(); ++k) {  // the first rank never has more than one in double
      const std::vector<double> all = gather_column(*state_->ranks, sets, fields[k], state_->threads, ids, particles());
      for (const std::uint32_t id : columns.ids) columns.values[k].push_back(static_cast<float>(all[id]));
    }
    return;
  }
  if (!whole) rows = rows_of(sets, particles(), choice);
  for (std::uint32_t id = 0; id < particles(); ++id) {
    if (whole || rows[id] >= 0) columns.ids.push_back(id);
  }
  columns.values.resize(fields.size());
  for (std::vector<float>& column : columns.values) column.resize(columns.ids.size());
  if (whole) {
    fill(sets, fields, state_->threads, by_id, columns.values);
  } else {
    fill(
        sets, fields, state_->threads, [&rows](const SetView& view, int p) { return rows[view.set.id[p]]; },
        columns.values);
  }
}

void Simulation::read_own_particles(const std::vector<std::string>& names, const ParticleChoice& choice,
                                    ParticleColumns& columns) const {
  const std::vector<SetView> sets = state_->views();
  const std::vector<Chosen> fields = find_fields(names, sets);
  state_->fetch(numbers_of(fields));
  std::vector<std::vector<std::int64_t>> rows(sets.size());
  columns.ids.clear();
  for (const SetView& view : sets) {
    std::vector<std::int64_t>& of_set = rows[view.index];
    of_set.assign(view.set.id.size(), -1);
    for (int p = 0; p < view.set.size(); ++p) {
      if (!chosen(view, p, choice)) continue;
      of_set[p] = static_cast<std::int64_t>(columns.ids.size());
      columns.ids.push_back(view.set.id[p]);
    }
  }
  columns.values.resize(fields.size());
  for (std::vector<float>& column : columns.values) column.resize(columns.ids.size());
  fill(
      sets, fields, state_->threads, [&](const SetView& view, int p) { return rows[view.index][p]; }, columns.values);
}

}  // namespace mpm
