// The least memory of a scene, against a count by hand.
#include "mpm/advice/memory.hpp"

#include <gtest/gtest.h>

namespace mpm {
namespace memory_test {

TEST(Memory, CountsWhatAParticleTakes) {
  MethodDefinition method;
  method.particles_per_direction = 2;
  // USAVG in three dimensions: 2 positions and 18 scalars of 8 bytes in 3 + 3 + (3 + 9 + 6), id 4, sorting 29, an
  // eighth of a node's 10 numbers.
  EXPECT_EQ(least_bytes_of_particle(method, GeometryKind::solid), 8 * 24 + 4 + 29 + 10);
  method.precision = Precision::float32;
  EXPECT_EQ(least_bytes_of_particle(method, GeometryKind::solid), 8 * 6 + 4 * 18 + 4 + 33 + 10);
  method.update = UpdateScheme::usf;
  // Planar: 1 position, 2 + 4 + 4 scalars, a quarter of a node's 7 numbers.
  EXPECT_EQ(least_bytes_of_particle(method, GeometryKind::plane_strain), 8 * 2 + 4 * 10 + 4 + 33 + 14);
  // Plane stress stores one more scalar, F_yy.
  EXPECT_EQ(least_bytes_of_particle(method, GeometryKind::plane_stress), 8 * 2 + 4 * 11 + 4 + 33 + 14);
  // A line: 1 position, 1 + 1 + 3 scalars, half of a node's 4 numbers.
  EXPECT_EQ(least_bytes_of_particle(method, GeometryKind::line), 8 * 1 + 4 * 5 + 4 + 33 + 16);
}

}  // namespace memory_test
}  // namespace mpm
