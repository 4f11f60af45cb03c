// The height of the ground from particles: exact for a flat bed and an even slope, without what flies, and a round trip
// through GeoTIFF into another scene. 0.5 s.
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
constexpr double kRoundOff = 1e-12;  // bound on round-off in sums of parts of a cell [m]

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

// The mean of a parabola over a column is above the height at its middle by z'' width^2 / 24, so the order is the
// second. Grains are slices of 5 mm, each as high as the ground at its middle.
TEST(GroundSurface, CurvedGroundIsOfSecondOrder) {
  constexpr double kCurvature = 0.4, kSlice = 0.005;  // [1/m], [m]
  Plane bowl;
  for (double x = 0.5 * kSlice; x < 2.0; x += kSlice) {
    const double z = 0.15 + 0.5 * kCurvature * x * x;
    bowl.grains.push_back({{x, 0.5, 0.5 * z}, {0.5 * kSlice, 0.5, 0.5 * z}, kSlice * z});
  }
  for (const double width : {0.1, 0.2}) {
    GroundSurface surface({{0.0, 0.0, 0.0}, {2.0, 1.0, 1.0}}, kCell, true);
    const int columns = static_cast<int>(std::lround(2.0 / width)) + 1;
    const HeightGrid& found = surface.find({{0.0, 0.0}, width, columns, 1}, bowl.grains);
    for (int i = 1; i + 1 < columns; ++i) {
      const double x = i * width, above = found.heights[i] - (0.15 + 0.5 * kCurvature * x * x);
      // Slices themselves miss the mean by their own share.
      EXPECT_NEAR(above, kCurvature * (width * width - kSlice * kSlice) / 24.0, 1e-9) << i;
    }
  }
}

const char* const kBed = R"yaml(
grid: {cell: 0.1, min: [10, 20, 5], max: [12, 21.6, 6]}
materials: [{name: m, law: linear_elastic, density: 1600, young: 1e6, poisson: 0.25}]
bodies: [{name: soil, material: m, shape: {height_field: {heights: "5.4 + 0.1*sin(3*x) + 0.1*(y - 20)"}}}]
)yaml";

TEST(GroundSurface, AMapThatIsSavedIsTheStartOfAnotherScene) {
  const Scene scene = parse_scene(kBed, "bed.yaml");
  const Simulation simulation(scene);
  const GroundRaster whole = ground_raster(scene.definition.grid, GeometryKind::solid, 0.1);
  GroundMap map(simulation, "soil");
  const HeightGrid saved = map.read(simulation, whole);
  const std::string file = ::testing::TempDir() + "ground_surface_test.tif";
  write_height_tiff(file, saved);

  const HeightTable read = read_height_file(file, kGroundLimit);
  EXPECT_EQ(read.columns, 21);
  EXPECT_EQ(read.rows, 17);
  EXPECT_EQ(read.values, saved.heights);  // to the bit
  ASSERT_TRUE(read.span);
  EXPECT_NEAR((read.span->first - Vec2(10, 20)).norm() + (read.span->second - Vec2(12, 21.6)).norm(), 0.0, 1e-12);

  const Scene next = parse_scene(kBed, "next.yaml", {"bodies.soil.shape={height_field: {file: \"" + file + "\"}}"});
  const Simulation again(next);
  const auto mass = [](const Simulation& of) {
    std::vector<double> masses;
    of.particle_field("mass", masses);
    double sum = 0.0;
    for (const double one : masses) sum += one;
    return sum;
  };
  // The integral of the heights that both scenes are filled to, from the file's own values: the trapezoidal rule is
  // that of a bilinear surface.
  double under = 0.0;
  for (int j = 0; j < 17; ++j) {
    for (int i = 0; i < 21; ++i) {
      const double area = 0.01 * (i % 20 == 0 ? 0.5 : 1.0) * (j % 16 == 0 ? 0.5 : 1.0);
      under += area * (saved.heights[static_cast<std::size_t>(j) * 21 + i] - 5.0);
    }
  }
  EXPECT_NEAR(mass(simulation) / (1600 * under), 1.0, 1e-3);  // 1 % is asked for
  EXPECT_NEAR(mass(again) / (1600 * under), 1.0, 1e-3);
  GroundMap second(again, "");
  const HeightGrid& found = second.read(again, whole);
  for (std::size_t i = 0; i < saved.heights.size(); ++i) EXPECT_NEAR(found.heights[i], saved.heights[i], 0.005) << i;
  std::remove(file.c_str());
}

