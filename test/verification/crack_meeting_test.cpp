// J and stress intensities of a crack in a body that expands or has water in its pores: the strip of
// crack_edge_test.cpp under the same load, in which what the other physics does is known.
//
// K is load controlled and depends on no elastic constant: 2.8245 sigma sqrt(pi a) (crack reference 7.4) with a scale
// for a = 10.1 mm, 5113 Pa m^0.5. J = K^2 / E' with the constants that the material has: undrained ones where water
// cannot leave. A strip that is free to expand bears no stress under an even temperature, nor under one, or a pressure,
// that is linear across it. Bounds: K as in crack_edge_test.cpp is half a per cent low on 10 cells, J one; 2 % of J as
// measured by contours of any size there. A strip of 20 cells takes about 2 s; Cost: 30 s in all.
#include "crack_case.hpp"

namespace verification {
namespace crack_meeting_test {

using namespace crack_case;

constexpr double kIntensity = 5113.0;  // [Pa m^0.5]

struct Physics {
  std::string geometry = "plane_strain", law = "linear_elastic", constants, transport;
  int size = 3;
  double load = 1e4;  // [Pa]
};

Tip pull(const Physics& physics) {
  std::string text = fmt::format(
      "geometry: {}\nthickness: 1e-3\ngrid: {{cell: 1e-3, min: [-4e-3, -35e-3], max: [24e-3, 36e-3]}}\n"
      "time: {{end: 1.2e-3, cfl: 0.6, sync: 1e-4}}\n"
      "method: {{shape: ugimp, update: usavg, transfer: flip, damping: {{grid: 2e4}}}}\n"
      "materials: [{{name: polymer, law: {}, density: 1000, young: 2.5e9, poisson: 0.33, {}}}]\n",
      physics.geometry, physics.law, physics.constants);
  text += body(0.0, -0.031, 0.02, 0.032);
  text += "loads:\n" + traction("z_max", ramped(physics.load, 3e-4)) + traction("z_min", ramped(-physics.load, 3e-4));
  text += fmt::format(
      "transport: {}\ncracks:\n  contour: {{size: {}}}\n"
      "  list: [{{name: notch, points: [[0.3e-3, 0.5e-3], [10.1e-3, 0.5e-3]], start: exterior, end: tip}}]\n",
      physics.transport, physics.size);
  mpm::Simulation simulation = made(text);
  run_until(simulation, 1.2e-3);
  return tip(simulation, "end");
}

std::string heated(const std::string& rise) {
  return fmt::format(
      "{{temperature: {{compression_heat: off, initial: 300, sources: "
      "[{{ramp: \"300+20*({})*(t<0.3e-3 ? 0.5-0.5*cos(pi*t/0.3e-3) : 1)\"}}]}}}}",
      rise);
}

constexpr const char* kHeat = "heat_capacity: 1000, conductivity: 0, thermal_expansion: 2e-6";

// b = 0.8, S = 2e-10 / Pa: K_u = K + b^2 / S = 5.651 GPa, G = 0.9398 GPa, nu_u = 0.4212 and
// E_u = 2.6714 GPa, so that J = K^2 (1 - nu_u^2) / E_u = 8.05e-3 J/m^2.
TEST(CrackMeeting, UndrainedWaterStiffensTheBody) {
  const Tip tip = pull({"plane_strain", "linear_elastic", "storage: 2e-10, biot: 0.8", "{pore_pressure: {}}"});
  EXPECT_NEAR(tip.one, kIntensity, 0.025 * kIntensity);  // stiff to changes of volume: 2.2 % low on these cells
  EXPECT_NEAR(tip.j, 8.05e-3, 0.04 * 8.05e-3);
}

// Drained, though so slowly that the pressure stays: one that is linear across the strip bends it freely. The strain
// that it brings, b p / (3 K) = 2.6e-5 at p = 240 kPa, is seven times that of the load.
TEST(CrackMeeting, DrainedPressureWithASlopeBringsNothing) {
  const double j = kIntensity * kIntensity / kPlane;
  for (const int size : {3, 6}) {
    const Tip tip =
        pull({"plane_strain", "linear_elastic", "storage: 1e-6, biot: 0.8, permeability: 1e-24, viscosity: 1e-3",
              "{pore_pressure: {sources: [{ramp: \"2.4e5*(x/0.02)*(t<0.3e-3 ? 0.5-0.5*cos(pi*t/0.3e-3) : "
              "1)\"}]}}",
              size});
    EXPECT_NEAR(tip.one, kIntensity, 0.02 * kIntensity) << size;
    EXPECT_NEAR(tip.j, j, 0.03 * j) << size;
  }
}

// Even growth, by ten and a hundred times the strain of the load, against the same strip without. What grows by a
// hundredfold in 0.3 ms still swings a little.
TEST(CrackMeeting, EvenGrowthChangesNothing) {
  const Tip cold = pull({"plane_strain", "neo_hookean", kHeat, heated("0")});
  for (const auto& [rise, part] : {std::pair("1", 0.01), std::pair("10", 0.05)}) {
    const Tip warm = pull({"plane_strain", "neo_hookean", kHeat, heated(rise)});
    EXPECT_NEAR(warm.j, cold.j, part * cold.j) << rise;
    EXPECT_NEAR(warm.one, cold.one, part * cold.one) << rise;
  }
}

// Linear in x: the strip bends and bears no stress.
TEST(CrackMeeting, LinearTemperatureBringsNothing) {
  const double j = kIntensity * kIntensity / kYoung;
  for (const int size : {3, 6}) {
    const Tip tip = pull({"plane_stress", "linear_elastic", kHeat, heated("x/0.02"), size});
    EXPECT_NEAR(tip.j, j, 0.02 * j) << size;
    EXPECT_NEAR(tip.one, kIntensity, 0.015 * kIntensity) << size;
  }
}

// K of an edge crack by the weight function of H. F. Bueckner (1970), Z. angew. Math. Mech. 50, 529-546, for a / width
// up to 0.5; stress(x / width) [Pa], depth `a` and `width` [m]. By the middles of equal parts of sqrt(1 - x / a).
template <class Stress>
double intensity_of(double a, double width, Stress&& stress) {
  constexpr int kParts = 1000;
  const double r2 = std::pow(a / width, 2), r6 = r2 * r2 * r2;
  const double first = 0.6147 + 17.1844 * r2 + 8.7822 * r6, second = 0.2502 + 3.2889 * r2 + 70.0444 * r6;
  double sum = 0.0;
  for (int i = 0; i < kParts; ++i) {
    const double u = std::pow((i + 0.5) / kParts, 2);  // 1 - x / a
    sum += stress(a * (1.0 - u) / width) * (1.0 + first * u + second * u * u);
  }
  return 4.0 * std::sqrt(a / (2.0 * M_PI)) * sum / kParts;
}

// Colder by a parabola, without a load: the strip would have the stress E alpha dT (x^2 - x + 1/6), x over the width,
// which the notch cuts. K is alike on all contours and 4 % low; on cells of half the size it is 1 % low. J is the
// difference of terms that are many times as large, and its contour should be the widest there is.
TEST(CrackMeeting, ParabolaOfTemperatureOpensANotch) {
  const double exact = intensity_of(0.0101, 0.02, [](double x) { return 2.5e9 * 4e-5 * (x * x - x + 1.0 / 6.0); });
  Tip tips[2];
  for (const int i : {0, 1}) {
    tips[i] = pull({"plane_stress", "linear_elastic", kHeat, heated("-(x/0.02)^2"), i == 0 ? 4 : 6, 0.0});
    EXPECT_NEAR(tips[i].one, 0.963 * exact, 0.02 * exact);
  }
  EXPECT_NEAR(tips[0].one, tips[1].one, 0.01 * exact);
  EXPECT_NEAR(tips[1].j, 0.84 * exact * exact / kYoung, 0.04 * exact * exact / kYoung);
}

}  // namespace crack_meeting_test
}  // namespace verification
