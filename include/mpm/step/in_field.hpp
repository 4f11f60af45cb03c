// A stage that acts on every velocity field alike (a wall, the axis): one such stage a field, each handed the context
// of its own. A scene with one field has no need of it.
#pragma once

#include <memory>
#include <utility>

#include "mpm/grid/fields.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

class InField final : public Stage {
 public:
  /// `field` outlives the stage.
  InField(Grid& field, std::unique_ptr<Stage> stage) : field_(field), stage_(std::move(stage)) {}

  void momentum_gathered(StepContext& context) override { in_field(context, &Stage::momentum_gathered); }
  void before_strain(StepContext& context) override { in_field(context, &Stage::before_strain); }
  void forces_gathered(StepContext& context) override { in_field(context, &Stage::forces_gathered); }
  void momentum_updated(StepContext& context) override { in_field(context, &Stage::momentum_updated); }
  void velocity_found(StepContext& context, NodalField&) override {
    StepContext own = of_field(context);
    stage_->velocity_found(own, field_.increment);
  }
  void increment_found(StepContext& context, NodalField&) override {
    StepContext own = of_field(context);
    stage_->increment_found(own, field_.increment);
  }
  void grid_advanced(StepContext& context) override { in_field(context, &Stage::grid_advanced); }
  void accounts(std::vector<ImpulseAccount>& list) const override { stage_->accounts(list); }
  void keep(StateArchive& archive) override { stage_->keep(archive); }

 private:
  StepContext of_field(const StepContext& context) const { return {field_, context.dt, context.start}; }
  void in_field(const StepContext& context, void (Stage::*joint)(StepContext&)) {
    StepContext own = of_field(context);
    (stage_.get()->*joint)(own);
  }

  Grid& field_;
  std::unique_ptr<Stage> stage_;
};

}  // namespace mpm
