// Sorting of nearly sorted particles, as in a run: each iteration moves all of them by a quarter of a cell along x,
// forth and back in turn. They are grouped as the kernels of the widest instruction set need them.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "benchmarks.hpp"
#include "block.hpp"
#include "mpm/kernel/isa.hpp"
#include "mpm/kernel/select.hpp"
#include "mpm/mechanics/continuum.hpp"

namespace bench {
namespace {

mpm::Grouping widest_grouping(mpm::GeometryKind geometry, mpm::Precision precision) {
  const mpm::Isa isa = mpm::best_isa();
  if (precision == mpm::Precision::float32) {
    return mpm::kernel_grouping(mpm::kernel_table<float>(mpm::ShapeKind::ugimp, geometry, isa));
  }
  return mpm::kernel_grouping(mpm::kernel_table<double>(mpm::ShapeKind::ugimp, geometry, isa));
}

void sort(benchmark::State& state, const char* scene, mpm::Precision precision, int threads) {
  Block block(scene, {}, precision);
  mpm::Sorter sorter(threads, widest_grouping(block.definition.geometry, precision));
  sorter.sort(block.sets, block.fields);
  double shift = 0.25 * block.grid.layout.cell(0);
  for (auto _ : state) {
    state.PauseTiming();
    for (double& x : block.sets[0].x[0]) x += shift;
    shift = -shift;
    state.ResumeTiming();
    if (sorter.sort(block.sets, block.fields)) state.SkipWithError("a particle left the grid");
  }
  state.SetItemsProcessed(state.iterations() * block.particles());
}

}  // namespace

void register_sort() {
  struct Case {
    const char* name;
    const char* scene;
    int threads;
  };
  for (const Case& c :
       {Case{"solid", "speed_block_3d", 1}, Case{"solid", "speed_block_3d", 2},
        Case{"solid_irregular", "speed_block_3d_irregular", 1}, Case{"plane_strain", "speed_block_2d", 1}}) {
    for (const mpm::Precision precision : {mpm::Precision::float64, mpm::Precision::float32}) {
      benchmark::RegisterBenchmark(
          fmt::format("sort/{}/{}/threads:{}", c.name, mpm::precision_name(precision), c.threads).c_str(), sort,
          c.scene, precision, c.threads)
          ->UseRealTime();
    }
  }
}

}  // namespace bench
