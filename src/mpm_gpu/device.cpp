#include "mpm_gpu/device.hpp"

#include <array>
#include <memory>
#include <string>
#include <utility>

#include "mpm/modules/with_precision.hpp"
#include "mpm_gpu/exchange.hpp"

namespace mpm_gpu {
namespace {

using mpm::ImpulseAccount;
using mpm::ParticleSet;
using mpm::Vec3;

template <class T>
class RunDevice final : public mpm::Device {
 public:
  RunDevice(const mpm::SimulationDefinition& definition, const std::vector<ParticleSet>& sets, mpm::RunModules modules,
            Executor executor)
      : definition_(definition),
        modules_(modules),
        layout_(dimensions(definition.geometry), definition.grid.cell, definition.grid.min, definition.grid.max),
        executor_(executor) {
    begin(sets);
  }

  void step(double start, double dt) override {
    told([&] { run_->solver().step(dt, start); });
  }
  void make_room() override {
    told([&] { run_->solver().make_room(); });
  }
  Fastest fastest(int set, double cell) override {
    Fastest fastest{};
    told([&] {
      const auto found = run_->solver().fastest(set, cell);
      fastest = {found.rate, in_world(found.place)};
    });
    return fastest;
  }
  ImpulseAccount take_given(int face) override {
    const Impulses::OfFace& now = run_->solver().impulses().face[face];
    Impulses::OfFace& before = told_[face];
    std::array<double, 3> along{};
    for (int k = 0; k < 3; ++k) along[k] = now.impulse[k] - before.impulse[k];
    ImpulseAccount given;
    given.impulse = in_world(along);
    given.exchanged = now.exchanged - before.exchanged;
    before = now;
    return given;
  }
  Vec3 take_carried() override {
    const std::array<double, 3> now = run_->solver().put_around().carried();
    std::array<double, 3> since{};
    for (std::size_t k = 0; k < 3; ++k) since[k] = now[k] - carried_before_[k];
    carried_before_ = now;
    return in_world(since);
  }
  void tell_modules() override {
    told([&] {
      for (const auto& stage : run_->solver().stages()) stage->tell_modules();
    });
  }
  Sums sums(int set) override {
    Sums sums;
    told([&] {
      const Totals found = run_->solver().totals(set);
      sums = {found.kinetic, found.elastic, found.plastic, found.carried, found.least_j, {}, {}};
      sums.momentum = in_world({found.momentum[0], found.momentum[1], found.momentum[2]});
      sums.place = in_world({found.place[0], found.place[1], found.place[2]});
    });
    return sums;
  }
  void fetch(std::vector<ParticleSet>& sets, Numbers which) override {
    told([&] { run_->write_to(sets, which == Numbers::all); });
  }
  void take(const std::vector<ParticleSet>& sets) override {
    told([&] { begin(sets); });
  }

 private:
  void begin(const std::vector<ParticleSet>& sets) {
    run_.reset();  // before the next one takes memory
    run_ = std::make_unique<DeviceRun<T>>(definition_, sets, executor_, &modules_);
    told_ = {};
    carried_before_ = {};
  }
  Vec3 in_world(const std::array<double, 3>& along) const {
    Vec3 vector = Vec3::Zero();
    for (int k = 0; k < layout_.dim(); ++k) vector[layout_.axis(k)] = along[k];
    return vector;
  }
  /// The run knows the errors of modules alone.
  template <class Work>
  static void told(Work&& work) {
    try {
      work();
    } catch (const GpuError& error) {
      throw mpm::ModuleError(error.what());
    }
  }

  const mpm::SimulationDefinition& definition_;  ///< the simulation's own
  mpm::RunModules modules_;
  mpm::GridLayout layout_;
  Executor executor_;
  std::unique_ptr<DeviceRun<T>> run_;
  std::array<Impulses::OfFace, 6> told_{};
  std::array<double, 3> carried_before_{};  ///< PutAround::carried() when last taken [kg m]
};

}  // namespace

mpm::DeviceMaker device_by(Executor executor) {
  mpm::DeviceMaker maker;
  maker.make = [executor](const mpm::SimulationDefinition& definition, const std::vector<ParticleSet>& sets,
                          mpm::RunModules modules) {
    return mpm::with_precision(definition.method.precision, [&](auto zero) -> std::unique_ptr<mpm::Device> {
      return std::make_unique<RunDevice<decltype(zero)>>(definition, sets, modules, executor);
    });
  };
  return maker;
}

}  // namespace mpm_gpu
