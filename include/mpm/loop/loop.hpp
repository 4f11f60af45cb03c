// The loops of the solver, each by its name, shared out among threads. All parallel work is started here and nowhere
// else: a profile of a run (loop/profile.hpp) has a row for each name.
//
// A loop must write the same whoever does which entry: entries write places of their own, and what is summed
// over several of them is summed in fixed groups (loop/chunk_sums.hpp, particles/sum_particles.hpp) or has no order
// (largest, whole numbers). Then a run has the same bits for any number of threads. An exception must not leave an
// entry.
#pragma once

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <utility>

#include "mpm/loop/profile.hpp"

namespace mpm {

/// Threads at work on one loop, as one of them sees them.
struct Team {
  int thread;   ///< number of this one, from 0
  int threads;  ///< number of all

  /// First entry of this thread's part of so many entries, and one past its last.
  template <class Count>
  std::pair<Count, Count> part(Count entries) const {
    const Count of_each = entries / threads, longer = entries % threads, here = static_cast<Count>(thread);
    const Count first = of_each * here + std::min(here, longer);
    return {first, first + of_each + (here < longer ? 1 : 0)};
  }
  /// Waits until all threads have come here.
  void meet() const {
    if (threads == 1) return;
#pragma omp barrier
  }
};

/// work(team) on each of so many threads, at least 1, at once. `name`: of the loop's row in a profile.
template <class Work>
void for_team(const char* name, int threads, Work&& work) {
  const TimeProfile::Part part(name);
  // Beginning, end and barrier of a parallel region of one thread are calls of the system, too.
  if (threads == 1) return work(Team{0, 1});
#pragma omp parallel num_threads(threads)
  work(Team{omp_get_thread_num(), omp_get_num_threads()});
}

/// Does `work` while no other thread does such work: for what threads find together.
template <class Work>
void in_turn(Work&& work) {
#pragma omp critical(mpm_one_at_a_time)
  work();
}

/// pass(first, end, thread) for a contiguous part of so many entries on each thread.
template <class Count, class Pass>
void for_parts(const char* name, int threads, Count entries, Pass&& pass) {
  for_team(name, threads, [&](const Team& team) {
    const auto [first, end] = team.part(entries);
    if (first < end) pass(first, end, team.thread);
  });
}

/// visit(i) for entries 0 to `entries` - 1.
template <class Count, class Visit>
void for_all(const char* name, int threads, Count entries, Visit&& visit) {
  for_parts(name, threads, entries, [&](Count first, Count end, int) {
    for (Count i = first; i < end; ++i) visit(i);
  });
}

/// As for_all(), for entries of unlike work: each thread takes the next when it has done with one.
template <class Visit>
void for_unlike(const char* name, int threads, int entries, Visit&& visit) {
  std::atomic<int> next{0};
  for_team(name, threads, [&](const Team&) {
    for (int i = next++; i < entries; i = next++) visit(i);
  });
}

/// pass(first, end, group) for groups of so many entries, the last one shorter.
template <class Pass>
void for_groups(const char* name, int threads, int entries, int of_group, Pass&& pass) {
  for_all(name, threads, (entries + of_group - 1) / of_group,
          [&](int g) { pass(g * of_group, std::min(entries, (g + 1) * of_group), g); });
}

}  // namespace mpm
