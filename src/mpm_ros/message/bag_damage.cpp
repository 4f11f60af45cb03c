#include "mpm_ros/message/bag_damage.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace mpm_ros {

namespace {

constexpr std::string_view kFirstLine = "#ROSBAG V2.0\n";
constexpr std::uint8_t kIndex = 4, kChunk = 5, kConnection = 7;  // kinds of records
constexpr std::size_t kEntry = 12, kPlace = 8;                   // sizes in an index: a time, then a place in the chunk

/// A file as it lies on the disk, in memory.
class MappedFile {
 public:
  explicit MappedFile(const std::string& path) {
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    struct stat about {};
    if (file < 0) return;
    if (fstat(file, &about) == 0 && S_ISREG(about.st_mode) && about.st_size > 0) {
      size_ = static_cast<std::size_t>(about.st_size);
      bytes_ = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
      if (bytes_ == MAP_FAILED) size_ = 0;
    }
    close(file);
  }
  ~MappedFile() {
    if (size_ > 0) munmap(bytes_, size_);
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  std::string_view bytes() const { return {static_cast<const char*>(bytes_), size_}; }

 private:
  void* bytes_ = nullptr;
  std::size_t size_ = 0;
};

template <typename Number>
Number number_at(std::string_view bytes, std::size_t at) {
  if (bytes.size() < at + sizeof(Number)) throw std::out_of_range("a length or place is missing");
  Number number;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

/// Bytes that follow their length of four bytes.
std::string_view part_at(std::string_view bytes, std::size_t at) {
  const auto length = number_at<std::uint32_t>(bytes, at);
  if (bytes.size() - at - 4 < length) throw std::out_of_range("it says that it is longer than what it lies in");
  return bytes.substr(at + 4, length);
}

using Fields = std::map<std::string_view, std::string_view>;

Fields fields_of(std::string_view header) {
  Fields fields;
  for (std::size_t at = 0; at < header.size();) {
    const std::string_view field = part_at(header, at);
    const std::size_t equals = field.find('=');
    if (equals == std::string_view::npos) throw std::out_of_range("a field of its header has no name");
    fields[field.substr(0, equals)] = field.substr(equals + 1);
    at += 4 + field.size();
  }
  return fields;
}

template <typename Number>
Number field(const Fields& fields, std::string_view name) {
  const auto found = fields.find(name);
  if (found == fields.end() || found->second.size() != sizeof(Number))
    throw std::out_of_range(fmt::format("its header has no '{}'", name));
  return number_at<Number>(found->second, 0);
}

struct Record {
  Fields header;
  std::string_view data;
  std::size_t end = 0;  // place behind it
};

Record record_at(std::string_view bytes, std::size_t at) {
  Record record;
  const std::string_view header = part_at(bytes, at);
  record.header = fields_of(header);
  record.data = part_at(bytes, at + 4 + header.size());
  record.end = at + 8 + header.size() + record.data.size();
  return record;
}

/// The chunk that was read last: what indices behind it name.
struct Chunk {
  std::vector<std::uint32_t> places;  // places of its records, if they can be seen
  bool packed = false;
  std::uint32_t size = 0;  // unpacked

  void check(std::uint32_t place) const {
    if (packed ? place < size : std::binary_search(places.begin(), places.end(), place)) return;
    throw std::out_of_range(fmt::format("it names a message at byte {} of its chunk, where none begins", place));
  }
};

Chunk read_chunk(const Record& record) {
  Chunk chunk;
  chunk.size = field<std::uint32_t>(record.header, "size");
  const auto compression = record.header.find("compression");
  chunk.packed = compression == record.header.end() || compression->second != "none";
  if (chunk.packed) return chunk;
  if (chunk.size != record.data.size()) throw std::out_of_range("its size is not that of what is in it");
  for (std::size_t at = 0; at < record.data.size();) {
    const Record inner = record_at(record.data, at);
    if (field<std::uint8_t>(inner.header, "op") == kConnection) fields_of(inner.data);
    chunk.places.push_back(static_cast<std::uint32_t>(at));
    at = inner.end;
  }
  return chunk;
}

}  // namespace

std::string bag_damage(const std::string& path) {
  const MappedFile file(path);
  const std::string_view bytes = file.bytes();
  if (bytes.substr(0, kFirstLine.size()) != kFirstLine) return {};
  std::size_t at = kFirstLine.size();
  try {
    // Behind the chunks stands what rosbag looks at by itself. A bag that was cut off, or not closed, has not even
    // that.
    const auto end = field<std::uint64_t>(record_at(bytes, at).header, "index_pos");
    if (end == 0 || end > bytes.size()) return {};
    Chunk chunk;
    while (at < end) {
      const Record record = record_at(bytes, at);
      const auto op = field<std::uint8_t>(record.header, "op");
      if (op == kChunk) {
        chunk = read_chunk(record);
      } else if (op == kIndex) {
        if (record.data.size() != kEntry * field<std::uint32_t>(record.header, "count"))
          throw std::out_of_range("its count is not that of what is in it");
        for (std::size_t i = kPlace; i < record.data.size(); i += kEntry)
          chunk.check(number_at<std::uint32_t>(record.data, i));
      }
      at = record.end;
    }
  } catch (const std::out_of_range& error) {
    return fmt::format("damaged: the record at byte {} cannot be read: {}", at, error.what());
  }
  return {};
}

}  // namespace mpm_ros
