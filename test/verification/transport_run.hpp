// Helpers that the tests of transport share: the balance of a quantity, and errors of what particles see.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "scene_run.hpp"

namespace verification {

/// A number of the run; a test that asks for one that nobody reports fails.
inline double reported(const mpm::Simulation& simulation, const std::string& name) {
  for (const mpm::NamedNumber& one : simulation.state().numbers) {
    if (one.name == name) return one.value;
  }
  ADD_FAILURE() << "no module reports '" << name << "'";
  return 0.0;
}

/// The particles have gained what came in, each summed by itself, to round-off: 1e-10 of what was exchanged, of which
/// there has to be some.
inline void expect_balance(const mpm::Simulation& simulation, const std::string& quantity) {
  EXPECT_LT(reported(simulation, quantity + " budget error"), 1e-10) << quantity;
  EXPECT_NE(reported(simulation, quantity + " content"), 0.0) << quantity;
}

/// Differences between particles and a solution.
struct Misfit {
  double rms = 0.0, most = 0.0;
};

/// `exact(p)`: of particle p.
template <class Exact>
Misfit misfit(const std::vector<double>& values, Exact exact) {
  Misfit result;
  for (std::size_t p = 0; p < values.size(); ++p) {
    const double error = values[p] - exact(p);
    result.rms += error * error / static_cast<double>(values.size());
    result.most = std::max(result.most, std::abs(error));
  }
  result.rms = std::sqrt(result.rms);
  return result;
}

/// Order of convergence from errors on a grid and on one of half its cells.
inline double order_of_convergence(double coarse, double fine) { return std::log2(coarse / fine); }

}  // namespace verification
