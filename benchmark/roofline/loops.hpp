// The loops that find what the machine can do, built once an instruction set (loops_*.cpp), so that nothing inline is
// shared between two of them.
#pragma once

#include <cstddef>

namespace roofline {

struct Loops {
  const char* isa;
  bool (*available)();  ///< on this processor
  int doubles;          ///< in a register
  /// Runs `turns` turns of independent multiply-adds; returns how many it did, counted a number (not a register).
  double (*multiply_add_double)(long turns);
  double (*multiply_add_single)(long turns);
  /// a = b + s c over n doubles, `turns` times; 24 bytes a number, as STREAM counts (no read of a before its write).
  void (*triad)(double* a, const double* b, const double* c, std::size_t n, long turns);
};

extern const Loops kPlain, kAvx2, kAvx512;

}  // namespace roofline
