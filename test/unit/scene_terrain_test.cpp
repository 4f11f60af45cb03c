// Deformable bodies whose shape is a height_field: their particles, the files that they come from, and refusals.
#include <gtest/gtest.h>
#include <png.h>
#include <tiffio.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <random>

#include "mpm/scene/scene.hpp"
#include "mpm/terrain/height_topic.hpp"

namespace mpm {
namespace scene_terrain_test {

std::string scene_of(const std::string& field, const std::string& geometry = "solid", double cell = 0.1) {
  const bool solid = geometry == "solid";
  return "geometry: " + geometry + "\nbodies: [{name: soil, material: soft, shape: {height_field: {" + field +
         "}}}]\ngrid: {cell: " + std::to_string(cell) + (solid ? ", min: [0, 0, 0], max: [1, 2, 1]" : "") +
         (geometry == "line" ? ", min: 0, max: 1"
          : solid            ? ""
                             : ", min: [0, 0], max: [1, 1]") +
         "}\nmaterials: [{name: soft, density: 1000, law: neo_hookean, young: 1 MPa, poisson: 0.3}]\n";
}

DeformableBody soil_of(const std::string& field, const std::string& geometry = "solid", double cell = 0.1) {
  return build(parse_scene(scene_of(field, geometry, cell), "good.yaml")).bodies.at(0);
}

/// `key`: after the shape's kind.
void expect_refused(const std::string& field, const std::string& key, const std::string& what,
                    const std::string& geometry = "solid") {
  const std::string start = "bad.yaml:2: bodies.soil.shape.height_field" + key + ": ";
  try {
    build(parse_scene(scene_of(field, geometry), "bad.yaml"));
    FAIL() << "taken: " << field;
  } catch (const SceneError& error) {
    const std::string found = error.what();
    EXPECT_EQ(found.substr(0, start.size()), start) << found;
    EXPECT_NE(found.find(what), std::string::npos) << found;
    EXPECT_EQ(found.find('\n'), std::string::npos) << found;
  }
}

/// Volume of a body's particles [m^3], and the height of its centre [m].
std::pair<double, double> volume_and_centre(const DeformableBody& soil) {
  double volume = 0.0, moment = 0.0;
  for (std::size_t p = 0; p < soil.positions.size(); ++p) {
    const double own = soil.particle_volume * soil.parts.at(p);
    volume += own;
    moment += own * soil.positions[p].z();
  }
  return {volume, moment / volume};
}

// Places whose centres lie below the surface have particles, and of each column at most one or two more, cut by it.
TEST(SceneTerrain, HoldsTheParticlesBelowTheBilinearSurface) {
  const DeformableBody soil = soil_of("x: [0, 1], y: [0, 2], heights: [[0.11, 0.33], [0.57, 0.91]], bottom: 0.1");
  std::size_t expected = 0;
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 40; ++j) {
      const double u = (i + 0.5) / 20, v = (j + 0.5) / 40;
      const double height = (1 - u) * (1 - v) * 0.11 + u * (1 - v) * 0.33 + (1 - u) * v * 0.57 + u * v * 0.91;
      for (int k = 2; k < 20; ++k) expected += (k + 0.5) * 0.05 < height ? 1 : 0;  // from z = 0.1 on
    }
  }
  EXPECT_GT(soil.positions.size(), expected);
  EXPECT_LT(soil.positions.size(), expected + 20 * 40);
  for (const Vec3& p : soil.positions) {
    const double u = p.x(), v = p.y() / 2;
    EXPECT_LT(p.z(), (1 - u) * (1 - v) * 0.11 + u * (1 - v) * 0.33 + (1 - u) * v * 0.57 + u * v * 0.91);
    EXPECT_GT(p.z(), 0.1);
  }
  // Over the unit square the mean of a bilinear height is that of its corners, 0.48 m; the mean of its square is a
  // ninth of the sum of squares, of products along edges, and half of those across: 0.27188 m^2 (by Simpson's rule in
  // both directions, which is exact here). The centre of what lies above 0.1 m follows.
  const auto [volume, centre] = volume_and_centre(soil);
  EXPECT_NEAR(volume, 2.0 * (0.48 - 0.1), 1e-9);
  const double corners = 0.11 * 0.11 + 0.33 * 0.33 + 0.57 * 0.57 + 0.91 * 0.91;
  const double edges = 0.11 * 0.33 + 0.57 * 0.91 + 0.11 * 0.57 + 0.33 * 0.91;
  const double square = (corners + edges + 0.5 * (0.11 * 0.91 + 0.33 * 0.57)) / 9.0;
  EXPECT_NEAR(centre, 0.5 * (square - 0.01) / 0.38, 1e-4);
}

