#include "tolerant_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <memory>

#if H5_VERSION_GE(1, 14, 0)
#include <H5FDdevelop.h>
#endif

namespace mpm {
namespace {

/// File that HDF5 passes around; its own part comes first.
struct TolerantFile {
  H5FD_t common{};
  int descriptor = -1;
  haddr_t end_of_space = 0, end_of_file = 0;
  TolerantDisk* disk = nullptr;
};

/// Carried by the access list, copied by value.
struct Access {
  TolerantDisk* disk = nullptr;
};

TolerantFile& of(H5FD_t* file) { return *reinterpret_cast<TolerantFile*>(file); }
const TolerantFile& of(const H5FD_t* file) { return *reinterpret_cast<const TolerantFile*>(file); }

void keep(const TolerantFile& file, int code) {
  if (file.disk->error == 0) file.disk->error = code == 0 ? EIO : code;
}

void* copy_access(const void* access) { return new Access(*static_cast<const Access*>(access)); }

herr_t free_access(void* access) {
  delete static_cast<Access*>(access);
  return 0;
}

H5FD_t* open_file(const char* name, unsigned, hid_t access_list, haddr_t) {
  const auto* access = static_cast<const Access*>(H5Pget_driver_info(access_list));
  if (access == nullptr) return nullptr;
  auto file = std::make_unique<TolerantFile>();
  file->disk = access->disk;
  file->descriptor = open(name, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file->descriptor < 0) {
    keep(*file, errno);
    return nullptr;
  }
  return &file.release()->common;
}

herr_t close_file(H5FD_t* file) {
  const std::unique_ptr<TolerantFile> own(&of(file));
  if (close(own->descriptor) != 0) keep(*own, errno);
  return 0;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  if (flags != nullptr) {
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA;
  }
  return 0;
}

haddr_t end_of_space(const H5FD_t* file, H5FD_mem_t) { return of(file).end_of_space; }

herr_t set_end_of_space(H5FD_t* file, H5FD_mem_t, haddr_t address) {
  of(file).end_of_space = address;
  return 0;
}

haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t) { return of(file).end_of_file; }

/// Reads zeros for what lies beyond the end of the file, or was not written.
herr_t read_file(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, size_t size, void* buffer) {
  auto* to = static_cast<char*>(buffer);
  while (size > 0) {
    const ssize_t part = pread(of(file).descriptor, to, size, static_cast<off_t>(address));
    if (part < 0 && errno == EINTR) continue;
    if (part <= 0) {
      if (part < 0) keep(of(file), errno);
      std::memset(to, 0, size);
      return 0;
    }
    to += part;
    address += static_cast<haddr_t>(part);
    size -= static_cast<size_t>(part);
  }
  return 0;
}

herr_t write_file(H5FD_t* file, H5FD_mem_t kind, hid_t, haddr_t address, size_t size, const void* buffer) {
  TolerantFile& own = of(file);
  own.end_of_file = std::max(own.end_of_file, address + size);
  if (kind == H5FD_MEM_DRAW && own.disk->leaves_out) return 0;
  const auto* from = static_cast<const char*>(buffer);
  while (size > 0 && own.disk->error == 0) {
    const ssize_t part = pwrite(own.descriptor, from, size, static_cast<off_t>(address));
    if (part < 0 && errno == EINTR) continue;
    if (part <= 0) {
      keep(own, part < 0 ? errno : ENOSPC);
      break;
    }
    from += part;
    address += static_cast<haddr_t>(part);
    size -= static_cast<size_t>(part);
  }
  return 0;
}

herr_t truncate_file(H5FD_t* file, hid_t, hbool_t) {
  TolerantFile& own = of(file);
  if (own.end_of_file == own.end_of_space) return 0;
  if (own.disk->error == 0 && ftruncate(own.descriptor, static_cast<off_t>(own.end_of_space)) != 0) keep(own, errno);
  own.end_of_file = own.end_of_space;
  return 0;
}

/// Registered once for the process; negative when HDF5 refuses.
hid_t driver() {
  static const hid_t id = [] {
    static H5FD_class_t type{};
#if H5_VERSION_GE(1, 14, 0)
    type.version = H5FD_CLASS_VERSION;
    type.value = static_cast<H5FD_class_value_t>(600);  // number of the range for programs' own
#endif
    type.name = "mpm_tolerant";
    type.maxaddr = (haddr_t{1} << 62) - 1;
    type.fc_degree = H5F_CLOSE_WEAK;
    type.fapl_size = sizeof(Access);
    type.fapl_copy = copy_access;
    type.fapl_free = free_access;
    type.open = open_file;
    type.close = close_file;
    type.query = query;
    type.get_eoa = end_of_space;
    type.set_eoa = set_end_of_space;
    type.get_eof = end_of_file;
    type.read = read_file;
    type.write = write_file;
    type.truncate = truncate_file;
    const H5FD_mem_t one_kind[] = H5FD_FLMAP_DICHOTOMY;
    std::copy(std::begin(one_kind), std::end(one_kind), type.fl_map);
    return H5FDregister(&type);
  }();
  return id;
}

}  // namespace

bool write_tolerantly(hid_t access_list, TolerantDisk& disk) {
  const Access access{&disk};
  return driver() >= 0 && H5Pset_driver(access_list, driver(), &access) >= 0;
}

}  // namespace mpm
