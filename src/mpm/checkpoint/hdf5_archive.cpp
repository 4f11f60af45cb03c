#include "hdf5_archive.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <utility>

#include "mpm/math/input_file.hpp"
#include "mpm/math/output_file.hpp"

namespace mpm {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 20;  ///< numbers that have one checksum
constexpr std::size_t kChecksum = 4;                  ///< [bytes]

hid_t type_of(StateArchive::Number number) {
  switch (number) {
    case StateArchive::Number::float32:
      return H5T_NATIVE_FLOAT;
    case StateArchive::Number::float64:
      return H5T_NATIVE_DOUBLE;
    case StateArchive::Number::int32:
      return H5T_NATIVE_INT32;
    case StateArchive::Number::int64:
      return H5T_NATIVE_INT64;
    case StateArchive::Number::uint8:
      return H5T_NATIVE_UINT8;
    case StateArchive::Number::uint32:
      return H5T_NATIVE_UINT32;
    case StateArchive::Number::uint64:
      return H5T_NATIVE_UINT64;
  }
  return -1;
}

/// HDF5 as Debian packages it serves one thread at a time, and several runs of one program may read or write at once.
/// Recursive: an Hdf5Id closes within calls that hold it.
std::recursive_mutex one_at_a_time;

/// Reason why no file of that name can be written; empty if it can.
std::string problem_with(const std::string& path) {
  if (std::string refused = refused_output(path); !refused.empty()) return refused;  // a pipe would wait to be opened
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return std::strerror(errno);
  std::fclose(file);
  return {};
}

}  // namespace

CheckpointError not_written_whole(const std::string& path, int error) {
  const std::string reason = error != 0 ? fmt::format(" ({})", std::strerror(error)) : "";
  return CheckpointError(fmt::format(
      "checkpoint {}: cannot be written whole{}; check the space on its disk, and try again", path, reason));
}

bool Hdf5Id::close() {
  if (id_ < 0) return false;
  const std::lock_guard<std::recursive_mutex> lock(one_at_a_time);
  return close_(std::exchange(id_, -1)) >= 0;
}

void silence_hdf5() {
  const std::lock_guard<std::recursive_mutex> lock(one_at_a_time);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // handler of this thread, if the library knows threads
  // The library has asked to be closed at exit before, when it was first called; what is asked for later comes first.
  [[maybe_unused]] static const int at_exit = std::atexit([] { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); });
}

Hdf5Writer::Hdf5Writer(const std::string& path) : path_(path) {
  const std::lock_guard<std::recursive_mutex> lock(one_at_a_time);
  silence_hdf5();
  if (const std::string problem = problem_with(path); !problem.empty()) {
    throw CheckpointError(
        fmt::format("checkpoint {}: cannot be written: {}; check its folder and the space on its disk", path, problem));
  }
  // The later layouts of HDF5 have checksums for what is not data, and small lists of chunks.
  const Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  if (!access || H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110) < 0 || !write_tolerantly(access, disk_))
    fail();
  file_ = {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose};
  make_groups_ = {H5Pcreate(H5P_LINK_CREATE), H5Pclose};
  if (!file_ || !make_groups_ || H5Pset_create_intermediate_group(make_groups_, 1) < 0) fail();
}

Hdf5Id Hdf5Writer::make(const std::string& name, Number number, std::size_t count, std::size_t chunk,
                        H5D_alloc_time_t placed) {
  const std::lock_guard<std::recursive_mutex> lock(one_at_a_time);
  const hsize_t size = count;
  const Hdf5Id space(count == 0 ? H5Screate(H5S_NULL) : H5Screate_simple(1, &size, nullptr), H5Sclose);
  if (!space) fail();
  const Hdf5Id layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  const hsize_t part = std::min(count, chunk);
  if (!layout || (count > 0 && (H5Pset_chunk(layout, 1, &part) < 0 || H5Pset_fletcher32(layout) < 0 ||
                                H5Pset_alloc_time(layout, placed) < 0))) {
    fail();
  }
  Hdf5Id set(H5Dcreate2(file_, name.c_str(), type_of(number), space, make_groups_, layout, H5P_DEFAULT), H5Dclose);
  if (!set || disk_.error != 0) fail();
  return set;
}

