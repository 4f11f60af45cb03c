#include "mpm_gpu/device.hpp"

#include <array>
#include <memory>
#include <utility>

#include "mpm/implicit/implicit_step.hpp"
#include "mpm/modules/with_precision.hpp"
#include "mpm_gpu/exchange.hpp"
#include "mpm_gpu/held_nodes.hpp"

namespace mpm_gpu {
namespace {

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
    told([&] { run().solver().step(dt, start); }, false);
  }
  void make_room() override {
    told([&] { run().solver().make_room(); });
  }
  Fastest fastest(int set, double cell) override {
    Fastest fastest{};
    told([&] {
      const auto found = run().solver().fastest(set, cell);
      fastest = {found.rate, in_world(found.place)};
    });
    return fastest;
  }
  // Sums begin again at zero when they are taken: a run that goes on from a checkpoint has the same bits.
  OfWall take_wall(int face) override {
    Impulses::OfFace now;
    told([&] { now = std::exchange(run().solver().impulses().face[face], {}); });
    OfWall wall;
    wall.given.impulse = in_world({now.impulse[0], now.impulse[1], now.impulse[2]});
    wall.given.exchanged = now.exchanged;
    wall.loss = {now.friction, now.held};
    return wall;
  }
  double take_averaged() override {
    double averaged = 0.0;
    told([&] { averaged = std::exchange(run().solver().impulses().averaged, 0.0); });
    return averaged;
  }
  mpm::HeldNodes held(int face) const override {
    mpm::HeldNodes nodes;
    const Solver<T>& solver = run().solver();
    const bool rubs = solver.grid().faces[face] == Face::frictional;
    // As on the processor, where walls that always hold remember it with USF alone.
    if (!rubs && definition_.method.update != mpm::UpdateScheme::usf) return nodes;
    told([&] { nodes = held_nodes(solver.holds(), solver.grid(), layout_, face); });
    return nodes;
  }
  void hold(int face, const mpm::HeldNodes& nodes) override {
    told([&] {
      hold_nodes(run().solver().holds(), run().solver().grid(), layout_, face, nodes);
      run().solver().sort_next();
    });
  }
  Vec3 take_carried() override { return in_world(run().solver().put_around().take_carried()); }
  void tell_modules() override {
    told([&] {
      for (const auto& stage : run().solver().stages()) stage->tell_modules();
    });
  }
  Sums sums(int set) override {
    Sums sums;
    told([&] {
      const Totals found = run().solver().totals(set);
      sums = {found.kinetic, found.elastic, found.plastic, found.carried, found.least_j, {}, {}};
      sums.momentum = in_world({found.momentum[0], found.momentum[1], found.momentum[2]});
      sums.place = in_world({found.place[0], found.place[1], found.place[2]});
    });
    return sums;
  }
  void fetch(std::vector<ParticleSet>& sets, Numbers which) override {
    told([&] { run().write_to(sets, which); });
  }
  void take(const std::vector<ParticleSet>& sets) override {
    told([&] { begin(sets); }, false);
  }

 private:
  void begin(const std::vector<ParticleSet>& sets) {
    if (auto* solve = modules_.modules.template first<mpm::ImplicitSolve<T>>()) solve->use(nullptr);
    run_.reset();  // before the next one takes memory
    run_ = std::make_unique<DeviceRun<T>>(definition_, sets, executor_, &modules_);
  }
  /// @throws mpm::ModuleError where there is none, since it could not be made again
  DeviceRun<T>& run() const {
    if (!run_) throw mpm::ModuleError("gpu: the particles are lost, since they could not be taken over");
    return *run_;
  }
  Vec3 in_world(const std::array<double, 3>& along) const {
    Vec3 vector = Vec3::Zero();
    for (int k = 0; k < layout_.dim(); ++k) vector[layout_.axis(k)] = along[k];
    return vector;
  }
  /// Does it after a look at the steps up to now, or without one. The run knows the errors of modules alone.
  template <class Work>
  void told(Work&& work, bool looks = true) const {
    try {
      if (looks) run().solver().look();
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
