// Device code of the kernels of laws, shape functions and stages, made of the headers that the processor's executor
// runs. Nothing is launched from here: clang turns this file into PTX without a card or CUDA's own headers
// (scripts/lib/check_device_code), which shows that laws, shape functions and passes are what a device can do.
//
// Headers that the processor shares are between the pragmas, so that no function needs a mark.
#include "mpm_gpu/device/host_headers.hpp"

#pragma clang force_cuda_host_device begin
#include "mpm/material/norsand_energy.hpp"
#include "mpm/shape/bspline.hpp"
#include "mpm/shape/dirac.hpp"
#include "mpm/shape/ugimp_stretch.hpp"
#include "mpm_gpu/law_passes.hpp"
#include "mpm_gpu/leaving_passes.hpp"
#include "mpm_gpu/liquid_passes.hpp"
#include "mpm_gpu/load_passes.hpp"
#include "mpm_gpu/node_passes.hpp"
#include "mpm_gpu/prescribed_passes.hpp"
#include "mpm_gpu/soil_end_kernels.hpp"
#pragma clang force_cuda_host_device end
#include "mpm_gpu/device/law_functions.hpp"

namespace mpm_gpu {

/// A thread an index.
template <class Kernel>
__attribute__((global)) void launch(Kernel kernel, long count) {
  const long i =
      static_cast<long>(__nvvm_read_ptx_sreg_ctaid_x()) * __nvvm_read_ptx_sreg_ntid_x() + __nvvm_read_ptx_sreg_tid_x();
  if (i < count) kernel(i);
}

/// The same of what is summed.
template <class Kernel, class Sum>
__attribute__((global)) void launch_sum(Kernel kernel, long count, Sum* sums) {
  const long i =
      static_cast<long>(__nvvm_read_ptx_sreg_ctaid_x()) * __nvvm_read_ptx_sreg_ntid_x() + __nvvm_read_ptx_sreg_tid_x();
  if (i < count) sums[i] += kernel(i);
}

/// A thread a member of a team.
template <class Kernel>
__attribute__((global)) void launch_turn(Kernel kernel, int turn) {
  kernel(static_cast<long>(__nvvm_read_ptx_sreg_ctaid_x()), turn, static_cast<int>(__nvvm_read_ptx_sreg_tid_x()));
}

template <class T, class Geometry, template <class> class ShapeClass>
void each_pass() {
  (void)&launch<MomentumKernel<T, Geometry, ShapeClass>>;
  (void)&launch<MomentumKernel<T, Geometry, ShapeClass, true>>;
  (void)&launch<GradientKernel<T, Geometry::kDim, ShapeClass>>;
  (void)&launch<IncrementToParticlesKernel<T, Geometry::kDim, ShapeClass>>;
  (void)&launch<IncrementKernel<T, Geometry::kDim, ShapeClass>>;
  (void)&launch<IncrementKernel<T, Geometry::kDim, ShapeClass, true>>;
  (void)&launch<ForceKernel<T, Geometry, ShapeClass>>;
  (void)&launch<ForceKernel<T, Geometry, ShapeClass, true>>;
  (void)&launch<MoveKernel<T, Geometry::kDim, ShapeClass, mpm_kernel::kIncrement>>;
  (void)&launch<MoveKernel<T, Geometry::kDim, ShapeClass, mpm_kernel::kAdopt>>;
  (void)&launch<MoveKernel<T, Geometry::kDim, ShapeClass, mpm_kernel::kAffine>>;
  (void)&launch<LoadKernel<T, Geometry::kDim, ShapeClass>>;
  (void)&launch<FullnessKernel<T, Geometry::kDim, ShapeClass>>;
  (void)&launch<FullnessToParticlesKernel<T, Geometry::kDim, ShapeClass>>;
  (void)&launch<MoveKernel<T, Geometry::kDim, ShapeClass, mpm_kernel::kIncrement, Counting::slip>>;
  (void)&launch<MoveKernel<T, Geometry::kDim, ShapeClass, mpm_kernel::kIncrement, Counting::damping>>;
  (void)&launch<MoveKernel<T, Geometry::kDim, ShapeClass, mpm_kernel::kAdopt, Counting::damping>>;
  (void)&launch<MoveKernel<T, Geometry::kDim, ShapeClass, mpm_kernel::kAffine, Counting::damping>>;
}

template <class T, int Dim>
void each_of_loads() {
  (void)&launch<LoadOfParticleKernel<T, Dim>>;
  (void)&launch<LoadKernel<T, Dim, mpm::Dirac>>;
  (void)&launch<TractionKernel<T, Dim>>;
  (void)&launch<LoadPowerKernel<T, Dim>>;
  (void)&launch<HoldKernel<T, Dim>>;
  (void)&launch<PutBackKernel<T, Dim>>;
}

template <class T, class Geometry>
void each_of_soil() {
  constexpr int kDim = Geometry::kDim;
  (void)&launch<SoilNumbersKernel<T, Geometry>>;
  (void)&launch<SoilLoadKernel<T, kDim>>;
  (void)&launch<SoilCellKernel<T, Geometry>>;
  (void)&launch_turn<SoilPushKernel<T, kDim>>;
  (void)&launch_turn<SoilSweepKernel<T, kDim>>;
  (void)&launch<SoilChangesKernel<T, kDim>>;
  (void)&launch<SoilMotionKernel<T, kDim>>;
  (void)&launch<SoilTakeKernel<T, Geometry>>;
  (void)&launch<SoilStoreKernel<T, kDim>>;
  (void)&launch<HeldAtRestKernel<T, kDim>>;
  (void)&launch<StoreAtRestKernel<T, kDim>>;
  (void)&launch_sum<HeldOfCells<T, kDim>, HeldSums>;
  (void)&launch_sum<SolvedNodes<T, kDim>, DeedSums>;
  if constexpr (kDim == 2) return;
  (void)&launch<SoilGoOnKernel<T>>;
  (void)&launch<RowsGoOnKernel<T>>;
  (void)&launch<SoilMeetKernel<T>>;
  (void)&launch<ImpulsesKernel<T>>;
  (void)&launch<PackKernel<T>>;
  (void)&launch<UnpackKernel<T>>;
  (void)&launch<OwnersKernel<T>>;
}

/// False for a user's law, which is code of the host.
template <class OneLaw>
constexpr bool kOnDevice = !std::is_same_v<OneLaw, mpm::UserLaw>;

template <class T, class Geometry, class OneLaw>
void law() {
  if constexpr (kOnDevice<OneLaw>) (void)&launch<LawKernel<T, Geometry, OneLaw>>;
  if constexpr (kOnDevice<OneLaw>) (void)&launch<RateKernel<T, Geometry, OneLaw>>;
  if constexpr (kOnDevice<OneLaw>) (void)&launch_sum<TotalsKernel<T, Geometry, OneLaw>, Totals>;
  if constexpr (kOnDevice<OneLaw> && OneLaw::kAveragesStress) (void)&launch<AverageKernel<T, Geometry, OneLaw>>;
  if constexpr (OneLaw::kMatter == mpm::Matter::liquid) (void)&launch<RelaxKernel<T, Geometry, OneLaw>>;
}
template <class T, class Geometry, class... Laws>
void each_law(const std::variant<Laws...>*) {
  (law<T, Geometry, Laws>(), ...);
}

template <class T, class Geometry>
void each_kernel() {
  each_pass<T, Geometry, mpm::Ugimp>();
  each_pass<T, Geometry, mpm::UgimpStretch>();
  each_pass<T, Geometry, mpm::QuadraticSpline>();
  each_pass<T, Geometry, mpm::CubicSpline>();
  each_of_loads<T, Geometry::kDim>();
  each_of_soil<T, Geometry>();
  (void)&launch<DomainKernel<T, Geometry::kDim>>;
  (void)&launch<VolumeKernel<T, Geometry>>;
  (void)&launch<FirstIncrementKernel<T, Geometry::kDim>>;
  (void)&launch<FirstIncrementKernel<T, Geometry::kDim, true>>;
  each_law<T, Geometry>(static_cast<const mpm::Law*>(nullptr));
}

void all_kernels() {
  (void)&launch<HeldWorkKernel>;
  (void)&launch<HeldShareKernel>;
  (void)&launch<KeyKernel>;
  (void)&launch<FaultKernel>;
  each_kernel<double, mpm::Solid>();
  each_kernel<float, mpm::Solid>();
  each_kernel<double, mpm::PlaneStrain>();
  each_kernel<float, mpm::PlaneStrain>();
}

}  // namespace mpm_gpu
