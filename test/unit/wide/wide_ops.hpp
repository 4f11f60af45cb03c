// The operations of a register as plain functions on the numbers of one register. They separate the test, which every
// machine can run, from a file that is compiled once for each instruction set, like the kernels (kernel/kernels.hpp).
// That file does not include the test framework, whose inline functions would be shared between instruction sets.
#pragma once

#include <cstdint>

namespace mpm_test {

/// Arrays hold the numbers of one register, unless said otherwise.
template <class T>
struct WideOps {
  int lanes;
  void (*exp)(const T* x, T* to);
  void (*log)(const T* x, T* to);
  void (*inverse_cbrt)(const T* x, T* to);
  void (*pow)(const T* x, const T* y, T* to);
  void (*sqrt)(const T* x, T* to);
  void (*abs)(const T* x, T* to);
  void (*round)(const T* x, T* to);
  void (*max)(const T* a, const T* b, T* to);
  void (*min)(const T* a, const T* b, T* to);
  void (*select_less)(const T* a, const T* b, T* to);  ///< a where a < b, and -b elsewhere
  unsigned (*less)(const T* a, const T* b);            ///< lane l as bit l
  unsigned (*less_equal)(const T* a, const T* b);
  unsigned (*equal)(const T* a, const T* b);
  unsigned (*first)(int count);
  unsigned (*combine)(unsigned count_a, unsigned count_b);  ///< first(a) & !first(b) | first(1)
  void (*interleave)(const T* a, T* to);                    ///< from four registers to four
  void (*permute)(const T* a, const std::int64_t* at, T* to);
  void (*load_first)(const T* from, int count, T* to);  ///< reads `count`, writes all
  void (*store_first)(const T* from, int count, T* to);
  void (*place)(const double* x, int count, double origin, double scale, double shift, T* to);
  void (*displace)(double* x_new, const double* x, const T* displacement, int count);
};

}  // namespace mpm_test
