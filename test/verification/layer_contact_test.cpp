// The exact solution of the punch and sphere tests, compared with solutions that are known in closed form.
#include "layer_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mpm/math/constants.hpp"

namespace verification {
namespace layer_contact_test {

using mpm::kPi;
// The sum over wave numbers ends at 150 / radius; its remainder is estimated by a mean, with an error of about 1e-5.
constexpr double kEndOfSum = 1e-4;

TEST(LayerContact, HalfSpace) {
  // Boussinesq: F = 2 E* a delta, p = F / (2 pi a sqrt(a^2 - r^2)). Hertz: F = 4 E* a^3 / (3 R), delta = a^2 / R,
  // p = 2 E* sqrt(a^2 - r^2) / (pi R). Numbers: E = 1 MPa, nu = 0.3, a = 0.1, R = 1 (exact-solutions 12 and 13).
  const ElasticBlock half_space{1e6, 0.3};
  const LayerContact contact(half_space, ToolShape::circular, 0.1);
  const PressedTool punch = contact.flat_punch(1e-3);
  EXPECT_NEAR(punch.force, 219.780, kEndOfSum * 219.780);
  EXPECT_NEAR(punch.pressure(0.05), 219.780 / (2.0 * kPi * 0.1 * std::sqrt(0.0075)), 1.0);
  const PressedTool sphere = contact.paraboloid(1.0);
  EXPECT_NEAR(sphere.force, 1465.20, 2.0 * kEndOfSum * 1465.20);
  EXPECT_NEAR(sphere.approach, 0.01, 2.0 * kEndOfSum * 0.01);
  EXPECT_NEAR(sphere.pressure(0.0), 69958.0, 1e-3 * 69958.0);
}

TEST(LayerContact, LineLoadOnAHalfPlane) {
  // Hertz: a = sqrt(4 P R / (pi E*)), with P = 1000 N/m and R = 1 m: a = 0.034039 m, p0 = 18702.7 Pa
  // (exact-solutions 12). A layer of a thousand half widths is the half plane: its force differs by (a / H)^2.
  const ElasticBlock deep{1e6, 0.3, 34.0};
  const PressedTool roller = LayerContact(deep, ToolShape::strip, 0.034039).paraboloid(1.0);
  EXPECT_NEAR(roller.force, 1000.0, 1.0);
  EXPECT_NEAR(roller.pressure(0.0), 18702.7, 20.0);
}

TEST(LayerContact, ThickLayer) {
  // Far from the tool its pressure acts as a single force: the layer lowers the deflection under the tool by
  // F (1/(pi E* H)) I, I = integral of 1 - K(u) over u = 1.168; so F = 2 E* a delta / (1 - 2 I a / (pi H)), with an
  // error of (a / H)^3. I: Vorovich, Aleksandrov and Babeshko (1974).
  const ElasticBlock layer{1e6, 0.3, 20.0};
  const double half_space = 2.0 * layer.plane_modulus() * 1e-3;
  const double force = LayerContact(layer, ToolShape::circular, 1.0).flat_punch(1e-3).force;
  EXPECT_NEAR(force / half_space, 1.0 / (1.0 - 2.0 * 1.168 / (kPi * 20.0)), 2e-4);
}

TEST(LayerContact, ThinLayer) {
  // A strip at least four thicknesses wide has the stiffness E* / H away from its edges, and the two edges do not
  // influence each other: the force grows by 2 E* delta (difference of a) / H.
  const ElasticBlock layer{1e6, 0.3, 1.0};
  const double narrow = LayerContact(layer, ToolShape::strip, 4.0, 8).flat_punch(1e-3).force;
  const double wide = LayerContact(layer, ToolShape::strip, 8.0, 8).flat_punch(1e-3).force;
  const double growth = 2.0 * layer.plane_modulus() * 1e-3 * 4.0;
  EXPECT_NEAR(wide - narrow, growth, kEndOfSum * growth);
}

TEST(LayerContact, RowOfStrips) {
  // A row of strip punches with period w on a half plane: p = (F / w) sqrt(2) cos(pi x / w) /
  // sqrt(cos(2 pi x / w) - cos(2 pi a / w)) (Westergaard (1939)). A block of five periods' height has K = 1 to
  // round-off.
  const ElasticBlock block{1e6, 0.3, 10.0, 1.0};
  const double w = 2.0, a = 0.5;
  const PressedTool punch = LayerContact(block, ToolShape::strip, a, 6).flat_punch(1e-3);
  for (const double x : {0.0, 0.2, 0.4}) {
    const double exact = punch.force / w * std::sqrt(2.0) * std::cos(kPi * x / w) /
                         std::sqrt(std::cos(2.0 * kPi * x / w) - std::cos(2.0 * kPi * a / w));
    // The series of the pressure converges slower than the force: 1e-3 with six terms.
    EXPECT_NEAR(punch.pressure(x), exact, 1e-3 * exact) << x;
  }
}

TEST(LayerContact, Block) {
  const auto force = [](double height, double half_length) {
    const ElasticBlock block{1e6, 0.3, height, half_length};
    return LayerContact(block, ToolShape::circular, 0.1).flat_punch(1e-3).force;
  };
  // Walls twenty radii away change the layer only by the ratio of the tool's area to that of the block, 1e-3.
  const double layer = force(0.2, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(force(0.2, 2.0), layer, 1e-3 * layer);
  // A layer ten radii deep is 1 / (1 - 2 1.168 / (10 pi)) = 1.080 times as stiff as the half space, an error of 1e-3 in
  // that (see ThickLayer); walls at ten radii prevent expansion and stiffen it further.
  EXPECT_NEAR(force(1.0, std::numeric_limits<double>::infinity()) / 219.780, 1.080, 2e-3);
  EXPECT_GT(force(1.0, 1.0) / 219.780, 1.080);
}

TEST(LayerContact, RoundBlock) {
  const auto force = [](double height, double half_length, bool round) {
    const ElasticBlock block{1e6, 0.3, height, half_length, round};
    return LayerContact(block, ToolShape::circular, 0.1).flat_punch(1e-3).force;
  };
  // A wall twenty radii away changes the layer only by the ratio of the tool's area to that of the block, 2.5e-3.
  const double layer = force(0.2, std::numeric_limits<double>::infinity(), false);
  EXPECT_NEAR(force(0.2, 2.0, true), layer, 2.5e-3 * layer);
  // A round block is stiffer than the square around it, and nearly as stiff as the square of the same area: the walls
  // act mainly through the mean deflection, which depends on the area alone. Here this is a fifth of the stiffness, and
  // the corners change a part of it.
  const double kEqualArea = 0.5 * std::sqrt(kPi);
  const double square = force(0.2, 0.2 * kEqualArea, false), round = force(0.2, 0.2, true);
  EXPECT_GT(round, force(0.2, 0.2, false));
  EXPECT_NEAR(round, square, 0.01 * square);
  // A punch on the whole face of the block is the oedometer: F = E (1 - nu) / ((1 + nu)(1 - 2 nu)) A delta / H.
  const double all = LayerContact({1e6, 0.3, 0.2, 0.1, true}, ToolShape::circular, 0.1, 6).flat_punch(1e-3).force;
  const double oedometer = 1e6 * 0.7 / (1.3 * 0.4) * kPi * 0.01 * 1e-3 / 0.2;
  EXPECT_NEAR(all, oedometer, kEndOfSum * oedometer);
}

}  // namespace layer_contact_test
}  // namespace verification
