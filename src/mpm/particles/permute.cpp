#include "mpm/particles/permute.hpp"

#include <algorithm>

#include "mpm/loop/loop.hpp"

namespace mpm {
namespace {

/// Particles asleep that change places because `now` are awake and not those before them any more.
struct Moved {
  std::size_t from, to, count;

  Moved(const ParticleOrder& order, std::size_t now) {
    const std::size_t before = order.asleep_from(), asleep = order.asleep();
    count = std::min(asleep, now > before ? now - before : before - now);
    from = now > before ? before : before + asleep - count;
    to = now > before ? now + asleep - count : now;
  }
};

}  // namespace

std::size_t room_for_particles(std::size_t particles) {
  std::size_t step = 1024;
  while (16 * step < particles) step *= 2;
  return (particles / step + 2) * step;
}

void permute(ParticleSet& set, const std::uint32_t* places, const ParticleOrder& order, std::size_t room,
             PermuteScratch& scratch, int threads) {
  const std::size_t n = order.count(), size = n + order.asleep();
  const bool all = order.asleep() == 0;  // then arrays change places; else what is asleep stays where it is
  const Moved moved(order, n);
  const auto reorder = [&](auto& values) {
    auto& other = scratch.of(values);
    other.resize(n, room);
    const auto* from = values.data();
    auto* to = other.data();
    for_all("particles: into their order", threads, n, [from, to, places](std::size_t i) { to[i] = from[places[i]]; });
    if (all) {
      values.swap(other);
      return;
    }
    values.extend(std::max(size, values.size()), room + order.asleep());
    auto* own = values.data();
    std::copy_n(own + moved.from, moved.count, own + moved.to);
    for_all("particles: into their order", threads, n, [own, to](std::size_t i) { own[i] = to[i]; });
    values.resize(size);
  };
  set.each_scalar(reorder);
  reorder(set.id);
  if (!set.side.empty()) reorder(set.side);
  const auto fit = [&](auto& values) { values.resize(size, room + order.asleep()); };
  for (std::size_t k = 0; k < set.next_x.size(); ++k) {
    PaddedArray<double>& next = set.next_x[k];
    if (!all) next.extend(size, room + order.asleep());  // it has what is asleep, too
    fit(next);
    std::copy_n(set.x[k].data() + moved.to, moved.count, next.data() + moved.to);
  }
  for (ParticleScalar& scalar : set.domain) scalar.visit(fit);
  if (moved.count == 0 || set.rest_changes.empty()) return;
  set.rest_changes.resize(std::max(set.rest_changes.size(), size / ParticleSet::kRestGroup + 1));
  for (std::size_t p = moved.to; p < moved.to + moved.count; ++p) ++set.rest_changes[p / ParticleSet::kRestGroup];
}

}  // namespace mpm
