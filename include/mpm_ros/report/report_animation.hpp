// A run as a film: each particle snapshot is handed to the plotting script as it is read, which draws it and forgets
// it. The scale of the colours and the frame of the picture come from a pass over all snapshots before.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mpm/math/geometry.hpp"
#include "mpm_ros/report/report_bag.hpp"
#include "mpm_ros/report/script.hpp"

namespace mpm_ros {

/// The particle field that colours a picture: `wanted`, or one that tells most of those recorded.
/// @throws ReportError when `wanted` was not recorded
std::string choose_field(const std::vector<std::string>& recorded, const std::string& wanted);

/// Range of a field and box around all particles, over a whole run, in little memory.
class FieldRange : public RunVisitor {
 public:
  explicit FieldRange(std::string field) : field_(std::move(field)) {}
  void particles(std::int64_t time, const sensor_msgs::PointCloud2& message) override;
  const std::string& field() const { return field_; }
  const mpm::Box& box() const { return box_; }  ///< box of the particles' centres [m]
  /// Value that a part of the particles and snapshots lies below, 0 <= part <= 1, from an even sample.
  double quantile(double part) const;

 private:
  std::string field_;
  mpm::Box box_;
  std::vector<float> sample_;
  std::size_t stride_ = 1;   ///< stride of the values that are kept
  std::size_t counted_ = 0;  ///< values met
};

/// Gives the snapshots that it receives to the script.
class Animation : public RunVisitor {
 public:
  /// `csv`: folder with the tables and outlines of the run; `file`: .mp4 or .gif; `frames`: how many snapshots will
  /// follow. @throws ReportError
  Animation(const std::string& csv, const std::string& file, const FieldRange& range, std::size_t frames);
  /// @throws ReportError when the script has stopped
  void particles(std::int64_t time, const sensor_msgs::PointCloud2& message) override;
  /// @throws ReportError when the script fails
  void close();

 private:
  void send(const void* data, std::size_t bytes);

  std::string field_;
  const mpm::Vec3 corner_;  ///< from which places are sent [m]
  Script script_;
  std::vector<std::array<float, 4>> rows_;
};

}  // namespace mpm_ros
