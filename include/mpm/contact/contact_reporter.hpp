// What modules of contact report beyond what every module does: of a rigid body, and of pairs of deformable bodies.
#pragma once

#include <vector>

#include "mpm/contact/contact_ledger.hpp"
#include "mpm/contact/pair_report.hpp"

namespace mpm {

class ContactReporter {
 public:
  virtual ~ContactReporter() = default;
  /// What it books of a rigid body; null if it does not act on that one.
  virtual ContactLedger* ledger_of(const RigidBody&) { return nullptr; }
  /// Adds a report of each pair that it acts between, since this reader's last call; `now` [s]. Other readers notice
  /// nothing.
  virtual void read_pairs(double /*now*/, std::vector<PairReport>&, int /*reader*/ = 0) {}
};

}  // namespace mpm
