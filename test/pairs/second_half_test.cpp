// Every two features that go together, in scenes whose twins have the same answer: rows of odd number (twins.hpp).
// Cost: 20 s.
#include "twins.hpp"

namespace mpm::pairs {
namespace second_half_test {

TEST(Pairs, OfOddRowsAgreeWithTheirTwins) { check_rows(1, 2); }

}  // namespace second_half_test
}  // namespace mpm::pairs
