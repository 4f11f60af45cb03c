// Storage of particles: aligned arrays that may be read beyond their end, in either precision.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#include "mpm/particles/particle_scalar.hpp"

namespace mpm {
namespace particle_storage_test {

TEST(PaddedArray, IsAlignedAndZeroForARegisterBeyondItsEnd) {
  for (const std::size_t size : {1, 7, 8, 1000}) {
    const PaddedArray<float> array(size, 3.0F);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % 64, 0U);
    const char zero[64] = {};
    EXPECT_EQ(std::memcmp(array.end(), zero, sizeof zero), 0) << size;
    EXPECT_EQ(array[size - 1], 3.0F);
  }
}

TEST(PaddedArray, CopiesMovesAndKeepsItsRoom) {
  PaddedArray<double> a(5, 1.5);
  PaddedArray<double> b = a;
  b[4] = 2.5;
  EXPECT_EQ(a[4], 1.5);
  const double* place = b.data();
  a = std::move(b);
  EXPECT_EQ(a.data(), place);
  EXPECT_EQ(a[4], 2.5);
  a.resize(3);
  a.resize(5);
  EXPECT_EQ(a.data(), place);
  a.resize(6);
  EXPECT_EQ(a.size(), 6U);
  EXPECT_TRUE(PaddedArray<double>().empty());
}

TEST(ParticleScalar, RoundsToThePrecisionThatItStores) {
  // 1/3 is not a binary fraction: IEEE 754 binary32 keeps 24 bits of it.
  ParticleScalar single(Precision::float32, 4, 1.0 / 3.0), full(Precision::float64, 4, 1.0 / 3.0);
  EXPECT_EQ(single[3], 11184811.0 / 33554432.0);
  EXPECT_EQ(full[3], 1.0 / 3.0);
  single.set(2, 0.1);
  EXPECT_EQ(single.data<float>()[2], 0.1F);
  EXPECT_EQ(single.precision(), Precision::float32);
  EXPECT_THROW(single.data<double>(), std::bad_variant_access);
  EXPECT_THROW(full.data<float>(), std::bad_variant_access);
  single.swap(full);
  EXPECT_EQ(single.precision(), Precision::float64);
  EXPECT_EQ(full.size(), 4U);
}

}  // namespace particle_storage_test
}  // namespace mpm