void Hdf5Writer::values(const std::string& name, Number number, void* data, std::size_t count) {
  const std::lock_guard<std::recursive_mutex> lock(one_at_a_time);
  const Hdf5Id set = make(name, number, count, kChunk, H5D_ALLOC_TIME_INCR);
  if (count > 0 && H5Dwrite(set, type_of(number), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) fail();
  if (disk_.error != 0) fail();  // the rest would be of no use
}

std::vector<std::uint64_t> Hdf5Writer::places(const std::string& name, Number number, std::size_t count,
                                              std::size_t chunk) {
  const std::lock_guard<std::recursive_mutex> lock(one_at_a_time);
  disk_.leaves_out = true;  // the library would fill what it makes room for
  const Hdf5Id set = make(name, number, count, chunk, H5D_ALLOC_TIME_EARLY);
  disk_.leaves_out = false;
  const std::size_t whole = chunk * H5Tget_size(type_of(number)) + kChecksum;
  std::vector<std::uint64_t> list;
  for (hsize_t first = 0; first < count; first += chunk) {
    unsigned without = 0;
    haddr_t place = HADDR_UNDEF;
    hsize_t bytes = 0;
    if (H5Dget_chunk_info_by_coord(set, &first, &without, &place, &bytes) < 0 || without != 0 || bytes != whole ||
        place == HADDR_UNDEF) {
      fail();
    }
    list.push_back(place);
  }
  return list;
}

void Hdf5Writer::close() {
  const std::lock_guard<std::recursive_mutex> lock(one_at_a_time);
  if (H5Fflush(file_, H5F_SCOPE_GLOBAL) < 0 || !file_.close() || disk_.error != 0) fail();
}

void Hdf5Writer::fail() const { throw not_written_whole(path_, disk_.error); }

Hdf5Reader::Hdf5Reader(const std::string& path) : path_(path) {
  const std::lock_guard<std::recursive_mutex> lock(one_at_a_time);
  silence_hdf5();
  if (const std::string refused = refused_input(path); !refused.empty())
    throw CheckpointError(fmt::format("checkpoint {}: {}", path, refused));
  if (H5Fis_hdf5(path.c_str()) <= 0) {
    throw CheckpointError(fmt::format(
        "checkpoint {}: it is no HDF5 file; name one that run_scene --checkpoint or save_checkpoint has written",
        path));
  }
  file_ = {H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose};
  if (!file_) {
    throw CheckpointError(fmt::format("checkpoint {}: it is cut off or damaged; take an earlier one", path));
  }
}

Hdf5Id Hdf5Reader::open(const std::string& name) const {
  Hdf5Id set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set) {
    throw CheckpointError(fmt::format(
        "checkpoint {}: it has no '{}': it is no checkpoint of this scene and version, or damaged", path_, name));
  }
  return set;
}

bool Hdf5Reader::has(const std::string& name) const {
  const std::lock_guard<std::recursive_mutex> lock(one_at_a_time);
  return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0;
}

void Hdf5Reader::part(const std::string& name, Number number, void* data, std::size_t first, std::size_t count) {
  if (count == 0) return;
  const std::lock_guard<std::recursive_mutex> lock(one_at_a_time);
  const Hdf5Id set = open(name);
  const hsize_t begin = first, size = count;
  const Hdf5Id there(H5Dget_space(set), H5Sclose), here(H5Screate_simple(1, &size, nullptr), H5Sclose);
  if (!there || !here || H5Sselect_hyperslab(there, H5S_SELECT_SET, &begin, nullptr, &size, nullptr) < 0 ||
      H5Dread(set, type_of(number), here, there, H5P_DEFAULT, data) < 0) {
    throw CheckpointError(
        fmt::format("checkpoint {}: '{}' cannot be read: the file is cut off or damaged", path_, name));
  }
}

std::size_t Hdf5Reader::stored(const std::string& name) {
  const std::lock_guard<std::recursive_mutex> lock(one_at_a_time);
  const Hdf5Id set = open(name);
  const Hdf5Id space(H5Dget_space(set), H5Sclose);
  const hssize_t count = space ? H5Sget_simple_extent_npoints(space) : -1;
  if (count < 0) throw CheckpointError(fmt::format("checkpoint {}: '{}' is damaged", path_, name));
  return static_cast<std::size_t>(count);
}

void Hdf5Reader::values(const std::string& name, Number number, void* data, std::size_t count) {
  const std::lock_guard<std::recursive_mutex> lock(one_at_a_time);
  if (const std::size_t there = stored(name); there != count) {
    throw CheckpointError(
        fmt::format("checkpoint {}: '{}' has {} numbers where {} belong: it is of another scene, or "
                    "damaged",
                    path_, name, there, count));
  }
  if (count == 0) return;
  const Hdf5Id set = open(name);
  if (H5Dread(set, type_of(number), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) {
    throw CheckpointError(
        fmt::format("checkpoint {}: '{}' cannot be read: the file is cut off or damaged", path_, name));
  }
}

}  // namespace mpm
