// Heights to GeoTIFF, through libtiff.
#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "geo_tiff.hpp"
#include "mpm/math/output_file.hpp"
#include "mpm/terrain/height_file.hpp"

namespace mpm {
namespace {

constexpr int kProjected = 1;  ///< coordinates of a plane
constexpr std::uint16_t kLinesOfStrip = 64;

/// Tells libtiff of the tags of GeoTIFF.
void know_geo_tags(TIFF* tiff) {
  static char scale[] = "ModelPixelScaleTag", tie[] = "ModelTiepointTag", keys[] = "GeoKeyDirectoryTag",
              holes[] = "GDAL_NODATA";
  static const std::array<TIFFFieldInfo, 4> kTags = {
      {{kPixelScaleTag, TIFF_VARIABLE, TIFF_VARIABLE, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, scale},
       {kTiepointTag, TIFF_VARIABLE, TIFF_VARIABLE, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, tie},
       {kKeysTag, TIFF_VARIABLE, TIFF_VARIABLE, TIFF_SHORT, FIELD_CUSTOM, 1, 1, keys},
       {kNoDataTag, TIFF_VARIABLE, TIFF_VARIABLE, TIFF_ASCII, FIELD_CUSTOM, 1, 0, holes}}};
  TIFFMergeFieldInfo(tiff, kTags.data(), kTags.size());
}

}  // namespace

void write_height_tiff(const std::string& path, const HeightGrid& map) {
  const auto refuse = [&](const std::string& why) {
    throw SceneError(fmt::format("{}: the map cannot be written: {}", path, why));
  };
  if (const std::string refused = refused_output(path); !refused.empty()) refuse(refused);
  const std::string file = behind_links(path), part = file + ".part";
  const TiffMessages messages;
  errno = 0;
  TIFF* tiff = TIFFOpen(part.c_str(), "w");
  if (tiff == nullptr) {
    refuse(fmt::format("{}; check the folder and its permissions, or choose another",
                       errno != 0 ? std::strerror(errno) : TiffMessages::last().c_str()));
  }
  bool written = true;
  {
    const TiffFile closes(tiff);
    know_geo_tags(tiff);
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, map.columns);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, map.rows);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8 * sizeof(double));
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, kLinesOfStrip);
    const double across = (map.high.x() - map.low.x()) / (map.columns - 1);
    const double along = map.rows > 1 ? (map.high.y() - map.low.y()) / (map.rows - 1) : across;
    // The first line is at high y.
    const std::array<double, 3> scale = {across, along, 0.0};
    const std::array<double, 6> tie = {0.0, 0.0, 0.0, map.low.x(), map.high.y(), 0.0};
    const std::array<std::uint16_t, 20> keys = {1,
                                                1,
                                                0,
                                                4,  // version, and four keys
                                                kModelKey,
                                                0,
                                                1,
                                                kProjected,  //
                                                kRasterKey,
                                                0,
                                                1,
                                                kPixelIsPoint,  //
                                                kUnitKey,
                                                0,
                                                1,
                                                kMetre,  //
                                                kVerticalUnitKey,
                                                0,
                                                1,
                                                kMetre};
    TIFFSetField(tiff, kPixelScaleTag, static_cast<int>(scale.size()), scale.data());
    TIFFSetField(tiff, kTiepointTag, static_cast<int>(tie.size()), tie.data());
    TIFFSetField(tiff, kKeysTag, static_cast<int>(keys.size()), keys.data());
    TIFFSetField(tiff, kNoDataTag, "nan");
    std::vector<double> line(static_cast<std::size_t>(map.columns));
    for (int row = 0; row < map.rows && written; ++row) {
      const auto from = map.heights.begin() + static_cast<std::ptrdiff_t>(map.rows - 1 - row) * map.columns;
      line.assign(from, from + map.columns);
      written = TIFFWriteScanline(tiff, line.data(), static_cast<std::uint32_t>(row), 0) >= 0;
    }
    written = written && TIFFFlush(tiff) != 0;
  }
  if (written && std::rename(part.c_str(), file.c_str()) == 0) return;
  const std::string why = errno != 0 ? std::strerror(errno) : TiffMessages::last();
  std::remove(part.c_str());
  refuse(why + "; make room, or choose another place");
}

}  // namespace mpm