TEST(SceneTerrain, HasTheVolumeOfItsIntegral) {
  // The integral of 0.2 + 0.3 x^2 y over [0, 1] x [0, 2] is 0.4 + 0.3 * 1/3 * 2. Straight lines between points of a
  // parabola add 0.3 y c^2 / 6, in the mean 1.25e-4 m with c = 0.05 m, over 2 m^2.
  const DeformableBody soil = soil_of("x: [0, 1], y: [0, 2], heights: 0.2 + 0.3*x^2*y", "solid", 0.05);
  EXPECT_NEAR(volume_and_centre(soil).first, 0.6 + 2.0 * 1.25e-4, 2.0 * 1e-5);
}

TEST(SceneTerrain, AnExpressionReachesOverTheGrid) {
  EXPECT_EQ(soil_of("heights: 0.3 + 0.1*x*y").positions,
            soil_of("x: [0, 1], y: [0, 2], heights: 0.3 + 0.1*x*y").positions);
}

TEST(SceneTerrain, APlanarSceneHasAProfile) {
  const DeformableBody soil = soil_of("x: [0, 1], heights: [0.13, 0.77]", "plane_strain");
  // The centre of what lies below a straight line from a to b is at (a^2 + a b + b^2) / (3 (a + b)).
  const auto [volume, centre] = volume_and_centre(soil);
  EXPECT_NEAR(volume, 0.45, 1e-9);
  EXPECT_NEAR(centre, (0.13 * 0.13 + 0.13 * 0.77 + 0.77 * 0.77) / (3 * 0.9), 1e-4);
}

