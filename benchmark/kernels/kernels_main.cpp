// Benchmarks of the parts of a step: kernels, laws, the sort, and whole small scenes. Options: see --help.
#include <benchmark/benchmark.h>

#include "benchmarks.hpp"

int main(int argc, char** argv) {
  bench::register_kernels();
  bench::register_sort();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
