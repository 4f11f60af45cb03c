// The loops that measure the limits of the machine. They are built once for each instruction set (loops_*.cpp), so that
// no inline function is shared between two of them.
#pragma once

#include <cstddef>

namespace roofline {

struct Loops {
  const char* isa;
  bool (*available)();  ///< true if this processor has the instruction set
  int doubles;          ///< doubles in a register
  /// Runs `turns` iterations of independent multiply-adds. Returns their count, of numbers rather than registers.
  double (*multiply_add_double)(long turns);
  double (*multiply_add_single)(long turns);
  /// a = b + s c over n doubles, `turns` times; 24 bytes a number, as STREAM counts (no read of a before its write).
  void (*triad)(double* a, const double* b, const double* c, std::size_t n, long turns);
};

extern const Loops kPlain, kAvx2, kAvx512;

}  // namespace roofline
