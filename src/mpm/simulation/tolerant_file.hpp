// How HDF5 reaches the disk when a checkpoint is written. Private to this folder.
//
// HDF5 cannot let go of a file that it could not write: closing it fails, its memory stays, and the library tries again
// when the process ends, where that is a segmentation fault. This file driver therefore tells the library that every
// write went well, and keeps the first error for whoever asks at the end; the file is then removed. Source: HDF5
// reference manual, Virtual File Layer.
#pragma once

#include <hdf5.h>

#include <string>

namespace mpm {

/// The first error of a file that was written by the driver: a value of errno; 0: none.
struct DiskError {
  int code = 0;
};

/// Has the files of this access list written by the driver, which makes each anew. `error` must outlive them. False
/// when HDF5 refuses.
bool write_tolerantly(hid_t access_list, DiskError& error);

}  // namespace mpm
