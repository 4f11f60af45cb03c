#include "mpm/simulation/global_quantity.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <ctime>
#include <iterator>
#include <tuple>

#include "mpm/math/nearest.hpp"
#include "mpm/modules/shipped_modules.hpp"
#include "mpm/shape/ring.hpp"
#include "state.hpp"

namespace mpm {
namespace {

enum class Source { mean, sum, contact, number, steps, wall, cpu };

struct Quantity {
  std::string name;
  std::string unit;
  Source source;
  std::vector<std::string> fields = {};    ///< fields of particles
  int axis = 0;                            ///< axis of a contact force; -1: outwards, of a radian
  std::vector<std::string> energies = {};  ///< energies of the run that are added to a sum (EnergyReport)
  std::vector<std::string> less = {};      ///< that are taken from it
};

// Work that loads, velocity conditions, absorbing faces and rigid bodies did since the start.
const std::vector<std::string> kExternalWork = {"load_work", "contact_work"};

// Energies in imperfect interfaces, of bodies in contact and of the faces of cracks.
const std::vector<std::string> kInterfaces = {"interface", "crack_interface"};

const std::vector<Quantity>& table() {
  static const std::vector<Quantity> kTable = [] {
    std::vector<Quantity> list;
    // Tensors: components, and their names about an axis, where r is x, the hoop is y and z is z.
    struct Tensor {
      const char *letter, *end, *unit;
    };
    for (const Tensor& tensor :
         {Tensor{"s", "", "Pa"}, Tensor{"e", "", "1"}, Tensor{"e", "e", "1"}, Tensor{"e", "p", "1"}}) {
      const auto add = [&](const std::string& name, const std::string& field) {
        list.push_back(
            {tensor.letter + name + tensor.end, tensor.unit, Source::mean, {tensor.letter + field + tensor.end}});
      };
      for (const char* component : {"xx", "yy", "zz", "xy", "xz", "yz"}) add(component, component);
      add("rr", "xx");
      add("tt", "yy");
      add("rz", "xz");
    }
    const Quantity others[] = {
        {"velx", "m/s", Source::mean, {"vx"}},
        {"vely", "m/s", Source::mean, {"vy"}},
        {"velz", "m/s", Source::mean, {"vz"}},
        {"velr", "m/s", Source::mean, {"vx"}},
        {"dispx", "m", Source::mean, {"ux"}},
        {"dispy", "m", Source::mean, {"uy"}},
        {"dispz", "m", Source::mean, {"uz"}},
        {"dispr", "m", Source::mean, {"ux"}},
        {"contactx", "N", Source::contact, {}, 0},
        {"contacty", "N", Source::contact, {}, 1},
        {"contactz", "N", Source::contact, {}, 2},
        {"contactr", "N/rad", Source::contact, {}, -1},
        {"temp", "K", Source::mean, {"temperature"}},
        {"concentration", "1", Source::mean, {"concentration"}},
        {"pore pressure", "Pa", Source::mean, {"pore_pressure"}},
        {"kinetic energy", "J", Source::sum, {"kinetic_energy"}},
        {"strain energy", "J", Source::sum, {"strain_energy"}},
        {"plastic energy", "J", Source::sum, {"plastic_energy"}},
        {"heat energy", "J", Source::sum, {"heat_energy"}},
        {"thermal energy", "J", Source::sum, {"thermal_energy"}},
        {"energy", "J", Source::sum, {"kinetic_energy", "strain_energy"}},
        {"interface energy", "J", Source::sum, {}, 0, kInterfaces},
        {"external work", "J", Source::sum, {}, 0, kExternalWork},
        {"potential energy", "J", Source::sum, {"kinetic_energy", "strain_energy"}, 0, kInterfaces, kExternalWork},
        {"step number", "1", Source::steps},
        {"elapsed time", "s", Source::wall},
        {"cpu time", "s", Source::cpu},
    };
    list.insert(list.end(), std::begin(others), std::end(others));
    for (const ShippedModules& shipped : shipped_modules()) {
      for (const auto& [name, unit] : shipped.numbers) list.push_back({name, unit, Source::number});
    }
    return list;
  }();
  return kTable;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// Its place in the table, or -1.
int find(const std::string& name) {
  const std::string wanted = lower(name);
  const auto& all = table();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Quantity& q) { return wanted == q.name; });
  return found == all.end() ? -1 : static_cast<int>(found - all.begin());
}

/// True if there is one of each body.
bool of_bodies(const Quantity& quantity) {
  return quantity.source == Source::contact || (!quantity.fields.empty() && quantity.energies.empty());
}

bool has_temperature(const Law& law) {
  return std::visit([](const auto& l) { return l.kTemperature >= 0; }, law);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> global_quantity_names() {
  std::vector<std::pair<std::string, std::string>> names;
  for (const Quantity& quantity : table()) names.emplace_back(quantity.name, quantity.unit);
  return names;
}

std::vector<std::string> reported_number_names() {
  std::vector<std::string> names;
  for (const Quantity& quantity : table()) {
    if (quantity.source == Source::number) names.push_back(quantity.name);
  }
  return names;
}

std::string problem_of(const GlobalQuantity& quantity) {
  const int known = find(quantity.name);
  if (known >= 0) {
    if (quantity.body.empty() || of_bodies(table()[known])) return {};
    return fmt::format("'{}' is of the whole run, not of a body; leave 'body' out", quantity.name);
  }
  std::vector<std::string> names;
  for (const Quantity& one : table()) names.emplace_back(one.name);
  return fmt::format("no global quantity '{}'; {}", quantity.name, suggest(lower(quantity.name), names));
}

bool of_rigid_body(const GlobalQuantity& quantity) {
  const int known = find(quantity.name);
  return known >= 0 && table()[known].source == Source::contact;
}

namespace {

/// Unit of a number that some module of the run brings; empty if none does.
std::string unit_of_number(const std::vector<NamedNumber>& numbers, const std::string& name) {
  const auto own = [&](const NamedNumber& number) { return number.name == name; };
  const auto found = std::find_if(numbers.begin(), numbers.end(), own);
  return found == numbers.end() ? "" : found->unit;
}

}  // namespace

GlobalQuantities::GlobalQuantities(Simulation& simulation, const std::vector<GlobalQuantity>& chosen)
    : simulation_(simulation) {
  for (const GlobalQuantity& wanted : chosen) {
    Term term{find(wanted.name), {}, 0, static_cast<std::size_t>(simulation.particles()), {}, 0.0};
    const std::string unit = wanted.body.empty() ? unit_of_number(simulation.numbers(), wanted.name) : "";
    if (term.quantity < 0 && !unit.empty()) {  // true for a number of a module that is not shipped
      names_.push_back(wanted.name);
      units_.push_back(unit);
      terms_.push_back(std::move(term));
      continue;
    }
    if (const std::string problem = problem_of(wanted); !problem.empty()) throw DefinitionError(problem);
    const Quantity& quantity = table()[term.quantity];
    if (quantity.source == Source::contact) {
      for (int body = 0; body < static_cast<int>(simulation.state_->bodies.size()); ++body) {
        if (wanted.body.empty() || body == simulation.find_body(wanted.body)) term.contacts.push_back(body);
      }
      if (!wanted.body.empty() && term.contacts.empty()) {
        throw DefinitionError(fmt::format("{}: no rigid body is called '{}'", wanted.name, wanted.body));
      }
    } else if (!wanted.body.empty()) {
      std::tie(term.first, term.last) = simulation.body_ids(wanted.body);
    }
    for (const std::string& field : quantity.fields) {
      const auto known = std::find(fields_.begin(), fields_.end(), field);
      term.fields.push_back(static_cast<int>(known - fields_.begin()));
      if (known == fields_.end()) fields_.push_back(field);
    }
    names_.push_back(wanted.body.empty() ? wanted.name : wanted.name + " of " + wanted.body);
    units_.emplace_back(quantity.unit);
    terms_.push_back(std::move(term));
  }
  if (Simulation::needs_start(fields_)) simulation.keep_start();
  values_.resize(terms_.size());
}

double GlobalQuantities::sum(const Term& term) const {
  double total = 0.0;
  const auto [begin, end] = simulation_.state_->rows_of(term.first, term.last);
  for (const int field : term.fields) {
    const std::vector<double>& column = columns_[field];
    for (std::size_t row = begin; row < end; ++row) total += column[row];
  }
  if (simulation_.state_->over) total = simulation_.state_->ranks->sum(total);
  const Quantity& quantity = table()[term.quantity];
  if (quantity.energies.empty()) return total;
  EnergyReport energy;
  simulation_.state_->modules.energies(energy);
  if (simulation_.state_->over) simulation_.state_->over->add_up(energy);
  double less = 0.0;
  for (const std::string& name : quantity.energies) total += energy.of(name);
  for (const std::string& name : quantity.less) less += energy.of(name);
  return total - less;
}

double GlobalQuantities::number(const std::string& name) const {
  double sum = 0.0;
  for (const NamedNumber& number : simulation_.numbers()) sum += number.name == name ? number.value : 0.0;
  return sum;
}

double GlobalQuantities::mean(const Term& term) const {
  if (fields_[term.fields.front()] != "temperature") {
    const bool renews = simulation_.state_->renews_particles();
    return sum(term) / static_cast<double>(renews ? simulation_.particles() : term.last - term.first);
  }
  // Only bodies that have a temperature count: all if it is transported, else those whose law has one.
  double total = 0.0, count = 0.0;
  const Simulation::State& state = *simulation_.state_;
  const bool all = state.definition.transport.find(Transported::temperature) != nullptr;
  for (std::size_t s = 0; s < state.sets.size(); ++s) {
    const ParticleSet& set = state.sets[s];
    if (!(all || has_temperature(state.laws[s])) || set.first_id < term.first || set.first_id >= term.last) continue;
    count += static_cast<double>(state.sizes[s]);
    const std::vector<double>& column = columns_[term.fields.front()];
    const auto [begin, end] = state.rows_of(set.first_id, set.first_id + state.sizes[s]);
    for (std::size_t row = begin; row < end; ++row) total += column[row];
  }
  if (state.over) total = state.ranks->sum(total);
  return count > 0.0 ? total / count : 0.0;  // as of a particle
}

double GlobalQuantities::contact_impulse(const Term& term, int axis) const {
  double total = 0.0;
  for (const int body : term.contacts) {
    total -= simulation_.state_->impulse("contact/" + simulation_.state_->bodies[body].name())[axis];
  }
  return total;
}

double GlobalQuantities::value_of(Term& term, const std::string& name, double interval) const {
  if (term.quantity < 0) return number(name);
  const Quantity& quantity = table()[term.quantity];
  const Simulation::State& state = *simulation_.state_;
  switch (quantity.source) {
    case Source::mean:
      return mean(term);
    case Source::sum:
      return sum(term);
    case Source::contact: {
      const bool about_axis = axisymmetric(state.definition.geometry);
      const double before = term.impulse;
      term.impulse = contact_impulse(term, std::max(quantity.axis, 0));
      if (!(interval > 0.0)) return 0.0;
      // Around an axis what points outwards cancels in the whole body.
      if (about_axis && quantity.axis == 0) return 0.0;
      const double force = (term.impulse - before) / interval;
      return quantity.axis < 0 ? force / kTurn : force;
    }
    case Source::number:
      return number(quantity.name);
    case Source::steps:
      return static_cast<double>(state.steps.steps);
    case Source::wall:
      return state.wall.count();
    case Source::cpu:
      return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  }
  return 0.0;
}

const std::vector<double>& GlobalQuantities::read() {
  if (!fields_.empty()) simulation_.read_fields(fields_, columns_);
  const double now = seconds_of(simulation_.time());
  const double interval = last_ < 0.0 ? 0.0 : now - last_;
  const Simulation::State& state = *simulation_.state_;
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    values_[k] = state.from_first(value_of(terms_[k], names_[k], interval));
  }
  last_ = now;
  return values_;
}

void GlobalQuantities::serialise(StateArchive& archive) {
  std::uint64_t count = terms_.size();
  archive.value("terms", count);
  if (count != terms_.size()) return;
  archive.column("impulse", terms_, &Term::impulse);
  archive.value("last", last_);
}

}  // namespace mpm
