// Heights from GeoTIFF, through libtiff.
//
// Of the tags of GeoTIFF only those are read that say how large a map is and where it lies; of its keys, whether points
// are pixels' centres or corners, the unit of length, and that of heights.
#include <fmt/format.h>
#include <tiffio.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>

#include "geo_tiff.hpp"
#include "mpm/terrain/height_file.hpp"

namespace mpm {
namespace {

constexpr int kVerticalKey = 4096;  // reference system of heights
constexpr int kGeographic = 2, kGeocentric = 3, kFoot = 9002, kSurveyFoot = 9003;
constexpr double kMetresAFoot = 0.3048, kMetresASurveyFoot = 1200.0 / 3937.0;
// Heights in feet of the EPSG register: NGVD29 (ftUS), NAVD88 (ftUS), NAVD88 (ft).
constexpr int kNgvd29SurveyFeet = 5702, kNavd88SurveyFeet = 6360, kNavd88Feet = 8228;

/// The values of a tag that libtiff does not know, or knows from another library; none when the file has no such tag.
template <class T>
std::vector<T> values_of(TIFF* tiff, std::uint32_t tag, TIFFDataType type) {
  const TIFFField* field = TIFFFindField(tiff, tag, TIFF_ANY);
  if (field == nullptr || TIFFFieldDataType(field) != type || TIFFFieldPassCount(field) == 0) return {};
  const void* data = nullptr;
  std::uint32_t count = 0;
  if (TIFFFieldReadCount(field) == TIFF_VARIABLE2) {
    if (TIFFGetField(tiff, tag, &count, &data) == 0) return {};
  } else {
    std::uint16_t few = 0;
    if (TIFFGetField(tiff, tag, &few, &data) == 0) return {};
    count = few;
  }
  const auto* first = static_cast<const T*>(data);
  return std::vector<T>(first, first + count);
}

/// The text of a tag; empty when the file has no such tag.
std::string tiff_text(TIFF* tiff, std::uint32_t tag) {
  const TIFFField* field = TIFFFindField(tiff, tag, TIFF_ANY);
  const char* text = nullptr;
  if (field != nullptr && TIFFFieldDataType(field) == TIFF_ASCII && TIFFFieldPassCount(field) == 0)
    return TIFFGetField(tiff, tag, &text) != 0 ? text : "";
  const std::vector<char> characters = values_of<char>(tiff, tag, TIFF_ASCII);
  return {characters.begin(), std::find(characters.begin(), characters.end(), '\0')};
}

/// The samples of a pixel: how they are stored, and which of them is a hole.
class TiffSample {
 public:
  TiffSample(TIFF* tiff, const std::string& path) {
    std::uint16_t samples = 1, photometric = PHOTOMETRIC_MINISBLACK, orientation = ORIENTATION_TOPLEFT;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &samples);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits_);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format_);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &orientation);
    TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &photometric);
    if (samples != 1 || photometric != PHOTOMETRIC_MINISBLACK) {
      throw SceneError(
          fmt::format("{}: a TIFF of {} samples a pixel, with colours or with white as 0; write one height a pixel",
                      path, samples));
    }
    if (orientation != ORIENTATION_TOPLEFT)
      throw SceneError(path + ": a turned or mirrored TIFF; write it with its first row at the top");
    const bool whole = format_ == SAMPLEFORMAT_UINT || format_ == SAMPLEFORMAT_INT;
    const bool known = whole ? bits_ == 8 || bits_ == 16 || bits_ == 32 || bits_ == 64
                             : format_ == SAMPLEFORMAT_IEEEFP && (bits_ == 32 || bits_ == 64);
    if (!known) {
      throw SceneError(fmt::format(
          "{}: a TIFF with samples of {} bits and format {}; write integers of 8 to 64 bits, or floats of 32 or 64",
          path, bits_, format_));
    }
    const std::string text = tiff_text(tiff, kNoDataTag);
    const std::size_t begin = text.find_first_not_of(' ');
    if (begin == std::string::npos) return;
    double value = 0.0;
    if (std::from_chars(text.data() + begin, text.data() + text.size(), value).ec != std::errc())
      throw SceneError(fmt::format("{}: its no-data value '{}' is not a number; write one", path, text));
    hole_ = bits_ == 32 && format_ == SAMPLEFORMAT_IEEEFP ? static_cast<float>(value) : value;
  }
  std::size_t bytes() const { return bits_ / 8; }
  double at(const unsigned char* bytes) const {
    const double value = raw(bytes);
    return value == hole_ || !std::isfinite(value) ? std::numeric_limits<double>::quiet_NaN() : value;
  }

 private:
  template <class T>
  static double read(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
  }
  double raw(const unsigned char* bytes) const {
    if (format_ == SAMPLEFORMAT_IEEEFP) return bits_ == 32 ? read<float>(bytes) : read<double>(bytes);
    const bool sign = format_ == SAMPLEFORMAT_INT;
    if (bits_ == 8) return sign ? read<std::int8_t>(bytes) : read<std::uint8_t>(bytes);
    if (bits_ == 16) return sign ? read<std::int16_t>(bytes) : read<std::uint16_t>(bytes);
    if (bits_ == 32) return sign ? read<std::int32_t>(bytes) : read<std::uint32_t>(bytes);
    return sign ? read<std::int64_t>(bytes) : read<std::uint64_t>(bytes);
  }

  std::uint16_t bits_ = 1, format_ = SAMPLEFORMAT_UINT;
  double hole_ = std::numeric_limits<double>::quiet_NaN();
};

