// Two equal cracks in line, |x| from b to a, in a plate in tension: J at the tips that face each other, on contours
// that keep away from the other tip, and tips that grow towards each other until no contour goes between them.
//
// Exact, in an infinite plate: K_I(b) = s sqrt(pi / b) (c^2 - b^2) / sqrt(a^2 - b^2), K_I(a) = s sqrt(pi / a)
// (a^2 - c^2) / sqrt(a^2 - b^2), c^2 = a^2 E(k) / K(k), k^2 = 1 - b^2 / a^2: Westergaard's stress function
// s (z^2 - c^2) / sqrt((z^2 - a^2) (z^2 - b^2)), with c such that each crack closes. Source: T. J. Willmore (1949), Q.
// J. Mech. Appl. Math. 2, 53-63; H. Tada, P. C. Paris, G. R. Irwin, The Stress Analysis of Cracks Handbook.
#include "crack_case.hpp"
#include "page.hpp"

namespace verification {
namespace crack_pair_test {

using namespace crack_case;

constexpr double kCell = 1e-3, kStress = 1e4;  // [m], [Pa]

double k_of(double inner, double outer, bool at_inner) {
  const double k = std::sqrt(1.0 - inner * inner / (outer * outer));
  const double zero = outer * outer * std::comp_ellint_2(k) / std::comp_ellint_1(k);
  const double place = at_inner ? inner : outer, over = at_inner ? zero - inner * inner : outer * outer - zero;
  return kStress * std::sqrt(kHalfTurn / place) * over / std::sqrt(outer * outer - inner * inner);
}

/// Cracks of 10 cells each whose near tips are `gap` cells apart; those tips lie a tenth of a cell from a node, beyond
/// it as the crack goes; `far`: what the other ends are. A plate of 120 by 121 cells.
mpm::Simulation pull(double gap, double periods, const std::string& far, const std::string& growth = "",
                     const std::string& fracture = "") {
  const double h = kCell, half = 60 * h, period = 4.0 * half / kBarSpeed;
  const double sync = sync_of(periods * period, 40), end = 40 * sync;
  std::string text = head(h, {-half - 4 * h, -half - 4 * h, half + 4 * h, half + 5 * h}, end, sync,
                          0.9 * 2 * kHalfTurn / period, fracture) +
                     body(-half, -half, half, half + h);
  text +=
      "loads:\n" + traction("z_max", ramped(kStress, 0.6 * period)) + traction("z_min", ramped(-kStress, 0.6 * period));
  const double b = 0.5 * gap * h, a = b + 10 * h;
  text += fmt::format(
      "cracks:\n{0}  list:\n    - {{name: left, points: [[{1:.12g}, {2:.12g}], [{3:.12g}, {2:.12g}]], start: {6}, "
      "end: tip}}\n"
      "    - {{name: right, points: [[{4:.12g}, {2:.12g}], [{5:.12g}, {2:.12g}]], start: tip, end: {6}}}\n",
      growth, -a, 0.5 * h, -b, b, a, far);
  mpm::Simulation simulation = made(text);
  run_until(simulation, end);
  return simulation;
}

// About 30 s.
TEST(CrackPair, TipsThatFaceEachOther) {
  Page page("crack", "crack_pair", "Two cracks in line");
  page.problem(
          "Two cracks of 10 mm each lie in line in a plate 120 mm wide and 121 mm high, which is pulled by 10 kPa; "
          "their "
          "near tips are 7.8, 5.8 and 3.8 mm apart. Cells of 1 mm, contours of 3 cells.")
      .exact("K_I at the near and the far tips by elliptic integrals; J = K²/E'.", "Willmore (1949)")
      .meaning(
          "The contour at a near tip keeps away from the other one. Without that J there would be next to nothing as "
          "soon as both lie in one contour.");
  for (const double gap : {7.8, 5.8, 3.8}) {
    const mpm::Simulation simulation = pull(gap, 2.0, "tip");
    for (const bool near : {true, false}) {
      const double inner = 0.5 * gap * kCell, outer = inner + 10 * kCell, h = 0.15 * kCell;
      const double exact = std::pow(k_of(inner, outer, near), 2) / kPlane;
      // A tip off by 0.15 cells (crack reference 2.3), and 2 % of a contour of two cells (4.2) with the width of the
      // plate.
      const double moved = std::pow(near ? k_of(inner - h, outer, true) : k_of(inner, outer + h, false), 2) / kPlane;
      for (const auto& [crack, end] :
           {std::pair<int, std::string>{1, near ? "end" : "start"}, {2, near ? "start" : "end"}}) {
        page.near(fmt::format("J, {} tip of crack {}, {} mm apart", near ? "near" : "far", crack, gap),
                  number(simulation, fmt::format("crack {} {} j", crack, end)), exact, moved / exact - 1.0 + 0.02,
                  "J/m²");
      }
    }
  }
}

// Tips whose criterion needs J: they cannot know theirs any more and stop. About 25 s.
TEST(CrackPair, TipsThatMeetStop) {
  const double inner = 4.9 * kCell, j_ic = 0.3 * std::pow(k_of(inner, inner + 10 * kCell, true), 2) / kPlane;
  const mpm::Simulation simulation = pull(9.8, 1.0, "none", "  growth: {criterion: release_rate}\n",
                                          fmt::format(", fracture: {{j_ic: {:.6g}}}", j_ic));
  const std::vector<mpm::CrackTipReport> tips = simulation.crack_tips();
  ASSERT_EQ(tips.size(), 2u);
  for (const mpm::CrackTipReport& tip : tips) {
    EXPECT_NE(tip.growth.find("another tip is too near"), std::string::npos) << tip.growth;
    EXPECT_TRUE(tip.stopped);
    EXPECT_GT(tip.growths, 0);
  }
  // Steps of half a cell each, and a contour asks for two cells on its own side of a node and one beyond: it is there
  // down to 3 cells and, as nodes are up to half a cell from the tip, to 2.5 at least.
  const double gap = (tips[1].place.x() - tips[0].place.x()) / kCell;
  EXPECT_LT(gap, 3.5);
  EXPECT_GT(gap, 1.5);
}

}  // namespace crack_pair_test
}  // namespace verification
