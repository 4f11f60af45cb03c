// Stages of a scene that needs more than the plain step. They act between its passes, at the hooks of the solver's own
// (mpm/step/stage.hpp), and own what they add. What depends on time they ask of the solver's modules, on the host:
// of the simulation that the device takes the steps of, else of their own.
#pragma once

#include <cstddef>

#include "mpm/step/order.hpp"
#include "mpm_gpu/executor.hpp"
#include "mpm_gpu/taken.hpp"
#include "mpm_gpu/views.hpp"

namespace mpm_gpu {

template <class T>
class Stage {
 public:
  virtual ~Stage() = default;

  /// Makes room for so many nodes, between sync periods.
  virtual void make_room(Executor&, long /*nodes*/) {}
  /// A step begins at `start` [s], before which particles have been sorted so often: chooses its settings and lays
  /// arrays beside its own. @throws mpm::ModuleError
  virtual void begin_step(Executor&, Step<T>&, double /*start*/, long /*sorts*/) {}
  /// Acts as a stage does at the hook. At `forces_gathered`, which comes before the internal force here,
  /// NodeView::load is to be set.
  virtual void act(mpm::Hook, Executor&, const Step<T>&) {}
  /// Asked when particles are outside the grid: true when it has put them all back. @throws mpm::ModuleError
  virtual bool put_back(Executor&, const Step<T>&) { return false; }
  /// The step is done, and its sums are known.
  virtual void end_step(Executor&, const Step<T>&, double /*start*/, const Taken& taken) { count(taken); }
  /// True if it hands out the same work in all steps of one length, so that a step may be recorded and replayed. Then
  /// it begins and acts in the step that is recorded, and count() stands in the place of end_step().
  virtual bool repeats() const { return false; }
  /// Counts what particles have lost in one or more steps.
  virtual void count(const Taken&) {}
  /// Books with modules of the solver what was counted since the last call.
  virtual void tell_modules() {}
  virtual std::size_t bytes() const { return 0; }
};

}  // namespace mpm_gpu