class SceneTerrainFile : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// A grey image, `grey(column, row)` from the lower left on.
  std::string png(const std::string& name, int columns, int rows, int bits, const std::function<int(int, int)>& grey,
                  int colour = PNG_COLOR_TYPE_GRAY) const {
    std::FILE* file = std::fopen(path(name).c_str(), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, columns, rows, bits, colour, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (int row = rows; row-- > 0;) {
      std::vector<png_byte> line;
      for (int column = 0; column < columns; ++column) {
        if (bits == 16) line.push_back(static_cast<png_byte>(grey(column, row) >> 8));
        line.push_back(static_cast<png_byte>(grey(column, row)));
        if (colour == PNG_COLOR_TYPE_GRAY_ALPHA) line.push_back(255);
      }
      png_write_row(png, line.data());
    }
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
    return path(name);
  }

  struct Tags {
    double pixel = 0.2;                   // 0: no ModelPixelScale
    bool is_point = false;                // GTRasterTypeGeoKey
    int model = 1, unit = 9001;           // projected, metre
    int vertical = 0, vertical_unit = 0;  // VerticalGeoKey and VerticalUnitsGeoKey; 0: none
    const char* no_data = nullptr;
    bool tiled = false;
    int samples = 1;
    Vec2 corner{-0.1, 1.1};  // place of the tiepoint, the upper left
  };
  /// `value(column, row)` from the lower left on.
  template <class T>
  std::string tiff(const std::string& name, int columns, int rows, const Tags& tags,
                   const std::function<T(int, int)>& value) const {
    static const TIFFFieldInfo kFields[] = {
        {33550, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("ModelPixelScale")},
        {33922, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("ModelTiepoint")},
        {34735, -1, -1, TIFF_SHORT, FIELD_CUSTOM, 1, 1, const_cast<char*>("GeoKeyDirectory")},
        {42113, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, const_cast<char*>("GDAL_NODATA")}};
    TIFF* file = TIFFOpen(path(name).c_str(), "w");
    TIFFMergeFieldInfo(file, kFields, 4);
    TIFFSetField(file, TIFFTAG_IMAGEWIDTH, columns);
    TIFFSetField(file, TIFFTAG_IMAGELENGTH, rows);
    TIFFSetField(file, TIFFTAG_SAMPLESPERPIXEL, tags.samples);
    TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, 8 * sizeof(T));
    TIFFSetField(file, TIFFTAG_SAMPLEFORMAT,
                 std::is_floating_point_v<T> ? SAMPLEFORMAT_IEEEFP
                                             : (std::is_signed_v<T> ? SAMPLEFORMAT_INT : SAMPLEFORMAT_UINT));
    TIFFSetField(file, TIFFTAG_PHOTOMETRIC, tags.samples == 3 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK);
    TIFFSetField(file, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(file, TIFFTAG_COMPRESSION, COMPRESSION_LZW);
    const double scale[] = {tags.pixel, tags.pixel, 0.0};
    const double tie[] = {0, 0, 0, tags.corner.x(), tags.corner.y(), 0};
    const auto raster = static_cast<std::uint16_t>(tags.is_point ? 2 : 1);
    std::vector<std::uint16_t> keys = {1, 1, 0, 0};
    const std::pair<int, int> entries[] = {
        {1024, tags.model}, {1025, raster}, {3076, tags.unit}, {4096, tags.vertical}, {4099, tags.vertical_unit}};
    for (const auto& [key, value] : entries) {
      if (value == 0) continue;
      for (const int number : {key, 0, 1, value}) keys.push_back(static_cast<std::uint16_t>(number));
      ++keys[3];
    }
    if (tags.pixel > 0) {
      TIFFSetField(file, 33550, 3, scale);
      TIFFSetField(file, 33922, 6, tie);
      TIFFSetField(file, 34735, static_cast<int>(keys.size()), keys.data());
    }
    if (tags.no_data != nullptr) TIFFSetField(file, 42113, tags.no_data);
    constexpr int kTile = 16;
    if (tags.tiled) {
      TIFFSetField(file, TIFFTAG_TILEWIDTH, kTile);
      TIFFSetField(file, TIFFTAG_TILELENGTH, kTile);
      for (int top = 0; top < rows; top += kTile) {
        for (int left = 0; left < columns; left += kTile) {
          std::vector<T> tile(kTile * kTile);
          for (int j = top; j < std::min(rows, top + kTile); ++j) {
            for (int i = left; i < std::min(columns, left + kTile); ++i)
              tile[(j - top) * kTile + i - left] = value(i, rows - 1 - j);
          }
          TIFFWriteTile(file, tile.data(), left, top, 0, 0);
        }
      }
    } else {
      for (int j = 0; j < rows; ++j) {
        std::vector<T> line(columns * tags.samples);
        for (int i = 0; i < columns; ++i) line[i * tags.samples] = value(i, rows - 1 - j);
        TIFFWriteScanline(file, line.data(), j, 0);
      }
    }
    TIFFClose(file);
    return path(name);
  }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("mpm_terrain_test_" + std::to_string(std::random_device{}()));
};

/// Plane of 0.053 + 0.2 x + 0.4 y over the unit square: with 6 x 6 points, heights above 0.053 are (i + 2 j) / 15 of
/// 0.6 m, which 8 and 16 bits hold exactly. No particle's centre lies on the surface.
const DeformableBody& plane() {
  static const DeformableBody body = soil_of("x: [0, 1], y: [0, 1], heights: 0.053 + 0.2*x + 0.4*y, cells: [5, 5]");
  return body;
}

constexpr double kRounded = 5e-6;  ///< a survey foot is 2 parts in a million longer, of 0.65 m [m]

void expect_the_plane(const std::string& field) {
  const DeformableBody body = soil_of(field);
  ASSERT_EQ(body.positions.size(), plane().positions.size()) << field;
  for (std::size_t p = 0; p < body.positions.size(); ++p) {
    EXPECT_LT((body.positions[p] - plane().positions[p]).norm(), kRounded) << field;
    EXPECT_NEAR(body.parts[p], plane().parts[p], kRounded / 0.05) << field;
  }
}

