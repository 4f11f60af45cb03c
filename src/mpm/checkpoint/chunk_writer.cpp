#include "chunk_writer.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "hdf5_archive.hpp"
#include "mpm/math/output_file.hpp"

namespace mpm {
namespace {

/// Checksum of words of 16 bits whose first byte is the higher one, as the library takes them on all machines.
std::uint32_t fletcher32(const void* data, std::size_t bytes) {
  constexpr std::size_t kWords = 360;  // so many sums do not leave 32 bits
  const auto* byte = static_cast<const unsigned char*>(data);
  const auto folded = [](std::uint32_t sum) { return (sum & 0xffff) + (sum >> 16); };
  std::uint32_t sum = 0, sum_of_sums = 0;
  for (std::size_t left = bytes / 2; left > 0;) {
    const std::size_t words = std::min(left, kWords);
    for (std::size_t i = 0; i < words; ++i, byte += 2) {
      sum += static_cast<std::uint32_t>(byte[0] << 8 | byte[1]);
      sum_of_sums += sum;
    }
    sum = folded(sum);
    sum_of_sums = folded(sum_of_sums);
    left -= words;
  }
  return folded(sum_of_sums) << 16 | folded(sum);
}

}  // namespace

ChunkWriter::ChunkWriter(const std::string& path, std::uint64_t inode) : path_(path) {
  std::string problem = refused_output(path);  // a pipe would wait to be opened
  if (problem.empty()) {
    descriptor_ = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) problem = std::strerror(errno);
  }
  struct stat about {};
  if (problem.empty() && (fstat(descriptor_, &about) != 0 || about.st_ino != inode)) {
    problem = "it is another file than on the first rank";
  }
  if (problem.empty()) return;
  if (descriptor_ >= 0) ::close(descriptor_);
  throw CheckpointError(fmt::format(
      "checkpoint {}: cannot be written by all ranks: {}; put it into a folder that all their machines share", path,
      problem));
}

ChunkWriter::~ChunkWriter() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void ChunkWriter::write(std::uint64_t place, const void* numbers, std::size_t bytes) {
  const std::uint32_t sum = fletcher32(numbers, bytes);
  unsigned char checksum[4];
  for (int i = 0; i < 4; ++i) checksum[i] = static_cast<unsigned char>(sum >> 8 * i);
  write_bytes(place, numbers, bytes);
  write_bytes(place + bytes, checksum, sizeof checksum);
}

void ChunkWriter::write_bytes(std::uint64_t place, const void* data, std::size_t bytes) {
  const auto* from = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t part = pwrite(descriptor_, from, bytes, static_cast<off_t>(place));
    if (part < 0 && errno == EINTR) continue;
    if (part <= 0) throw not_written_whole(path_, part < 0 ? errno : ENOSPC);
    from += part;
    place += static_cast<std::uint64_t>(part);
    bytes -= static_cast<std::size_t>(part);
  }
}

void ChunkWriter::close() {
  if (::close(std::exchange(descriptor_, -1)) != 0) throw not_written_whole(path_, errno);
}

}  // namespace mpm
