#include "mpm_ros/record/ground_record.hpp"

#include <cmath>

namespace mpm_ros {

GroundRecord::GroundRecord(const mpm::Simulation& simulation, const mpm::GroundOutput& output)
    : output_(output),
      period_(mpm::nanoseconds_of(output.period)),
      whole_(mpm::ground_raster(simulation.definition().grid, simulation.definition().geometry, output.resolution)),
      ground_(simulation, output.of) {}

bool GroundRecord::look(const mpm::Simulation& simulation, bool all) {
  if (start_.empty()) start_ = ground_.read(simulation, whole_).heights;
  mpm::GroundRaster part = whole_;
  if (!output_.follows.empty()) {
    const mpm::RigidBody& body = simulation.rigid_body(simulation.find_body(output_.follows));
    part = mpm::window_of(whole_, body.pose().position.head<2>(), output_.window);
  }
  map_ = ground_.read(simulation, part);
  if (!all && !changed()) return false;
  told_ = map_;
  mpm::HeightGrid start = map_;
  start.low = whole_.low;
  start.columns = whole_.columns;
  start.rows = whole_.rows;
  start.heights = start_;
  before_ = mpm::part_of(start, part).heights;
  return true;
}

bool GroundRecord::changed() const {
  if (output_.change == 0.0 || told_.heights.size() != map_.heights.size() || told_.low != map_.low) return true;
  for (std::size_t i = 0; i < map_.heights.size(); ++i) {
    if (std::isnan(map_.heights[i]) != std::isnan(told_.heights[i])) return true;
    if (std::abs(map_.heights[i] - told_.heights[i]) > output_.change) return true;
  }
  return false;
}

void GroundRecord::serialise(mpm::StateArchive& archive) {
  double resolution = output_.resolution;
  archive.value("resolution", resolution);
  std::string of = output_.of;
  archive.value("of", of);
  archive.list("start", start_);
  const auto points = static_cast<std::size_t>(whole_.columns) * static_cast<std::size_t>(whole_.rows);
  if (resolution != output_.resolution || of != output_.of || start_.size() != points) start_.clear();
}

}  // namespace mpm_ros
