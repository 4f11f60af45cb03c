#include "mpm/kernel/select.hpp"

// One function a family, in the namespace of its instruction set; defined in wide/*.cpp.
#define MPM_DECLARE_KERNELS(space)                                   \
  namespace space {                                                  \
  const mpm_kernel::PassFamily& stencil3_passes();                   \
  const mpm_kernel::PassFamily& stencil5_passes();                   \
  const mpm_kernel::PassFamily& cpdi_passes();                       \
  const mpm_kernel::PassFamily& qcpdi_passes();                      \
  const mpm_kernel::PassFamily& axisymmetric_stencil3_passes();      \
  const mpm_kernel::PassFamily& axisymmetric_cpdi_passes();          \
  const mpm_kernel::PassFamily& axisymmetric_qcpdi_passes();         \
  const mpm_kernel::ShapeFamily& dirac_shape();                      \
  const mpm_kernel::ShapeFamily& ugimp_shape();                      \
  const mpm_kernel::ShapeFamily& ugimp_stretch_shape();              \
  const mpm_kernel::ShapeFamily& bspline2_shape();                   \
  const mpm_kernel::ShapeFamily& bspline3_shape();                   \
  const mpm_kernel::ShapeFamily& axisymmetric_dirac_shape();         \
  const mpm_kernel::ShapeFamily& axisymmetric_ugimp_shape();         \
  const mpm_kernel::ShapeFamily& axisymmetric_ugimp_stretch_shape(); \
  const mpm_kernel::LawFamily& line_laws();                          \
  const mpm_kernel::LawFamily& plane_stress_laws();                  \
  const mpm_kernel::LawFamily& plane_strain_laws();                  \
  const mpm_kernel::LawFamily& axisymmetric_laws();                  \
  const mpm_kernel::LawFamily& solid_laws();                         \
  const mpm_kernel::SweepFamily& soil_sweeps();                      \
  }
MPM_DECLARE_KERNELS(mpm_plain)
MPM_DECLARE_KERNELS(mpm_avx2)
MPM_DECLARE_KERNELS(mpm_avx512)

namespace mpm {
namespace {

#if defined(MPM_PLAIN_KERNELS)
#define MPM_PLAIN(name) mpm_plain::name
#else
#define MPM_PLAIN(name) nullptr
#endif
#if defined(MPM_AVX2_KERNELS)
#define MPM_AVX2(name) mpm_avx2::name
#else
#define MPM_AVX2(name) nullptr
#endif
#if defined(MPM_AVX512_KERNELS)
#define MPM_AVX512(name) mpm_avx512::name
#else
#define MPM_AVX512(name) nullptr
#endif
#define MPM_KERNELS(name) \
  { MPM_PLAIN(name), MPM_AVX2(name), MPM_AVX512(name) }
/// Tables of a shape function, by instruction set: its passes and, of a product along the axes, what makes its weights.
struct ShapeTables {
  const mpm_kernel::PassFamily& (*passes[3])();
  const mpm_kernel::ShapeFamily& (*shape[3])();
};
constexpr ShapeTables kShapes[] = {{MPM_KERNELS(stencil3_passes), MPM_KERNELS(dirac_shape)},
                                   {MPM_KERNELS(stencil3_passes), MPM_KERNELS(ugimp_shape)},
                                   {MPM_KERNELS(stencil3_passes), MPM_KERNELS(ugimp_stretch_shape)},
                                   {MPM_KERNELS(cpdi_passes), {}},
                                   {MPM_KERNELS(qcpdi_passes), {}},
                                   {MPM_KERNELS(stencil3_passes), MPM_KERNELS(bspline2_shape)},
                                   {MPM_KERNELS(stencil5_passes), MPM_KERNELS(bspline3_shape)}};
constexpr ShapeTables kAxisymmetricShapes[] = {
    {MPM_KERNELS(axisymmetric_stencil3_passes), MPM_KERNELS(axisymmetric_dirac_shape)},
    {MPM_KERNELS(axisymmetric_stencil3_passes), MPM_KERNELS(axisymmetric_ugimp_shape)},
    {MPM_KERNELS(axisymmetric_stencil3_passes), MPM_KERNELS(axisymmetric_ugimp_stretch_shape)},
    {MPM_KERNELS(axisymmetric_cpdi_passes), {}},
    {MPM_KERNELS(axisymmetric_qcpdi_passes), {}}};
constexpr const mpm_kernel::LawFamily& (*kLaws[][3])() = {MPM_KERNELS(line_laws), MPM_KERNELS(plane_strain_laws),
                                                          MPM_KERNELS(plane_stress_laws),
                                                          MPM_KERNELS(axisymmetric_laws), MPM_KERNELS(solid_laws)};

constexpr const mpm_kernel::SweepFamily& (*kSweeps[3])() = MPM_KERNELS(soil_sweeps);

const mpm_kernel::KernelTable<double>& of(const mpm_kernel::PassFamily& family, int axes, double) {
  return family.in_double[axes - 1];
}
const mpm_kernel::KernelTable<float>& of(const mpm_kernel::PassFamily& family, int axes, float) {
  return family.in_single[axes - 1];
}
const mpm_kernel::ShapeKernels<double>& of(const mpm_kernel::ShapeFamily& family, int axes, double) {
  return family.in_double[axes - 1];
}
const mpm_kernel::ShapeKernels<float>& of(const mpm_kernel::ShapeFamily& family, int axes, float) {
  return family.in_single[axes - 1];
}
const mpm_kernel::LawKernels<double>* of(const mpm_kernel::LawFamily& family, double) { return family.in_double; }
const mpm_kernel::LawKernels<float>* of(const mpm_kernel::LawFamily& family, float) { return family.in_single; }

mpm_kernel::CellKind cell_kind(GeometryKind geometry) {
  if (axisymmetric(geometry)) return mpm_kernel::CellKind::rings;
  return dimensions(geometry) == 3 ? mpm_kernel::CellKind::space : mpm_kernel::CellKind::plane;
}

}  // namespace

template <class T>
mpm_kernel::KernelTable<T> kernel_table(ShapeKind shape, GeometryKind geometry, Isa isa) {
  if (!has_shape(shape, geometry)) return {};
  const int set = static_cast<int>(isa), axes = dimensions(geometry);
  const ShapeTables& tables = (axisymmetric(geometry) ? kAxisymmetricShapes : kShapes)[static_cast<int>(shape)];
  mpm_kernel::KernelTable<T> table = of(tables.passes[set](), axes, T());
  if (tables.shape[set] != nullptr) table.shape = &of(tables.shape[set](), axes, T());
  table.laws = of(kLaws[static_cast<int>(geometry)][set](), T());
  return table;
}

template <>
const mpm_kernel::SweepTable<double>& sweep_table<double>(Isa isa, GeometryKind geometry) {
  return kSweeps[static_cast<int>(isa)]().in_double[static_cast<int>(cell_kind(geometry))];
}
template <>
const mpm_kernel::SweepTable<float>& sweep_table<float>(Isa isa, GeometryKind geometry) {
  return kSweeps[static_cast<int>(isa)]().in_single[static_cast<int>(cell_kind(geometry))];
}

template mpm_kernel::KernelTable<double> kernel_table<double>(ShapeKind, GeometryKind, Isa);
template mpm_kernel::KernelTable<float> kernel_table<float>(ShapeKind, GeometryKind, Isa);

}  // namespace mpm
