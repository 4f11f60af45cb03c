// A suite: one problem with a known answer, which any method can be run on, on any grid.
//
// A suite says how its definition is made for a method and a discretisation, and how far a run is from the answer. It
// holds no run: the runner (runner.hpp) makes one and shows every sync point to the measure.
// Weak: an error is one number a run, so that what it hides (where, in which field) has to be looked for in
// verification.md. Source of each problem: its own file in src/mpm/study.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mpm/definition/definition.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm::study {

/// A suite or method that there is not.
class StudyError : public Error {
 public:
  using Error::Error;
};

/// Discretisation that a suite is computed with.
struct Discretisation {
  int cells = 0;                    ///< across the length that the suite names
  double cfl = 0.5;                 ///< fraction of a cell that the fastest wave may travel in a step
  int particles_per_direction = 2;  ///< along a cell's edge
  double step = 0.0;                ///< upper limit of the time step [s]; none when 0
};

/// Distance of a run from what is exact, followed through the run.
class ErrorMeasure {
 public:
  virtual ~ErrorMeasure() = default;
  /// Shown at the start and at every sync point.
  virtual void look(Simulation& simulation) = 0;
  /// Relative error so far; Suite::measure_text says relative to what.
  virtual double error() const = 0;
};

/// Place of the material point that was at `start` [m], at `time` [s].
using Motion = std::function<Vec3(double time, const Vec3& start)>;

struct Suite {
  std::string name;
  std::string title;
  std::string problem;       ///< statement of what is computed
  std::string exact;         ///< statement of what is exact, and its source
  std::string measure_text;  ///< definition of the error, and its reference
  GeometryKind geometry = GeometryKind::plane_strain;
  bool costly = false;  ///< the short study runs the main methods alone
  std::function<SimulationDefinition(const MethodDefinition&, const Discretisation&)> definition;
  std::function<std::unique_ptr<ErrorMeasure>()> measure;
  Motion motion;                      ///< exact; none where only a quantity of the motion is known
  std::vector<Discretisation> quick;  ///< runs of the short study
  std::vector<Discretisation> full;   ///< runs of the long one
};

/// All of them, in the order of the document.
const std::vector<Suite>& suites();
/// @throws StudyError that lists the names there are
const Suite& find_suite(const std::string& name);

/// Grids one after another at Courant number 0.5 and two particles an edge, then on the grid `varied` the Courant
/// numbers 0.2 and 0.8, and three particles an edge.
std::vector<Discretisation> grids(const std::vector<int>& cells, int varied);

}  // namespace mpm::study
