// A million particles that flow through ranks for 2,000 steps: none is lost, none doubled. Two disks fly around a
// periodic domain, meet off their centres, and turn; they come to blocks that had no particles, so that the grid is
// divided anew on the way. Ranks are threads; over MPI the same is said of fewer particles (test/mpi).
// Cost: 2 s; the million 5 minutes on two processors. There 2.7 million particles changed rank,
// and the grid was divided 11 times.
#include <gtest/gtest.h>

#include <cmath>
#include <mutex>

#include "mpm/ranks/lists.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"
#include "scene_run.hpp"
#include "thread_communicator.hpp"

namespace verification {
namespace over_ranks_flow_test {

const char* const kDisks = R"(
geometry: plane_strain
grid: {cell: 1, min: [0, 0], max: [1024, 600]}
time: {end: 1000, sync: 5}
method: {update: usf}
materials: [{name: soft, density: 1, law: neo_hookean, young: 1, poisson: 0.3}]
bodies:
  - name: left
    material: soft
    shape: {sphere: {center: [256, 260], radius: 200}}
    initial: {velocity: [1.4, 0]}
  - name: right
    material: soft
    shape: {sphere: {center: [700, 340], radius: 200}}
    initial: {velocity: [1, 0]}
boundaries: {x: periodic, z_min: slip, z_max: slip}
)";

struct Flow {
  std::uint64_t particles = 0, steps = 0;
  mpm::SharingReport sharing;
  double residual = 0.0, mass_before = 0.0, mass_after = 0.0;
};

/// True if the ids of all ranks' particles are those from 0 on, each once.
bool all_there_once(mpm::Communicator& ranks, const mpm::Simulation& simulation) {
  mpm::ParticleColumns own;
  simulation.read_own_particles({"x"}, {}, own);
  std::vector<std::uint32_t> ids = mpm::gather_list(ranks, own.ids);
  std::sort(ids.begin(), ids.end());
  bool once = ids.size() == simulation.particles();
  for (std::size_t n = 0; n < ids.size(); ++n) once = once && ids[n] == n;
  return once;
}

Flow flow(int count, std::uint64_t steps, const std::vector<std::string>& overrides) {
  Flow found;
  std::mutex one_at_a_time;
  mpm::run_ranks(count, [&](mpm::Communicator& ranks) {
    mpm::SimulationOptions options;
    options.threads = 1;
    options.ranks = {&ranks, [](mpm::Communicator*) {}};
    std::unique_lock<std::mutex> lock(one_at_a_time);  // a scene is read by one thread at a time
    const mpm::Scene scene = mpm::parse_scene(kDisks, "disks.yaml", overrides);
    lock.unlock();
    mpm::Simulation simulation(mpm::build(scene, &ranks), options);
    EXPECT_TRUE(all_there_once(ranks, simulation));
    const auto mass = [&] {
      double sum = 0.0;
      for (const double one : field(simulation, "mass")) sum += one;  // by id, on the first rank
      return sum;
    };
    const double before = mass();
    while (simulation.state().step.steps < steps) simulation.advance();
    EXPECT_TRUE(all_there_once(ranks, simulation));
    const mpm::SolverState state = simulation.state();
    const mpm::SharingReport sharing = simulation.sharing();
    const double after = mass();
    if (ranks.first()) found = {state.particles, state.step.steps, sharing, state.audit.residual, before, after};
  });
  return found;
}

void expect_flow(const Flow& found, std::uint64_t particles, std::uint64_t steps) {
  EXPECT_GE(found.particles, particles);
  EXPECT_GE(found.steps, steps);
  EXPECT_EQ(found.mass_after, found.mass_before);  // to the bit
  EXPECT_GT(found.mass_before, 0.0);
  EXPECT_LT(found.residual, 1e-10);
  // Half of them and more have gone to another rank, and not for one division alone.
  EXPECT_GT(found.sharing.handed_over, particles / 2);
  EXPECT_GT(found.sharing.divisions, 2U);
  testing::Test::RecordProperty("particles", std::to_string(found.particles));
  testing::Test::RecordProperty("steps", std::to_string(found.steps));
  testing::Test::RecordProperty("handed_over", std::to_string(found.sharing.handed_over));
  testing::Test::RecordProperty("divisions", std::to_string(found.sharing.divisions));
}

// The same with disks of a tenth of the radius.
TEST(OverRanksFlow, LosesAndDoublesNone) {
  const std::vector<std::string> small = {"grid.max=[128, 64]",
                                          "bodies.left.shape={sphere: {center: [32, 28], radius: 20}}",
                                          "bodies.right.shape={sphere: {center: [76, 36], radius: 20}}", "time.sync=1"};
  for (const int count : {2, 4}) expect_flow(flow(count, 300, small), 10'000, 300);
}

TEST(FullOverRanksFlow, LosesAndDoublesNoneOfAMillion) { expect_flow(flow(4, 2000, {}), 1'000'000, 2000); }

}  // namespace over_ranks_flow_test
}  // namespace verification
