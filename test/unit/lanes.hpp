// A register of four numbers without any instruction set, with exactly the operations that math/lanes.hpp requires, for
// tests of code that is written for registers. Comparisons do not convert to bool and there are no other operations, so
// code that compiles with it compiles with every register.
#pragma once

#include "mpm/math/lanes.hpp"

namespace mpm::test {

struct FourMask {
  bool m[4];

  friend FourMask operator&(const FourMask& a, const FourMask& b) {
    return {{a.m[0] && b.m[0], a.m[1] && b.m[1], a.m[2] && b.m[2], a.m[3] && b.m[3]}};
  }
  friend FourMask operator|(const FourMask& a, const FourMask& b) {
    return {{a.m[0] || b.m[0], a.m[1] || b.m[1], a.m[2] || b.m[2], a.m[3] || b.m[3]}};
  }
  friend FourMask operator!(const FourMask& a) { return {{!a.m[0], !a.m[1], !a.m[2], !a.m[3]}}; }
  friend bool any(const FourMask& a) { return a.m[0] || a.m[1] || a.m[2] || a.m[3]; }
  friend bool all(const FourMask& a) { return a.m[0] && a.m[1] && a.m[2] && a.m[3]; }
};

template <class S>
struct Four {
  static constexpr int kLanes = 4;
  S v[4];

  Four() = default;
  explicit Four(double x) : v{S(x), S(x), S(x), S(x)} {}

  friend S lane(const Four& a, int i) { return a.v[i]; }
  friend void set_lane(Four& a, int i, S value) { a.v[i] = value; }

  friend Four operator+(const Four& a, const Four& b) {
    return each([&](int i) { return a.v[i] + b.v[i]; });
  }
  friend Four operator-(const Four& a, const Four& b) {
    return each([&](int i) { return a.v[i] - b.v[i]; });
  }
  friend Four operator*(const Four& a, const Four& b) {
    return each([&](int i) { return a.v[i] * b.v[i]; });
  }
  friend Four operator/(const Four& a, const Four& b) {
    return each([&](int i) { return a.v[i] / b.v[i]; });
  }
  friend Four operator-(const Four& a) {
    return each([&](int i) { return -a.v[i]; });
  }
  Four& operator+=(const Four& b) { return *this = *this + b; }
  Four& operator-=(const Four& b) { return *this = *this - b; }
  Four& operator*=(const Four& b) { return *this = *this * b; }
  Four& operator/=(const Four& b) { return *this = *this / b; }

  friend FourMask operator<(const Four& a, const Four& b) {
    return test([&](int i) { return a.v[i] < b.v[i]; });
  }
  friend FourMask operator<=(const Four& a, const Four& b) {
    return test([&](int i) { return a.v[i] <= b.v[i]; });
  }
  friend FourMask operator>(const Four& a, const Four& b) { return b < a; }
  friend FourMask operator>=(const Four& a, const Four& b) { return b <= a; }

  friend Four select(const FourMask& which, const Four& a, const Four& b) {
    return each([&](int i) { return which.m[i] ? a.v[i] : b.v[i]; });
  }
  friend Four min(const Four& a, const Four& b) {
    return each([&](int i) { return std::min(a.v[i], b.v[i]); });
  }
  friend Four max(const Four& a, const Four& b) {
    return each([&](int i) { return std::max(a.v[i], b.v[i]); });
  }
  friend Four pow(const Four& a, const Four& b) {
    return each([&](int i) { return std::pow(a.v[i], b.v[i]); });
  }
  friend Four sqrt(const Four& a) {
    return each([&](int i) { return std::sqrt(a.v[i]); });
  }
  friend Four abs(const Four& a) {
    return each([&](int i) { return std::abs(a.v[i]); });
  }
  friend Four exp(const Four& a) {
    return each([&](int i) { return std::exp(a.v[i]); });
  }
  friend Four log(const Four& a) {
    return each([&](int i) { return std::log(a.v[i]); });
  }
  friend Four inverse_cbrt(const Four& a) {
    return each([&](int i) { return mpm::inverse_cbrt(a.v[i]); });
  }

 private:
  template <class Lane>
  static Four each(Lane&& value) {
    Four result;
    for (int i = 0; i < kLanes; ++i) result.v[i] = value(i);
    return result;
  }
  template <class Lane>
  static FourMask test(Lane&& holds) {
    return {{holds(0), holds(1), holds(2), holds(3)}};
  }
};

}  // namespace mpm::test
