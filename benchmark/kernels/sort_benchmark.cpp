// Sorting nearly sorted particles, as a run does when some have left their place: each turn moves all of them by a
// quarter of a cell along x, there and back. Groups are of 8 in a column, as for AVX-512 in double precision.
#include <benchmark/benchmark.h>

#include "mpm/scene/scene.hpp"
#include "mpm/step/sorter.hpp"

namespace {

mpm::ParticleSet particles_of(const mpm::SimulationDefinition& definition, const mpm::GridLayout& layout) {
  const mpm::DeformableBody& body = definition.bodies.front();
  const int dim = layout.dim();
  const std::size_t n = body.positions.size();
  mpm::ParticleSet set;
  set.id.resize(n);
  set.x.assign(dim, mpm::PaddedArray<double>(n));
  set.v.assign(dim, mpm::ParticleScalar(set.precision, n));
  set.f.assign(dim == 3 ? 9 : 5, mpm::ParticleScalar(set.precision, n));
  set.tau.assign(dim == 3 ? 6 : 4, mpm::ParticleScalar(set.precision, n));
  for (int k = 0; k < dim; ++k) {
    set.highest[k] = layout.last_node(k);
    for (std::size_t p = 0; p < n; ++p) set.x[k][p] = body.positions[p][layout.axis(k)];
  }
  return set;
}

void sort(benchmark::State& state, const char* scene) {
  const mpm::SimulationDefinition definition = mpm::build(mpm::load_scene(scene));
  const int dim = definition.geometry == mpm::GeometryKind::solid ? 3 : 2;
  mpm::Grid grid(mpm::GridLayout(dim, definition.grid.cell, definition.grid.min, definition.grid.max));
  std::vector<mpm::ParticleSet> sets = {particles_of(definition, grid.layout)};
  mpm::Sorter sorter(static_cast<int>(state.range(0)), {8, mpm::Grouping::By::column});
  sorter.sort(sets, grid);
  double shift = 0.25 * definition.grid.cell.x();
  for (auto _ : state) {
    state.PauseTiming();
    for (double& x : sets[0].x[0]) x += shift;
    shift = -shift;
    state.ResumeTiming();
    if (sorter.sort(sets, grid)) state.SkipWithError("a particle left the grid");
  }
  state.SetItemsProcessed(state.iterations() * sets[0].size());
}

BENCHMARK_CAPTURE(sort, solid, "speed_block_3d")->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK_CAPTURE(sort, solid_irregular, "speed_block_3d_irregular")->ArgName("threads")->Arg(1)->UseRealTime();
BENCHMARK_CAPTURE(sort, planar, "speed_block_2d")->ArgName("threads")->Arg(1)->UseRealTime();

}  // namespace
