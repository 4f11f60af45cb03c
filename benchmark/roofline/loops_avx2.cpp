// AVX2 with fused multiply-add.
#include "loops_impl.hpp"

namespace roofline {

extern const Loops kAvx2 = {
    "avx2",
    [] { return static_cast<bool>(__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")); },
    4,
    multiply_add<double, 32>,
    multiply_add<float, 32>,
    triad<32>};

}  // namespace roofline
