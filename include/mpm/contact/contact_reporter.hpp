// Reports that modules of contact give in addition to those of every module: on contact with a rigid body, and on pairs
// of deformable bodies.
#pragma once

#include <vector>

#include "mpm/contact/contact_ledger.hpp"
#include "mpm/contact/pair_report.hpp"

namespace mpm {

class ContactReporter {
 public:
  virtual ~ContactReporter() = default;
  /// Returns the module's ledger of a rigid body; null if the module does not act on that body.
  virtual ContactLedger* ledger_of(const RigidBody&) { return nullptr; }
  /// Adds a report on each pair that the module acts between, since this reader's last call; `now` [s]. Reports of
  /// other readers do not change.
  virtual void read_pairs(double /*now*/, std::vector<PairReport>&, int /*reader*/ = 0) {}
};

}  // namespace mpm
