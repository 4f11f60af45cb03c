// Tables as comma-separated text: a header row with units ("time [s]"), then one row a record. Numbers are written
// in the shortest form that reads back to the same bits.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "mpm/math/geometry.hpp"

namespace mpm_ros {

/// A table that cannot be written: no such folder, no space left, a row of the wrong length.
class CsvError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One file, written row by row; nothing but the present row is held.
class CsvWriter {
 public:
  /// Replaces the file and writes the header. @throws CsvError when the file cannot be opened
  CsvWriter(const std::string& path, const std::vector<std::string>& columns);

  CsvWriter& operator<<(double value);
  CsvWriter& operator<<(float value);
  CsvWriter& operator<<(std::uint64_t value);
  CsvWriter& operator<<(const mpm::Vec3& value);    ///< three cells
  CsvWriter& operator<<(const std::string& value);  ///< quoted when it holds a comma, a quote or a line break
  /// @throws CsvError when the cells are not as many as the columns
  void end_row();
  /// Flushes and closes. @throws CsvError when anything could not be written
  void close();

 private:
  void separate();

  std::string path_;
  std::size_t columns_;
  std::size_t cells_ = 0;
  fmt::memory_buffer row_;
  std::ofstream file_;
};

/// Appends "prefix x [unit]", "prefix y [unit]", "prefix z [unit]"; `prefix` ends as the letter should follow it.
void add_vector_columns(std::vector<std::string>& columns, const std::string& prefix, const std::string& unit);

/// Makes the folder and its parents, if need be. @throws CsvError
void make_csv_folder(const std::string& folder);

/// A file name's stem from any name: what is not a letter, digit, dot, dash or underscore becomes an underscore.
std::string file_stem(const std::string& name);

}  // namespace mpm_ros
