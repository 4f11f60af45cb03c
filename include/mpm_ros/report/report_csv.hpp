// Writes the messages of a run as the tables of csv_tables.hpp, and the shapes of the rigid bodies as OBJ files that
// any mesh viewer opens: outline_<body>.obj, in the body's own frame; bodies.csv says where it was.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mpm_ros/csv/csv_tables.hpp"
#include "mpm_ros/csv/robot_csv.hpp"
#include "mpm_ros/csv/terrain_csv.hpp"
#include "mpm_ros/report/report_bag.hpp"

namespace mpm_ros {

class CsvExport : public RunVisitor {
 public:
  /// Makes the folder; tables that are there already are replaced. @throws CsvError
  CsvExport(const std::string& folder, bool axisymmetric);

  void contact_forces(std::int64_t time, const ContactForces& message) override;
  void bodies(std::int64_t time, const BodyStates& message) override;
  void solver_state(std::int64_t time, const SolverState& message) override;
  void global_quantities(std::int64_t time, const GlobalQuantities& message) override;
  void cracks(std::int64_t time, const Cracks& message) override;
  void robots(std::int64_t time, const RobotStates& message) override;
  void command(std::int64_t time, const Command& message) override;
  void markers(const visualization_msgs::MarkerArray& message) override;
  void terrain(std::int64_t time, const HeightMap& message) override;
  void close();

 private:
  std::string folder_;
  ContactForcesCsv contact_forces_;
  ContactPairsCsv contact_pairs_;
  BodiesCsv bodies_;
  SolverStateCsv solver_state_;
  GlobalQuantitiesCsv global_quantities_;
  CracksCsv cracks_;
  RobotsCsv robots_;
  CommandsCsv commands_;
  TerrainCsv terrain_;
};

/// The particle snapshots that it is given, one file each.
class SnapshotExport : public RunVisitor {
 public:
  /// @throws CsvError
  explicit SnapshotExport(const std::string& folder) : particles_(folder) {}
  void particles(std::int64_t time, const sensor_msgs::PointCloud2& message) override;
  void close() { particles_.close(); }

 private:
  ParticlesCsv particles_;
};

/// Choice of the snapshots, taken at `times` [ns], to write: at most `most` of them, evenly spread from the first to
/// the last, with one place kept for the snapshot nearest to `peak` [ns] when there are three places or more.
std::set<std::size_t> choose_snapshots(const std::vector<std::int64_t>& times, std::size_t most,
                                       std::optional<std::int64_t> peak);

/// A body's triangles as a Wavefront OBJ file; equal vertices are joined. @throws CsvError
void write_outline(const std::string& path, const visualization_msgs::Marker& marker);

}  // namespace mpm_ros
