// The particles of one body in one block, a chunk of whole groups at a time.
#pragma once

#include <cstring>

#include "mpm/kernel/kernels.hpp"
#include "mpm/kernel/wide.hpp"

namespace mpm {

/// Masses of particles [p, p + lanes): one for all of a body, or, of rings about an axis, each its own.
template <bool Rings, class T>
Wide<T> mass_of(const mpm_kernel::SetView<T>& set, int p, int lanes) {
  if constexpr (Rings) {
    return Wide<T>::load_first(set.masses + p, lanes);
  } else {
    return Wide<T>(set.mass);
  }
}

template <class T>
bool absent(const mpm_kernel::SetView<T>& set, const mpm_kernel::BlockView& block) {
  return set.group_begin[block.owner] == set.group_begin[block.owner + 1];
}

/// visit(first particle, first group, end of groups) for the set's particles of one block, at most `most` at a time.
template <int Most = mpm_kernel::kChunk, class T, class Visit>
void each_chunk(const mpm_kernel::SetView<T>& set, int owner, Visit&& visit) {
  const int end = static_cast<int>(set.group_begin[owner + 1]);
  for (int g = static_cast<int>(set.group_begin[owner]); g < end;) {
    const int first = static_cast<int>(set.group[g]);
    int g_end = g + 1;
    while (g_end < end && static_cast<int>(set.group[g_end + 1]) - first <= Most) ++g_end;
    visit(first, g, g_end);
    g = g_end;
  }
}

/// visit(place in the chunk, lanes) for each of its groups.
template <class T, class Visit>
void each_group(const mpm_kernel::SetView<T>& set, int first, int g, int g_end, Visit&& visit) {
  for (; g < g_end; ++g) {
    const int p = static_cast<int>(set.group[g]);
    visit(p - first, static_cast<int>(set.group[g + 1]) - p);
  }
}

/// Copies one component of the deformation of a block's particles to where the step's domains are kept: strain goes on
/// within the step, and what was scattered with one domain has to be gathered with the same.
template <class T>
void note_domain(const mpm_kernel::SetView<T>& set, int owner, const T* f, T* domain) {
  const std::uint32_t first = set.group[set.group_begin[owner]], end = set.group[set.group_begin[owner + 1]];
  std::memcpy(domain + first, f + first, (end - first) * sizeof(T));
}

}  // namespace mpm
