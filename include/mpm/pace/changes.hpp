// Changes that would bring a run to a wanted pace: those that the scene does not use yet, from the one that costs least
// in accuracy to the one that costs most, and the first of them that together reach it.
//
// Factors of threads, precision and update are timed on the scene where that was done, else they are the least that
// doc/performance.md has for any scene and instruction set. The step and the cell change the number of steps by
// arithmetic: whole steps to a sync period, as cfl and as 1/cell; particles go as 1/cell to the power of the axes.
// Weak: factors are multiplied, though a run that waits for memory gains less from the second one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mpm/definition/definition.hpp"
#include "mpm/pace/forecast.hpp"

namespace mpm::pace {

struct Change {
  std::string what;     ///< as one writes it: "method.precision=single"
  double factor = 1.0;  ///< times as fast, alone
  std::string origin;   ///< origin of the factor
  std::string price;    ///< in accuracy
};

/// Times as fast, timed on the scene; without value where that was not done.
struct TimedFactors {
  std::optional<double> threads, single, usf;
};

struct Plan {
  double wanted = 1.0;           ///< simulated over wall time
  std::vector<Change> changes;   ///< each alone, the least harmful first
  std::vector<Change> together;  ///< the first that together reach what is wanted, or all that there are
  double reaches = 0.0;          ///< with these
  bool enough() const { return reaches >= wanted; }
};

/// @param threads most threads that can be of use, on this machine and for so many particles
Plan make_plan(const SimulationDefinition& definition, const Forecast& forecast, double wanted, int threads,
               const TimedFactors& timed = {});

/// Several lines: a table of the changes, and which of them together would reach what is wanted.
std::string plan_table(const Plan& plan, const Forecast& forecast);
/// One line: "--threads 2, method.precision=single and time.cfl=0.9 together would reach 1.1".
std::string plan_text(const Plan& plan);

}  // namespace mpm::pace
