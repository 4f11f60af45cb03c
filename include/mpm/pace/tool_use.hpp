// Use of tools in the ground in a run: how deep they reach, and whether they dig across it, are pressed into it or roll
// on it. It decides how many cells lie across what the tool does to the ground, and which measured runs tell the error
// of its force (mpm/pace/force_errors.hpp).
//
// A tool is looked at while it is in the ground. It rolls if a point of its rim moves at least half as fast about its
// origin as the origin does; else it is pressed in or pulled out if most of its way is along gravity, and digs if most
// is across. Weak: a tool that a topic will command stands still in a rehearsal and has no use; what is thrown up is no
// ground, whose surface is that of the start.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "mpm/simulation/simulation.hpp"

namespace mpm::pace {

enum class ToolUse { blade, plate, wheel };
/// In the order of ToolUse.
inline constexpr std::array<const char*, 3> kToolUseNames = {"blade", "plate", "wheel"};

/// A tool in the ground.
struct ToolAtWork {
  int body = 0;                ///< index of the rigid body
  std::optional<ToolUse> use;  ///< nothing: it did not move, as one that commands move
  double depth = 0.0;          ///< to which it reaches below the ground as it was at the start, at most [m]
  double width = 0.0;          ///< the smaller of its extents across gravity [m]
  /// Length that cells count across in such a use [m]: the width of a plate that has ends, the depth of a blade and a
  /// wheel, and the smaller of the two where the use is not known.
  double length(std::optional<ToolUse> in_use) const;
};

/// Watches the tools of a run, the same for any number of threads.
class ToolsInGround {
 public:
  /// The ground is that of now: call before the first step.
  explicit ToolsInGround(const Simulation& simulation);
  /// Call at sync points, some dozens of times in a run: a look takes as long as tens of thousands of distances.
  void look(const Simulation& simulation);
  /// Follows tools whose motion is prescribed from where they are until `end` [s].
  void look_ahead(const Simulation& simulation, double end);
  /// Those that have been in the ground. A depth below half a spacing of particles is not seen.
  std::vector<ToolAtWork> found() const;

 private:
  struct Way {
    Pose before;
    double along = 0.0, across = 0.0, rim = 0.0;  ///< in the ground [m]
    double depth = 0.0, width = 0.0;              ///< [m]
  };

  /// Height of the ground in the column of cells at a point [m]; nothing where there is none.
  std::optional<double> ground_at(const Vec3& point) const;
  double depth_of(const Surface& surface, const Pose& pose) const;
  /// `turned`: by how much since the look before [rad], which may be more than a turn.
  void look_at(Way& way, const Surface& surface, const Pose& pose, double turned) const;

  std::vector<int> axes_, level_;  ///< axes of the scene, and those of them across gravity
  int up_ = 2;
  double sense_ = 1.0;  ///< sign of up along that axis
  Vec3 low_ = Vec3::Zero(), cell_ = Vec3::Zero();
  std::array<int, 3> columns_{1, 1, 1};
  std::vector<double> heights_;  ///< heights of columns, along up; -infinity in those without ground
  std::vector<Way> ways_;
  double last_ = 0.0;  ///< time of the look before [s]
};

}  // namespace mpm::pace
