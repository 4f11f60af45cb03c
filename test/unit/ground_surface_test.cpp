// The height of the ground from particles: exact for a flat bed and an even slope, without what flies, and a round trip
// through GeoTIFF into another scene. Takes about a second.
#include "mpm/terrain/ground_surface.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm/terrain/ground_map.hpp"
#include "mpm/terrain/height_file.hpp"
#include "test_files.hpp"

namespace mpm {
namespace ground_surface_test {

constexpr double kCell = 0.1;
constexpr double kRoundOff = 1e-12;  // of sums of parts of a cell [m]

/// Grains of a plane on a lattice of a quarter of a square cell each, 1 m deep along y.
struct Plane {
  std::vector<GroundGrain> grains;
  void fill(double from_x, double to_x, double from_z, double to_z, double spacing = 0.05) {
    for (double x = from_x + 0.5 * spacing; x < to_x; x += spacing) {
      for (double z = from_z + 0.5 * spacing; z < to_z; z += spacing) add(x, z, spacing);
    }
  }
  void add(double x, double z, double spacing = 0.05) {
    grains.push_back({{x, 0.5, z}, {0.5 * spacing, 0.5, 0.5 * spacing}, spacing * spacing});
  }
  /// In a domain of 2 m by 1 m.
  std::vector<double> heights() const {
    GroundSurface surface({{0.0, 0.0, 0.0}, {2.0, 1.0, 1.0}}, kCell, true);
    return surface.find({{0.0, 0.0}, kCell, 21, 1}, grains).heights;
  }
};

TEST(GroundSurface, FlatBedIsExactWhereverItsTopAndBottomLie) {
  for (const auto& [bottom, top] : {std::pair(0.0, 0.4), {0.0, 0.35}, {0.15, 0.5}, {0.0, 0.1}, {0.05, 0.15}}) {
    Plane bed;
    bed.fill(0.0, 2.0, bottom, top);
    for (const double height : bed.heights()) EXPECT_NEAR(height, top, kRoundOff) << bottom << " to " << top;
  }
}

TEST(GroundSurface, LatticeThatDoesNotFitTheCellsIsExactToo) {
  Plane bed;
  bed.fill(0.0, 2.0, 0.0, 0.48, 0.04);
  for (const double height : bed.heights()) EXPECT_NEAR(height, 0.48, kRoundOff);
}

TEST(GroundSurface, ThrownGrainsAndWhatHangsInTheAirAreNoGround) {
  Plane bed;
  bed.fill(0.0, 2.0, 0.0, 0.4);
  bed.add(0.725, 0.725);
  bed.fill(1.2, 1.5, 0.7, 0.9);  // a bucketful
  for (const double height : bed.heights()) EXPECT_NEAR(height, 0.4, kRoundOff);
}

TEST(GroundSurface, OverhangThatHangsTogetherIsGroundAndTheGapBelowItIsNot) {
  Plane bed;
  bed.fill(0.0, 2.0, 0.0, 0.3);
  bed.fill(0.8, 1.0, 0.3, 0.8);
  bed.fill(0.4, 0.8, 0.65, 0.8);  // a ledge over a gap of 0.35 m
  const std::vector<double> heights = bed.heights();
  EXPECT_NEAR(heights[2], 0.3, kRoundOff);
  for (const int column : {5, 6, 7, 9}) EXPECT_NEAR(heights[column], 0.8, kRoundOff) << column;
}

TEST(GroundSurface, UprightFaceInAColumnIsItsMean) {
  Plane bed;
  bed.fill(0.0, 2.0, 0.0, 0.2);
  bed.fill(1.0, 2.0, 0.2, 0.8);  // the face stands at the middle of column 10
  const std::vector<double> heights = bed.heights();
  EXPECT_NEAR(heights[9], 0.2, kRoundOff);
  EXPECT_NEAR(heights[10], 0.5, kRoundOff);
  EXPECT_NEAR(heights[11], 0.8, kRoundOff);
}

TEST(GroundSurface, ColumnWithoutMaterialHasNoHeight) {
  Plane heap;
  heap.fill(0.5, 1.0, 0.0, 0.3);
  const std::vector<double> heights = heap.heights();
  for (const int column : {0, 4, 11, 20}) EXPECT_TRUE(std::isnan(heights[column])) << column;
  for (const int column : {6, 7, 8, 9}) EXPECT_NEAR(heights[column], 0.3, kRoundOff) << column;
  EXPECT_TRUE(std::isnan(Plane().heights().front()));
}

// A column's volume over its width is the mean of the height in it, hence the height of its middle on an even slope;
// grains follow it to a tenth of a place (cut_cells.hpp). `of`: the height at a point.
double worst_of_slope(double cell, double steepness) {
  const std::string scene = fmt::format(
      "geometry: plane_strain\ngrid: {{cell: {}, min: [0, 0], max: [2, 2.4]}}\n"
      "materials: [{{name: m, law: linear_elastic, density: 1600, young: 1e6, poisson: 0.25}}]\n"
      "bodies: [{{name: soil, material: m, shape: {{height_field: {{heights: '0.45 + {} * x'}}}}}}]\n",
      cell, steepness);
  const Simulation simulation(parse_scene(scene, "slope.yaml"));
  const GridDefinition& grid = simulation.definition().grid;
  GroundMap map(simulation, "");
  const HeightGrid& found = map.read(simulation, ground_raster(grid, GeometryKind::plane_strain, cell));
  double worst = 0.0;
  for (int i = 0; i < found.columns; ++i)
    worst = std::max(worst, std::abs(found.heights[i] - (0.45 + steepness * i * cell)));
  return worst / cell;
}

TEST(GroundSurface, EvenSlopeIsExactToAFewHundredthsOfACell) {
  for (const double steepness : {0.1, 0.3, 0.7}) {
    EXPECT_LT(worst_of_slope(0.1, steepness), 0.05) << steepness;
    EXPECT_LT(worst_of_slope(0.05, steepness), 0.05) << steepness;
  }
}

}  // namespace ground_surface_test
}  // namespace mpm
