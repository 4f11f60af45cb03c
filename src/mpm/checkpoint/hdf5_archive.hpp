// State in an HDF5 file: one dataset for each array, one group for each group of names, with checksums (fletcher32).
// Private to this folder. Source: HDF5 reference manual, C interface.
#pragma once

#include <hdf5.h>

#include <string>
#include <vector>

#include "mpm/checkpoint/checkpoint.hpp"
#include "tolerant_file.hpp"

namespace mpm {

/// An HDF5 identifier, closed by what it was opened with.
class Hdf5Id {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Id() = default;
  Hdf5Id(hid_t id, Close close) : id_(id), close_(close) {}
  Hdf5Id(Hdf5Id&& other) noexcept { swap(other); }
  Hdf5Id& operator=(Hdf5Id other) noexcept {
    swap(other);
    return *this;
  }
  ~Hdf5Id() { this->close(); }
  /// False when it could not be, or was never open.
  bool close();
  explicit operator bool() const { return id_ >= 0; }
  operator hid_t() const { return id_; }  // NOLINT: as the C interface takes it

 private:
  void swap(Hdf5Id& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
  }
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// From here on the library prints no errors: they become ours. Not only while a file is open: what a damaged file
/// leaves open is closed when the program ends, in whichever thread that is.
void silence_hdf5();

/// Error for a disk that did not take all. `error`: a value of errno; 0: not known.
CheckpointError not_written_whole(const std::string& path, int error);

class Hdf5Writer final : public StateArchive {
 public:
  /// Makes the file anew. @throws CheckpointError
  explicit Hdf5Writer(const std::string& path);
  bool reading() const override { return false; }
  /// All is with the system then. @throws CheckpointError
  void close();
  /// An array under its whole name. @throws CheckpointError
  void array(const std::string& name, Number number, void* data, std::size_t count) {
    values(name, number, data, count);
  }
  /// Makes an array whose numbers others write, each `chunk` of them with their checksum (chunk_writer.hpp), the last
  /// ones filled up to as many. Returns where in the file each chunk has its place [bytes]. @throws CheckpointError
  std::vector<std::uint64_t> places(const std::string& name, Number number, std::size_t count, std::size_t chunk);

 protected:
  void values(const std::string& name, Number number, void* data, std::size_t count) override;
  std::size_t stored(const std::string&) override { return 0; }

 private:
  Hdf5Id make(const std::string& name, Number number, std::size_t count, std::size_t chunk, H5D_alloc_time_t placed);
  [[noreturn]] void fail() const;
  std::string path_;
  TolerantDisk disk_;
  Hdf5Id file_, make_groups_;
};

class Hdf5Reader final : public StateArchive {
 public:
  /// @throws CheckpointError for a file that cannot be read or is not HDF5
  explicit Hdf5Reader(const std::string& path);
  bool reading() const override { return true; }
  bool has(const std::string& name) const;
  // Access to arrays by their whole names. @throws CheckpointError
  std::size_t count(const std::string& name) { return stored(name); }
  void array(const std::string& name, Number number, void* data, std::size_t count) {
    values(name, number, data, count);
  }
  /// So many numbers from number `first` on.
  void part(const std::string& name, Number number, void* data, std::size_t first, std::size_t count);

 protected:
  void values(const std::string& name, Number number, void* data, std::size_t count) override;
  std::size_t stored(const std::string& name) override;

 private:
  Hdf5Id open(const std::string& name) const;
  std::string path_;
  Hdf5Id file_;
};

}  // namespace mpm
