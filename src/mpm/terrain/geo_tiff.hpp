// Parts that reading and writing of GeoTIFF have in common: tags, keys, and the messages of libtiff. Private to this
// folder.
#pragma once

#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

namespace mpm {

constexpr std::uint32_t kPixelScaleTag = 33550, kTiepointTag = 33922, kKeysTag = 34735, kNoDataTag = 42113;
// GeoTIFF 1.1 keys: kind of coordinates, whether a pixel is an area or a point, units of length and of heights.
constexpr int kModelKey = 1024, kRasterKey = 1025, kUnitKey = 3076, kVerticalUnitKey = 4099;
constexpr int kPixelIsPoint = 2, kMetre = 9001;

/// Keeps libtiff's messages, which else go to the terminal, while it exists.
class TiffMessages {
 public:
  TiffMessages() : error_(TIFFSetErrorHandler(keep)), warning_(TIFFSetWarningHandler(nullptr)) { last().clear(); }
  ~TiffMessages() {
    TIFFSetErrorHandler(error_);
    TIFFSetWarningHandler(warning_);
  }
  TiffMessages(const TiffMessages&) = delete;
  TiffMessages& operator=(const TiffMessages&) = delete;
  static std::string& last() {
    thread_local std::string text;
    return text;
  }

 private:
  static void keep(const char* /*module*/, const char* format, va_list arguments) {
    char text[256];
    std::vsnprintf(text, sizeof text, format, arguments);
    last() = text;
    std::replace(last().begin(), last().end(), '\n', ' ');
  }
  TIFFErrorHandler error_, warning_;
};

struct CloseTiff {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using TiffFile = std::unique_ptr<TIFF, CloseTiff>;

}  // namespace mpm
