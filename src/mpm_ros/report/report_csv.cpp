#include "mpm_ros/report/report_csv.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>

#include "mpm/math/nanoseconds.hpp"
#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/report/report_cloud.hpp"
#include "mpm_ros/report/report_messages.hpp"

namespace mpm_ros {
namespace {

/// The folder, once it is there: members write to it as they are made.
const std::string& made(const std::string& folder) {
  make_csv_folder(folder);
  return folder;
}

}  // namespace

CsvExport::CsvExport(const std::string& folder, bool axisymmetric)
    : folder_(made(folder)),
      contact_forces_(folder, axisymmetric),
      contact_pairs_(folder),
      bodies_(folder),
      solver_state_(folder),
      global_quantities_(folder),
      cracks_(folder),
      robots_(folder),
      commands_(folder),
      terrain_(folder) {}

void CsvExport::contact_forces(std::int64_t time, const ContactForces& message) {
  contact_forces_.add(mpm::nearest_seconds(time), message.bodies);
  contact_pairs_.add(mpm::nearest_seconds(time), message.pairs);
}

void CsvExport::bodies(std::int64_t time, const BodyStates& message) {
  bodies_.add(mpm::nearest_seconds(time), body_states_of(message));
}

void CsvExport::solver_state(std::int64_t time, const SolverState& message) {
  solver_state_.add(mpm::nearest_seconds(time), message);
}

void CsvExport::global_quantities(std::int64_t time, const GlobalQuantities& message) {
  if (message.units.size() != message.names.size())
    throw BagError("global_quantities: as many units as names are needed");
  global_quantities_.add(mpm::nearest_seconds(time), message.names, message.units, message.values);
}

void CsvExport::cracks(std::int64_t time, const Cracks& message) { cracks_.add(mpm::nearest_seconds(time), message); }

void CsvExport::robots(std::int64_t time, const RobotStates& message) {
  robots_.add(mpm::nearest_seconds(time), message.robots);
}

void CsvExport::command(std::int64_t time, const Command& message) { commands_.add(command_row_of(time, message)); }

void CsvExport::markers(const visualization_msgs::MarkerArray& message) {
  for (const visualization_msgs::Marker& marker : message.markers) {
    if (marker.type != visualization_msgs::Marker::TRIANGLE_LIST || marker.points.empty()) continue;
    write_outline(folder_ + "/outline_" + file_stem(marker.header.frame_id) + ".obj", marker);
  }
}

void CsvExport::terrain(std::int64_t time, const HeightMap& message) {
  if (message.heights.size() != static_cast<std::size_t>(message.columns) * message.rows)
    throw BagError("terrain: as many heights as points are needed");
  terrain_.add(mpm::nearest_seconds(time), message);
}

void CsvExport::close() {
  contact_forces_.close();
  contact_pairs_.close();
  bodies_.close();
  solver_state_.close();
  global_quantities_.close();
  cracks_.close();
  robots_.close();
  commands_.close();
  terrain_.close();
}

void SnapshotExport::particles(std::int64_t time, const sensor_msgs::PointCloud2& message) {
  const CloudColumns cloud = columns_of(message);
  particles_.add(mpm::nearest_seconds(time), cloud.ids, cloud.columns);
}

std::set<std::size_t> choose_snapshots(const std::vector<std::int64_t>& times, std::size_t most,
                                       std::optional<std::int64_t> peak) {
  std::set<std::size_t> chosen;
  if (times.empty() || most == 0) return chosen;
  const std::size_t last = times.size() - 1;
  if (most == 1) return {last};
  const bool with_peak = peak && most > 2 && times.size() > most;
  if (with_peak) {
    const auto nearer = [&](std::int64_t a, std::int64_t b) { return std::llabs(a - *peak) < std::llabs(b - *peak); };
    const auto nearest = std::min_element(times.begin(), times.end(), nearer);
    chosen.insert(static_cast<std::size_t>(nearest - times.begin()));
  }
  const std::size_t gaps = std::min(with_peak ? most - 1 : most, times.size()) - 1;
  for (std::size_t i = 0; i <= gaps; ++i) chosen.insert(gaps == 0 ? last : (2 * i * last + gaps) / (2 * gaps));
  return chosen;
}

void write_outline(const std::string& path, const visualization_msgs::Marker& marker) {
  const mpm::Pose pose = from_message(marker.pose);
  std::ofstream file(path, std::ios::trunc);
  file << "# " << marker.header.frame_id << ": triangles in the body's own frame [m]\n";
  file << "o " << marker.header.frame_id << "\n";
  std::map<std::array<double, 3>, std::size_t> known;
  fmt::memory_buffer faces;
  const std::size_t corners = marker.points.size() / 3 * 3;
  for (std::size_t corner = 0; corner < corners; ++corner) {
    const geometry_msgs::Point& point = marker.points[corner];
    const mpm::Vec3 vertex = pose.to_world({point.x, point.y, point.z});
    const auto [entry, fresh] =
        known.emplace(std::array<double, 3>{vertex.x(), vertex.y(), vertex.z()}, known.size() + 1);
    if (fresh) file << fmt::format("v {} {} {}\n", vertex.x(), vertex.y(), vertex.z());
    fmt::format_to(std::back_inserter(faces), "{}{}", corner % 3 == 0 ? "f " : " ", entry->second);
    if (corner % 3 == 2) faces.push_back('\n');
  }
  file.write(faces.data(), static_cast<std::streamsize>(faces.size()));
  file.close();
  if (!file) throw CsvError(path + ": cannot be written; check the folder and the space on its disk");
}

}  // namespace mpm_ros
