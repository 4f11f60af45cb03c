// Sums, largest numbers, texts and lists of all ranks of a run, for those who need not know whether there are others:
// in a process that is alone, whose `ranks` and `halo` are null, each is what the process itself gives, and costs one
// comparison. Collective.
#pragma once

#include <string>
#include <vector>

#include "mpm/ranks/agree.hpp"
#include "mpm/ranks/halo.hpp"
#include "mpm/ranks/lists.hpp"

namespace mpm {

/// True on one rank alone: for what counts once, or is written once.
inline bool is_first(const Communicator* ranks) { return ranks == nullptr || ranks->first(); }
/// True if it is on any rank.
inline bool any_of_all(Communicator* ranks, bool own) { return ranks == nullptr ? own : ranks->any(own); }

/// Replaces each of `count` numbers by its sum.
inline void add_up(Communicator* ranks, double* numbers, int count) {
  if (ranks != nullptr) ranks->sum(numbers, count);
}
inline double sum_of_all(Communicator* ranks, double own) { return ranks == nullptr ? own : ranks->sum(own); }

/// Replaces each of `count` numbers by the largest; not a number if it is not a number on any.
inline void find_largest(Communicator* ranks, double* numbers, int count) {
  if (ranks != nullptr) ranks->largest(numbers, count);
}
inline double largest_of_all(Communicator* ranks, double own) {
  find_largest(ranks, &own, 1);
  return own;
}
inline double least_of_all(Communicator* ranks, double own) { return -largest_of_all(ranks, -own); }

/// Text of the lowest rank that says something; empty if none does.
inline std::string text_of_all(Communicator* ranks, std::string own) {
  return ranks == nullptr ? own : first_text(*ranks, own);
}
/// The lists of all ranks, one after another.
template <class T>
std::vector<T> list_of_all(Communicator* ranks, std::vector<T> own) {
  return ranks == nullptr ? own : gather_list(*ranks, own);
}

/// Adds what others have spread to the nodes of a velocity field; `values` have its blocks.
inline void add_of_others(Halo* halo, int field, NodalField& values) {
  if (halo != nullptr) halo->add(field, values);
}

}  // namespace mpm
