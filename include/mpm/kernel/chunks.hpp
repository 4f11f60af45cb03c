// The particles of one body in one block, a chunk of whole groups at a time.
#pragma once

#include <cstring>

#include "mpm/kernel/interleave.hpp"
#include "mpm/kernel/kernels.hpp"

namespace mpm {

/// True of a set whose particles have masses of their own: rings about an axis, and others whose body's surface cuts
/// cells.
template <bool Rings, class T>
bool weighs_each(const mpm_kernel::SetView<T>& set) {
  return Rings || set.weighed;
}

/// Masses of particles [p, p + lanes): one for all of a body, or each its own.
template <bool Rings, class T>
Wide<T> mass_of(const mpm_kernel::SetView<T>& set, int p, int lanes) {
  return weighs_each<Rings>(set) ? Wide<T>::load_first(set.masses + p, lanes) : Wide<T>(set.mass);
}

template <class T>
bool absent(const mpm_kernel::SetView<T>& set, const mpm_kernel::BlockView& block) {
  return set.group_begin[block.owner] == set.group_begin[block.owner + 1];
}

/// Particles of a set that are worked on together: some groups of one block, or (of points of domains, which groups
/// mean nothing to) some particles.
struct ParticleChunk {
  int first, count;
  int group, group_end;
  int groups() const { return group_end - group; }
};

/// visit(chunk) for the set's particles of one block, whole groups and at most kChunk particles at a time.
template <class T, class Visit>
void each_chunk_of_groups(const mpm_kernel::SetView<T>& set, int owner, Visit&& visit) {
  const int end = static_cast<int>(set.group_begin[owner + 1]);
  for (int g = static_cast<int>(set.group_begin[owner]); g < end;) {
    const int first = static_cast<int>(set.group[g]);
    int g_end = g + 1;
    while (g_end < end && static_cast<int>(set.group[g_end + 1]) - first <= mpm_kernel::kChunk) ++g_end;
    visit(ParticleChunk{first, static_cast<int>(set.group[g_end]) - first, g, g_end});
    g = g_end;
  }
}

/// visit(place in the chunk, lanes) for each of its groups.
template <class T, class Visit>
void each_group(const mpm_kernel::SetView<T>& set, const ParticleChunk& chunk, Visit&& visit) {
  for (int g = chunk.group; g < chunk.group_end; ++g) {
    const int p = static_cast<int>(set.group[g]);
    visit(p - chunk.first, static_cast<int>(set.group[g + 1]) - p);
  }
}

/// Four numbers of every particle of a chunk, those of a particle together: what is scattered by the values of the
/// shape function.
template <class T>
struct ChunkValues {
  alignas(64) T v[4 * mpm_kernel::kBuffer];
  void set(int q, Wide<T> v0, Wide<T> v1, Wide<T> v2, Wide<T> v3) { interleave(v + 4 * q, v0, v1, v2, v3); }
};

/// Copies one component of the deformation of a block's particles to where the step's domains are kept: strain goes on
/// within the step, and what was scattered with one domain has to be gathered with the same.
template <class T>
void note_domain(const mpm_kernel::SetView<T>& set, int owner, const T* f, T* domain) {
  const std::uint32_t first = set.group[set.group_begin[owner]], end = set.group[set.group_begin[owner + 1]];
  std::memcpy(domain + first, f + first, (end - first) * sizeof(T));
}

}  // namespace mpm
