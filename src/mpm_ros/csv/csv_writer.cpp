#include "mpm_ros/csv/csv_writer.hpp"

#include <cctype>
#include <filesystem>
#include <iterator>
#include <system_error>

#include "mpm/math/output_file.hpp"

namespace mpm_ros {

CsvWriter::CsvWriter(const std::string& path, const std::vector<std::string>& columns)
    : path_(path), columns_(columns.size()) {
  if (const std::string problem = mpm::open_output(file_, path); !problem.empty())
    throw CsvError(path + ": cannot be written: " + problem);
  for (const std::string& column : columns) *this << column;
  end_row();
}

void CsvWriter::separate() {
  if (cells_++ > 0) row_.push_back(',');
}

CsvWriter& CsvWriter::operator<<(double value) {
  separate();
  fmt::format_to(std::back_inserter(row_), "{}", value);
  return *this;
}

CsvWriter& CsvWriter::operator<<(float value) {
  separate();
  fmt::format_to(std::back_inserter(row_), "{}", value);
  return *this;
}

CsvWriter& CsvWriter::operator<<(std::uint64_t value) {
  separate();
  fmt::format_to(std::back_inserter(row_), "{}", value);
  return *this;
}

CsvWriter& CsvWriter::operator<<(const mpm::Vec3& value) { return *this << value.x() << value.y() << value.z(); }

CsvWriter& CsvWriter::operator<<(const std::string& value) {
  separate();
  if (value.find_first_of(",\"\r\n") == std::string::npos) {
    row_.append(value);
    return *this;
  }
  row_.push_back('"');
  for (const char c : value) {
    if (c == '"') row_.push_back('"');
    row_.push_back(c);
  }
  row_.push_back('"');
  return *this;
}

void CsvWriter::end_row() {
  if (cells_ != columns_) {
    throw CsvError(fmt::format("{}: a row of {} cells under {} columns", path_, cells_, columns_));
  }
  row_.push_back('\n');
  file_.write(row_.data(), static_cast<std::streamsize>(row_.size()));
  row_.clear();
  cells_ = 0;
  if (!file_) throw CsvError(path_ + ": cannot be written; is the disk full?");
}

void CsvWriter::close() {
  file_.close();
  if (!file_) throw CsvError(path_ + ": cannot be written; is the disk full?");
}

void add_vector_columns(std::vector<std::string>& columns, const std::string& prefix, const std::string& unit) {
  for (const char* axis : {"x", "y", "z"}) columns.push_back(prefix + axis + " [" + unit + "]");
}

void make_csv_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw CsvError(folder + ": the folder cannot be made: " + error.message() + "; choose another");
}

std::string file_stem(const std::string& name) {
  std::string stem = name;
  for (char& c : stem) {
    const bool keep = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '_';
    if (!keep) c = '_';
  }
  return stem;
}

}  // namespace mpm_ros