TEST_F(SceneTerrainFile, ImagesGiveTheParticlesOfTheExpression) {
  const std::string keys = "x: [0, 1], y: [0, 1], scale: 60 cm, offset: 53 mm, file: ";
  expect_the_plane(keys + png("8.png", 6, 6, 8, [](int i, int j) { return 17 * (i + 2 * j); }));
  expect_the_plane(keys + png("16.png", 6, 6, 16, [](int i, int j) { return 4369 * (i + 2 * j); }));
  expect_the_plane(keys +
                   png("4.png", 2, 2, 8, [](int i, int j) { return 85 * (i + 2 * j); }));  // bilinear is the same
}

TEST_F(SceneTerrainFile, GeoTiffLiesWhereItsTagsSay) {
  const std::function<float(int, int)> height = [](int i, int j) { return 0.053F + 0.04F * i + 0.08F * j; };
  // Pixels are areas: the tiepoint is the corner of the first.
  expect_the_plane("file: " + tiff("area.tif", 6, 6, {}, height));
  Tags point;
  point.is_point = true;
  point.corner = {0.0, 1.0};
  expect_the_plane("file: " + tiff("point.tif", 6, 6, point, height));
  Tags feet = point;
  feet.pixel = 0.2 / 0.3048, feet.corner = {0.0, 1.0 / 0.3048}, feet.unit = 9002;
  expect_the_plane("file: " + tiff("feet.tif", 6, 6, feet, height));
  // Heights in feet by the unit or the reference system that the keys name, and not where a scale is written.
  const std::function<float(int, int)> high = [](int i, int j) {
    return static_cast<float>((0.053 + 0.04 * i + 0.08 * j) / 0.3048);
  };
  for (const auto& [system, unit] : {std::pair{0, 9002}, std::pair{0, 9003}, std::pair{8228, 0}, std::pair{6360, 0}}) {
    Tags up = point;
    up.vertical = system, up.vertical_unit = unit;  // a survey foot is 2 parts in a million longer
    expect_the_plane("file: " + tiff("up.tif", 6, 6, up, high));
    if (unit == 9003) expect_the_plane("scale: 1 m, file: " + tiff("written.tif", 6, 6, up, height));
  }
  Tags metres = point;
  metres.vertical_unit = 9001, metres.vertical = 5703;
  expect_the_plane("file: " + tiff("metres.tif", 6, 6, metres, height));
  Tags fathoms = point;
  fathoms.vertical_unit = 9014;
  const std::string odd = tiff("fathoms.tif", 6, 6, fathoms, height);
  expect_refused("file: " + odd, ".file",
                 "unit of code 9014 (VerticalUnits), which is neither metre nor foot; write scale");
  expect_the_plane("scale: 1, file: " + odd);
  // Elsewhere by x and y, of the size from centre to centre or from edge to edge.
  Tags far = point;
  far.corner = {500000.0, 4000000.0};
  expect_the_plane("x: [0, 1], y: [0, 1], file: " + tiff("far.tif", 6, 6, far, height));
  const std::function<float(int, int)> wide = [](int i, int j) { return 0.053F + 0.2F / 5 * i + 0.4F / 5 * j; };
  Tags sixth = far;
  sixth.pixel = 1.0 / 6;
  expect_the_plane("x: [0, 1], y: [0, 1], file: " + tiff("edges.tif", 6, 6, sixth, wide));
}

TEST_F(SceneTerrainFile, GeoTiffOfIntegersInTilesWithHoles) {
  // Millimetres; no data beyond the unit square, which `within` leaves out.
  Tags tags;
  tags.tiled = true;
  tags.no_data = "-9999";
  tags.corner = {-0.1, 3.9};
  const std::function<std::int16_t(int, int)> height = [](int i, int j) {
    return static_cast<std::int16_t>(i > 5 || j > 5 ? -9999 : 53 + 40 * i + 80 * j);
  };
  const std::string file = tiff("holes.tif", 20, 20, tags, height);
  expect_the_plane("within: {x: [0, 1], y: [0, 1]}, scale: 1 mm, file: " + file);
  Tags floats = tags;
  floats.no_data = "nan";
  const std::function<double(int, int)> real = [&](int i, int j) {
    return height(i, j) < 0 ? std::numeric_limits<double>::quiet_NaN() : 1e-3 * height(i, j);
  };
  expect_the_plane("within: {x: [0, 1], y: [0, 1]}, file: " + tiff("nan.tif", 20, 20, floats, real));
  expect_refused("within: {y: [0, 1.01], x: [0, 1]}, scale: 1 mm, file: " + file, ".file",
                 "6 of its points under the body have no height, the first at x = 0 m, y = 1.2 m");
}

