#include "mpm_ros/record/vtk_file.hpp"

#include <boost/predef/other/endian.h>
#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <numeric>

#include "mpm/math/output_file.hpp"

namespace mpm_ros {
namespace {

constexpr const char* kByteOrder = BOOST_ENDIAN_LITTLE_BYTE ? "LittleEndian" : "BigEndian";

}  // namespace

VtkFile::VtkFile(double time, const std::vector<float>& points) : time_(time), points_(points.size() / 3) {
  place_.push_back(array("Points", "Float32", 3, points));
}

VtkFile::VtkFile(double time, const std::vector<double>& points, bool fine) : time_(time), points_(points.size() / 3) {
  if (fine) {
    place_.push_back(array("Points", "Float64", 3, points));
  } else {
    place_.push_back(array("Points", "Float32", 3, std::vector<float>(points.begin(), points.end())));
  }
}

template <typename Value>
VtkFile::Array VtkFile::array(const std::string& name, const char* type, int components,
                              const std::vector<Value>& values) {
  Array result{name, type, components, std::string(values.size() * sizeof(Value), '\0')};
  if (!values.empty()) std::memcpy(result.bytes.data(), values.data(), result.bytes.size());
  return result;
}

void VtkFile::draw_points() { draw("Verts", std::vector<std::size_t>(points_, 1)); }

void VtkFile::draw_triangles() { draw("Polys", std::vector<std::size_t>(points_ / 3, 3)); }

void VtkFile::draw_lines(const std::vector<std::size_t>& points_of_line) { draw("Lines", points_of_line); }

void VtkFile::draw(const char* kind, const std::vector<std::size_t>& points_of_cell) {
  kind_ = kind;
  ends_.clear();
  std::int32_t end = 0;
  for (const std::size_t points : points_of_cell) ends_.push_back(end += static_cast<std::int32_t>(points));
}

void VtkFile::add(const std::string& name, const std::vector<float>& values) {
  values_.push_back(array(name, "Float32", 1, values));
}

void VtkFile::add(const std::string& name, const std::vector<double>& values) {
  values_.push_back(array(name, "Float64", 1, values));
}

void VtkFile::add(const std::string& name, const std::vector<std::uint32_t>& values) {
  values_.push_back(array(name, "UInt32", 1, values));
}

void VtkFile::write(const std::string& path) const {
  std::vector<Array> cells;
  const std::string kind = kind_;
  if (!kind.empty()) {
    std::vector<std::int32_t> corners(ends_.empty() ? 0 : static_cast<std::size_t>(ends_.back()));
    std::iota(corners.begin(), corners.end(), 0);
    cells = {array("connectivity", "Int32", 1, corners), array("offsets", "Int32", 1, ends_)};
  }

  // Each array lies behind its length, 64 bits; `offset` counts from the first byte behind the underscore.
  std::uint64_t offset = 0;
  const auto describe = [&offset](const std::vector<Array>& arrays) {
    std::string text;
    for (const Array& entry : arrays) {
      text += fmt::format(
          "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
          entry.type, xml_text(entry.name), entry.components, offset);
      offset += sizeof(std::uint64_t) + entry.bytes.size();
    }
    return text;
  };
  const auto drawn = [&](const char* name) { return kind == name ? ends_.size() : 0; };
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\">\n"
      "<PolyData>\n<FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
      "format=\"ascii\">{:.17g}"
      "</DataArray></FieldData>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"{}\">\n",
      kByteOrder, time_, points_, drawn("Verts"), drawn("Lines"), drawn("Polys"));
  text += "<Points>\n" + describe(place_) + "</Points>\n";
  if (!kind.empty()) text += fmt::format("<{0}>\n{1}</{0}>\n", kind, describe(cells));
  text +=
      "<PointData>\n" + describe(values_) + "</PointData>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";

  std::ofstream file;
  if (const std::string problem = mpm::open_output(file, path); !problem.empty())
    throw VtkError(fmt::format("{}: cannot be written: {}", path, problem));
  file << text;
  const auto append = [&file](const std::vector<Array>& arrays) {
    for (const Array& entry : arrays) {
      const std::uint64_t size = entry.bytes.size();
      file.write(reinterpret_cast<const char*>(&size), sizeof(size));
      file.write(entry.bytes.data(), static_cast<std::streamsize>(size));
    }
  };
  append(place_);
  append(cells);
  append(values_);
  file << "\n</AppendedData>\n</VTKFile>\n";
  file.close();
  if (!file) throw VtkError(fmt::format("{}: cannot be written; check the space on its disk", path));
}

void VtkFile::write_whole(const std::string& path, const std::vector<std::string>& pieces) const {
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PPolyData\" version=\"1.0\" byte_order=\"{}\" "
      "header_type=\"UInt64\">\n<PPolyData GhostLevel=\"0\">\n",
      kByteOrder);
  const auto describe = [&text](const char* what, const std::vector<Array>& arrays) {
    text += fmt::format("<{}>\n", what);
    for (const Array& entry : arrays) {
      text += fmt::format("<PDataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n", entry.type,
                          xml_text(entry.name), entry.components);
    }
    text += fmt::format("</{}>\n", what);
  };
  describe("PPoints", place_);
  describe("PPointData", values_);
  for (const std::string& piece : pieces) text += fmt::format("<Piece Source=\"{}\"/>\n", xml_text(piece));
  text += "</PPolyData>\n</VTKFile>\n";
  std::ofstream file;
  if (const std::string problem = mpm::open_output(file, path); !problem.empty())
    throw VtkError(fmt::format("{}: cannot be written: {}", path, problem));
  file << text;
  file.close();
  if (!file) throw VtkError(fmt::format("{}: cannot be written; check the space on its disk", path));
}

std::string xml_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

}  // namespace mpm_ros
