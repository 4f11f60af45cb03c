// The ground of a run over time: when a map of it is due, whether it has changed enough to be told, and what it was at
// the start.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/math/state_archive.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/terrain/ground_map.hpp"

namespace mpm_ros {

class GroundRecord {
 public:
  /// @throws mpm::Error as mpm::GroundMap and mpm::ground_raster()
  GroundRecord(const mpm::Simulation& simulation, const mpm::GroundOutput& output);

  /// At a sync point, `time` [ns].
  bool due(std::int64_t time) const { return time % period_ == 0; }
  /// Reads the map now; the first one is that of the start. Collective over several ranks. Returns true if it is to be
  /// told: it is the first, the window has moved, a height has changed by more than asked, or `all` are.
  bool look(const mpm::Simulation& simulation, bool all);

  /// As it was read last: the window, or all of the domain.
  const mpm::HeightGrid& map() const { return map_; }
  /// Heights at the start, as many as the map's [m].
  const std::vector<double>& before() const { return before_; }
  /// For checkpoints: the start. A run that resumes with other points, or from a file without them, starts anew.
  void serialise(mpm::StateArchive& archive);

 private:
  bool changed() const;

  const mpm::GroundOutput output_;
  const std::int64_t period_;  // [ns]
  const mpm::GroundRaster whole_;
  mpm::GroundMap ground_;
  std::vector<double> start_;  // heights of all points; empty before the first map
  mpm::HeightGrid map_, told_;
  std::vector<double> before_;
};

}  // namespace mpm_ros
