// An archive of numbers in memory, for tests of what a class keeps of its state.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <string>

#include "mpm/math/state_archive.hpp"

namespace mpm::test {

/// Keeps numbers by name; no lists, whose size it does not know.
class KeptNumbers final : public StateArchive {
 public:
  void read() { reading_ = true; }
  bool reading() const override { return reading_; }

 protected:
  void values(const std::string& name, Number number, void* data, std::size_t count) override {
    constexpr std::size_t kBytes[] = {4, 8, 4, 8, 1, 4, 8};  // in the order of Number
    const std::size_t bytes = count * kBytes[static_cast<int>(number)];
    std::string& kept = kept_[name];
    if (!reading_) kept.assign(static_cast<const char*>(data), bytes);
    ASSERT_EQ(kept.size(), bytes) << name;
    if (reading_) std::memcpy(data, kept.data(), bytes);
  }
  std::size_t stored(const std::string&) override { return 0; }  // no list is kept

 private:
  bool reading_ = false;
  std::map<std::string, std::string> kept_;
};

}  // namespace mpm::test
