// A strip with a crack from one edge, in tension: K, J by contours of each size, where the tip and the line lie in a
// cell, and the same crack mirrored and listed backwards.
//
// K = F sigma sqrt(pi a), F = 2.8245 at a/W = 0.5. Source: crack reference 7.4 (finite elements converged to 1e-4);
// H. Tada, P. C. Paris, G. R. Irwin, The Stress Analysis of Cracks Handbook, 2.10-2.12.
// What a place in the cell does: crack reference 2.3, found there by solving the same equations for equilibrium.
// One strip of 20 cells takes about 2 s.
#include "crack_case.hpp"
#include "page.hpp"

namespace verification {
namespace crack_edge_test {

using namespace crack_case;

constexpr double kWidth = 0.02, kStress = 1e4;  // [m], [Pa]

/// Tada's formula, for the change with a/W alone; scaled to the figure of finite elements at 0.5.
double factor(double part) {
  const auto formula = [](double alpha) {
    const double q = 0.5 * kHalfTurn * alpha;
    return std::sqrt(std::tan(q) / q) * (0.752 + 2.02 * alpha + 0.37 * std::pow(1.0 - std::sin(q), 3)) / std::cos(q);
  };
  return 2.8245 * formula(part) / formula(0.5);
}

double intensity(double length) { return factor(length / kWidth) * kStress * std::sqrt(kHalfTurn * length); }

struct Strip {
  int cells = 20;
  int size = 3;            ///< size of the contour
  double tip = 0.1;        ///< beyond a node [cells]
  double line = 0.5;       ///< above a node [cells]
  bool left = true;        ///< the crack comes from the left
  bool upper = true;       ///< the line lies `line` above the node below it, else below the node above it
  bool backwards = false;  ///< the chain begins at the tip

