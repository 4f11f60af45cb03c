// The kernels of uGIMP against the reference (kernel_check.hpp): on every instruction set of this machine, in both
// geometries and precisions, for every law and every arrangement of particles that takes another path through them.
#include "kernel_check.hpp"

namespace mpm::test {
namespace kernels_test {

template <class Geometry, class T>
void check_all(Isa isa) {
  const auto zoo = paths::zoo();
  for (std::size_t m = 0; m < zoo.size(); ++m) {
    for (const Places places : kAllPlaces) {
      const double flips[] = {1.0, 0.95, 0.0};
      Kernels<Geometry, T>(ShapeKind::ugimp, zoo[m], places, isa, flip(flips[m % 3])).check(false);
      Kernels<Geometry, T>(ShapeKind::ugimp, zoo[m], places, isa, flip(flips[(m + 1) % 3])).check(true);
    }
  }
}

class KernelsTest : public testing::TestWithParam<Isa> {};
INSTANTIATE_TEST_SUITE_P(Isas, KernelsTest, testing::ValuesIn(available_isas()),
                         [](const auto& info) { return isa_name(info.param); });

TEST_P(KernelsTest, OfASolidInDouble) { check_all<Solid, double>(GetParam()); }
TEST_P(KernelsTest, OfAPlaneInDouble) { check_all<PlaneStrain, double>(GetParam()); }
TEST_P(KernelsTest, OfASolidInSingle) { check_all<Solid, float>(GetParam()); }
TEST_P(KernelsTest, OfAPlaneInSingle) { check_all<PlaneStrain, float>(GetParam()); }

}  // namespace kernels_test
}  // namespace mpm::test
