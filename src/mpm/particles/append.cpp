#include "mpm/particles/append.hpp"

#include <algorithm>
#include <type_traits>

#include "mpm/particles/permute.hpp"

namespace mpm {
namespace {

/// Calls visit(array) for every array of a set that has a value for each particle.
template <class Visit>
void each_array(ParticleSet& set, Visit&& visit) {
  set.each_scalar(visit);
  visit(set.id);
  if (!set.side.empty()) visit(set.side);
  for (PaddedArray<double>& place : set.next_x) visit(place);
  for (ParticleScalar& scalar : set.domain) scalar.visit(visit);
}

void note_changes(ParticleSet& set, std::size_t first, std::size_t end) {
  if (set.rest_changes.empty()) return;
  constexpr std::size_t kGroup = ParticleSet::kRestGroup;
  set.rest_changes.resize(std::max(set.rest_changes.size(), static_cast<std::size_t>(set.size()) / kGroup + 1));
  for (std::size_t group = first / kGroup; group <= end / kGroup && group < set.rest_changes.size(); ++group)
    ++set.rest_changes[group];
}

void put(ParticleScalar& to, std::size_t at, const ParticleScalar* from, std::size_t count, double otherwise) {
  for (std::size_t p = 0; p < count; ++p) to.set(at + p, from == nullptr ? otherwise : (*from)[p]);
}

void put(std::vector<ParticleScalar>& to, std::size_t at, const std::vector<ParticleScalar>& from, std::size_t count,
         double otherwise) {
  for (std::size_t c = 0; c < to.size(); ++c) put(to[c], at, c < from.size() ? &from[c] : nullptr, count, otherwise);
}

}  // namespace

void append_awake(ParticleSet& set, const ParticleSet& more) {
  const std::size_t awake = set.awake(), before = set.id.size(), count = more.id.size(), size = before + count;
  const std::size_t moved = std::min(count, static_cast<std::size_t>(set.asleep));
  const std::size_t room = room_for_particles(size);
  each_array(set, [&](auto& values) {
    values.extend(size, room);
    std::copy_n(values.data() + awake, moved, values.data() + size - moved);
  });
  for (std::size_t k = 0; k < set.x.size(); ++k) {
    std::copy_n(more.x[k].data(), count, set.x[k].data() + awake);
    if (!set.start_x.empty()) std::copy_n(more.x[k].data(), count, set.start_x[k].data() + awake);
    if (!set.next_x.empty()) std::copy_n(more.x[k].data(), count, set.next_x[k].data() + awake);
  }
  put(set.v, awake, more.v, count, 0.0);
  put(set.f, awake, more.f, count, 0.0);
  put(set.tau, awake, more.tau, count, 0.0);
  put(set.history, awake, more.history, count, 0.0);
  put(set.masses, awake, more.masses, count, more.mass);
  put(set.surface, awake, more.surface, count, 1.0);
  put(set.affine, awake, {}, count, 0.0);
  for (NamedScalar& scalar : set.brought) std::fill_n(scalar.values.data() + awake, count, 0.0);
  std::copy_n(more.id.data(), count, set.id.data() + awake);
  if (!set.side.empty()) std::fill_n(set.side.data() + awake, count, std::uint8_t{0});
  note_changes(set, awake, size);
}

void remove_awake(ParticleSet& set, const std::vector<std::uint32_t>& places) {
  if (places.empty()) return;
  const std::size_t awake = set.awake(), before = set.id.size(), left = awake - places.size();
  const std::size_t moved = std::min(places.size(), static_cast<std::size_t>(set.asleep));
  auto gone = std::lower_bound(places.begin(), places.end(), left);
  std::size_t from = left;  // the next one beyond that stays
  for (const std::uint32_t place : places) {
    if (place >= left) break;
    for (; gone != places.end() && *gone == from; ++gone) ++from;
    copy_particle(set, from++, place);
  }
  each_array(set, [&](auto& values) { std::copy_n(values.data() + before - moved, moved, values.data() + left); });
  cut_off(set, before - places.size());
  note_changes(set, left, before);
}

void copy_particle(ParticleSet& set, std::size_t from, std::size_t to) {
  each_array(set, [&](auto& values) { values[to] = values[from]; });
}

void cut_off(ParticleSet& set, std::size_t size) {
  each_array(set, [&](auto& values) { values.resize(size); });
}

}  // namespace mpm
