// The kernels of every shape function against the reference (kernel_check.hpp): on every instruction set of this
// machine, in all kinds of geometry and both precisions, for every arrangement of particles, every transfer, and the
// passes that only some scenes need. Laws and shape functions are independent of each other, so two laws are enough,
// one of them with a history; kernels_test.cpp has all of them.
#include "kernel_check.hpp"
#include "kernel_transfers.hpp"
#include "step_scene.hpp"

namespace mpm::test {
namespace kernel_shapes_test {

struct Case {
  ShapeKind shape;
  Isa isa;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Isa isa : available_isas()) {
    for (const ShapeKind shape : kAllShapes) all.push_back({shape, isa});
  }
  return all;
}

class KernelShapesTest : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Cases, KernelShapesTest, testing::ValuesIn(cases()), [](const auto& info) {
  return std::string(shape_name(info.param.shape)) + "_" + isa_name(info.param.isa);
});

template <class Geometry, class T>
void check_shape(const Case& of) {
  if (!has_shape(of.shape, kGeometryKind<Geometry>)) GTEST_SKIP() << "there is no such shape function in this geometry";
  const auto zoo = paths::zoo();
  const paths::Specimen specimens[] = {zoo[2], zoo[8]};  // neo-Hookean, metal
  int n = 0;
  for (const Places places : kAllPlaces) {
    for (const bool regather : {false, true}) {
      Kernels<Geometry, T>(of.shape, specimens[n % 2], places, of.isa, kAllTransfers[n % 5]).check(regather);
      ++n;
    }
  }
  for (const Places places : {Places::mixed, Places::bodies}) {
    Kernels<Geometry, T>(of.shape, zoo[2], places, of.isa, flip(1.0), true).check(true);
  }
  for (const Places places : {Places::bodies, Places::loose, Places::walled}) {
    Kernels<Geometry, T>(of.shape, zoo[2], places, of.isa, kAllTransfers[4]).check_moves();
    KernelTransfers<Geometry, T>(of.shape, zoo[2], places, of.isa).check();
    Kernels<Geometry, T>(of.shape, zoo[2], places, of.isa, flip(1.0)).project();
  }
  if ((of.shape == ShapeKind::cpdi || of.shape == ShapeKind::qcpdi) && Geometry::kDim > 1) {
    Kernels<Geometry, T>(of.shape, zoo[2], Places::loose, of.isa, flip(1.0)).check_outgrown();
  }
}

TEST_P(KernelShapesTest, OfASolidInDouble) { check_shape<Solid, double>(GetParam()); }
TEST_P(KernelShapesTest, OfAPlaneInDouble) { check_shape<PlaneStrain, double>(GetParam()); }
TEST_P(KernelShapesTest, OfASolidInSingle) { check_shape<Solid, float>(GetParam()); }
TEST_P(KernelShapesTest, OfAPlaneInSingle) { check_shape<PlaneStrain, float>(GetParam()); }
TEST_P(KernelShapesTest, OfALineInDouble) { check_shape<Line, double>(GetParam()); }
TEST_P(KernelShapesTest, OfALineInSingle) { check_shape<Line, float>(GetParam()); }
TEST_P(KernelShapesTest, OfRingsInDouble) { check_shape<Axisymmetric, double>(GetParam()); }
TEST_P(KernelShapesTest, OfRingsInSingle) { check_shape<Axisymmetric, float>(GetParam()); }

// The rules of the axis that exist for comparison: planar functions, with which nothing else changes; domains that
// reach across the axis, whose nodes can have a mass near or below zero, so that only values can be compared; the mean
// motion.
template <class T>
void check_axis_rules(const Case& of) {
  if (!has_shape(of.shape, GeometryKind::axisymmetric)) GTEST_SKIP() << "there is no such shape function about an axis";
  using Rings = Kernels<Axisymmetric, T>;
  const paths::Specimen rubber = paths::zoo()[2];
  const AxisRules planar{AxisDomains::fitted, AxisFunctions::planar, AxisGhosts::free, AxisMotion::mean};
  const AxisRules whole{AxisDomains::whole, AxisFunctions::weighted, AxisGhosts::free, AxisMotion::mean};
  const AxisRules mean{AxisDomains::fitted, AxisFunctions::weighted, AxisGhosts::zero, AxisMotion::mean};
  for (const Places places : {Places::irregular, Places::loose}) {
    for (const Transfer& transfer : kAllTransfers) {
      Rings(of.shape, rubber, places, of.isa, transfer, false, planar).check(true);
      Rings(of.shape, rubber, places, of.isa, transfer, false, mean).check(true);
    }
    for (const AxisRules& axis : {planar, whole}) {
      KernelTransfers<Axisymmetric, T>(of.shape, rubber, places, of.isa, axis)
          .check(axis.domains == AxisDomains::fitted);
      Rings(of.shape, rubber, places, of.isa, flip(1.0), false, axis).project();
    }
  }
}
TEST_P(KernelShapesTest, OfOtherRulesAtTheAxisInDouble) { check_axis_rules<double>(GetParam()); }
TEST_P(KernelShapesTest, OfOtherRulesAtTheAxisInSingle) { check_axis_rules<float>(GetParam()); }

}  // namespace kernel_shapes_test
}  // namespace mpm::test
