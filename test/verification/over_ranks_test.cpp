// Runs over several ranks, which are threads here, against the same runs on one process: the motion, the forces on
// tools and what is dissipated; checkpoints, which any number of ranks reads; and a run that fails on one rank.
//
// A sum over particles of several ranks has other round-off than on one process, so runs differ by what the scene makes
// of that: over a hundred steps they are asked to be equal to 1e-10 of the momentum that was exchanged.
// Cost: 25 s.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <numeric>

#include "mpm/simulation/checkpoint.hpp"
#include "scene_run.hpp"
#include "thread_communicator.hpp"

namespace verification {
namespace over_ranks_test {

/// What is compared.
struct Outcome {
  std::uint64_t steps = 0, state_hash = 0, memory_hash = 0;
  double exchanged = 0.0, residual = 0.0, mass = 0.0;
  double carried = 0.0;                              ///< sum of m |v| [kg m/s]
  std::vector<std::vector<double>> velocity, place;  ///< [axis][id]
  std::vector<mpm::ContactReport> contacts;
  std::vector<mpm::NamedEnergy> energies;
  std::vector<std::pair<std::string, double>> metrics;
};

struct Case {
  std::string scene;
  std::vector<std::string> overrides;
  std::uint64_t steps = 100;
  bool points = false;  ///< whether it meets tools at points
};

std::ostream& operator<<(std::ostream& out, const Case& run) { return out << run.scene; }

/// Functions of a scene hold one evaluation at a time, so ranks that are threads have scenes of their own, read in
/// turn.
mpm::Scene scene_of(const Case& run) {
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  const std::filesystem::path file = source_file("test/verification/scenes/" + run.scene + ".yaml");
  return mpm::load_scene(std::filesystem::exists(file) ? file.string() : run.scene, run.overrides);
}

mpm::Simulation start_on(const Case& run, mpm::Communicator* ranks) {
  const mpm::Scene scene = scene_of(run);
  mpm::SimulationOptions options;
  options.threads = 1;
  if (ranks != nullptr) options.ranks = {ranks, [](mpm::Communicator*) {}};
  return mpm::Simulation(mpm::build(scene, ranks), options);
}

Outcome outcome_of(mpm::Simulation& simulation) {
  Outcome outcome;
  const mpm::SolverState state = simulation.state();
  outcome.steps = state.step.steps;
  outcome.exchanged = state.audit.exchanged;
  outcome.residual = state.audit.residual;
  outcome.energies = state.energy.list();
  for (const char* name : {"vx", "vy", "vz"}) outcome.velocity.push_back(field(simulation, name));
  for (const char* name : {"x", "y", "z"}) outcome.place.push_back(field(simulation, name));
  const std::vector<double> masses = field(simulation, "mass");
  outcome.mass = std::accumulate(masses.begin(), masses.end(), 0.0);
  for (std::size_t p = 0; p < masses.size(); ++p) {
    outcome.carried += masses[p] * std::hypot(outcome.velocity[0][p], outcome.velocity[1][p], outcome.velocity[2][p]);
  }
  const int bodies = static_cast<int>(simulation.bodies().size());
  for (int body = 0; body < bodies; ++body) outcome.contacts.push_back(simulation.take_contact(body));
  outcome.metrics = simulation.metrics();
  outcome.state_hash = simulation.state_hash();
  outcome.memory_hash = simulation.memory_hash();
  return outcome;
}

void run_steps(mpm::Simulation& simulation, std::uint64_t steps) {
  const std::int64_t period = simulation.sync_period();
  const double end = simulation.definition().time.end;
  while (simulation.state().step.steps < steps && seconds(simulation) + 0.5e-9 * static_cast<double>(period) < end) {
    simulation.advance();
  }
}

Outcome run_alone(const Case& run) {
  mpm::Simulation simulation = start_on(run, nullptr);
  run_steps(simulation, run.steps);
  return outcome_of(simulation);
}

Outcome run_over(const Case& run, int count) {
  Outcome of_first;
  mpm::run_ranks(count, [&](mpm::Communicator& ranks) {
    mpm::Simulation simulation = start_on(run, &ranks);
    run_steps(simulation, run.steps);
    Outcome own = outcome_of(simulation);
    if (ranks.first()) of_first = std::move(own);
  });
  return of_first;
}

double largest_difference(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].size(), b[k].size());
    for (std::size_t p = 0; p < std::min(a[k].size(), b[k].size()); ++p) {
      const double difference = std::abs(a[k][p] - b[k][p]);
      if (!(difference <= largest)) largest = difference;
    }
  }
  return largest;
}

