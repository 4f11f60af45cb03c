// Fault on one rank alone, told on all: so that all end together, with one reason.
#pragma once

#include <string>
#include <utility>

#include "mpm/ranks/communicator.hpp"

namespace mpm {

/// Text of the lowest rank that says something; empty if none does. Collective.
std::string first_text(Communicator& ranks, const std::string& own);

/// Calls work(), in which ranks do not speak to each other. Where it throws a Failure on one rank it throws one on all,
/// with the reason of the lowest that has one. `ranks`: null for a process that is alone. Collective.
template <class Failure, class Work>
void agree(Communicator* ranks, Work&& work) {
  if (ranks == nullptr) return work();
  std::string reason;
  try {
    work();
  } catch (const Failure& failure) {
    reason = failure.what();
  }
  reason = first_text(*ranks, reason);
  if (!reason.empty()) throw Failure(reason);
}

}  // namespace mpm
