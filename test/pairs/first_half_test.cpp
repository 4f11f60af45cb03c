// Every two features that go together, in scenes whose twins have the same answer: rows of even number (twins.hpp).
// Cost: 20 s.
#include "twins.hpp"

namespace mpm::pairs {
namespace first_half_test {

TEST(Pairs, OfEvenRowsAgreeWithTheirTwins) { check_rows(0, 2); }

}  // namespace first_half_test
}  // namespace mpm::pairs
