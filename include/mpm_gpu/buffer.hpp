// Memory that kernels work on: an array that grows only when asked to, between steps, and never within one. On a card
// it is the card's memory.
#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

namespace mpm_gpu {

template <class T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  /// Makes room for so many; what was there before is lost if that is more than there was.
  void fit(long count) {
    if (count > static_cast<long>(values_.size())) values_.assign(static_cast<std::size_t>(count), T{});
  }
  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }
  T& operator[](long i) { return values_[static_cast<std::size_t>(i)]; }
  const T& operator[](long i) const { return values_[static_cast<std::size_t>(i)]; }
  long size() const { return static_cast<long>(values_.size()); }
  std::size_t bytes() const { return values_.size() * sizeof(T); }
  void swap(Buffer& other) noexcept { values_.swap(other.values_); }

 private:
  std::vector<T> values_;
};

}  // namespace mpm_gpu