/// The value of a key in the GeoKeyDirectory: entries of four numbers, of which the first is the key; 0 when it is
/// absent or not kept there.
int key_of(const std::vector<std::uint16_t>& keys, int key) {
  for (std::size_t i = 4; i + 3 < keys.size(); i += 4) {
    if (keys[i] == key && keys[i + 1] == 0) return keys[i + 3];
  }
  return 0;
}

void read_tiff_span(TIFF* tiff, HeightTable& table) {
  const std::vector<double> pixel = values_of<double>(tiff, kPixelScaleTag, TIFF_DOUBLE);
  if (pixel.size() < 2 || !(pixel[0] > 0.0) || !(pixel[1] > 0.0) || !std::isfinite(pixel[0] + pixel[1])) {
    table.no_span = "it has no pixel scale (the tag ModelPixelScale)";
    return;
  }
  const auto keys = values_of<std::uint16_t>(tiff, kKeysTag, TIFF_SHORT);
  const int model = key_of(keys, kModelKey), unit = key_of(keys, kUnitKey);
  if (model == kGeographic || model == kGeocentric) {
    table.no_span = "its coordinates are degrees, or about the Earth's centre, and not a plane's";
    return;
  }
  if (unit != 0 && unit != kMetre && unit != kFoot && unit != kSurveyFoot) {
    table.no_span = fmt::format("its unit of length has the code {}, which is neither metre nor foot", unit);
    return;
  }
  const double metres = unit == kFoot ? kMetresAFoot : unit == kSurveyFoot ? kMetresASurveyFoot : 1.0;
  // A tiepoint: column, row, height, and the place that they have. Pixels are areas unless a key says otherwise, and
  // the tiepoint is then one of corners. Without one, the origin is at the first point, or at the corner of the area
  // there.
  const double centre = key_of(keys, kRasterKey) == kPixelIsPoint ? 0.0 : 0.5;
  std::vector<double> tie = values_of<double>(tiff, kTiepointTag, TIFF_DOUBLE);
  if (tie.size() < 6) tie = {0.0, table.rows - 1.0 + 2.0 * centre, 0.0, 0.0, 0.0, 0.0};
  const auto place = [&](double column, double row) {
    return Vec2(metres * (tie[3] + (column + centre - tie[0]) * pixel[0]),
                metres * (tie[4] - (row + centre - tie[1]) * pixel[1]));
  };
  table.span = {place(0, table.rows - 1), place(table.columns - 1, 0)};
}

void read_height_unit(TIFF* tiff, HeightTable& table) {
  const auto keys = values_of<std::uint16_t>(tiff, kKeysTag, TIFF_SHORT);
  const int unit = key_of(keys, kVerticalUnitKey), system = key_of(keys, kVerticalKey);
  if (unit == kMetre) {
    table.unit = 1.0;
  } else if (unit == kFoot || (unit == 0 && system == kNavd88Feet)) {
    table.unit = kMetresAFoot;
  } else if (unit == kSurveyFoot || (unit == 0 && (system == kNgvd29SurveyFeet || system == kNavd88SurveyFeet))) {
    table.unit = kMetresASurveyFoot;
  } else if (unit != 0) {
    table.unit_fault =
        fmt::format("its heights have the unit of code {} (VerticalUnits), which is neither metre nor foot", unit);
  }
}

}  // namespace

HeightTable read_height_tiff(const std::string& path, const HeightLimit& limit) {
  const TiffMessages messages;
  const auto broken = [&]() {
    throw SceneError(fmt::format("{}: not a sound TIFF: {}; write it again", path, TiffMessages::last()));
  };
  const TiffFile file(TIFFOpen(path.c_str(), "r"));
  TIFF* tiff = file.get();
  if (tiff == nullptr) broken();
  std::uint32_t columns = 0, rows = 0;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &columns);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &rows);
  check_height_points(path, columns, rows, limit);
  const TiffSample sample(tiff, path);
  HeightTable table;
  table.columns = static_cast<int>(columns);
  table.rows = static_cast<int>(rows);
  table.values.resize(static_cast<std::size_t>(columns) * rows);
  // Pieces of an image: tiles, or lines.
  std::uint32_t wide = columns, high = 1;
  const bool tiled = TIFFIsTiled(tiff) != 0;
  if (tiled) {
    TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &wide);
    TIFFGetField(tiff, TIFFTAG_TILELENGTH, &high);
    check_height_points(path + ": its tiles", wide, high, kGroundLimit);
  }
  const std::size_t line = wide * sample.bytes();
  if (static_cast<std::size_t>(tiled ? TIFFTileSize64(tiff) : TIFFScanlineSize64(tiff)) != line * high)
    throw SceneError(path + ": a TIFF whose pieces have another size than their samples; write it again");
  std::vector<unsigned char> piece(line * high);
  for (std::uint32_t top = 0; top < rows; top += high) {
    for (std::uint32_t left = 0; left < columns; left += wide) {
      const bool read = tiled ? TIFFReadTile(tiff, piece.data(), left, top, 0, 0) >= 0
                              : TIFFReadScanline(tiff, piece.data(), top, 0) >= 0;
      if (!read) broken();
      for (std::uint32_t row = top; row < std::min(rows, top + high); ++row) {
        double* to = &table.values[static_cast<std::size_t>(rows - 1 - row) * columns];  // the first row is at high y
        const unsigned char* from = &piece[(row - top) * line];
        for (std::uint32_t column = left; column < std::min(columns, left + wide); ++column) {
          to[column] = sample.at(from + (column - left) * sample.bytes());
        }
      }
    }
  }
  read_tiff_span(tiff, table);
  read_height_unit(tiff, table);
  return table;
}

}  // namespace mpm
