// A plan of many runs of one scene: which keys of the scene take which values (doc/sweeps.md). It is read and checked
// here, and each run's scene with it; nothing is run.
//
//   const mpm::sweep::Plan plan = mpm::sweep::read_plan("plan.yaml");
//   for (int run = 1; run <= plan.runs(); ++run) mpm::sweep::resolve(plan, run);
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"

namespace mpm::sweep {

/// A key of the scene and what it is set to, in YAML, as `run_scene --set` takes them.
struct Setting {
  std::string path;   ///< "materials.sand.young"
  std::string value;  ///< "2 MPa"
  friend bool operator==(const Setting& a, const Setting& b) { return a.path == b.path && a.value == b.value; }
};

/// Alternatives, each of which sets one key or several.
using Axis = std::vector<std::vector<Setting>>;

struct Plan {
  std::string label;                         ///< the plan's file
  std::string scene;                         ///< shipped name, or a path
  std::vector<Setting> set;                  ///< the same in all runs
  std::vector<Axis> axes;                    ///< every combination is a run; the last axis changes fastest
  std::vector<std::string> parameters;       ///< paths of what differs between runs, in the plan's order
  std::vector<std::string> record;           ///< outputs that runs record beside summary and log: bag, csv, vtk
  std::map<std::string, std::string> where;  ///< "file:line" by path
  std::string text;                          ///< as read

  /// Number of runs, which are counted from 1.
  int runs() const;
  /// Settings that run `number` makes beside `set`, in the order of `parameters`.
  std::vector<Setting> settings(int number) const;
};

/// The most runs that a plan may have.
inline constexpr int kMostRuns = 100000;

/// Reads and checks a plan; paths of scenes in it start from its folder. @throws SceneError
Plan read_plan(const std::string& path);
/// `label`: the name of the file in errors.
Plan parse_plan(const std::string& text, const std::string& label);

/// A run's scene, and its text: values set, method chosen, files by their path from the root. It needs nothing else.
struct ResolvedRun {
  Scene scene;
  std::string text;
  double memory = 0.0;  ///< that the run takes at least [bytes]
};
/// Reads and checks the scene of a run, then has `check` look at it. @throws SceneError that names the run, and the
/// parameter where it can, also for an Error of `check`
ResolvedRun resolve(const Plan& plan, int run, const std::function<void(const Scene&)>& check = {});
/// Builds a scene, to find what only shows then: a body outside the grid, a step that is too short. @throws Error
void check_build(const Scene& scene);

/// The plan's scene with the files that it names by their path from the root: it can lie in any folder.
std::string base_scene(const Plan& plan);

}  // namespace mpm::sweep