/// `part`: of the exchanged momentum.
void expect_equal(const Outcome& over, const Outcome& alone, double part) {
  EXPECT_EQ(over.steps, alone.steps);
  EXPECT_LT(over.residual, std::max(1e-12, 10.0 * alone.residual));
  // All particles together, were all as far off as the one that is most.
  const double off = largest_difference(over.velocity, alone.velocity) * alone.mass;
  EXPECT_LE(off, part * (alone.exchanged > 0.0 ? alone.exchanged : alone.carried));
  ASSERT_EQ(over.contacts.size(), alone.contacts.size());
  for (std::size_t b = 0; b < alone.contacts.size(); ++b) {
    const mpm::Vec3 there = over.contacts[b].mean.force, here = alone.contacts[b].mean.force;
    EXPECT_LE((there - here).norm(), 10.0 * part * std::max(here.norm(), alone.contacts[b].pressing))
        << alone.contacts[b].body;
  }
  ASSERT_EQ(over.energies.size(), alone.energies.size());
  double total = 0.0;
  for (const mpm::NamedEnergy& energy : alone.energies) total += std::abs(energy.value);
  for (std::size_t i = 0; i < alone.energies.size(); ++i) {
    EXPECT_EQ(over.energies[i].name, alone.energies[i].name);
    EXPECT_NEAR(over.energies[i].value, alone.energies[i].value, 100.0 * part * total) << alone.energies[i].name;
  }
}

class OverRanks : public testing::TestWithParam<Case> {};

TEST_P(OverRanks, MovesAsOnOneProcess) {
  // As one rank, which solves points of contact in the order of several. One process has another, in which sweeps end
  // elsewhere: its forces are seen to differ by up to 0.4 % of what presses.
  const Outcome alone = run_over(GetParam(), 1), process = run_alone(GetParam());
  if (GetParam().points) {
    for (std::size_t b = 0; b < alone.contacts.size(); ++b) {
      const mpm::Vec3 there = process.contacts[b].mean.force, here = alone.contacts[b].mean.force;
      EXPECT_LE((there - here).norm(), 0.01 * std::max(here.norm(), alone.contacts[b].pressing));
    }
  } else {
    expect_equal(process, alone, 1e-10);
  }
  ASSERT_GT(alone.exchanged + alone.carried, 0.0);
  for (const int count : {2, 3, 8}) {
    SCOPED_TRACE(count);
    const Outcome over = run_over(GetParam(), count);
    expect_equal(over, alone, 1e-10);
    // Not of every scene: whether a node that neither nears nor leaves a tool touches it is a matter of round-off.
    for (std::size_t b = 0; b < alone.contacts.size(); ++b) {
      EXPECT_EQ(over.contacts[b].nodes, alone.contacts[b].nodes) << alone.contacts[b].body;
    }
  }
}

const Case kCases[] = {
    {"sliding_block", {}},    // friction on a tool, in the plane
    {"column_collapse", {}},  // soil, mean stresses of cells, rough walls
    {"speed_tool_3d", {"grid.cell=0.04", "rigid_bodies.blade.sides=one"}, 100, true},  // a tool met at points
    {"sphere_indentation", {"time.end=0.01"}, 300},                                    // about an axis
    {"end_loaded_cylinder", {}},                                                       // tractions
    {"cone_penetrometer", {"grid.cell=8 mm"}, 100, true},                              // soil that settles first
    {"compressed_block", {}, 100, true},                                               // tools and damping
    {"speed_block_3d", {"grid.cell=0.04", "time.sync=0.005"}},                         // free flight
};

INSTANTIATE_TEST_SUITE_P(Of, OverRanks, testing::ValuesIn(kCases), [](const auto& run) { return run.param.scene; });

