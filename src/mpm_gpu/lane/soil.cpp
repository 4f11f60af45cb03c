#include "mpm_gpu/soil_end_kernels.hpp"

namespace mpm_gpu {
namespace {

template <class T, class Geometry>
struct SoilPassesOf {
  static constexpr int kDim = Geometry::kDim, kTeam = kMembers<kDim>;
  using Soil = SoilView<T>;
  using Step = mpm_gpu::Step<T>;
  using Node = mpm_kernel::SoilNode<T>;

  static void numbers(Executor& run, const SetView& set, const mpm_kernel::SoilParticles<T>& particles,
                      const Soil& soil) {
    run.for_each("gpu: particles to cells", set.count, SoilNumbersKernel<T, Geometry>{particles, soil, set.first});
  }
  static void load(Executor& run, const Step& step, const Soil& soil) {
    run.for_each("gpu: nodes of the soil", step.nodes.nodes, SoilLoadKernel<T, kDim>{step, soil});
  }
  static void cells(Executor& run, const Step& step, const Soil& soil, int number, double dt,
                    const mpm_kernel::SoilConstants& constants) {
    run.for_each("gpu: particles to cells", step.nodes.nodes,
                 SoilCellKernel<T, Geometry>{step, soil, constants, dt, number});
  }
  static void push(Executor& run, const Step& step, const Soil& soil, const std::int32_t* blocks, long count) {
    run.template in_turns<kTeam>("gpu: momentum of stresses", count, kTeam * soil.soils,
                                 SoilPushKernel<T, kDim>{soil, step.nodes, blocks});
  }
  static void sweep(Executor& run, const Step& step, const Soil& soil, const std::int32_t* blocks, long count,
                    const std::uint8_t* marked, bool backwards) {
    run.template in_turns<kTeam>("gpu: sweeps over cells", count, kTeam * soil.soils,
                                 SoilSweepKernel<T, kDim>{soil, step.nodes, blocks, marked, backwards});
  }
  static void changes(Executor& run, const Soil& soil, long blocks, mpm_kernel::SweepChange* to) {
    run.for_each("gpu: sweeps over cells", blocks, SoilChangesKernel<T, kDim>{soil.change, to});
  }
  static void go_on(Executor& run, const Step& step, const Soil& soil, T factor) {
    const long nodes = step.nodes.nodes, cells = nodes * soil.soils;
    run.for_each("gpu: extrapolation", cells, SoilGoOnKernel<T>{soil, nodes, cells, factor});
  }
  static void go_on_in_rows(Executor& run, const RowsView<T>& rows, long tools, long walls, T factor) {
    run.for_each("gpu: extrapolation", tools + walls, RowsGoOnKernel<T>{rows, tools, factor});
  }
  static void meet(Executor& run, const Soil& soil, const RowsView<T>& rows, long count) {
    run.for_each("gpu: sweeps over contacts", count, SoilMeetKernel<T>{soil, rows});
  }
  static HeldSums held(Executor& run, const Step& step, const Soil& soil, Buffer<HeldSums>& partial) {
    return run.template reduce<HeldSums>(
        "gpu: accounts", step.nodes.nodes * soil.soils,
        [=](long i) {
          return HeldOfCell<T, kDim>{&soil, i};
        },
        partial);
  }
  static void held_at_rest(Executor& run, const Step& step, const Soil& soil, const std::int32_t* numbers, long count,
                           double* to) {
    run.for_each("gpu: accounts", count, HeldAtRestKernel<T, kDim>{soil, step.nodes, numbers, to});
  }
  static void store_at_rest(Executor& run, const Step& step, const Soil& soil, const std::int32_t* numbers, long count,
                            const double* impulses) {
    run.for_each("gpu: nodes of the soil", count, StoreAtRestKernel<T, kDim>{soil, step, numbers, impulses});
  }
  static void motion(Executor& run, const Step& step, const Soil& soil) {
    run.for_each("gpu: cells to particles", step.nodes.nodes * soil.soils, SoilMotionKernel<T, kDim>{soil});
  }
  static void take(Executor& run, const Step& step, const SetView& set, const mpm_kernel::SoilParticles<T>& particles,
                   const Soil& soil, int number) {
    run.for_each("gpu: cells to particles", set.count,
                 SoilTakeKernel<T, Geometry>{step, soil, particles, set, step.settings.dt, number});
  }
  static DeedSums deeds(Executor& run, const Step& step, const Soil& soil, Buffer<DeedSums>& partial) {
    return run.template reduce<DeedSums>("gpu: accounts", step.nodes.nodes, SolvedNodes<T, kDim>{soil, step}, partial);
  }
  static void store(Executor& run, const Step& step, const Soil& soil) {
    run.for_each("gpu: nodes of the soil", step.nodes.nodes, SoilStoreKernel<T, kDim>{soil, step});
  }
  static void pack(Executor& run, const Soil& soil, const std::int32_t* numbers, long count, Node* to) {
    run.for_each("gpu: nodes of the soil", count, PackKernel<T>{soil.node, numbers, to});
  }
  static void unpack(Executor& run, const Soil& soil, const std::int32_t* numbers, long count, const Node* from) {
    run.for_each("gpu: nodes of the soil", count, UnpackKernel<T>{soil.node, numbers, from});
  }
  static void impulses(Executor& run, const RowsView<T>& rows, long tools, long walls, T* to) {
    run.for_each("gpu: sweeps over contacts", tools + walls, ImpulsesKernel<T>{rows, tools, to});
  }
  static void owners(Executor& run, const Step& step, std::uint8_t* to) {
    run.for_each("gpu: blocks", step.nodes.blocks, OwnersKernel<T>{step, nodes_of_block(kDim), to});
  }
  static constexpr SoilPassTable<T> kPasses = {
      &numbers,      &load,   &cells, &push,  &sweep, &changes,       &go_on, &go_on_in_rows, &meet,     &held,
      &held_at_rest, &motion, &take,  &deeds, &store, &store_at_rest, &pack,  &unpack,        &impulses, &owners};
};

template <class T>
const SoilPassTable<T>& choose(int dim) {
  return dim == 3 ? SoilPassesOf<T, mpm::Solid>::kPasses : SoilPassesOf<T, mpm::PlaneStrain>::kPasses;
}

}  // namespace

const SoilPassTable<double>& soil_passes(int dim, double) { return choose<double>(dim); }
const SoilPassTable<float>& soil_passes(int dim, float) { return choose<float>(dim); }

}  // namespace mpm_gpu
