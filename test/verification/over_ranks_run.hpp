// Runs of a scene on one process and over several ranks, which are threads here, and what they have to agree in: the
// motion of each particle, the forces on tools, energies, and an audit that closes.
//
// A sum over particles of several ranks has other round-off than on one process, so runs differ by what the scene makes
// of that: over a hundred steps they are asked to be equal to 1e-10 of the momentum that was exchanged.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <numeric>
#include <utility>

#include "scene_run.hpp"
#include "thread_communicator.hpp"

namespace verification {
namespace over_ranks {

/// Values that are compared.
struct Outcome {
  std::uint64_t steps = 0, state_hash = 0, memory_hash = 0;
  double seconds = 0.0;
  double exchanged = 0.0, residual = 0.0, mass = 0.0;
  double balance = 0.0;                              ///< change of the balance of energies since the start [J]
  double carried = 0.0;                              ///< sum of m |v| [kg m/s]
  std::vector<std::vector<double>> velocity, place;  ///< [axis][id]
  std::vector<double> around;                        ///< length along each axis if it is periodic, else 0 [m]
  std::vector<std::vector<double>> transported;      ///< [quantity][id]
  std::vector<mpm::ContactReport> contacts;
  std::vector<mpm::PairReport> pairs;
  std::vector<mpm::NamedImpulse> impulses;
  std::vector<mpm::NamedNumber> numbers;
  std::vector<mpm::NamedEnergy> energies;
  std::vector<std::pair<std::string, double>> metrics;
};

struct Case {
  std::string scene;
  std::vector<std::string> overrides;
  std::uint64_t steps = 100;
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
  return mpm::Simulation(mpm::build(scene, ranks), options);
}

inline Outcome outcome_of(mpm::Simulation& simulation) {
  Outcome outcome;
  const mpm::SolverState state = simulation.state();
  outcome.steps = state.step.steps;
  outcome.seconds = seconds(simulation);
  outcome.exchanged = state.audit.exchanged;
  outcome.residual = state.audit.residual;
  outcome.impulses = state.audit.impulses;
  outcome.energies = state.energy.list();
  outcome.balance = state.energy.balance();
  for (const char* name : {"vx", "vy", "vz"}) outcome.velocity.push_back(field(simulation, name));
  for (const char* name : {"x", "y", "z"}) outcome.place.push_back(field(simulation, name));
  const mpm::SimulationDefinition& definition = simulation.definition();
  for (int axis = 0; axis < 3; ++axis) {
    const bool periodic = definition.walls[2 * axis].kind == mpm::WallKind::periodic;
    outcome.around.push_back(periodic ? definition.grid.max[axis] - definition.grid.min[axis] : 0.0);
  }
  const std::vector<double> masses = field(simulation, "mass");
  outcome.mass = std::accumulate(masses.begin(), masses.end(), 0.0);
  for (std::size_t p = 0; p < masses.size(); ++p) {
    outcome.carried += masses[p] * std::hypot(outcome.velocity[0][p], outcome.velocity[1][p], outcome.velocity[2][p]);
  }
  const int bodies = static_cast<int>(simulation.bodies().size());
  for (int body = 0; body < bodies; ++body) outcome.contacts.push_back(simulation.take_contact(body));
  outcome.pairs = simulation.take_pairs();
  outcome.numbers = state.numbers;
  for (const auto kind :
       {mpm::Transported::temperature, mpm::Transported::concentration, mpm::Transported::pore_pressure}) {
    if (definition.transport.find(kind) == nullptr) continue;
    outcome.transported.push_back(field(simulation, mpm::traits_of(kind).name));
  }
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

inline Outcome run_of(mpm::Simulation& simulation, std::uint64_t steps) {
  const double before = simulation.state().energy.balance();
  run_steps(simulation, steps);
  Outcome outcome = outcome_of(simulation);
  outcome.balance -= before;
  return outcome;
}

inline Outcome run_alone(const Case& run) {
  mpm::Simulation simulation = start_on(run, nullptr);
  return run_of(simulation, run.steps);
}

inline Outcome run_over(const Case& run, int count) {
  Outcome of_first;
  mpm::run_ranks(count, [&](mpm::Communicator& ranks) {
    mpm::Simulation simulation = start_on(run, &ranks);
    Outcome own = run_of(simulation, run.steps);
    if (ranks.first()) of_first = std::move(own);
  });
  return of_first;
}

/// `lengths`: of the axes that are periodic, along which a place is one with those whole lengths away; else empty.
inline double largest_difference(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b,
                                 const std::vector<double>& lengths = {}) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].size(), b[k].size());
    for (std::size_t p = 0; p < std::min(a[k].size(), b[k].size()); ++p) {
      double difference = std::abs(a[k][p] - b[k][p]);
      if (k < lengths.size() && lengths[k] > 0.0) difference = std::abs(std::remainder(difference, lengths[k]));
      if (!(difference <= largest)) largest = difference;
    }
  }
  return largest;
}

