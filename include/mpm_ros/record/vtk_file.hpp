// One .vtp file, or a .pvtp that names pieces: points, lines, or a surface of triangles, with values at each, as VTK's
// XML format of surfaces (PolyData). The numbers stand behind the XML as raw bytes, so that a file is written, and read
// by ParaView, at the speed of the disk.
//
// Weak: at most 2^31 points; uncompressed, and always of the byte order of this machine (which the file names).
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace mpm_ros {

/// A file for ParaView that cannot be written. what() is one line.
class VtkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class VtkFile {
 public:
  /// `time` [s]: what ParaView shows as the file's time. `points`: x, y, z of each in turn [m].
  VtkFile(double time, const std::vector<float>& points);
  /// `fine`: they are written as float64, as float32 else.
  VtkFile(double time, const std::vector<double>& points, bool fine);

  /// Every point is drawn by itself.
  void draw_points();
  /// Three points each, in their order, are a triangle.
  void draw_triangles();
  /// Lines through that many points each, in their order; together all points.
  void draw_lines(const std::vector<std::size_t>& points_of_line);
  /// A value for each point.
  void add(const std::string& name, const std::vector<float>& values);
  void add(const std::string& name, const std::vector<double>& values);
  void add(const std::string& name, const std::vector<std::uint32_t>& values);

  /// @throws VtkError
  void write(const std::string& path) const;
  /// A .pvtp file that names other files, in its folder, as pieces of one: they have the arrays that this one has.
  /// @throws VtkError
  void write_whole(const std::string& path, const std::vector<std::string>& pieces) const;

 private:
  struct Array {
    std::string name;
    const char* type;
    int components;
    std::string bytes;
  };
  template <typename Value>
  static Array array(const std::string& name, const char* type, int components, const std::vector<Value>& values);

  void draw(const char* kind, const std::vector<std::size_t>& points_of_cell);

  double time_;
  std::size_t points_;
  const char* kind_ = "";           ///< kind of what is drawn: "Verts", "Lines" or "Polys"; empty: nothing is
  std::vector<std::int32_t> ends_;  ///< for each cell, the number of points before the next one's
  std::vector<Array> place_, values_;
};

/// `text` with what XML takes for its own replaced.
std::string xml_text(const std::string& text);

}  // namespace mpm_ros
