#include "mpm_gpu/exchange.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "mpm/kernel/kernels.hpp"
#include "mpm/mechanics/stress_average.hpp"
#include "mpm/rules/feature_rules.hpp"
#include "mpm_gpu/soil_passes.hpp"
#include "mpm_gpu/stages.hpp"

namespace mpm_gpu {
namespace {

using mpm::ParticleSet;
using mpm::SimulationDefinition;

Face face_of(mpm::WallKind kind) {
  switch (kind) {
    case mpm::WallKind::none:
    case mpm::WallKind::periodic:
      return Face::open;
    case mpm::WallKind::fixed:
      return Face::fixed;
    case mpm::WallKind::frictional:
      return Face::frictional;
    default:
      return Face::slip;
  }
}

GridView view_of(const SimulationDefinition& d) {
  const mpm::GridLayout layout(dimensions(d.geometry), d.grid.cell, d.grid.min, d.grid.max);
  GridView view{};
  for (int k = 0; k < layout.dim(); ++k) {
    view.origin[k] = layout.origin(k);
    view.inverse_cell[k] = layout.inverse_cell(k);
    view.last_node[k] = layout.last_node(k);
    view.period[k] = d.walls[2 * layout.axis(k)].kind == mpm::WallKind::periodic ? layout.last_node(k) : 0;
    view.gravity[k] = d.gravity[layout.axis(k)];
    // A block more to each side than the particles', who reach a node beyond the domain.
    view.blocks_along[k] = (layout.last_node(k) + 1 + kBeside) / kEdge + 2;
    for (int side = 0; side < 2; ++side) {
      const mpm::WallDefinition& wall = d.walls[2 * layout.axis(k) + side];
      // The solve of an implicit step has rows of contact for walls, or holds their nodes itself.
      view.faces[2 * k + side] = d.method.update == mpm::UpdateScheme::implicit ? Face::open : face_of(wall.kind);
      view.friction[2 * k + side] =
          wall.friction.stick ? std::numeric_limits<double>::infinity() : wall.friction.coefficient;
    }
    view.low_wall[k] = view.faces[2 * k] != Face::open ? 0.0 : -mpm_kernel::kNoWall;
    view.high_wall[k] = view.faces[2 * k + 1] != Face::open ? layout.last_node(k) : mpm_kernel::kNoWall;
  }
  view.wall_layers = mpm::traits_of(d.method.shape).wall_layers();
  return view;
}

std::optional<Shape> shape_of(mpm::ShapeKind kind) {
  switch (kind) {
    case mpm::ShapeKind::ugimp:
      return Shape::ugimp;
    case mpm::ShapeKind::ugimp_stretch:
      return Shape::ugimp_stretch;
    case mpm::ShapeKind::bspline2:
      return Shape::bspline2;
    case mpm::ShapeKind::bspline3:
      return Shape::bspline3;
    default:
      return std::nullopt;
  }
}

Method method_of(const SimulationDefinition& d) {
  Method method;
  method.shape = shape_of(d.method.shape).value();
  static_assert(static_cast<int>(Update::usavg) == static_cast<int>(mpm::UpdateScheme::usavg));
  static_assert(static_cast<int>(Update::implicit) == static_cast<int>(mpm::UpdateScheme::implicit));
  method.update = static_cast<Update>(d.method.update);
  const mpm::Transfer& transfer = d.method.transfer;
  method.flip = transfer.flip;
  if (transfer.kind == mpm::TransferKind::apic) {
    method.motion = mpm_kernel::kAffine;
  } else if (transfer.kind != mpm::TransferKind::flip) {
    method.motion = mpm_kernel::kAdopt;
    method.order = transfer.order;
    method.from_start = transfer.kind == mpm::TransferKind::xpic;
  }
  method.mixes = transfer.mixes();
  method.from_start = method.from_start || method.mixes;
  method.counting = counting_of(d.method);
  method.terms = d.method.gradient_terms;
  return method;
}

const mpm::DeformableBody& body_of(const SimulationDefinition& d, const std::string& name) {
  const auto found = std::find_if(d.bodies.begin(), d.bodies.end(), [&](const auto& b) { return b.name == name; });
  if (found == d.bodies.end()) throw GpuError("gpu: no body of the scene is called '" + name + "'");
  return *found;
}

std::vector<mpm::Law> laws_of(const SimulationDefinition& d, const std::vector<ParticleSet>& sets) {
  const std::string reason = refused(d);
  if (!reason.empty()) throw GpuError("gpu: " + reason);
  std::vector<mpm::Law> laws;
  for (const ParticleSet& set : sets) laws.push_back(make_law(find_material(d, body_of(d, set.name))));
  return laws;
}

template <class T>
std::vector<typename Solver<T>::LawOfSet> pointers_to(const std::vector<mpm::Law>& laws) {
  std::vector<typename Solver<T>::LawOfSet> result;
  for (const mpm::Law& law : laws) {
    std::visit([&](const auto& one) { result.push_back({law.index(), &one, sizeof(one)}); }, law);
  }
  return result;
}

/// Plastic strains at the start of the step before, by place, of a set whose stress is averaged; else null.
template <class Set>
auto* strain_before(Set& set) {
  const auto is_it = [](const auto& scalar) { return scalar.name == mpm::StressAverage::kStrainBefore; };
  const auto found = std::find_if(set.brought.begin(), set.brought.end(), is_it);
  return found == set.brought.end() ? nullptr : &found->values;
}

std::vector<SetView> views_of(const std::vector<ParticleSet>& sets) {
  std::vector<SetView> views;
  std::uint32_t first = 0;
  for (const ParticleSet& set : sets) {
    SetView view{};
    view.first = first;
    view.count = static_cast<std::uint32_t>(set.awake());
    view.mass = set.mass;
    view.averages = strain_before(set) != nullptr;
    view.first_id = set.first_id;
    for (int k = 0; k < 3; ++k) {
      view.half[k] = set.half[k];
      view.lowest[k] = set.lowest[k];
      view.highest[k] = set.highest[k];
    }
    first += view.count;
    views.push_back(view);
  }
  return views;
}

double least_mass(const std::vector<ParticleSet>& sets) {
  double least = sets.front().least_mass();
  for (const ParticleSet& set : sets) least = std::min(least, set.least_mass());
  return 1e-30 * least;  // as the solver has it
}

/// About what a particle takes [bytes]: its numbers, those of Solver beside them, and 210 for keys, the table and nodes
/// of a compact body in three dimensions, of which twice what is in use is reserved.
template <class T>
std::size_t bytes_of_particle(const ParticleSet& set) {
  const std::size_t axes = set.x.size(), of_solver = axes * axes + 1;
  return (axes + 1) * sizeof(double) + 3 * sizeof(std::uint32_t) + 1 + 210 +
         (set.v.size() + set.f.size() + set.tau.size() + set.history.size() + set.affine.size() + set.masses.size() +
          set.surface.size() + of_solver) *
             sizeof(T);
}

/// About what the soil of an implicit step takes beside it [bytes], with a node of the table for each particle, as many
/// as are reserved for a compact body.
template <class T>
std::size_t bytes_of_soil(const SimulationDefinition& d) {
  if (d.method.update != mpm::UpdateScheme::implicit) return 0;
  std::set<std::string> soils;
  for (const mpm::DeformableBody& body : d.bodies) soils.insert(body.material);
  const std::size_t of_cell =
      sizeof(mpm_kernel::SoilGroup<T, 1>) + sizeof(mpm_kernel::SoilMask<T, 1>) + sizeof(mpm_kernel::SoilMotion<T>);
  return soils.size() * of_cell + 3 * sizeof(mpm_kernel::SoilNode<T>) + kSoilNumbers * sizeof(T);
}

/// Number of each id among those that are awake, in the order of ids.
std::vector<std::uint32_t> numbers_of_awake(const std::vector<ParticleSet>& sets) {
  std::vector<std::uint32_t> numbers;
  for (const ParticleSet& set : sets) {
    numbers.resize(std::max<std::size_t>(numbers.size(), set.first_id + static_cast<std::size_t>(set.size())));
    for (int p = 0; p < set.awake(); ++p) numbers[set.id[p]] = 1;
  }
  std::uint32_t count = 0;
  for (std::uint32_t& number : numbers) count += std::exchange(number, count);
  return numbers;
}

template <class T>
ParticleStore<T> store_of(const SimulationDefinition& d, const std::vector<ParticleSet>& sets) {
  ParticleStore<T> store;
  long count = 0, first = 0;
  std::size_t bytes = 0;
  for (const ParticleSet& set : sets) {
    count += set.awake();
    bytes = std::max(bytes, bytes_of_particle<T>(set));
  }
  const auto has = [&](std::vector<mpm::ParticleScalar> ParticleSet::*scalar) {
    return std::any_of(sets.begin(), sets.end(), [&](const ParticleSet& set) { return !(set.*scalar).empty(); });
  };
  const bool any_mass = has(&ParticleSet::masses), any_surface = has(&ParticleSet::surface);
  Executor::require(count, bytes + bytes_of_soil<T>(d));
  store.id.fit(count);
  const bool any_asleep = std::any_of(sets.begin(), sets.end(), [](const ParticleSet& set) { return set.asleep > 0; });
  if (any_asleep) {
    const std::vector<std::uint32_t> numbers = numbers_of_awake(sets);
    store.number.fit(static_cast<long>(numbers.size()));
    store.number.upload(numbers);
  }
  for (const ParticleSet& set : sets) {
    const int awake = set.awake();
    const auto copy = [&](const auto& from, auto& to) {
      for (std::size_t c = 0; c < from.size(); ++c) {
        using Number = std::decay_t<decltype(to[c].get(0))>;
        std::vector<Number> numbers(awake);
        for (int p = 0; p < awake; ++p) numbers[p] = static_cast<Number>(from[c][p]);
        to[c].fit(count);
        to[c].upload(numbers, first);
      }
    };
    copy(set.x, store.x);
    copy(set.v, store.v);
    copy(set.f, store.f);
    copy(set.tau, store.tau);
    copy(set.history, store.history);
    if (const auto* before = strain_before(set)) {
      store.strain_before.fit(count);
      store.strain_before.upload(before->data(), awake, first);
    }
    copy(set.affine, store.affine);
    // A number of each particle of all sets, where one has them.
    const auto complete = [&](const auto& from, bool any, double same, Buffer<T>& to) {
      std::vector<T> numbers(awake, static_cast<T>(same));
      for (int p = 0; p < awake && !from.empty(); ++p) numbers[p] = static_cast<T>(from[0][p]);
      if (!any) return;
      to.fit(count);
      to.upload(numbers, first);
    };
    complete(set.masses, any_mass, set.mass, store.mass);
    complete(set.surface, any_surface, 1.0, store.surface);
    store.id.upload(set.id.data(), awake, first);
    first += awake;
  }
  return store;
}

}  // namespace

std::string refused(const SimulationDefinition& d) {
  const mpm::RunKind kind{1, true};
  for (const mpm::FeatureRule& rule : mpm::feature_rules()) {
    if (rule.feature != mpm::Feature::device) continue;
    if (const auto who = find_feature(rule.beside, d, kind)) {
      return mpm::BrokenRule{&rule, "", *who}.why() + "; " + rule.remedy;
    }
  }
  return {};
}

template <class T>
DeviceRun<T>::DeviceRun(const SimulationDefinition& definition, const std::vector<ParticleSet>& sets, Executor executor,
                        const mpm::RunModules* modules)
    : layout_(dimensions(definition.geometry), definition.grid.cell, definition.grid.min, definition.grid.max),
      laws_(laws_of(definition, sets)),
      solver_(
          [&] {
            GridView view = view_of(definition);
            view.least_mass = least_mass(sets);
            return view;
          }(),
          dimensions(definition.geometry), method_of(definition), views_of(sets), pointers_to<T>(laws_),
          store_of<T>(definition, sets), executor) {
  add_stages(solver_, definition, sets, laws_, modules);
}

template <class T>
void DeviceRun<T>::write_to(std::vector<ParticleSet>& sets, mpm::Device::Numbers which) {
  solver_.look();
  const ParticleStore<T>& store = solver_.particles();
  const std::vector<std::uint32_t> id = store.id.download();
  for (std::size_t s = 0; s < sets.size(); ++s) {
    ParticleSet& set = sets[s];
    const long first = solver_.sets()[s].first;
    const auto count = static_cast<std::size_t>(set.awake());
    std::vector<long> there(static_cast<std::size_t>(set.size()));  // places in the store, by id from the first
    for (long i = first; i < first + set.awake(); ++i) there[id[i] - set.first_id] = i;
    std::vector<long> from_where(count);
    for (std::size_t p = 0; p < count; ++p) from_where[p] = there[set.id[p] - set.first_id];
    const auto copy = [&](const auto& from, auto& to) {
      for (std::size_t c = 0; c < to.size(); ++c) {
        const auto numbers = from[c].download();
        for (std::size_t p = 0; p < count; ++p) to[c].set(p, numbers[from_where[p]]);
      }
    };
    copy(store.v, set.v);
    if (which == mpm::Device::Numbers::velocity) continue;
    for (std::size_t k = 0; k < set.x.size(); ++k) {
      const std::vector<double> places = store.x[k].download();
      for (std::size_t p = 0; p < count; ++p) set.x[k][p] = places[from_where[p]];
    }
    for (std::size_t k = 0; k < set.start_x.size(); ++k) {
      const std::vector<std::int16_t> turns = solver_.put_around().turns(static_cast<int>(k)).download();
      const double length = layout_.last_node(static_cast<int>(k)) * layout_.cell(static_cast<int>(k));
      for (std::size_t p = 0; p < count && !turns.empty(); ++p) set.start_x[k][p] += turns[from_where[p]] * length;
    }
    if (which == mpm::Device::Numbers::motion) continue;
    copy(store.f, set.f);
    copy(store.tau, set.tau);
    copy(store.history, set.history);
    if (auto* before = strain_before(set)) {
      const std::vector<double> strains = store.strain_before.download();
      for (std::size_t p = 0; p < count; ++p) (*before)[p] = strains[from_where[p]];
    }
    copy(store.affine, set.affine);
  }
  if (which != mpm::Device::Numbers::velocity) solver_.clear_turns();
}

template class DeviceRun<double>;
template class DeviceRun<float>;

}  // namespace mpm_gpu