TEST_F(SceneTerrainFile, TextInTheSceneItself) {
  expect_the_plane("x: [0, 1], y: [0, 1], table: \"0.053 0.253\\n0.453, 0.653\"");
  expect_refused("x: [0, 1], y: [0, 1], table: \"0 1\\n2 three\"", ".table", "its text:2: 'three' is not a number");
}

TEST_F(SceneTerrainFile, AMessageBecomesAnOverride) {
  const std::string file = write("topic.yaml", scene_of("topic: hills, bottom: 10 cm"));
  const std::vector<HeightTopic> topics = height_topics(file, {"name=other"});
  ASSERT_EQ(topics.size(), 1U);
  EXPECT_EQ(topics[0].body, "soil");
  EXPECT_EQ(topics[0].topic, "hills");
  HeightGrid map{{0, 0}, {1, 1}, 2, 2, {0.053F, 0.253F, 0.453F, 0.653F}};
  const std::string given = heights_override(topics[0], map);
  const Scene loaded = load_scene(file, {given});
  const DeformableBody same =
      soil_of("x: [0, 1], y: [0, 1], heights: 0.053 + 0.2*x + 0.4*y, cells: [5, 5], bottom: 0.1");
  const std::vector<Vec3> read = build(loaded).bodies.at(0).positions;
  ASSERT_EQ(read.size(), same.positions.size());
  for (std::size_t p = 0; p < read.size(); ++p) EXPECT_LT((read[p] - same.positions[p]).norm(), kRounded);
  // The record of the scene needs no message.
  EXPECT_EQ(build(parse_scene(loaded.text, loaded.path)).bodies.at(0).positions, read);
  // In a scene of other units too, with the same floats.
  EXPECT_EQ(build(load_scene(file, {"units={length: mm, mass: kg, time: s}",
                                    "grid={cell: 100, min: [0, 0, 0], max: [1000, 2000, 1000]}",
                                    "materials.0.density=1000 kg/m3", given}))
                .bodies.at(0)
                .positions.size(),
            same.positions.size());
  EXPECT_TRUE(height_topics(write("none.yaml", scene_of("heights: 0.5")), {}).empty());
  EXPECT_TRUE(height_topics("blade_in_soil", {}).empty()) << "of boxes and a mesh";
  // Errors about a map do not quote it whole.
  map = {{0, 0}, {1, 1}, 100, 100, std::vector<double>(10000, 7.0)};
  try {
    load_scene(file, {heights_override(topics[0], map)});
    FAIL() << "taken";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("above grid.max"), std::string::npos) << error.what();
    EXPECT_LT(std::strlen(error.what()), 600U);
  }
  try {
    height_topics(write("both.yaml", scene_of("topic: hills, scale: 2")), {});
    FAIL() << "taken";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("bodies.soil.shape.height_field.scale: the message on the topic says it"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(SceneTerrainFile, WhatIsNoMapIsRefused) {
  const std::string place = "x: [0, 1], y: [0, 1], ";
  const auto refused = [&](const std::string& keys, const std::string& file, const std::string& what) {
    expect_refused(keys + "file: " + file, ".file", what);
  };
  const auto grey = [](int i, int j) { return 10 * (i + j); };
  const std::function<float(int, int)> height = [](int i, int j) { return 0.1F * (i + j); };
  refused(place, png("no_scale.png", 3, 3, 8, grey), "write scale, the height of white above black");
  refused(place + "scale: 1, ", png("alpha.png", 3, 3, 8, grey, PNG_COLOR_TYPE_GRAY_ALPHA), "greyscale");
  refused(place + "scale: 1, ", png("row.png", 3, 1, 8, grey), "two points at least along each axis");
  refused("scale: 1, ", png("nowhere.png", 3, 3, 8, grey), "it does not say how large it is; write x and y");
  const std::string sound = png("sound.png", 200, 200, 16, [](int i, int j) { return 300 * (i ^ j) % 65536; });
  std::filesystem::resize_file(sound, std::filesystem::file_size(sound) / 2);
  refused(place + "scale: 1, ", sound, "not a sound PNG");
  refused(place, write("photo.jpg", std::string("\xff\xd8\xff\xe0\0\x10JFIF", 10)), "neither text nor an image");
  refused(place, write("empty.csv", ""), "it is empty");
  refused(place, write("comment.csv", "# nothing\n"), "it has no points");
  refused(place, write("huge.pgm", "P2 1000000 1000000 255 0"), "cut out the part that is needed");
  refused(place, write("stub.tif", std::string("II*\0\x08\0\0\0", 8)), "not a sound TIFF");
  Tags colours;
  colours.samples = 3;
  refused(place, tiff<std::uint8_t>("rgb.tif", 3, 3, colours, [](int, int) { return 1; }), "3 samples a pixel");
  Tags bare;
  bare.pixel = 0.0;
  refused("", tiff("bare.tif", 3, 3, bare, height), "no pixel scale (the tag ModelPixelScale); write x and y");
  Tags degrees;
  degrees.model = 2;
  refused("", tiff("degrees.tif", 3, 3, degrees, height), "degrees");
  Tags far;
  far.corner = {500000.0, 4000000.0};
  refused("", tiff("far.tif", 3, 3, far, height), "out of the grid, 0 to 1 m; write x: [0, 0.4]");
  expect_refused("x: [0, 1], y: [0, 0.4], file: " + tiff("size.tif", 3, 3, {}, height), ".x",
                 "1 m, but the map measures 0.4 m along x (3 points 0.2 m apart): write [0, 0.4]");
  refused(place, write("holes.csv", "0.1 0.1\nnan nan\n"),
          "2 of its points under the body have no height, the first at x = 0 m, y = 1 m");
  refused(place, write("feet.csv", "1.1 1.1\n1.2 3.2\n"),
          "highest point, 3.2 m at x = 1 m, y = 1 m, is above grid.max, 1 m; in feet it would lie in the grid: write "
          "scale: 0.3048 m");
  refused(place, write("mm.csv", "100 200\n300 900\n"),
          "in millimetres it would lie in the grid: write scale: 0.001 m");
  refused(place + "offset: -0.5, ", write("deep.csv", "0.1 0.6\n0.7 0.9\n"),
          "lowest point, -0.4 m at x = 0 m, y = 0 m, is below grid.min, 0 m");
}

TEST(SceneTerrain, WhatCannotBeIsRefused) {
  const std::string place = "x: [0, 1], y: [0, 1], ";
  expect_refused(place + "heights: 0.5, bottom: -0.1", ".bottom", "below the grid, whose lower face is at 0 m");
  expect_refused(place + "heights: 0.5, bottom: 0.5", ".bottom", "no height is above");
  expect_refused(place + "heights: 1.5", ".heights", "write each height with its unit, else raise grid.max");
  expect_refused(place + "heights: 100*x - 40", ".heights", "write other heights, or move the grid");
  expect_refused("x: [0, 1.5], y: [0, 1], heights: 0.5", ".x", "within: {x: [from, to]}");
  expect_refused("x: [0.5, 1.5], y: [0, 1], heights: 0.5", ".x", "write x: [0, 1], or move the grid");
  expect_refused(place + "heights: 0.5, within: {x: [0.5, 1.2]}", ".within.x", "it leaves the map");
  expect_refused(place + "topic: terrain", ".topic", "run the simulator's node, or write file");
  expect_refused(place + "heights: 0.5, offset: 1", ".offset", "belongs to file");
  expect_refused("heights: [[0.1, 0.2], [0.1, 0.2]]", ".heights", "write x and y");
  expect_refused("x: [0, 1], heights: [0.1, 0.2]", "", "box or cylinder", "axisymmetric");
  expect_refused("x: [0, 1], heights: [0.1, 0.2]", "", "write box", "line");
  expect_refused("x: [0, 1], y: [0, 1], heights: [0.1, 0.2]", ".y", "leave it out", "plane_strain");
}

}  // namespace scene_terrain_test
}  // namespace mpm
