// Memory that kernels work on: an array that grows only when asked to, between steps, and never within one. It is the
// card's, which the host reaches by copies alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "mpm_gpu/card.hpp"

namespace mpm_gpu {

/// Bytes of the card, zero at first.
class Memory {
 public:
  Memory() = default;
  explicit Memory(std::size_t bytes) : data_(bytes == 0 ? nullptr : card::allocate(bytes)), bytes_(bytes) {}
  Memory(Memory&& other) noexcept { swap(other); }
  Memory& operator=(Memory&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Memory() {
    if (data_ != nullptr) card::release(data_);
  }
  void* data() const { return data_; }
  std::size_t bytes() const { return bytes_; }
  void swap(Memory& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(bytes_, other.bytes_);
  }
  void upload(std::size_t at, const void* from, std::size_t bytes) {
    card::upload(static_cast<char*>(data_) + at, from, bytes);
  }
  void download(std::size_t at, void* to, std::size_t bytes) const {
    card::download(to, static_cast<const char*>(data_) + at, bytes);
  }
  void download_soon(void* to, std::size_t bytes) const { card::download_soon(to, data_, bytes); }

 private:
  void* data_ = nullptr;
  std::size_t bytes_ = 0;
};

template <class T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  /// Makes room for so many; what was there before is lost if that is more than there was.
  void fit(long count) {
    if (count <= size()) return;
    memory_ = Memory();  // given back first, so that both need not fit
    memory_ = Memory(static_cast<std::size_t>(count) * sizeof(T));
  }
  /// The same for what grows now and then: makes twice the room that is needed where there is too little.
  void grow(long count) {
    if (count > size()) fit(2 * count);
  }
  /// For kernels: the host may not look there.
  T* data() { return static_cast<T*>(memory_.data()); }
  const T* data() const { return static_cast<const T*>(memory_.data()); }
  long size() const { return static_cast<long>(memory_.bytes() / sizeof(T)); }
  std::size_t bytes() const { return memory_.bytes(); }
  void swap(Buffer& other) noexcept { memory_.swap(other.memory_); }

  /// Copies from the host, to place `first` and on.
  void upload(const T* from, long count, long first = 0) {
    if (count > 0) memory_.upload(static_cast<std::size_t>(first) * sizeof(T), from, count_bytes(count));
  }
  void upload(const std::vector<T>& from, long first = 0) {
    upload(from.data(), static_cast<long>(from.size()), first);
  }
  /// Copies to the host, from place `first` and on.
  void download(T* to, long count, long first = 0) const {
    if (count > 0) memory_.download(static_cast<std::size_t>(first) * sizeof(T), to, count_bytes(count));
  }
  /// The same of the first `count`, which are there after the next copy that is waited for.
  void download_soon(T* to, long count) const {
    if (count > 0) memory_.download_soon(to, count_bytes(count));
  }
  std::vector<T> download() const {
    std::vector<T> all(static_cast<std::size_t>(size()));
    download(all.data(), size());
    return all;
  }
  /// A copy of one number, for errors and sums.
  T get(long i) const {
    T one;
    download(&one, 1, i);
    return one;
  }

 private:
  static std::size_t count_bytes(long count) { return static_cast<std::size_t>(count) * sizeof(T); }
  Memory memory_;
};

}  // namespace mpm_gpu
