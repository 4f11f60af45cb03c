// Target of a run, a pace or an error of the force on its tool, and the discretisation that reaches it.
//
// For a pace: of all candidates that are expected to reach it with a tenth to spare, and whose error is at most
// Target::most_error, the one with the least error. For an error: of all that keep it, the fastest. Where no candidate
// reaches the target, the one that comes nearest is taken, within that error where there is one. Errors that differ by
// less than kSameError of the force count as the same, and so do paces within kSamePace; then the faster one, or the
// more exact one, is taken. The pace is arithmetic: a step costs as its particles do, for each precision and update at
// the cost that was timed on the scene; steps to a sync period are whole, and implicit ones shorter where a tool would
// cross half a cell. Weak: a coarse grid's step costs more than its particles do, so what is chosen should be timed
// itself.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mpm/pace/discretisation.hpp"
#include "mpm/pace/force_errors.hpp"

namespace mpm::pace {

inline constexpr double kMostError = 0.4;  ///< largest error of the force; with more the figures say little

/// Exactly one of the first two.
struct Target {
  std::optional<double> real_time;    ///< simulated over wall time
  std::optional<double> force_error;  ///< error relative to the force on the tool
  std::vector<std::string> keep;      ///< discretisation_keys() that stay as the scene has them
  /// Axis across whose middle plane the scene is its own mirror image: the half above it is modelled.
  std::optional<int> symmetric;
  std::optional<ToolUse> use;      ///< use of all tools, as the scene says it
  std::optional<double> length;    ///< that cells count across, as the scene says it [m]
  double most_error = kMostError;  ///< largest error of a choice for a pace; infinite where no error is known
  double extent = 0.0;             ///< extent of the smallest tool, where no length is known otherwise [m]
  /// Settings of a scene for which the choice was made before, "key=value"; it is not made anew.
  std::optional<std::vector<std::string>> chosen;
  double expected_pace = 0.0, expected_error = 0.0;  ///< beside `chosen`

  bool keeps(const std::string& key) const;
};

/// "real_time: 1", "force_error: 5 %"
std::string target_text(const Target& target);

struct Candidate {
  Discretisation what;
  ForceError error;
  double pace = 0.0;   ///< expected, simulated over wall time
  bool timed = false;  ///< the pace was timed with it
};

inline constexpr double kSpare = 1.1;        ///< the pace that is asked of a candidate over the pace wanted
inline constexpr double kSameError = 0.001;  ///< difference relative to the force
inline constexpr double kSamePace = 0.02;    ///< relative

/// Costs that the pace of candidates is computed from.
struct StepCosts {
  GeometryKind geometry = GeometryKind::solid;
  Discretisation base;         ///< that was timed
  double particles = 0.0;      ///< with it
  double sync = 0.0;           ///< period of sync points [s]
  double wave_time = 0.0;      ///< in which the fastest wave crosses a cell of the base, by its shortest edge [s]
  std::optional<double> step;  ///< upper limit of the step [s]
  double fastest = 0.0;        ///< speed of a tool's surface, which limits implicit steps [m/s]
  /// Cost of one particle's step in the base's grid [s].
  std::function<double(Precision, UpdateScheme)> particle_step;

  /// Number of steps in a sync period.
  double steps(const Discretisation& one) const;
  /// Simulated over wall time.
  double pace(const Discretisation& one) const;
};

/// Every combination of cells, with the particles along an edge that fit them, and of what the target may change and
/// the rules of methods allow, that there are figures for. `cells`: pairs that fit the scene, its own among them.
/// `tools`: of which the one with the largest error decides.
std::vector<Candidate> candidates(const Target& target, const std::vector<ToolInGround>& tools,
                                  const std::vector<std::pair<Vec3, int>>& cells,
                                  const SimulationDefinition& definition, const ForceErrors& errors,
                                  const StepCosts& costs);

/// True if a candidate reaches the target.
bool reaches(const Target& target, const Candidate& candidate);
/// The place in `all` of the one to take, by the rule above. @param all at least one
std::size_t choose(const Target& target, const std::vector<Candidate>& all);

/// Those that no other beats in both pace and error, by falling error.
std::vector<Candidate> front(const std::vector<Candidate>& all);
/// Several lines: the chosen one, the scene as it is, and the front, with pace, error and its parts.
std::string candidates_table(const std::vector<Candidate>& all, const Candidate& chosen, const Discretisation& base,
                             GeometryKind geometry);

}  // namespace mpm::pace
