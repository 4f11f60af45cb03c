// A hash of bytes: FNV-1a, 64 bits. Tells things apart that differ by chance; it is no defence against whoever means
// harm. Source: Fowler, Noll, Vo; Eastlake et al. (2019), The FNV Non-Cryptographic Hash Algorithm.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace mpm {

class ByteHash {
 public:
  void add(const char* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) add_byte(static_cast<unsigned char>(bytes[i]));
  }
  /// The bytes of a number as they lie in memory.
  template <class Number>
  void add(const Number& number) {
    unsigned char bytes[sizeof(Number)];
    std::memcpy(bytes, &number, sizeof(Number));
    for (const unsigned char byte : bytes) add_byte(byte);
  }
  std::uint64_t value() const { return value_; }

 private:
  void add_byte(unsigned char byte) {
    value_ ^= byte;
    value_ *= 1099511628211ull;
  }

  std::uint64_t value_ = 14695981039346656037ull;
};

}  // namespace mpm
