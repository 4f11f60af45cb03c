// Fault of the smallest id, of those that several threads meet at particles in one pass: the same error for any
// number of threads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace mpm {

class FirstFault {
 public:
  explicit FirstFault(int threads) : of_thread_(threads) {}

  void clear() {
    for (One& one : of_thread_) one = {};
  }
  /// text() is called when the particle is the first that the thread has met.
  template <class Text>
  void note(int thread, std::uint32_t id, Text&& text) {
    One& one = of_thread_[thread];
    if (id < one.id) one = {id, text()};
  }
  /// @throws E with the text of the first, if there is one
  template <class E>
  void check() const {
    const auto first =
        std::min_element(of_thread_.begin(), of_thread_.end(), [](const One& a, const One& b) { return a.id < b.id; });
    if (!first->text.empty()) throw E(first->text);
  }

 private:
  struct One {
    std::uint32_t id = std::numeric_limits<std::uint32_t>::max();
    std::string text;
  };
  std::vector<One> of_thread_;
};

}  // namespace mpm
