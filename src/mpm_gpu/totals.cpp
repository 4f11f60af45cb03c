#include "mpm_gpu/totals.hpp"

namespace mpm_gpu {
namespace {

constexpr std::array<double, 4> kNothing{};

}  // namespace

Total::Total() {
  sum_.fit(4);
  sum_.upload(kNothing.data(), 4);
}

void Total::add(Executor& run, const char* name, const double* numbers, long count, int components, double factor) {
  if (count == 0) return;
  run.reduce_there<Part>(
      name, count,
      [=](long i) {
        Part one;
        for (int k = 0; k < components; ++k) one.of[k] = numbers[k * count + i];
        return one;
      },
      partial_);
  const Part* given = partial_.data();
  double* sum = sum_.data();
  run.for_each(name, 1, [=](long) {
    double square = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double part = factor * given->of[k];
      sum[k] += part;
      square += part * part;
    }
    sum[3] += __builtin_sqrt(square);
  });
}

Total::Sum Total::take() {
  std::array<double, 4> now{};
  sum_.download(now.data(), 4);
  sum_.upload(kNothing.data(), 4);
  return {{now[0], now[1], now[2]}, now[3]};
}

}  // namespace mpm_gpu
