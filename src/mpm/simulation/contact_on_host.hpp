// Contact with rigid bodies in the steps of a device: the run's stages of contact, on the nodes near bodies alone
// (step/device.hpp). Private to this folder.
#pragma once

#include <vector>

#include "mpm/rigid/rigid_body.hpp"
#include "mpm/step/device.hpp"
#include "mpm/step/modules.hpp"

namespace mpm {

class ContactOnHost final : public HostContact {
 public:
  /// `fields`: as the run's, without blocks. The others outlive this object; `sets` as they are when modules are made.
  ContactOnHost(const std::vector<RigidBody>& bodies, const Modules& modules, Fields fields,
                const std::vector<ParticleSet>& sets);

  /// Call when the bodies have their twists of the step.
  void begin_step(const StepContext& context);
  bool near(const Vec3& place, double radius) const override;
  Fields& fields() override { return fields_; }
  std::vector<ParticleSet>& sets() override { return sets_; }
  void act(Hook hook) override { modules_.act(hook, Rank::rigid_body, context_); }

 private:
  const std::vector<RigidBody>& bodies_;
  const Modules& modules_;
  Fields fields_;
  std::vector<ParticleSet> sets_;
  double reach_;             ///< distance from a body beyond which nothing meets it in a step [m]
  std::vector<Box> bounds_;  ///< bounds of each body, in this step [m]
  StepContext context_;
};

}  // namespace mpm
