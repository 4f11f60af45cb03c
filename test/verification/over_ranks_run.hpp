// What tests of runs over several ranks share: a run on one process or over ranks, which are threads, what is compared
// of it, and the comparison.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <numeric>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "scene_run.hpp"
#include "thread_communicator.hpp"

namespace verification {
namespace over_ranks {

/// What is compared.
struct Outcome {
  std::uint64_t steps = 0, state_hash = 0, memory_hash = 0;
  double exchanged = 0.0, residual = 0.0, mass = 0.0;
  double carried = 0.0;                              ///< sum of m |v| [kg m/s]
  std::vector<std::vector<double>> velocity, place;  ///< [axis][id]
  std::vector<mpm::ContactReport> contacts;
  std::vector<mpm::NamedEnergy> energies;
  std::vector<mpm::NamedImpulse> impulses;
  std::vector<mpm::NamedNumber> numbers;
  std::vector<std::pair<std::string, double>> metrics;
};

struct Case {
  std::string scene;
  std::vector<std::string> overrides;
  std::uint64_t steps = 100;
  bool points = false;  ///< whether it meets tools at points
};

inline std::ostream& operator<<(std::ostream& out, const Case& run) { return out << run.scene; }

/// Functions of a scene hold one evaluation at a time, so ranks that are threads have scenes of their own, read in
/// turn.
inline mpm::Scene scene_of(const Case& run) {
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  const std::filesystem::path file = source_file("test/verification/scenes/" + run.scene + ".yaml");
  return mpm::load_scene(std::filesystem::exists(file) ? file.string() : run.scene, run.overrides);
}

inline mpm::Simulation start_on(const Case& run, mpm::Communicator* ranks) {
  const mpm::Scene scene = scene_of(run);
  mpm::SimulationOptions options;
  options.threads = 1;
  if (ranks != nullptr) options.ranks = {ranks, [](mpm::Communicator*) {}};
  return mpm::Simulation(mpm::build(scene), options);
}

inline Outcome outcome_of(mpm::Simulation& simulation) {
  Outcome outcome;
  const mpm::SolverState state = simulation.state();
  outcome.steps = state.step.steps;
  outcome.exchanged = state.audit.exchanged;
  outcome.residual = state.audit.residual;
  outcome.energies = state.energy.list();
  outcome.impulses = state.audit.impulses;
  outcome.numbers = state.numbers;
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

inline void run_steps(mpm::Simulation& simulation, std::uint64_t steps) {
  const std::int64_t period = simulation.sync_period();
  const double end = simulation.definition().time.end;
  while (simulation.state().step.steps < steps && seconds(simulation) + 0.5e-9 * static_cast<double>(period) < end) {
    simulation.advance();
  }
}

inline Outcome run_alone(const Case& run) {
  mpm::Simulation simulation = start_on(run, nullptr);
  run_steps(simulation, run.steps);
  return outcome_of(simulation);
}

inline Outcome run_over(const Case& run, int count) {
  Outcome of_first;
  mpm::run_ranks(count, [&](mpm::Communicator& ranks) {
    mpm::Simulation simulation = start_on(run, &ranks);
    run_steps(simulation, run.steps);
    Outcome own = outcome_of(simulation);
    if (ranks.first()) of_first = std::move(own);
  });
  return of_first;
}

inline double largest_difference(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
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

/// `part`: of the exchanged momentum, or of what is carried where loads exchange none together.
inline void expect_equal(const Outcome& over, const Outcome& alone, double part) {
  EXPECT_EQ(over.steps, alone.steps);
  EXPECT_LT(over.residual, std::max(1e-12, 10.0 * alone.residual));
  // All particles together, were all as far off as the one that is most.
  const double off = largest_difference(over.velocity, alone.velocity) * alone.mass;
  EXPECT_LE(off, part * (alone.exchanged > 1e-6 * alone.carried ? alone.exchanged : alone.carried));
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

}  // namespace over_ranks
}  // namespace verification
