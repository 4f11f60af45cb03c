// Driver by which HDF5 reaches the disk when a checkpoint is written. Private to this folder.
//
// HDF5 cannot let go of a file that it could not write: closing it fails, its memory stays, and the library tries again
// when the process ends, where that is a segmentation fault. This file driver therefore tells the library that every
// write went well, and keeps the first error for whoever asks at the end; the file is then removed. It can also leave
// out the data of arrays, which others write where the library gave them a place (chunk_writer.hpp). Source: HDF5
// reference manual, Virtual File Layer.
#pragma once

#include <hdf5.h>

namespace mpm {

/// A file that is written by the driver.
struct TolerantDisk {
  int error = 0;            ///< the first: a value of errno; 0: none
  bool leaves_out = false;  ///< data of arrays are not written, but get their place
};

/// Has the files of this access list written by the driver, which makes each anew. `disk` must outlive them. False
/// when HDF5 refuses.
bool write_tolerantly(hid_t access_list, TolerantDisk& disk);

}  // namespace mpm