TEST(GroundSurface, HolesAndAPlanarMapComeBackFromAFile) {
  const double hole = std::numeric_limits<double>::quiet_NaN();
  const std::string file = ::testing::TempDir() + "ground_surface_line.tif";
  write_height_tiff(file, {{1.0, 0.0}, {1.75, 0.0}, 4, 1, {0.25, hole, 1.0 / 3.0, -7.5}});
  const HeightTable read = read_height_file(file, kGroundLimit);
  ASSERT_EQ(read.values.size(), 4U);
  EXPECT_EQ(read.rows, 1);
  EXPECT_TRUE(std::isnan(read.values[1]));
  EXPECT_EQ(read.values[2], 1.0 / 3.0);
  EXPECT_EQ(read.values[3], -7.5);
  EXPECT_NEAR(read.span->second.x(), 1.75, 1e-15);
  std::remove(file.c_str());
  try {
    write_height_tiff("/nowhere/at/all.tif", {{0, 0}, {1, 0}, 2, 1, {0, 0}});
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("No such file or directory; check the folder"), std::string::npos)
        << error.what();
  }
}

TEST(GroundSurface, WindowFollowsFromPointToPointWithinTheDomain) {
  const GroundRaster whole{{1.0, 2.0}, 0.1, 21, 11};
  const GroundRaster inside = window_of(whole, {2.04, 2.46}, {0.6, 0.4});
  EXPECT_EQ(inside.columns, 7);
  EXPECT_EQ(inside.rows, 5);
  EXPECT_NEAR(inside.low.x(), 1.7, 1e-12);  // the point nearest to 1.74
  EXPECT_NEAR(inside.low.y(), 2.3, 1e-12);
  const GroundRaster beyond = window_of(whole, {9.0, -9.0}, {0.6, 0.4});
  EXPECT_EQ(beyond.columns, 7);
  EXPECT_NEAR(beyond.low.x(), 2.4, 1e-12);  // ends with the domain, at 3
  EXPECT_NEAR(beyond.low.y(), 2.0, 1e-12);

  HeightGrid map{whole.low, {3.0, 3.0}, 21, 11, {}};
  for (int i = 0; i < 21 * 11; ++i) map.heights.push_back(i);
  const HeightGrid part = part_of(map, inside);
  EXPECT_EQ(part.heights.front(), 3 * 21 + 7);
  EXPECT_EQ(part.heights.back(), 7 * 21 + 13);
}

TEST(GroundSurface, OutputSaysWhatIsWrongWithIt) {
  const auto fault = [](const std::string& terrain) -> std::string {
    try {
      parse_scene(
          kBed, "bed.yaml",
          {"rigid_bodies=[{name: blade, shape: {box: {size: [0.1, 0.1, 0.1]}}, pose: {position: [11, 21, 5.9]}}]",
           "time={end: 1, sync: 0.01}", "output={terrain: " + terrain + "}"});
    } catch (const SceneError& error) {
      return error.what();
    }
    return "none";
  };
  const auto expect = [&](const std::string& terrain, const std::string& text) {
    EXPECT_NE(fault(terrain).find(text), std::string::npos) << fault(terrain);
  };
  EXPECT_EQ(fault("{}"), "none");
  expect("{period: -1}", "output.terrain.period: '-1' is not greater than 0");
  expect("{period: 0.025}", "is not a whole number of sync periods of 0.01 s; write 0.03 s");
  expect("{resolution: 0.3}", "the domain is 2 m along x, which is no whole number of 0.3 m; write 0.285714 m");
  expect("{change: -1}", "output.terrain.change: '-1' is less than 0");
  expect("{of: soli}", "soil");
  expect("{window: {of: blad, size: [1, 1]}}", "no rigid body 'blad'; did you mean 'blade'?");
  expect("{window: {of: blade, size: [1, 1.7]}}", "the window is longer along y than the domain, 1.6 m");
}

}  // namespace ground_surface_test
}  // namespace mpm