inline double largest(const std::vector<std::vector<double>>& values) {
  double most = 0.0;
  for (const std::vector<double>& list : values) {
    for (const double value : list) most = std::max(most, std::abs(value));
  }
  return most;
}

/// Compares the pairs of deformable bodies and the numbers of modules.
inline void expect_equal_reports(const Outcome& over, const Outcome& alone, double part) {
  ASSERT_EQ(over.pairs.size(), alone.pairs.size());
  for (std::size_t i = 0; i < alone.pairs.size(); ++i) {
    const mpm::PairReport &there = over.pairs[i], &here = alone.pairs[i];
    EXPECT_LE((there.force - here.force).norm(), 10.0 * part * here.pressing) << here.name;
    EXPECT_NEAR(there.pressing, here.pressing, 10.0 * part * here.pressing) << here.name;
    EXPECT_NEAR(there.friction_energy, here.friction_energy, 100.0 * part * std::abs(here.friction_energy));
    EXPECT_EQ(there.nodes, here.nodes) << here.name;
  }
  ASSERT_EQ(over.numbers.size(), alone.numbers.size());
  for (const mpm::NamedNumber& number : alone.numbers) {
    // As large as the largest of its unit: what is left of sums is as exact as they are.
    double scale = number.unit == "1" ? 1.0 : 0.0;
    for (const mpm::NamedNumber& other : alone.numbers) {
      if (other.unit == number.unit) scale = std::max(scale, std::abs(other.value));
    }
    const std::size_t i = &number - alone.numbers.data();
    EXPECT_EQ(over.numbers[i].name, number.name);
    EXPECT_NEAR(over.numbers[i].value, number.value, 100.0 * part * scale) << number.name;
    if (number.name.find("budget error") != std::string::npos) {  // error of what is transported
      EXPECT_LT(over.numbers[i].value, std::max(1e-12, 10.0 * number.value)) << number.name;
    }
  }
}

/// `part`: of the exchanged momentum, or of what is carried where loads exchange none together.
inline void expect_equal(const Outcome& over, const Outcome& alone, double part) {
  EXPECT_EQ(over.steps, alone.steps);
  EXPECT_LT(over.residual, std::max(1e-12, 10.0 * alone.residual));
  // All particles together, were all as far off as the one that is most.
  const double moved = alone.exchanged > 1e-6 * alone.carried ? alone.exchanged : alone.carried;
  EXPECT_LE(largest_difference(over.velocity, alone.velocity) * alone.mass, part * moved);
  constexpr double kLastPlaces = 1e-15;
  EXPECT_LE(largest_difference(over.place, alone.place, alone.around),
            part * moved / alone.mass * alone.seconds + kLastPlaces * largest(alone.place));
  for (std::size_t q = 0; q < alone.transported.size(); ++q) {
    EXPECT_LE(largest_difference({over.transported[q]}, {alone.transported[q]}),
              part * largest({alone.transported[q]}));
  }
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
  EXPECT_NEAR(over.balance, alone.balance, 100.0 * part * total);
  expect_equal_reports(over, alone, part);
}

}  // namespace over_ranks
}  // namespace verification
