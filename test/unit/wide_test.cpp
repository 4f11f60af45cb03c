// Registers of every instruction set of this machine: functions against long double, moves of numbers against loops.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "mpm/kernel/isa.hpp"
#include "wide/wide_ops.hpp"

#define MPM_DECLARE_OPS(space)                        \
  namespace space {                                   \
  const mpm_test::WideOps<double>& wide_ops_double(); \
  const mpm_test::WideOps<float>& wide_ops_single();  \
  }
MPM_DECLARE_OPS(mpm_plain)
MPM_DECLARE_OPS(mpm_avx2)
MPM_DECLARE_OPS(mpm_avx512)

namespace mpm::test {
namespace wide_test {

constexpr int kMostLanes = 16;

template <class T>
const mpm_test::WideOps<T>& ops(Isa isa) {
#if defined(MPM_AVX512_KERNELS)
  if (isa == Isa::avx512) {
    if constexpr (sizeof(T) == 8)
      return mpm_avx512::wide_ops_double();
    else
      return mpm_avx512::wide_ops_single();
  }
#endif
#if defined(MPM_AVX2_KERNELS)
  if (isa == Isa::avx2) {
    if constexpr (sizeof(T) == 8)
      return mpm_avx2::wide_ops_double();
    else
      return mpm_avx2::wide_ops_single();
  }
#endif
  (void)isa;
  if constexpr (sizeof(T) == 8) {
    return mpm_plain::wide_ops_double();
  } else {
    return mpm_plain::wide_ops_single();
  }
}

class WideTest : public testing::TestWithParam<Isa> {
 protected:
  void SetUp() override {
    if (!isa_available(GetParam())) GTEST_SKIP() << "this machine does not have " << isa_name(GetParam());
  }

