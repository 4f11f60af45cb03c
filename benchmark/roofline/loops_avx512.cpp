// AVX-512.
#include "loops_impl.hpp"

namespace roofline {

extern const Loops kAvx512 = {"avx512",
                              [] { return static_cast<bool>(__builtin_cpu_supports("avx512f")); },
                              8,
                              multiply_add<double, 64>,
                              multiply_add<float, 64>,
                              triad<64>};

}  // namespace roofline