// Every shipped scene: refused by name, or as on one process over a hundred steps. Takes long.
TEST(FullOverRanks, ShippedScenesMoveAsOnOneProcess) {
  int moved = 0;
  for (const auto& [name, line] : mpm::shipped_scenes()) {
    SCOPED_TRACE(name);
    Case run{name, {}};
    const auto definition = scene_of(run).definition;
    if (!(definition.time.end > 0.0)) run.overrides.push_back("time.end=1");
    std::string refusal;
    Outcome over;
    const auto refused_over = [&](int count) {
      try {
        over = run_over(run, count);
        return false;
      } catch (const mpm::Error& error) {
        refusal = error.what();
        return true;
      }
    };
    if (refused_over(2)) {
      EXPECT_NE(refusal.find("does not work over several ranks yet"), std::string::npos) << refusal;
      RecordProperty(name, refusal);
      continue;
    }
    // The sweeps that find the forces on free bodies end at 1e-5 of them.
    const bool free = std::any_of(definition.rigid_bodies.begin(), definition.rigid_bodies.end(),
                                  [](const mpm::RigidBodyDefinition& body) { return body.free.has_value(); });
    const double part = free ? 1e-6 : 1e-10;
    expect_equal(run_over(run, 1), over, part);
    for (const int count : {3, 8}) expect_equal(run_over(run, count), over, part);
    ++moved;
  }
  EXPECT_GT(moved, 10);
}

TEST(OverRanksRepeated, HasTheSameBits) {
  const Case run{"column_collapse", {}};
  const Outcome first = run_over(run, 3), second = run_over(run, 3);
  EXPECT_EQ(first.state_hash, second.state_hash);
  EXPECT_EQ(first.memory_hash, second.memory_hash);
}

class OverRanksCheckpoint : public testing::Test {
 protected:
  OverRanksCheckpoint()
      : path_((std::filesystem::temp_directory_path() / ("mpm_over_ranks_" + std::to_string(getpid()) + ".h5"))
                  .string()) {}
  ~OverRanksCheckpoint() override { std::filesystem::remove(path_); }

  /// Runs half of the steps, writes the checkpoint, and the rest.
  Outcome write(int count) const {
    Outcome of_first;
    on(count, [&](mpm::Simulation& simulation) {
      run_steps(simulation, run_.steps / 2);
      mpm::save_checkpoint(path_, simulation, {});
      run_steps(simulation, run_.steps);
      Outcome own = outcome_of(simulation);
      if (writes(simulation)) of_first = std::move(own);
    });
    return of_first;
  }
  Outcome go_on(int count) const {
    Outcome of_first;
    on(count, [&](mpm::Simulation& simulation) {
      mpm::load_checkpoint(path_, simulation, "");
      run_steps(simulation, run_.steps);
      Outcome own = outcome_of(simulation);
      if (writes(simulation)) of_first = std::move(own);
    });
    return of_first;
  }
  static bool writes(const mpm::Simulation& simulation) {
    return simulation.ranks() == nullptr || simulation.ranks()->first();
  }
  void on(int count, const std::function<void(mpm::Simulation&)>& work) const {
    if (count == 1) {
      mpm::Simulation simulation = start_on(run_, nullptr);
      return work(simulation);
    }
    mpm::run_ranks(count, [&](mpm::Communicator& ranks) {
      mpm::Simulation simulation = start_on(run_, &ranks);
      work(simulation);
    });
  }

  Case run_{"column_collapse", {}};
  std::string path_;
};

TEST_F(OverRanksCheckpoint, GoesOnToTheBitOnAsManyRanks) {
  const Outcome whole = write(3), resumed = go_on(3);
  EXPECT_EQ(resumed.state_hash, whole.state_hash);
  EXPECT_EQ(resumed.memory_hash, whole.memory_hash);
}

TEST_F(OverRanksCheckpoint, IsReadByAnyNumberOfRanks) {
  const Outcome whole = write(3);
  for (const int count : {1, 2, 5}) {
    SCOPED_TRACE(count);
    expect_equal(go_on(count), whole, 1e-10);
  }
}

TEST_F(OverRanksCheckpoint, OfOneProcessGoesOnOverRanks) {
  const Outcome whole = write(1);
  expect_equal(go_on(4), whole, 1e-10);
}

}  // namespace over_ranks_test
}  // namespace verification
