// The numbers that a rank writes of arrays in a checkpoint's HDF5 file, beside the other ranks. The first rank has the
// library make the arrays and give each chunk of them a place (Hdf5Writer::places()); each rank writes its chunks
// there, with the checksum that the library finds when it reads them. So the file is as if the library had written it.
// Private to this folder.
//
// The library's own way, MPI-IO, does not keep what a checkpoint promises (HDF5 1.10.8, Open MPI 4.1 with OMPIO and
// with ROMIO): where a disk is full some ranks get an error, and others wait for them for ever. It also writes every
// chunk that has a checksum twice, and is slower than one rank that writes all (doc/decisions.md). Weak: there is no
// collective buffering, so each chunk is a write of its own.
//
// Source: HDF5 file format specification, version 3, "Fletcher32 checksum filter"; Fletcher (1982), An arithmetic
// checksum for serial transmissions, IEEE Trans. Commun. 30, 247-252.
#pragma once

#include <cstdint>
#include <string>

#include "mpm/checkpoint/checkpoint.hpp"

namespace mpm {

class ChunkWriter {
 public:
  /// Opens a file that another rank has made, with the inode number that it has there. @throws CheckpointError
  ChunkWriter(const std::string& path, std::uint64_t inode);
  ChunkWriter(const ChunkWriter&) = delete;
  ChunkWriter& operator=(const ChunkWriter&) = delete;
  ~ChunkWriter();

  /// Numbers of one chunk; `bytes` is even. @throws CheckpointError
  void write(std::uint64_t place, const void* numbers, std::size_t bytes);
  /// All is with the system then. @throws CheckpointError
  void close();

 private:
  void write_bytes(std::uint64_t place, const void* data, std::size_t bytes);
  std::string path_;
  int descriptor_ = -1;
};

}  // namespace mpm
