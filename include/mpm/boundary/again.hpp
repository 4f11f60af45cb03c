// A stage once more in a step: what always holds its nodes acts before contact, so that friction knows no velocity
// through it, and again after it, for contact may have pushed them. Method reference 5.4, steps 7 to 9.
#pragma once

#include "mpm/step/stage.hpp"

namespace mpm {

class StageAgain final : public Stage {
 public:
  /// `stage` outlives this one, and comes before it in the list: its nodes are those of the step.
  explicit StageAgain(Stage& stage) : stage_(stage) {}

  void before_strain(StepContext& context) override { stage_.before_strain(context); }
  void momentum_updated(StepContext& context) override { stage_.momentum_updated(context); }
  void velocity_found(StepContext& context, NodalField& velocity) override { stage_.velocity_found(context, velocity); }
  void increment_found(StepContext& context, NodalField& increment) override {
    stage_.increment_found(context, increment);
  }

 private:
  Stage& stage_;
};

}  // namespace mpm
