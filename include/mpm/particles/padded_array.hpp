// A contiguous array that starts on a cache line and has room for a wide register beyond its end.
//
// A kernel loads a register that begins at any particle, the last one included. It masks the lanes beyond the end,
// whose addresses still belong to this array.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace mpm {

/// Array of numbers, 64-byte aligned, with kPadding readable bytes beyond the last one.
template <class T>
class PaddedArray {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= 64);

 public:
  using value_type = T;
  static constexpr std::size_t kAlignment = 64;  ///< [bytes]
  static constexpr std::size_t kPadding = 64;    ///< [bytes], zero when allocated

  PaddedArray() = default;
  explicit PaddedArray(std::size_t size) { assign(size, T()); }
  PaddedArray(std::size_t size, T value) { assign(size, value); }
  PaddedArray(const PaddedArray& other) {
    resize(other.size_);
    std::copy_n(other.data(), size_, data());
  }
  PaddedArray(PaddedArray&& other) noexcept { swap(other); }
  PaddedArray& operator=(PaddedArray other) noexcept {
    swap(other);
    return *this;
  }
  void swap(PaddedArray& other) noexcept {
    values_.swap(other.values_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

  /// Neither preserves nor initialises the contents. Allocates only when there is too little room, and then for `room`
  /// values if that is more. @throws std::bad_alloc
  void resize(std::size_t size, std::size_t room = 0) {
    if (size > capacity_) {
      values_.reset();
      capacity_ = size_ = 0;
      const std::size_t capacity = std::max(size, room), bytes = capacity * sizeof(T) + kPadding;
      values_.reset(static_cast<T*>(::operator new (bytes, std::align_val_t{kAlignment})));
      capacity_ = capacity;
      std::fill_n(reinterpret_cast<unsigned char*>(values_.get() + capacity), kPadding, static_cast<unsigned char>(0));
    }
    size_ = size;
  }
  /// As resize(), but keeps the values that were there.
  void extend(std::size_t size, std::size_t room) {
    if (size > capacity_) {
      PaddedArray longer;
      longer.resize(size, room);
      std::copy_n(data(), size_, longer.data());
      swap(longer);
    }
    size_ = size;
  }
  void assign(std::size_t size, T value) {
    resize(size);
    std::fill_n(data(), size, value);
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* data() { return values_.get(); }
  const T* data() const { return values_.get(); }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  T& operator[](std::size_t i) { return values_.get()[i]; }
  const T& operator[](std::size_t i) const { return values_.get()[i]; }

 private:
  struct Free {
    void operator()(T* values) const { ::operator delete (values, std::align_val_t{kAlignment}); }
  };
  std::unique_ptr<T, Free> values_;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace mpm
