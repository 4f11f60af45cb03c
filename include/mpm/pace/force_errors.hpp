// Error of the force on a tool in soil, for a discretisation: read from measured runs, in a small table.
//
//   problem,use,ground,axes,cells,along,precision,update,cfl,force,cost
//   blade_flat,blade,sand,2,8,2,double,usavg,0.5,0.985,170
//
// use: blade, plate or wheel (mpm/pace/tool_use.hpp); ground: sand, which has friction, or clay, which has cohesion
// alone; cells: across the tool's length, which of a blade and a wheel is the depth to which they reach and of a plate
// its width; along: particles along a cell's edge; force: over the answer, exact or that of the finest run, and further
// from 1 by what other places in a cell and other tools may add; cost: processor time of a particle's step on one
// thread [ns], or empty. doc/methods.md says how each was measured.
//
// The error of grid and particles is that of the reference, double, USAVG, cfl 0.5, against the answer: of a problem
// the largest with so many cells or more, and 1 % at least, since less is met by accident; between two numbers of cells
// a power of them; on grids coarser than a problem was run on that of its coarsest; over the problems
// of a use and a ground the largest, since a robot's tool may be like any of them. Precision and update add
// the change of the force that they alone make in a run of the table, root of the mean square too; so does the step,
// from the smallest cfl of the table on, in proportion between two of them. The whole is the root of the sum of the
// squares, as of errors that do not depend on each other.
//
// The column `cfl` of implicit steps has their length over sqrt(cell / gravity); their reference is double and the
// shortest step of a run's grid, and their update adds nothing, since it has figures of its own.
//
// Weak: as good as the problems, whose tools are slow.
#pragma once

#include <array>
#include <cmath>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "mpm/math/error.hpp"
#include "mpm/pace/discretisation.hpp"
#include "mpm/pace/tool_use.hpp"

namespace mpm::pace {

/// A table that is none.
class FiguresError : public Error {
 public:
  using Error::Error;
};

enum class Ground { sand, clay };
/// In the order of Ground.
inline constexpr std::array<const char*, 2> kGroundNames = {"sand", "clay"};

/// A tool whose error of the force is asked for; what is not known of it is taken from all there is.
struct ToolInGround {
  std::optional<ToolUse> use;
  std::optional<Ground> ground;
  double length = 0.0;  ///< that cells count across [m]
};

/// A row of the table.
struct ForceRun {
  std::string problem;
  ToolUse use = ToolUse::blade;
  Ground ground = Ground::sand;
  int axes = 2;        ///< number of axes of its grid: 2 or 3
  double cells = 0.0;  ///< across the tool
  int along = 2;
  Precision precision = Precision::float64;
  UpdateScheme update = UpdateScheme::usavg;
  double cfl = 0.5;    ///< cfl; for an implicit step its length over sqrt(cell / gravity)
  double force = 1.0;  ///< over the answer
  double cost = 0.0;   ///< cost of a particle's step, one thread [ns]; 0 where it was not timed
};

/// Parts of the error, relative to the force.
struct ForceError {
  double grid = 0.0, precision = 0.0, update = 0.0, step = 0.0;
  double total() const { return std::sqrt(grid * grid + precision * precision + update * update + step * step); }
};

class ForceErrors {
 public:
  ForceErrors() = default;
  /// @throws FiguresError without a run at the reference
  explicit ForceErrors(std::vector<ForceRun> runs);

  /// Cells are counted by the widest of their edges. Returns nothing for a grid that is coarser than all that were
  /// measured, or so many particles in a cell that none were. Finer than the finest counts as that.
  /// A scene with less than three axes is judged by problems with two.
  std::optional<ForceError> of(const Discretisation& one, const ToolInGround& tool, GeometryKind geometry) const;
  /// True if a run with such a tool in such a ground, as far as they are known, was measured on any grid with such
  /// steps.
  bool covers(const ToolInGround& tool, GeometryKind geometry, bool implicit = false) const;
  /// Cost of a particle's step over that in double precision with USAVG: 1 where there is no figure.
  double cost_factor(Precision precision, UpdateScheme update) const;

 private:
  /// True if others of its kind of steps are compared with this run.
  bool reference(const ForceRun& run) const;
  std::optional<double> grid_error(const ToolInGround& tool, int axes, double cells, int along, bool implicit) const;
  double change(int axes, Precision precision, UpdateScheme update) const;
  /// `family`: of steps, implicit or USAVG.
  double step_error(int axes, double cfl, UpdateScheme family) const;

  std::vector<ForceRun> runs_;
};

/// @throws FiguresError naming the line when the text is no such table
ForceErrors read_force_errors(std::istream& in);

}  // namespace mpm::pace
