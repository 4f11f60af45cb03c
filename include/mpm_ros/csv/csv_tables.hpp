// The tables of a run, the same whether run_scene writes them as it goes or bag_report from a bag:
// contact_forces.csv, contact_pairs.csv, bodies.csv, solver_state.csv, commands.csv, particles.csv (the index of the
// snapshots) and particles_NNNN.csv; robot_csv.hpp and terrain_csv.hpp have the others. doc/analysis.md lists the
// columns. Each table's columns are set by its first row.
#pragma once

#include <mpm_ros/ContactForce.h>
#include <mpm_ros/ContactPair.h>
#include <mpm_ros/Cracks.h>
#include <mpm_ros/SolverState.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mpm/definition/report.hpp"
#include "mpm_ros/csv/csv_writer.hpp"

namespace mpm_ros {

/// contact_forces.csv: contact_quantities() of each body.
class ContactForcesCsv {
 public:
  ContactForcesCsv(const std::string& folder, bool axisymmetric)
      : path_(folder + "/contact_forces.csv"), axisymmetric_(axisymmetric) {}
  /// `time` [s] is the end of the interval; the bodies and their order are those of the first row.
  /// @throws CsvError
  void add(double time, const std::vector<ContactForce>& bodies);
  void close();

 private:
  std::string path_;
  bool axisymmetric_;
  std::optional<CsvWriter> writer_;
};

/// contact_pairs.csv: pair_quantities() of each two deformable bodies; no file of a scene without such contact.
class ContactPairsCsv {
 public:
  explicit ContactPairsCsv(const std::string& folder) : path_(folder + "/contact_pairs.csv") {}
  /// `time` [s] is the end of the interval; the pairs and their order are those of the first row. @throws CsvError
  void add(double time, const std::vector<ContactPair>& pairs);
  void close();

 private:
  std::string path_;
  std::optional<CsvWriter> writer_;
};

/// bodies.csv: pose, twist and drive of each body.
class BodiesCsv {
 public:
  explicit BodiesCsv(const std::string& folder) : path_(folder + "/bodies.csv") {}
  /// @throws CsvError
  void add(double time, const std::vector<mpm::BodyState>& bodies);
  void close();

 private:
  std::string path_;
  std::optional<CsvWriter> writer_;
};

/// solver_state.csv: state_quantities() and the impulses of the momentum audit.
class SolverStateCsv {
 public:
  explicit SolverStateCsv(const std::string& folder) : path_(folder + "/solver_state.csv") {}
  /// `time` [s]. Impulses are put under the names of the first row. @throws CsvError
  void add(double time, const SolverState& state);
  void close();

 private:
  std::string path_;
  std::optional<CsvWriter> writer_;
  std::vector<std::string> impulses_;
};

/// global_quantities.csv: one column a quantity; no file of a scene that asks for none.
class GlobalQuantitiesCsv {
 public:
  explicit GlobalQuantitiesCsv(const std::string& folder) : path_(folder + "/global_quantities.csv") {}
  /// `time` [s]; names and units are those of the first row. @throws CsvError
  void add(double time, const std::vector<std::string>& names, const std::vector<std::string>& units,
           const std::vector<double>& values);
  void close();

 private:
  std::string path_;
  std::optional<CsvWriter> writer_;
};

/// crack_tips.csv: a row for each tip and time; crack_points.csv: a row for each point of a chain. No file of a scene
/// without cracks.
class CracksCsv {
 public:
  explicit CracksCsv(const std::string& folder) : folder_(folder) {}
  /// `time` [s]. @throws CsvError
  void add(double time, const Cracks& message);
  void close();

 private:
  std::string folder_;
  std::optional<CsvWriter> tips_, points_;
};

/// A command as it was applied.
struct CommandRow {
  double time = 0.0;  ///< [s] since the start, when it took effect
  std::string body;
  std::string kind = "velocity";  ///< or "pose", "wrench"
  mpm::Twist twist;               ///< twist of a velocity command
  mpm::Wrench wrench;             ///< wrench of a wrench command
  mpm::Pose pose;                 ///< pose of a pose command
  double arrival = 0.0;           ///< [s] of a pose command
};

/// commands.csv: one row a command; cells that do not belong to its kind are empty.
class CommandsCsv {
 public:
  /// @throws CsvError
  explicit CommandsCsv(const std::string& folder);
  void add(const CommandRow& command);
  void close();

 private:
  CsvWriter writer_;
};

/// A particle field's name and unit, one value a particle.
struct ParticleColumn {
  std::string name;
  std::string unit;  ///< empty: not known, left out of the header
  std::vector<float> values;
  std::vector<double> fine;  ///< the same in double precision, where it is recorded so; else empty
};

/// particles_NNNN.csv: one file a snapshot, one row a particle; particles.csv lists the files with their times.
class ParticlesCsv {
 public:
  /// @throws CsvError
  explicit ParticlesCsv(const std::string& folder);
  /// `ids` and the values of each column are as many as the particles. @throws CsvError
  void add(double time, const std::vector<std::uint32_t>& ids, const std::vector<ParticleColumn>& columns);
  void close();

 private:
  std::string folder_;
  std::uint64_t count_ = 0;
  CsvWriter index_;
};

/// "functions", "velocity" or "pose".
std::string drive_name(mpm::Drive drive);

}  // namespace mpm_ros