  double cell() const { return kWidth / cells; }
  double length() const { return (cells / 2 + tip) * cell(); }
};

Tip pull(const Strip& strip) {
  const double h = strip.cell(), ramp = 0.3e-3, end = 1.2e-3;
  const int half = 3 * strip.cells / 2;
  const double line = strip.upper ? strip.line : 1.0 - strip.line;
  const auto at = [&](double x) { return fmt::format("[{:.17g}, {:.17g}]", strip.left ? x : kWidth - x, line * h); };
  const std::string mouth = at(0.3 * h), tip_place = at(strip.length());
  std::string text = head(h, {-4 * h, -(half + 4) * h, kWidth + 4 * h, (half + 5) * h}, end, sync_of(end, 12), 2e4);
  text += body(0.0, -half * h, kWidth, (half + 1) * h);
  text += "loads:\n" + traction("z_max", ramped(kStress, ramp)) + traction("z_min", ramped(-kStress, ramp));
  text +=
      fmt::format("cracks:\n  contour: {{size: {}}}\n  list: [{{name: notch, points: [{}, {}], start: {}, end: {}}}]\n",
                  strip.size, strip.backwards ? tip_place : mouth, strip.backwards ? mouth : tip_place,
                  strip.backwards ? "tip" : "exterior", strip.backwards ? "exterior" : "tip");
  mpm::Simulation simulation = made(text);
  run_until(simulation, end);
  return tip(simulation, strip.backwards ? "start" : "end");
}

double j_of(const Strip& strip) { return std::pow(intensity(strip.length()), 2) / kPlane; }

TEST(CrackEdge, StressIntensity) {
  EXPECT_NEAR(factor(0.5) * 10.0 * std::sqrt(kHalfTurn * 10.0), 158.3, 0.05);  // the reference's figure [MPa mm^0.5]
  Page page("crack", "crack_edge", "A strip with a crack from its edge");
  page.problem(
          "A strip 20 mm wide and 60 mm high is pulled at its ends by 10 kPa; a crack half across comes from one edge, "
          "midway between grid lines, and ends a tenth of a cell beyond a node. 20 cells across, 4 particles a cell; "
          "E = 2500 MPa, ν = 0.33, plane strain.")
      .exact("K = F σ √(πa), F = 2.8245 at a = W/2; J = K²/E'.",
             "finite elements converged to 1e-4; Tada, Paris and Irwin, The Stress Analysis of Cracks Handbook")
      .meaning(
          "K is half a per cent low on 10 cells of crack, with every contour from three cells on. A contour of two "
          "cells, which lies in the strip around the tip where shape functions smooth the field, loses one more.");
  const double exact = intensity(Strip{}.length()), j = j_of(Strip{});
  Numbers sizes, parts;
  for (const int size : {2, 3, 4, 6}) {
    Strip strip;
    strip.size = size;
    const Tip tip = pull(strip);
    sizes.push_back(size), parts.push_back(tip.j / j);
    // Reference 7.4: 0.99 to 1.00 for sizes 2 to 6; 4.2: sizes agree within 1.2 %.
    page.near(fmt::format("J, contour of {} cells", size), tip.j, j, size == 2 ? 0.025 : 0.012, "J/m²");
    if (size != 3) continue;
    page.near("K_I, 20 cells", tip.one, exact, 0.01, "Pa √m");
    page.near_absolute("K_II / K_I", tip.two / tip.one, 0.0, 1e-3, "");
  }
  page.near("J of 4 cells over that of 6", parts[2] / parts[3], 1.0, 0.005, "");
  page.figure()
      .panel("J by size of the contour", "size [cells]", "J / exact")
      .exact("exact", {2, 6}, {1, 1})
      .points("20 cells", sizes, parts);
}

// Eight times the work: about 8 s.
TEST(FullCrackEdge, StressIntensityOnFortyCells) {
  Strip strip;
  strip.cells = 40;
  const Tip tip = pull(strip);
  const double exact = intensity(strip.length());
  Page page("crack", "crack_edge_forty", "The crack from an edge on 40 cells");
  page.problem("The strip above, 40 cells across.").exact("as above", "as above").meaning("20 cells of crack.");
  page.near("K_I, 40 cells", tip.one, exact, 0.01, "Pa √m");
  page.near("J, 40 cells", tip.j, exact * exact / kPlane, 0.012, "J/m²");
}

/// By how many cells a crack acts longer than it is, found in the reference for lines and tips at places in a cell.
const std::vector<std::pair<double, Numbers>> kLonger = {{0.5, {0.03, -0.02, 0.32, 0.16, 0.01, 0.13}},
                                                         {0.25, {0.03, 0.13, 0.41, 0.16, 0.17, 0.13}},
                                                         {0.125, {0.17, 0.12, 0.36, 0.29, 0.04, -0.03}},
                                                         {0.001, {0.74, 0.69, 0.54, 0.29, 0.01, -0.19}}};
const Numbers kTips = {0.05, 0.1, 0.25, 0.5, 0.75, 0.95};

/// The length at which the exact J is that of the run, less the crack's own [cells].
double longer(const Strip& strip) {
  const double j = pull(strip).j;
  double low = 0.8 * strip.length(), high = 1.3 * strip.length();
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    (std::pow(intensity(middle), 2) / kPlane < j ? low : high) = middle;
  }
  return (low - strip.length()) / strip.cell();
}

/// Every place of the reference's table, or of its first and last line those with these tips.
void map_places(Page& page, bool all) {
  Panel& panel =
      page.figure().panel("A crack acts longer than it is", "tip beyond a node [cells]", "longer by [cells]");
  for (const auto& [line, expected] : kLonger) {
    if (!all && line != 0.5 && line != 0.001) continue;
    Numbers tips, found, published;
    for (std::size_t n = 0; n < kTips.size(); ++n) {
      if (!all && n != 1 && n != 4) continue;
      Strip strip;
      strip.line = line;
      strip.tip = kTips[n];
      tips.push_back(kTips[n]), published.push_back(expected[n]);
      found.push_back(longer(strip));
      // The table is of 20 cells of crack, 10 are used here; 0.15 cells are what the reference budgets for a tip.
      page.near_absolute(fmt::format("longer by, line at {}, tip at {}", line, kTips[n]), found.back(), expected[n],
                         0.15, "cells");
    }
    panel.points(fmt::format("line {} cells above a node", line), tips, found);
    panel.published(fmt::format("equilibrium, line {}", line), tips, published);
  }
}

constexpr char kMapMeaning[] =
    "The crack ends where its last divided node lets it, up to 0.4 cells beyond its tip when it lies off the grid's "
    "lines, and up to 0.7 when it lies on one. For tests and for cracks that are meant to be straight: midway between "
    "grid lines, the tip a tenth of a cell beyond a node. J / exact falls toward 1 as the crack gets more cells.";

TEST(CrackEdge, PlaceInACell) {
  Page page("crack", "crack_places", "Where a crack lies in a cell");
  page.problem("The strip above, 20 cells across, with the tip and the line at places in a cell.")
      .exact("as above, with each crack's own length",
             "as above; effective lengths: static solutions of the same equations")
      .meaning(kMapMeaning);
  map_places(page, false);
}

// About 30 s.
TEST(FullCrackEdge, PlacesInACell) {
  Page page("crack", "crack_places_all", "Where a crack lies in a cell: all places");
  page.problem("The strip above, 20 cells across, with the tip and the line at places in a cell.")
      .exact("as above, with each crack's own length", "as above")
      .meaning(kMapMeaning);
  map_places(page, true);
}

// Mirrored and backward chains are the same crack. What differs is the order of sums: 1e-16 of each, over 1000 steps.
// The cells are as coarse as the contour allows.
TEST(CrackEdge, MirroredAndBackwards) {
  Strip strip;
  strip.cells = 12;
  strip.tip = 0.13;  // 0.1 would put the tip on a line from a particle to a node, where round-off decides
  strip.line = 0.3;  // off the middle, so that mirroring in z is another place in the cell
  const Tip first = pull(strip);
  EXPECT_GT(std::abs(first.two), 1e-5 * first.one);  // there is something to compare
  Page page("crack", "crack_mirrored", "A crack mirrored and listed backwards");
  page.problem(
          "A strip of 12 cells with a crack 0.3 cells above a grid line; the same from the right, upside down, and "
          "with its points in the other order.")
      .exact("The same J and K_I and |K_II|.", "symmetry")
      .meaning("The order of a crack's points and its side do not matter, to round-off.");
  for (const int variant : {1, 2, 4, 7}) {
    strip.left = !(variant & 1);
    strip.upper = !(variant & 2);
    strip.backwards = variant & 4;
    const Tip other = pull(strip);
    const std::string name = fmt::format("{}{}{}", strip.left ? "" : " from the right",
                                         strip.upper ? "" : " upside down", strip.backwards ? " backwards" : "");
    page.below("difference of J," + name, std::abs(other.j / first.j - 1.0), 1e-9, "");
    page.below("difference of K_I," + name, std::abs(other.one / first.one - 1.0), 1e-9, "");
    page.below("difference of |K_II| over K_I," + name, std::abs(std::abs(other.two) - std::abs(first.two)) / first.one,
               1e-9, "");
    const double sign = ((strip.left ? 1 : -1) * (strip.upper ? 1 : -1));
    EXPECT_GT(sign * other.two * first.two, 0.0) << name;  // K_II turns with one mirror, not with the order of points
  }
}

}  // namespace crack_edge_test
}  // namespace verification
