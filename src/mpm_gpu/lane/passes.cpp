#include "mpm_gpu/passes.hpp"

#include "mpm/shape/bspline.hpp"
#include "mpm/shape/dirac.hpp"
#include "mpm/shape/ugimp_stretch.hpp"
#include "mpm_gpu/leaving_passes.hpp"
#include "mpm_gpu/liquid_passes.hpp"
#include "mpm_gpu/load_passes.hpp"
#include "mpm_gpu/node_passes.hpp"
#include "mpm_gpu/particle_passes.hpp"
#include "mpm_gpu/prescribed_passes.hpp"

namespace mpm_gpu {
namespace {

template <class T, class Geometry, template <class> class ShapeClass>
struct PassesOf {
  static constexpr int kDim = Geometry::kDim;

  static void domains(Executor& run, const Step<T>& step) {
    run.for_each("gpu: domains", step.particles.count, DomainKernel<T, kDim>{step});
  }
  template <bool Affine>
  static void momentum(Executor& run, const Step<T>& step) {
    run.for_each("gpu: momentum to the nodes", step.nodes.nodes, MomentumKernel<T, Geometry, ShapeClass, Affine>{step});
  }
  static void gradient(Executor& run, const Step<T>& step) {
    for (int s = 0; s < step.set_count; ++s) {
      const SetView& set = step.sets[s];
      run.for_each("gpu: velocity gradient", set.count, GradientKernel<T, kDim, ShapeClass>{step, set});
    }
  }
  template <bool Mixed>
  static void first_increment(Executor& run, const Step<T>& step) {
    run.for_each("gpu: increments", step.nodes.nodes, FirstIncrementKernel<T, kDim, Mixed>{step});
  }
  static void to_particles(Executor& run, const Step<T>& step) {
    for (int s = 0; s < step.set_count; ++s) {
      const SetView& set = step.sets[s];
      run.for_each("gpu: increments", set.count, IncrementToParticlesKernel<T, kDim, ShapeClass>{step, set});
    }
  }
  template <bool Mixed>
  static void increment(Executor& run, const Step<T>& step) {
    run.for_each("gpu: increments", step.nodes.nodes, IncrementKernel<T, kDim, ShapeClass, Mixed>{step});
  }
  template <bool Driven>
  static void force(Executor& run, const Step<T>& step) {
    run.for_each("gpu: force and momentum of nodes", step.nodes.nodes,
                 ForceKernel<T, Geometry, ShapeClass, Driven>{step});
  }
  template <mpm_kernel::Motion Kind, Counting Counts>
  static void move(Executor& run, const Step<T>& step) {
    for (int s = 0; s < step.set_count; ++s) {
      const SetView& set = step.sets[s];
      run.for_each("gpu: velocity and place", set.count, MoveKernel<T, kDim, ShapeClass, Kind, Counts>{step, set});
    }
  }
  static void load_of_particles(Executor& run, const Step<T>& step, const LoadView& load) {
    run.for_each("gpu: loads", step.particles.count, LoadOfParticleKernel<T, kDim>{step, load});
  }
  template <template <class> class Spread>
  static void load(Executor& run, const Step<T>& step, bool adds) {
    run.for_each("gpu: loads", step.nodes.nodes, LoadKernel<T, kDim, Spread>{step, adds});
  }
  static void traction(Executor& run, const Step<T>& step, const TractionView& traction, bool adds) {
    run.for_each("gpu: loads", step.nodes.nodes, TractionKernel<T, kDim>{step, traction, adds});
  }
  static void load_power(Executor& run, const Step<T>& step, double* power) {
    run.for_each("gpu: loads", step.nodes.nodes, LoadPowerKernel<T, kDim>{step, power});
  }
  static void hold(Executor& run, const Step<T>& step, const HeldView& held, HeldPart part) {
    run.for_each("gpu: prescribed velocities", held.nodes, HoldKernel<T, kDim>{step, held, part});
  }
  static void put_back(Executor& run, const Step<T>& step, double* numbers) {
    for (int s = 0; s < step.set_count; ++s) {
      const SetView& set = step.sets[s];
      run.for_each("gpu: particles that left", set.count, PutBackKernel<T, kDim>{step, set, numbers});
    }
  }
  static void volumes(Executor& run, const Step<T>& step, int number, double start, bool stays, double* volume) {
    const SetView& set = step.sets[number];
    run.for_each("gpu: volume of liquids", set.count,
                 VolumeKernel<T, Geometry>{step.particles, set.first, start, stays, volume});
  }
  static void fullness(Executor& run, const Step<T>& step, const double* volume, double cell, double* fullness) {
    run.for_each("gpu: volume of liquids", step.nodes.nodes,
                 FullnessKernel<T, kDim, ShapeClass>{step, volume, cell, fullness});
  }
  static void fullness_to_particles(Executor& run, const Step<T>& step, int number, const double* fullness) {
    const SetView& set = step.sets[number];
    run.for_each("gpu: volume of liquids", set.count,
                 FullnessToParticlesKernel<T, kDim, ShapeClass>{step, set, fullness});
  }
  static constexpr bool kStretches = ShapeClass<mpm::Wide<T>>::kStretches;
  static constexpr Passes<T> kPasses = {
      kStretches ? &domains : nullptr,
      {&momentum<false>, &momentum<true>},
      &gradient,
      {&first_increment<false>, &first_increment<true>},
      &to_particles,
      {&increment<false>, &increment<true>},
      {&force<false>, &force<true>},
      {{&move<mpm_kernel::kIncrement, Counting::nothing>, &move<mpm_kernel::kIncrement, Counting::slip>,
        &move<mpm_kernel::kIncrement, Counting::damping>},
       {&move<mpm_kernel::kAdopt, Counting::nothing>, nullptr, &move<mpm_kernel::kAdopt, Counting::damping>},
       {&move<mpm_kernel::kAffine, Counting::nothing>, nullptr, &move<mpm_kernel::kAffine, Counting::damping>}},
      &load_of_particles,
      {&load<ShapeClass>, &load<mpm::Dirac>},
      &traction,
      &load_power,
      &hold,
      &put_back,
      &volumes,
      &fullness,
      &fullness_to_particles};
};

template <class T, template <class> class ShapeClass>
const Passes<T>& of_shape(int dim) {
  return dim == 3 ? PassesOf<T, mpm::Solid, ShapeClass>::kPasses : PassesOf<T, mpm::PlaneStrain, ShapeClass>::kPasses;
}
template <class T>
const Passes<T>& choose(int dim, Shape shape) {
  switch (shape) {
    case Shape::ugimp_stretch:
      return of_shape<T, mpm::UgimpStretch>(dim);
    case Shape::bspline2:
      return of_shape<T, mpm::QuadraticSpline>(dim);
    case Shape::bspline3:
      return of_shape<T, mpm::CubicSpline>(dim);
    case Shape::ugimp:
      break;
  }
  return of_shape<T, mpm::Ugimp>(dim);
}

}  // namespace

void find_held_work(Executor& run, const HeldView& held, double* work) {
  run.for_each("gpu: prescribed velocities", held.entries, HeldWorkKernel{held, work});
}
void find_held_shares(Executor& run, const HeldView& held, const std::uint32_t* entry, const double* factor,
                      double* share, long count) {
  run.for_each("gpu: prescribed velocities", count, HeldShareKernel{held, entry, factor, share});
}
void copy_faults(Executor& run, const std::uint8_t* fault, const std::uint32_t* id, long count, std::uint8_t* fault_to,
                 std::uint32_t* id_to) {
  run.for_each("gpu: particles that left", count, FaultKernel{fault, id, fault_to, id_to});
}
void copy_keys(Executor& run, const NodeView& nodes, std::uint64_t* to) {
  run.for_each("gpu: blocks", nodes.blocks, KeyKernel{nodes.key, to});
}

const Passes<double>& passes(int dim, Shape shape, double) { return choose<double>(dim, shape); }
const Passes<float>& passes(int dim, Shape shape, float) { return choose<float>(dim, shape); }

}  // namespace mpm_gpu
