// Sleep of blocks in the steps of a device: the run's own stage, on the nodes at its border alone, and particles that
// fall asleep and wake (step/device.hpp). Private to this folder.
//
// The host keeps the blocks and the order of particles of its last sort. As on the processor it sorts when a particle
// has left the reach of its block, or when some are to fall asleep or wake, though not when sorted particles would be
// faster: a block may wait for that sort up to 32 steps longer to fall asleep, and 8 to wake.
#pragma once

#include <memory>
#include <vector>

#include "mpm/sleep/sleep.hpp"
#include "mpm/step/device.hpp"

namespace mpm {

class RestOnHost final : public HostRest {
 public:
  /// All outlive this object. `device`: made later.
  RestOnHost(Sleep& sleep, const Modules& modules, Fields& fields, std::vector<ParticleSet>& sets,
             const std::unique_ptr<Device>& device)
      : sleep_(sleep), modules_(modules), fields_(fields), sets_(sets), device_(device) {}

  /// `context` outlives the step.
  void begin_step(StepContext& context);
  Fields& fields() override { return fields_; }
  const std::vector<ParticleSet>& sets() override { return sets_; }
  bool needs_all() const override { return all_; }
  void act(Hook hook) override;
  void particle_left() override { left_ = true; }

  /// True if a particle has left the reach of its block since the last sort.
  bool has_left() const { return left_; }
  /// True if particles may fall asleep or wake when they are sorted.
  bool has_work_for_sort() const { return sleep_.has_work_for_sort(); }
  /// Marks the blocks of which particles have moved out, as the update of particles does on the processor: their places
  /// are up to date.
  void find_loose();

 private:
  Sleep& sleep_;
  const Modules& modules_;
  Fields& fields_;
  std::vector<ParticleSet>& sets_;
  const std::unique_ptr<Device>& device_;
  StepContext* context_ = nullptr;
  bool all_ = false, left_ = false;
};

}  // namespace mpm
