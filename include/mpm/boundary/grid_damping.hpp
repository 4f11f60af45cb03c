// Grid damping: a force -alpha p on every node, so that momentum decays by (1 - alpha dt) a step; rigid motion is
// damped as well. Weak: it takes momentum from the material (the audit names it "damping"); for settling, not for
// dynamics. Source: Nairn, GIMP notes (2.35)-(2.42), the placement in the force; method reference 6.3.
#pragma once

#include "mpm/step/stage.hpp"

namespace mpm {

class GridDamping final : public Stage {
 public:
  /// `rate`: alpha [1/s]
  explicit GridDamping(double rate) : rate_(rate) { account_.name = "damping"; }

  void forces_gathered(StepContext& context) override;
  void accounts(std::vector<ImpulseAccount>& list) const override { list.push_back(account_); }

 private:
  double rate_;
  ImpulseAccount account_;
};

}  // namespace mpm
