// A hash of all that is kept, in the order in which it is: FNV-1a over words of eight bytes, one an array's length.
// Tells two states apart, and a file that was damaged from a whole one; it is no defence against whoever means harm.
#pragma once

#include <algorithm>
#include <cstring>

#include "mpm/math/state_archive.hpp"

namespace mpm {

class StateHash final : public StateArchive {
 public:
  bool reading() const override { return false; }
  std::uint64_t value() const { return value_; }

 protected:
  void values(const std::string& /*name*/, Number number, void* data, std::size_t count) override {
    add(count);
    const std::size_t size = number == Number::uint8 ? 1 : of_four(number) ? 4 : 8, bytes = size * count;
    const auto* from = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < bytes; i += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, from + i, std::min(sizeof(word), bytes - i));
      add(word);
    }
  }
  std::size_t stored(const std::string& /*name*/) override { return 0; }

 private:
  static bool of_four(Number number) {
    return number == Number::float32 || number == Number::int32 || number == Number::uint32;
  }
  void add(std::uint64_t word) {
    value_ ^= word;
    value_ *= 1099511628211ull;
    value_ ^= value_ >> 32;  // a whole word's high bits would else reach no low one
  }

  std::uint64_t value_ = 14695981039346656037ull;
};

}  // namespace mpm
