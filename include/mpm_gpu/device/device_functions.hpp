// Functions of the standard library that a device lacks and that laws call on single numbers: overloads for the device,
// which a compiler takes there in place of the host's. For clang, after the headers that declare the host's.
#pragma once

#include <utility>

__attribute__((device)) inline double sqrt(double x) { return __builtin_sqrt(x); }

namespace std {

__attribute__((device)) inline double sqrt(double x) { return __builtin_sqrt(x); }

template <class A, class B>
__attribute__((device)) pair(A, B)->pair<A, B>;

template <class T>
__attribute__((device)) void swap(T& a, T& b) {
  const T kept = a;
  a = b;
  b = kept;
}

template <class From, class To>
__attribute__((device)) To copy(From from, From end, To to) {
  for (; from != end; ++from, ++to) *to = *from;
  return to;
}

}  // namespace std
