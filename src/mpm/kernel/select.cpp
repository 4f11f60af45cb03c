#include "mpm/kernel/select.hpp"

// One function a family of tables, in the namespace of its instruction set; defined in wide/*.cpp.
#define MPM_DECLARE_KERNELS(space)                                   \
  namespace space {                                                  \
  const mpm_kernel::PassFamily& dirac_passes();                      \
  const mpm_kernel::PassFamily& ugimp_passes();                      \
  const mpm_kernel::PassFamily& ugimp_stretch_passes();              \
  const mpm_kernel::PassFamily& cpdi_passes();                       \
  const mpm_kernel::PassFamily& qcpdi_passes();                      \
  const mpm_kernel::PassFamily& bspline2_passes();                   \
  const mpm_kernel::PassFamily& bspline3_passes();                   \
  const mpm_kernel::PassFamily& axisymmetric_dirac_passes();         \
  const mpm_kernel::PassFamily& axisymmetric_ugimp_passes();         \
  const mpm_kernel::PassFamily& axisymmetric_ugimp_stretch_passes(); \
  const mpm_kernel::PassFamily& axisymmetric_cpdi_passes();          \
  const mpm_kernel::PassFamily& axisymmetric_qcpdi_passes();         \
  const mpm_kernel::LawFamily& line_laws();                          \
  const mpm_kernel::LawFamily& plane_stress_laws();                  \
  const mpm_kernel::LawFamily& plane_strain_laws();                  \
  const mpm_kernel::LawFamily& axisymmetric_laws();                  \
  const mpm_kernel::LawFamily& solid_laws();                         \
  }
MPM_DECLARE_KERNELS(mpm_plain)
MPM_DECLARE_KERNELS(mpm_avx2)
MPM_DECLARE_KERNELS(mpm_avx512)

namespace mpm {
namespace {

#if defined(MPM_X86_KERNELS)
#define MPM_KERNELS(name) \
  { mpm_plain::name, mpm_avx2::name, mpm_avx512::name }
#else
#define MPM_KERNELS(name) \
  { mpm_plain::name, nullptr, nullptr }
#endif
// By shape function or geometry, then by instruction set.
constexpr const mpm_kernel::PassFamily& (*kPasses[][3])() = {
    MPM_KERNELS(dirac_passes),   MPM_KERNELS(ugimp_passes), MPM_KERNELS(ugimp_stretch_passes),
    MPM_KERNELS(cpdi_passes),    MPM_KERNELS(qcpdi_passes), MPM_KERNELS(bspline2_passes),
    MPM_KERNELS(bspline3_passes)};
constexpr const mpm_kernel::PassFamily& (*kAxisymmetricPasses[][3])() = {
    MPM_KERNELS(axisymmetric_dirac_passes), MPM_KERNELS(axisymmetric_ugimp_passes),
    MPM_KERNELS(axisymmetric_ugimp_stretch_passes), MPM_KERNELS(axisymmetric_cpdi_passes),
    MPM_KERNELS(axisymmetric_qcpdi_passes)};
constexpr const mpm_kernel::LawFamily& (*kLaws[][3])() = {MPM_KERNELS(line_laws), MPM_KERNELS(plane_strain_laws),
                                                          MPM_KERNELS(plane_stress_laws),
                                                          MPM_KERNELS(axisymmetric_laws), MPM_KERNELS(solid_laws)};

const mpm_kernel::PassFamily& passes(ShapeKind shape, GeometryKind geometry, Isa isa) {
  const auto& family = (axisymmetric(geometry) ? kAxisymmetricPasses : kPasses)[static_cast<int>(shape)];
  return family[static_cast<int>(isa)]();
}

}  // namespace

template <>
mpm_kernel::KernelTable<double> kernel_table<double>(ShapeKind shape, GeometryKind geometry, Isa isa) {
  if (!has_shape(shape, geometry)) return {};
  auto table = passes(shape, geometry, isa).in_double[dimensions(geometry) - 1];
  table.laws = kLaws[static_cast<int>(geometry)][static_cast<int>(isa)]().in_double;
  return table;
}

template <>
mpm_kernel::KernelTable<float> kernel_table<float>(ShapeKind shape, GeometryKind geometry, Isa isa) {
  if (!has_shape(shape, geometry)) return {};
  auto table = passes(shape, geometry, isa).in_single[dimensions(geometry) - 1];
  table.laws = kLaws[static_cast<int>(geometry)][static_cast<int>(isa)]().in_single;
  return table;
}

}  // namespace mpm
