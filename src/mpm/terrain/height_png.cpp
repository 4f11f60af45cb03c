// Heights from grey PNG images, through libpng.
//
// libpng leaves a failed read by longjmp, which calls no destructors. So each function that calls it with setjmp in
// force keeps no objects of its own; they are in PngFile.
#include <fmt/format.h>
#include <png.h>

#include <cstdio>

#include "mpm/terrain/height_file.hpp"

namespace mpm {
namespace {

struct PngFile {
  explicit PngFile(const std::string& path) : file(std::fopen(path.c_str(), "rb")) {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, [](png_structp, png_const_charp) {});
    if (png != nullptr) info = png_create_info_struct(png);
  }
  ~PngFile() {
    png_destroy_read_struct(png != nullptr ? &png : nullptr, info != nullptr ? &info : nullptr, nullptr);
    if (file != nullptr) std::fclose(file);
  }
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;

  [[noreturn]] static void fail(png_structp png, png_const_charp what) {
    static_cast<PngFile*>(png_get_error_ptr(png))->error = what;
    png_longjmp(png, 1);
  }

  std::FILE* file;
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string error;
  std::vector<unsigned char> bytes;
  std::vector<png_bytep> rows;
};

bool read_png_head(PngFile& image) {
  if (setjmp(png_jmpbuf(image.png)) != 0) return false;
  png_init_io(image.png, image.file);
  png_set_user_limits(image.png, 0x7fffffff, 0x7fffffff);  // check_height_points() has its own
  png_read_info(image.png, image.info);
  return true;
}

/// To 8 or 16 bits a pixel, whatever is in the file.
bool read_png_rows(PngFile& image) {
  if (setjmp(png_jmpbuf(image.png)) != 0) return false;
  png_set_expand_gray_1_2_4_to_8(image.png);
  png_set_interlace_handling(image.png);
  png_read_update_info(image.png, image.info);
  png_read_image(image.png, image.rows.data());
  return true;
}

}  // namespace

HeightTable read_height_png(const std::string& path, const HeightLimit& limit) {
  PngFile image(path);
  if (image.file == nullptr || image.info == nullptr)
    throw SceneError(path + ": cannot be read; check its permissions");
  const auto broken = [&]() {
    throw SceneError(fmt::format("{}: not a sound PNG: {}; write it again", path, image.error));
  };
  if (!read_png_head(image)) broken();
  const png_uint_32 columns = png_get_image_width(image.png, image.info);
  const png_uint_32 rows = png_get_image_height(image.png, image.info);
  if (png_get_color_type(image.png, image.info) != PNG_COLOR_TYPE_GRAY)
    throw SceneError(path + ": a PNG with colours or transparency; write it as greyscale of 8 or 16 bits");
  if (png_get_valid(image.png, image.info, PNG_INFO_tRNS) != 0)
    throw SceneError(path + ": a PNG with transparent pixels; fill them, or write a GeoTIFF with a no-data value");
  check_height_points(path, columns, rows, limit);
  const bool wide = png_get_bit_depth(image.png, image.info) == 16;
  const std::size_t line = static_cast<std::size_t>(columns) * (wide ? 2 : 1);
  image.bytes.resize(line * rows);
  for (png_uint_32 row = 0; row < rows; ++row) image.rows.push_back(&image.bytes[row * line]);
  if (!read_png_rows(image)) broken();
  HeightTable table;
  table.of_white = true;
  table.columns = static_cast<int>(columns);
  table.rows = static_cast<int>(rows);
  table.values.reserve(static_cast<std::size_t>(columns) * rows);
  for (png_uint_32 row = rows; row-- > 0;) {  // the image's top is at high y
    const unsigned char* at = image.rows[row];
    for (png_uint_32 column = 0; column < columns; ++column) {
      table.values.push_back(wide ? (256 * at[2 * column] + at[2 * column + 1]) / 65535.0 : at[column] / 255.0);
    }
  }
  return table;
}

}  // namespace mpm