  /// Calls check(ops) for double and for float.
  template <class Check>
  void each_precision(Check&& check) {
    check(ops<double>(GetParam()), 0.0);
    check(ops<float>(GetParam()), 0.0F);
  }
};
INSTANTIATE_TEST_SUITE_P(Isas, WideTest, testing::Values(Isa::plain, Isa::avx2, Isa::avx512),
                         [](const auto& info) { return isa_name(info.param); });

/// The largest error of `apply`, in epsilons of the exact value, for 100000 random numbers from `draw`.
template <class T, class Draw, class Apply, class Exact>
double worst_error(int lanes, Draw&& draw, Apply&& apply, Exact&& exact) {
  std::mt19937_64 random(5);
  double worst = 0.0;
  for (int n = 0; n < 100000; n += lanes) {
    T x[kMostLanes] = {}, found[kMostLanes] = {};
    for (int l = 0; l < lanes; ++l) x[l] = static_cast<T>(draw(random));
    apply(x, found);
    for (int l = 0; l < lanes; ++l) {
      const long double expected = exact(static_cast<long double>(x[l]));
      const long double error = std::abs((found[l] - expected) / expected) / std::numeric_limits<T>::epsilon();
      worst = std::max(worst, std::isfinite(found[l]) ? static_cast<double>(error) : 1e99);
    }
  }
  return worst;
}

/// Draws numbers between `low` and `high`, uniformly.
auto even(double low, double high) {
  return [=](std::mt19937_64& random) { return std::uniform_real_distribution<double>(low, high)(random); };
}
/// Draws numbers whose logarithm is uniform.
auto by_size(double low, double high) {
  return [=](std::mt19937_64& random) {
    return std::exp(std::uniform_real_distribution<double>(std::log(low), std::log(high))(random));
  };
}

// The last operation of Horner's rule rounds a number near 1, and the reduced argument has an error of half an epsilon:
// together one epsilon, and half of one for the sum before the last.
TEST_P(WideTest, ExponentialIsExact) {
  each_precision([](const auto& o, auto zero) {
    using T = decltype(zero);
    const auto exact = [](long double x) { return std::exp(x); };
    const double most = sizeof(T) == 8 ? 708.0 : 87.0;
    EXPECT_LE(worst_error<T>(o.lanes, even(-most, most), o.exp, exact), 1.5);
    EXPECT_LE(worst_error<T>(o.lanes, even(-1.0, 1.0), o.exp, exact), 1.5);
    T x[kMostLanes], found[kMostLanes];
    std::fill(x, x + kMostLanes, T(1e6));
    o.exp(x, found);
    EXPECT_TRUE(std::isfinite(found[0]));  // finite, since the argument is limited
    std::fill(x, x + kMostLanes, T(0));
    o.exp(x, found);
    EXPECT_EQ(found[0], T(1));
  });
}

// A quotient, a sum and two products are each rounded by half an epsilon, and the difference in the quotient by one.
TEST_P(WideTest, LogarithmIsExact) {
  each_precision([](const auto& o, auto zero) {
    using T = decltype(zero);
    const auto exact = [](long double x) { return std::log(x); };
    const double smallest = std::numeric_limits<T>::min(), largest = std::numeric_limits<T>::max();
    EXPECT_LE(worst_error<T>(o.lanes, by_size(smallest, largest), o.log, exact), 3.0);
    // The relative error is as small where the logarithm itself is small.
    EXPECT_LE(worst_error<T>(o.lanes, even(0.5, 2.0), o.log, exact), 3.0);
    EXPECT_LE(worst_error<T>(o.lanes, even(0.999, 0.9999), o.log, exact), 3.0);
    EXPECT_LE(worst_error<T>(o.lanes, even(1.0001, 1.001), o.log, exact), 3.0);
    T x[kMostLanes], found[kMostLanes];
    std::fill(x, x + kMostLanes, T(1));
    o.log(x, found);
    EXPECT_EQ(found[0], T(0));
  });
}

// After two steps of fourth order from a start with an error of 3.4 % only the rounding of the last correction is left.
// Three octaves of numbers represent all, since the algorithm repeats in each.
TEST_P(WideTest, InverseThirdRootIsExact) {
  each_precision([](const auto& o, auto zero) {
    using T = decltype(zero);
    const auto exact = [](long double x) { return 1.0L / std::cbrt(x); };
    const double smallest = std::numeric_limits<T>::min(), largest = std::numeric_limits<T>::max();
    EXPECT_LE(worst_error<T>(o.lanes, by_size(smallest, largest), o.inverse_cbrt, exact), 1.5);
    EXPECT_LE(worst_error<T>(o.lanes, even(0.5, 4.0), o.inverse_cbrt, exact), 1.5);
  });
}

// The absolute error of y log x is the relative error of x^y: 3.5 epsilons of |y log x| (a product after the
// logarithm), and the error of exp.
TEST_P(WideTest, PowerIsAsExactAsItsExponent) {
  each_precision([](const auto& o, auto zero) {
    using T = decltype(zero);
    for (const double y : {-7.15, -5.0 / 3.0, -0.4, 0.5, 1.4, 7.0}) {
      T ys[kMostLanes];
      std::fill(ys, ys + kMostLanes, static_cast<T>(y));
      const auto exact = [&](long double x) { return std::pow(x, static_cast<long double>(ys[0])); };
      const auto apply = [&](const T* x, T* to) { o.pow(x, ys, to); };
      const double low = 0.2, high = 5.0, exponent = std::abs(y) * std::log(high);
      EXPECT_LE(worst_error<T>(o.lanes, by_size(low, high), apply, exact), 1.5 + 3.5 * exponent) << y;
    }
  });
}

TEST_P(WideTest, FunctionsLaneByLane) {
  each_precision([](const auto& o, auto zero) {
    using T = decltype(zero);
    std::mt19937_64 random(6);
    for (int n = 0; n < 2000; ++n) {
      T a[kMostLanes], b[kMostLanes], found[kMostLanes];
      for (int l = 0; l < kMostLanes; ++l) {
        a[l] = static_cast<T>(static_cast<int>(random() % 200) - 100) / 8;
        b[l] = static_cast<T>(static_cast<int>(random() % 200) - 100) / 8;
        if (random() % 4 == 0) b[l] = a[l];
      }
      const auto expect = [&](const char* what, auto&& value) {
        for (int l = 0; l < o.lanes; ++l) EXPECT_EQ(found[l], value(l)) << what << ' ' << a[l] << ' ' << b[l];
      };
      o.abs(a, found);
      expect("abs", [&](int l) { return std::abs(a[l]); });
      o.max(a, b, found);
      expect("max", [&](int l) { return std::max(a[l], b[l]); });
      o.min(a, b, found);
      expect("min", [&](int l) { return std::min(a[l], b[l]); });
      o.round(a, found);
      expect("round", [&](int l) { return std::nearbyint(a[l]); });
      o.select_less(a, b, found);
      expect("select", [&](int l) { return a[l] < b[l] ? a[l] : -b[l]; });
      unsigned less = 0, less_equal = 0, equal = 0;
      for (int l = 0; l < o.lanes; ++l) {
        less |= (a[l] < b[l] ? 1U : 0U) << l;
        less_equal |= (a[l] <= b[l] ? 1U : 0U) << l;
        equal |= (a[l] == b[l] ? 1U : 0U) << l;
      }
      EXPECT_EQ(o.less(a, b), less);
      EXPECT_EQ(o.less_equal(a, b), less_equal);
      EXPECT_EQ(o.equal(a, b), equal);
      for (T& x : a) x = std::abs(x);
      o.sqrt(a, found);
      expect("sqrt", [&](int l) { return std::sqrt(a[l]); });
      if (testing::Test::HasFailure()) return;
    }
    // No comparison with NaN holds.
    T none[kMostLanes], one[kMostLanes];
    std::fill(none, none + kMostLanes, std::numeric_limits<T>::quiet_NaN());
    std::fill(one, one + kMostLanes, T(1));
    EXPECT_EQ(o.less(none, one) | o.less(one, none) | o.less_equal(none, one) | o.equal(none, none), 0U);
  });
}

TEST_P(WideTest, MasksOfTheFirstLanes) {
  each_precision([](const auto& o, auto) {
    const unsigned all = (1U << o.lanes) - 1U;
    for (int count = 0; count <= o.lanes; ++count) {
      EXPECT_EQ(o.first(count), (1U << count) - 1U);
      for (int other = 0; other <= o.lanes; ++other) {
        const unsigned expected = (((1U << count) - 1U) & ~((1U << other) - 1U) & all) | 1U;
        EXPECT_EQ(o.combine(count, other), expected);
      }
    }
    EXPECT_EQ(o.first(o.lanes + 8), all);
    EXPECT_EQ(o.first(-8), 0U);
  });
}

TEST_P(WideTest, MovesNumbersWhereTheyBelong) {
  each_precision([](const auto& o, auto zero) {
    using T = decltype(zero);
    T a[4 * kMostLanes], found[4 * kMostLanes];
    for (int i = 0; i < 4 * kMostLanes; ++i) a[i] = static_cast<T>(i + 1);
    o.interleave(a, found);
    for (int l = 0; l < o.lanes; ++l) {
      for (int k = 0; k < 4; ++k) EXPECT_EQ(found[4 * l + k], a[k * o.lanes + l]);
    }
    std::mt19937_64 random(7);
    for (int n = 0; n < 200; ++n) {
      std::int64_t at[kMostLanes];
      for (std::int64_t& i : at) i = static_cast<std::int64_t>(random() % 64) - 32;
      o.permute(a, at, found);
      // Only the bits of an index that number the lanes count.
      for (int l = 0; l < o.lanes; ++l) EXPECT_EQ(found[l], a[at[l] & (o.lanes - 1)]);
    }
    for (int count = 0; count <= o.lanes; ++count) {
      std::fill(found, found + 4 * kMostLanes, T(-1));
      o.load_first(a, count, found);
      for (int l = 0; l < o.lanes; ++l) EXPECT_EQ(found[l], l < count ? a[l] : T(0));
      std::fill(found, found + 4 * kMostLanes, T(-1));
      o.store_first(a, count, found);
      for (int l = 0; l < kMostLanes; ++l) EXPECT_EQ(found[l], l < count ? a[l] : T(-1));
    }
  });
}

// Positions stay double in any register; their coordinates in a tile are rounded once, to the register's precision.
TEST_P(WideTest, PlacesAndDisplacesInDouble) {
  each_precision([](const auto& o, auto zero) {
    using T = decltype(zero);
    double x[kMostLanes], moved[kMostLanes];
    T displacement[kMostLanes], cells[kMostLanes];
    for (int l = 0; l < kMostLanes; ++l) {
      x[l] = 100.0 + 0.01 * l + 1e-9 * l * l;
      displacement[l] = static_cast<T>(1e-9 * (l + 1));
    }
    for (int count = 1; count <= o.lanes; ++count) {
      o.place(x, count, 99.5, 10.0, 4.0, cells);
      std::fill(moved, moved + kMostLanes, -1.0);
      o.displace(moved, x, displacement, count);
      for (int l = 0; l < count; ++l) {
        const double expected = (x[l] - 99.5) * 10.0 - 4.0;
        // The result is rounded to T, and the number 5 that is subtracted in double.
        EXPECT_NEAR(cells[l], expected, 0.5 * std::numeric_limits<T>::epsilon() * 4.0 + 1e-15 * 5.0);
        EXPECT_EQ(moved[l], x[l] + static_cast<double>(displacement[l]));
      }
      for (int l = count; l < kMostLanes; ++l) EXPECT_EQ(moved[l], -1.0);
    }
  });
}

}  // namespace wide_test
}  // namespace mpm::test
