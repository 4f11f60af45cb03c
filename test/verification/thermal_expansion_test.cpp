// Expansion with heat: a bar that is free, bars that are held, and a strip of two metals that bends.
//
// Free: the length grows by alpha dT and no stress arises. Held along one axis -E alpha dT, along two -E alpha dT /
// (1 - nu), along three -E alpha dT / (1 - 2 nu): Hooke's law with the strain alpha dT taken off (S. P. Timoshenko, J.
// N. Goodier, Theory of Elasticity, chapter 13). Two bonded strips of thickness h / 2 each, n the ratio of their
// moduli: curvature 24 (alpha_1 - alpha_2) dT / (h (14 + n + 1 / n)) (S. Timoshenko (1925), J. Opt. Soc. Am. 11,
// 233-255). Cost: 6 s.
#include <fmt/core.h>

#include "page.hpp"
#include "transport_run.hpp"

namespace verification {
namespace thermal_expansion_test {

constexpr double kYoung = 1e6, kPoisson = 0.3;  // numbers of warm_bar [Pa]
constexpr double kWarmed = 100.0, kEnd = 0.8;   // [K], [s]

std::vector<std::string> law_overrides(const std::string& law) {
  std::vector<std::string> list = {"materials.bar.law=" + law};
  if (law == "j2_plasticity") list.emplace_back("materials.bar.yield_stress=1e4");
  return list;
}

double largest(const mpm::Simulation& simulation, const std::vector<std::string>& names) {
  double most = 0.0;
  for (const std::string& name : names) {
    for (const double value : field(simulation, name)) most = std::max(most, std::abs(value));
  }
  return most;
}

TEST(ThermalExpansion, FreeBar) {
  Page page("transport", "free_bar", "A free bar that is warmed");
  page.problem("A bar of 4 x 2 x 2 cells, free, is warmed evenly by 100 K; α = 1e-7 and 1e-4 /K.")
      .exact("Grows by α ΔT along each axis (α ΔT of the start's length), no stress.", "definition of α")
      .scene("warm_bar");
  for (const std::string law : {"linear_elastic", "neo_hookean", "j2_plasticity"}) {
    for (const double alpha : {1e-7, 1e-4}) {
      std::vector<std::string> overrides = law_overrides(law);
      overrides.push_back(fmt::format("materials.bar.thermal_expansion={}", alpha));
      mpm::Simulation simulation = start("warm_bar", overrides, 1);
      const Numbers x0 = field(simulation, "x");
      run_until(simulation, kEnd);
      expect_balance(simulation, "temperature");
      const Numbers x = field(simulation, "x");
      const auto low = std::min_element(x0.begin(), x0.end()) - x0.begin(),
                 high = std::max_element(x0.begin(), x0.end()) - x0.begin();
      const double strain = (x[high] - x[low]) / (x0[high] - x0[low]) - 1.0;
      const std::string name = fmt::format(", {}, α = {:g}", law, alpha);
      if (alpha > 1e-5) {  // by now its faces lie in other cells than at the start
        page.report("strain over α ΔT" + name, strain / (alpha * kWarmed), "");
        page.report("largest stress over E α ΔT" + name,
                    largest(simulation, {"sxx", "syy", "szz", "sxz"}) / (kYoung * alpha * kWarmed), "");
        continue;
      }
      page.near("strain over α ΔT" + name, strain / (alpha * kWarmed), 1.0, 1e-6, "");
      page.below("largest stress over E α ΔT" + name,
                 largest(simulation, {"sxx", "syy", "szz", "sxz"}) / (kYoung * alpha * kWarmed), 1e-6, "");
    }
  }
  page.meaning("Free strain is taken off before a law sees the deformation: it brings no stress, however large it is.");
}

struct Holding {
  std::string name;
  std::vector<std::string> overrides;
  double stress;  ///< along x over E alpha dT
};

TEST(ThermalExpansion, HeldBar) {
  Page page("transport", "held_bar", "A held bar that is warmed");
  const std::vector<Holding> holdings = {
      {"solid, held along x",
       {"grid.min=[0, -0.2, -0.2]", "grid.max=[0.4, 0.4, 0.4]", "boundaries={x_min: slip, x_max: slip}"},
       -1.0},
      {"solid, held along all axes",
       {"grid.min=[0, 0, 0]", "grid.max=[0.4, 0.2, 0.2]", "boundaries={all: slip}"},
       -1.0 / (1.0 - 2.0 * kPoisson)},
      {"plane stress, held along x",
       {"geometry=plane_stress", "grid.min=[0, -0.2]", "grid.max=[0.4, 0.4]",
        "bodies.bar.shape.box={min: [0, 0], max: [0.4, 0.2]}", "boundaries={x_min: slip, x_max: slip}"},
       -1.0},
      {"plane strain, held along x",
       {"geometry=plane_strain", "grid.min=[0, -0.2]", "grid.max=[0.4, 0.4]",
        "bodies.bar.shape.box={min: [0, 0], max: [0.4, 0.2]}", "boundaries={x_min: slip, x_max: slip}"},
       -1.0 / (1.0 - kPoisson)},
      {"line, held at its ends",
       {"geometry=line", "grid.min=0", "grid.max=0.4", "bodies.bar.shape.box={min: 0, max: 0.4}",
        "boundaries={x_min: slip, x_max: slip}"},
       -1.0 / (1.0 - 2.0 * kPoisson)},
      // Here a ring of which only the length is held; its stress along z is what is compared.
      {"about an axis, held along z",
       {"geometry=axisymmetric", "grid.min=[0, 0]", "grid.max=[0.4, 0.4]",
        "bodies.bar.shape.box={min: [0, 0], max: [0.2, 0.4]}", "boundaries={z_min: slip, z_max: slip}"},
       -1.0}};
  page.problem(
          "A bar between smooth walls is warmed evenly by 100 K, α = 1e-7 /K: walls at the ends of one axis, two, "
          "or three.")
      .exact("-E α ΔT, -E α ΔT/(1 - ν), -E α ΔT/(1 - 2ν).", "Timoshenko and Goodier, Theory of Elasticity, chapter 13")
      .scene("warm_bar");
  for (const std::string law : {"linear_elastic", "neo_hookean", "j2_plasticity"}) {
    for (const Holding& holding : holdings) {
      std::vector<std::string> overrides = law_overrides(law);
      overrides.insert(overrides.end(), holding.overrides.begin(), holding.overrides.end());
      mpm::Simulation simulation = start("warm_bar", overrides, 1);
      run_until(simulation, kEnd);
      const bool ring = holding.name.rfind("about", 0) == 0;
      const Numbers stress = field(simulation, ring ? "szz" : "sxx");
      const double unit = kYoung * 1e-7 * kWarmed;
      const Misfit all = misfit(stress, [&](std::size_t) { return holding.stress * unit; });
      // Error of second order in the strain of 1e-5 times the moduli's ratios: 1e-4.
      page.near_absolute(holding.name + ", " + law + ": largest error of the stress over E α ΔT", all.most / unit, 0.0,
                         1e-4, "");
    }
  }
  // Warmed on and on, it yields at 0.3 of the stress that it would have.
  std::vector<std::string> yields = law_overrides("j2_plasticity");
  yields.insert(yields.end(), holdings[0].overrides.begin(), holdings[0].overrides.end());
  yields.emplace_back("materials.bar.yield_stress=3");
  yields.emplace_back("transport.temperature.sources=[{ramp: '300 + 100*t/0.8'}]");  // yields to the end
  mpm::Simulation simulation = start("warm_bar", yields, 1);
  run_until(simulation, kEnd);
  page.near("Mises stress of one that yields at 3 Pa", field(simulation, "mises").front(), 3.0, 1e-3, "Pa");
  page.meaning("Every law has the same free strain; what is held has the stress of the strain that is missing.");
}

/// Curvature of the half strip's middle over its height [1], by a parabola through its particles away from the end.
double curvature(const std::vector<std::string>& overrides) {
  mpm::Simulation simulation = start("bimetal_strip", overrides, 1);
  const Numbers x0 = field(simulation, "x"), z0 = field(simulation, "z");
  run_until(simulation, 300.0);
  expect_balance(simulation, "temperature");
  const Numbers z = field(simulation, "z");
  // u = a + b x^2 by least squares.
  double n = 0.0, s2 = 0.0, s4 = 0.0, u0 = 0.0, u2 = 0.0;
  for (std::size_t p = 0; p < x0.size(); ++p) {
    if (x0[p] > 3.5 || std::abs(z0[p] - 0.5) > 0.1) continue;
    const double xx = x0[p] * x0[p], u = z[p] - z0[p];
    n += 1.0, s2 += xx, s4 += xx * xx, u0 += u, u2 += u * xx;
  }
  return 2.0 * (n * u2 - s2 * u0) / (n * s4 - s2 * s2);
}

TEST(ThermalExpansion, BimetalStripBends) {
  Page page("transport", "bimetal_strip", "A strip of two metals bends");
  page.problem(
          "Two bonded layers of a strip ten times as long as high, in plane stress, half of it modelled; 8 cells "
          "over the height. α differs by 1e-5 /K, the upper one is twice as stiff; warmed by 100 K.")
      .exact("Curvature 24 Δα ΔT/(h (14 + n + 1/n)), n the ratio of the moduli.", "Timoshenko (1925)")
      .scene("bimetal_strip");
  const double exact = 24.0 * 1e-5 * 100.0 / (14.0 + 2.0 + 0.5);
  page.near("curvature times the height, uGIMP", 1e3 * curvature({}), 1e3 * exact, 0.03, "1e-3");
  page.near("the same, CPDI", 1e3 * curvature({"method.shape=cpdi"}), 1e3 * exact, 0.03, "1e-3");
  page.meaning("Bodies of one velocity field are bonded; a difference of free strain bends them.");
}

}  // namespace thermal_expansion_test
}  // namespace verification
