// Plain x86-64: SSE2, a product and a sum for a multiply-add.
#include "loops_impl.hpp"

namespace roofline {

extern const Loops kPlain = {
    "plain", [] { return static_cast<bool>(true); }, 2, multiply_add<double, 16>, multiply_add<float, 16>, triad<16>};

}  // namespace roofline
