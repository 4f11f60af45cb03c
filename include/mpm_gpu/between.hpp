// Interface of what acts on nodes between the passes of a step (near_bodies.hpp).
#pragma once

#include <cstdint>

#include "mpm/step/order.hpp"
#include "mpm_gpu/executor.hpp"
#include "mpm_gpu/views.hpp"

namespace mpm_gpu {

template <class T>
class Between {
 public:
  virtual ~Between() = default;

  /// Called before a step's passes; `sorts`: how often particles have been sorted so far. Returns NodeView::near.
  virtual const std::uint8_t* begin_step(Executor& run, const StepView<T>& step, long sorts) = 0;
  /// Acts as a stage of the solver does at the hook (mpm/step/stage.hpp).
  virtual void act(mpm::Hook hook, Executor& run, const StepView<T>& step) = 0;
};

}  // namespace mpm_gpu
