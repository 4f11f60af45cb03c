#include "mpm_gpu/passes.hpp"

#include "mpm/shape/bspline.hpp"
#include "mpm/shape/ugimp_stretch.hpp"
#include "mpm_gpu/node_passes.hpp"
#include "mpm_gpu/particle_passes.hpp"

namespace mpm_gpu {
namespace {

template <class T, class Geometry, template <class> class ShapeClass>
struct PassesOf {
  static constexpr int kDim = Geometry::kDim;

  static void domains(Executor& run, const StepView<T>& step) {
    run.for_each("gpu: domains", step.particles.count, DomainKernel<T, kDim>{step});
  }
  template <bool Affine>
  static void momentum(Executor& run, const StepView<T>& step) {
    run.for_each("gpu: momentum to the nodes", step.nodes.nodes, MomentumKernel<T, Geometry, ShapeClass, Affine>{step});
  }
  static void gradient(Executor& run, const StepView<T>& step) {
    for (int s = 0; s < step.set_count; ++s) {
      const SetView& set = step.sets[s];
      run.for_each("gpu: velocity gradient", set.count, GradientKernel<T, kDim, ShapeClass>{step, set});
    }
  }
  static void first_increment(Executor& run, const StepView<T>& step) {
    run.for_each("gpu: increments", step.nodes.nodes, FirstIncrementKernel<T, kDim>{step});
  }
  static void to_particles(Executor& run, const StepView<T>& step) {
    for (int s = 0; s < step.set_count; ++s) {
      const SetView& set = step.sets[s];
      run.for_each("gpu: increments", set.count, IncrementToParticlesKernel<T, kDim, ShapeClass>{step, set});
    }
  }
  static void increment(Executor& run, const StepView<T>& step) {
    run.for_each("gpu: increments", step.nodes.nodes, IncrementKernel<T, kDim, ShapeClass>{step});
  }
  static void force(Executor& run, const StepView<T>& step) {
    run.for_each("gpu: force and momentum of nodes", step.nodes.nodes, ForceKernel<T, Geometry, ShapeClass>{step});
  }
  template <mpm_kernel::Motion Kind>
  static void move(Executor& run, const StepView<T>& step) {
    for (int s = 0; s < step.set_count; ++s) {
      const SetView& set = step.sets[s];
      run.for_each("gpu: velocity and place", set.count, MoveKernel<T, kDim, ShapeClass, Kind>{step, set});
    }
  }
  static constexpr bool kStretches = ShapeClass<mpm::Wide<T>>::kStretches;
  static constexpr Passes<T> kPasses = {
      kStretches ? &domains : nullptr,
      {&momentum<false>, &momentum<true>},
      &gradient,
      &first_increment,
      &to_particles,
      &increment,
      &force,
      {&move<mpm_kernel::kIncrement>, &move<mpm_kernel::kAdopt>, &move<mpm_kernel::kAffine>}};
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

const Passes<double>& passes(int dim, Shape shape, double) { return choose<double>(dim, shape); }
const Passes<float>& passes(int dim, Shape shape, float) { return choose<float>(dim, shape); }

}  // namespace mpm_gpu
