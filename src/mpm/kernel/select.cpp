#include "mpm/kernel/select.hpp"

// One function a table, in the namespace of its instruction set; defined in wide/*.cpp.
#define MPM_DECLARE_KERNELS(space)                                    \
  namespace space {                                                   \
  const mpm_kernel::KernelTable<double>& plane_strain_ugimp_double(); \
  const mpm_kernel::KernelTable<double>& solid_ugimp_double();        \
  const mpm_kernel::KernelTable<float>& plane_strain_ugimp_single();  \
  const mpm_kernel::KernelTable<float>& solid_ugimp_single();         \
  }
MPM_DECLARE_KERNELS(mpm_plain)
MPM_DECLARE_KERNELS(mpm_avx2)
MPM_DECLARE_KERNELS(mpm_avx512)

namespace mpm {
namespace {

template <class T>
using Maker = const mpm_kernel::KernelTable<T>& (*)();

#if defined(MPM_X86_KERNELS)
#define MPM_KERNELS(name) mpm_plain::name, mpm_avx2::name, mpm_avx512::name
#else
#define MPM_KERNELS(name) mpm_plain::name
#endif
// By instruction set, in the order of Isa.
constexpr Maker<double> kSolidDouble[] = {MPM_KERNELS(solid_ugimp_double)};
constexpr Maker<double> kPlaneDouble[] = {MPM_KERNELS(plane_strain_ugimp_double)};
constexpr Maker<float> kSolidSingle[] = {MPM_KERNELS(solid_ugimp_single)};
constexpr Maker<float> kPlaneSingle[] = {MPM_KERNELS(plane_strain_ugimp_single)};

}  // namespace

template <>
const mpm_kernel::KernelTable<double>& ugimp_kernels<double>(int dim, Isa isa) {
  return (dim == 3 ? kSolidDouble : kPlaneDouble)[static_cast<int>(isa)]();
}

template <>
const mpm_kernel::KernelTable<float>& ugimp_kernels<float>(int dim, Isa isa) {
  return (dim == 3 ? kSolidSingle : kPlaneSingle)[static_cast<int>(isa)]();
}

}  // namespace mpm
