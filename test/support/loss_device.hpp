// A processor that takes the steps of a run and is lost after some of them, as a card may be. Its particles stay where
// they are.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "mpm/simulation/simulation.hpp"

namespace mpm::test {

class LossDevice final : public Device {
 public:
  explicit LossDevice(int steps, bool in_step = true) : left_(steps), in_step_(in_step) {}

  void step(double, double) override {
    if (--left_ < 0 && in_step_) lose();
  }
  void make_room() override {}
  Fastest fastest(int, double) override { return {2000.0, Vec3::Zero()}; }
  OfWall take_wall(int) override { return {}; }
  double take_averaged() override { return 0.0; }
  HeldNodes held(int) const override { return {}; }
  void hold(int, const HeldNodes&) override {}
  Vec3 take_carried() override { return Vec3::Zero(); }
  void tell_modules() override {}
  Sums sums(int) override {
    if (left_ < 0) lose();
    return {};
  }
  void fetch(std::vector<ParticleSet>&, Numbers) override {
    if (left_ < 0) lose();
  }
  void take(const std::vector<ParticleSet>&) override {}

  static constexpr const char* kWhy = "the card is lost to this program";

 private:
  [[noreturn]] static void lose() { throw ModuleError(kWhy); }

  int left_;
  bool in_step_;  ///< false: it takes steps on, and is found lost when it is read
};

/// One that is lost after so many steps.
inline DeviceMaker lost_after(int steps, bool in_step = true) {
  return {"a fake card", [=](const SimulationDefinition&, const std::vector<ParticleSet>&, const RunModules&) {
            return std::unique_ptr<Device>(std::make_unique<LossDevice>(steps, in_step));
          }};
}

/// One that stays.
inline DeviceMaker kept() { return lost_after(std::numeric_limits<int>::max()); }

/// One that has no room for the particles.
inline DeviceMaker too_small() {
  return {
      "a small card",
      [](const SimulationDefinition&, const std::vector<ParticleSet>&, const RunModules&) -> std::unique_ptr<Device> {
        throw Error("400 particles need more memory than is free: about 100 particles would fit");
      }};
}

}  // namespace mpm::test
