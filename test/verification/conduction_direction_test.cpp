// A material that conducts by a tensor: the same wave of temperature along the grid and turned by 30 degrees.
//
// Exact: T = sin(k s) exp(-(n.K n) k^2 t / (rho C)), s along the unit vector n, for any tensor K; the rim of a square
// is held at it. Where n is no principal axis the flux is oblique to it, and its part across the wave has no
// divergence. Source: the heat equation (Carslaw and Jaeger (1959), 1.20).
#include <fmt/core.h>

#include "mpm/math/constants.hpp"
#include "page.hpp"
#include "transport_run.hpp"

namespace verification {
namespace conduction_direction_test {

using mpm::kPi;
constexpr double kAlong = 5.0, kAcross = 1.0;  // conductivity over density and heat capacity [m^2/s]
constexpr double kEnd = 0.02;

struct Wave {
  double amplitude = 0.0;  ///< over the exact one
  double rms = 0.0;        ///< over the amplitude that is left
};

/// The tensor's first axis at `tensor` from x, the wave's direction at `normal`; both [degrees].
Wave decay(double tensor, double normal, const std::string& shape) {
  const double a = tensor * kPi / 180.0, b = normal * kPi / 180.0, k = kPi;
  const double xx = kAlong * std::cos(a) * std::cos(a) + kAcross * std::sin(a) * std::sin(a);
  const double zz = kAlong * std::sin(a) * std::sin(a) + kAcross * std::cos(a) * std::cos(a);
  const double xz = (kAlong - kAcross) * std::sin(a) * std::cos(a);
  const double nx = std::cos(b), nz = std::sin(b), rate = (xx * nx * nx + zz * nz * nz + 2.0 * xz * nx * nz) * k * k;
  const std::string wave = fmt::format("2 + sin({:.17g}*x + {:.17g}*z)", k * nx, k * nz);
  const std::string held = fmt::format("2 + sin({:.17g}*x + {:.17g}*z)*exp(-{:.17g}*t)", k * nx, k * nz, rate);
  const auto rim = [&](const std::string& box) { return "{region: {box: " + box + "}, value: '" + held + "'}"; };
  mpm::Simulation simulation = start(
      "anisotropic_plate",
      {"method.shape=" + shape,
       fmt::format("materials.wood.conductivity=[{:.17g}, 1000, {:.17g}, 0, {:.17g}, 0]", 1e3 * xx, 1e3 * zz, 1e3 * xz),
       "transport.temperature.initial='" + wave + "'",
       "transport.temperature.values=[" + rim("{min: [-0.1, -0.1], max: [0, 1.1]}") + ", " +
           rim("{min: [1, -0.1], max: [1.1, 1.1]}") + ", " + rim("{min: [-0.1, -0.1], max: [1.1, 0]}") + ", " +
           rim("{min: [-0.1, 1], max: [1.1, 1.1]}") + "]"},
      1);
  run_until(simulation, kEnd);
  expect_balance(simulation, "temperature");
  const Numbers x = field(simulation, "x"), z = field(simulation, "z"), t = field(simulation, "temperature");
  const double left = std::exp(-rate * kEnd);
  Wave result;
  double with = 0.0, own = 0.0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    const double one = std::sin(k * (nx * x[p] + nz * z[p]));
    with += one * (t[p] - 2.0) / left;
    own += one * one;
  }
  result.amplitude = with / own;
  result.rms = misfit(t, [&](std::size_t p) { return 2.0 + left * std::sin(k * (nx * x[p] + nz * z[p])); }).rms / left;
  return result;
}

TEST(ConductionDirection, TurnedTensor) {
  Page page("transport", "anisotropic_plate", "A plate that conducts better along one direction");
  page.problem(
          "A square of 20 by 20 cells conducts five times as well along one direction as across it. Half a wave of "
          "temperature along that direction decays to 0.37; direction and wave are along the grid, or turned by "
          "30°; or the wave is along the grid and the tensor turned. The rim is held at the exact values.")
      .exact("T = sin(k n·x) exp(-(n·Kn)k²t/(ρC)).", "the heat equation with a tensor")
      .scene("anisotropic_plate");
  for (const std::string shape : {"ugimp", "cpdi"}) {
    const Wave aligned = decay(0.0, 0.0, shape), turned = decay(30.0, 30.0, shape), oblique = decay(30.0, 0.0, shape);
    page.near("amplitude over the exact one, along the grid, " + shape, aligned.amplitude, 1.0, 0.01, "");
    page.near("amplitude, turned by 30°, over that along the grid, " + shape, turned.amplitude / aligned.amplitude, 1.0,
              0.01, "");
    page.near("amplitude over the exact one, the tensor turned alone, " + shape, oblique.amplitude, 1.0, 0.01, "");
    page.near_absolute("root mean square error, turned, " + shape, 100.0 * turned.rms, 0.0, 1.0, "% of the amplitude");
    page.near_absolute("root mean square error, tensor alone, " + shape, 100.0 * oblique.rms, 0.0, 1.0,
                       "% of the amplitude");
  }
  page.meaning("The direction in which a material conducts need not be one of the grid's.");
}

}  // namespace conduction_direction_test
}  // namespace verification
