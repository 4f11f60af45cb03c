#include "mpm_ros/record/run_scene_vtk.hpp"

#include <fmt/format.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <filesystem>

#include "mpm/math/output_file.hpp"
#include "mpm/ranks/agree.hpp"
#include "mpm_ros/csv/csv_writer.hpp"
#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/topics.hpp"
#include "mpm_ros/record/crack_lines.hpp"

namespace mpm_ros {
namespace {

constexpr const char* kParticleFiles = "particles";
constexpr const char* kListEnd = "</Collection>\n</VTKFile>\n";

template <typename Value>
std::vector<Value> column(const sensor_msgs::PointCloud2& cloud, const std::string& name) {
  std::vector<Value> values;
  values.reserve(cloud.width * cloud.height);
  for (sensor_msgs::PointCloud2ConstIterator<Value> value(cloud, name); value != value.end(); ++value) {
    values.push_back(*value);
  }
  return values;
}

template <typename Value>
std::vector<Value> points_of(const sensor_msgs::PointCloud2& cloud) {
  std::vector<Value> points;
  points.reserve(3UL * cloud.width * cloud.height);
  sensor_msgs::PointCloud2ConstIterator<Value> x(cloud, "x"), y(cloud, "y"), z(cloud, "z");
  for (; x != x.end(); ++x, ++y, ++z) points.insert(points.end(), {*x, *y, *z});
  return points;
}

/// `fine`: places are float64.
VtkFile particle_file(double time, const sensor_msgs::PointCloud2& cloud, bool fine) {
  VtkFile file = fine ? VtkFile(time, points_of<double>(cloud), true) : VtkFile(time, points_of<float>(cloud));
  file.draw_points();
  for (const sensor_msgs::PointField& field : cloud.fields) {
    if (field.name == "x" || field.name == "y" || field.name == "z") continue;
    if (field.datatype == sensor_msgs::PointField::UINT32) {
      file.add(field.name, column<std::uint32_t>(cloud, field.name));
    } else if (field.datatype == sensor_msgs::PointField::FLOAT64) {
      file.add(field.name, column<double>(cloud, field.name));
    } else {
      file.add(field.name, column<float>(cloud, field.name));
    }
  }
  return file;
}

std::string piece_name(int count, int rank) { return fmt::format("{}_{:04}_{}.vtp", kParticleFiles, count, rank); }

}  // namespace

VtkSink::VtkSink(const std::string& folder, const Stamps& stamps, mpm::Communicator* ranks)
    : folder_(folder), stamps_(stamps), ranks_(ranks) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw VtkError(
        fmt::format("{}: the folder for ParaView cannot be made: {}; choose another", folder, error.message()));
  }
  if (!first()) return;
  if (const std::string problem = mpm::open_output(list_, folder + "/run.pvd"); !problem.empty())
    throw VtkError(fmt::format("{}/run.pvd: cannot be written: {}", folder, problem));
  list_ << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n" << kListEnd;
}

void VtkSink::close() {
  if (!first()) return;
  list_.close();
  if (!list_) throw VtkError(folder_ + "/run.pvd: cannot be written; check the space on its disk");
}

bool VtkSink::wants(const std::string& topic) const {
  if (!first()) return topic == topics::kParticles || topic == topics::kTfStatic;
  return topic == topics::kParticles || topic == topics::kTfStatic || topic == topics::kBodies ||
         topic == topics::kMarkers || topic == topics::kCracks;
}

void VtkSink::put(const std::string&, const ros::Time&, const visualization_msgs::MarkerArray& message) {
  shapes_ = message;
}

void VtkSink::put(const std::string&, const ros::Time&, const BodyStates& message) { bodies_ = message; }

void VtkSink::put(const std::string&, const ros::Time&, const tf2_msgs::TFMessage& message) {
  origins_ = origins_of(message);
}

void VtkSink::put(const std::string&, const ros::Time&, const Cracks& message) { cracks_ = message; }

void VtkSink::put(const std::string&, const ros::Time& stamp, const sensor_msgs::PointCloud2& message) {
  const double time = mpm::seconds_of(stamps_.time_of(stamp));
  const auto origin = origins_.find(message.header.frame_id);
  const bool fine = origin != origins_.end();
  const VtkFile file =
      fine ? particle_file(time, in_world(message, origin->second), true) : particle_file(time, message, false);
  if (ranks_ != nullptr) mpm::agree<VtkError>(ranks_, [&] { write_piece(file); });
  mpm::agree<VtkError>(ranks_, [&] {
    if (!first()) return;
    write_whole(file, time);
    write_bodies(time);
    write_cracks(time);
  });
  ++count_;
}

void VtkSink::write_piece(const VtkFile& file) const { file.write(folder_ + "/" + piece_name(count_, ranks_->rank())); }

void VtkSink::write_whole(const VtkFile& file, double time) {
  if (ranks_ == nullptr) return write(file, kParticleFiles, 0, time);
  std::vector<std::string> pieces;
  for (int rank = 0; rank < ranks_->size(); ++rank) pieces.push_back(piece_name(count_, rank));
  const std::string name = fmt::format("{}_{:04}.pvtp", kParticleFiles, count_);
  file.write_whole(folder_ + "/" + name, pieces);
  list(kParticleFiles, name, 0, time);
}

void VtkSink::write_bodies(double time) {
  int part = 0;
  for (const visualization_msgs::Marker& shape : shapes_.markers) {
    ++part;
    if (shape.type != visualization_msgs::Marker::TRIANGLE_LIST || shape.points.empty()) continue;
    for (const BodyState& body : bodies_.bodies) {
      if (body.name != shape.header.frame_id) continue;
      const mpm::Pose pose = from_message(body.pose);
      std::vector<double> points;
      points.reserve(3 * shape.points.size());
      for (const geometry_msgs::Point& point : shape.points) {
        const mpm::Vec3 place = pose.position + pose.orientation * mpm::Vec3(point.x, point.y, point.z);
        points.insert(points.end(), place.begin(), place.end());
      }
      VtkFile file(time, points, !origins_.empty());
      file.draw_triangles();
      write(file, "body_" + file_stem(body.name), part, time);
    }
  }
}

void VtkSink::write_cracks(double time) {
  if (!cracks_.cracks.empty()) write(crack_lines(time, cracks_, !origins_.empty()), "cracks", 0, time);
}

void VtkSink::write(const VtkFile& file, const std::string& stem, int part, double time) {
  const std::string name = fmt::format("{}_{:04}.vtp", stem, count_);
  file.write(folder_ + "/" + name);
  list(stem, name, part, time);
}

void VtkSink::list(const std::string& stem, const std::string& name, int part, double time) {
  list_.seekp(-static_cast<std::streamoff>(std::string(kListEnd).size()), std::ios::end);
  list_ << fmt::format("<DataSet timestep=\"{:.12g}\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n", time, part,
                       xml_text(stem), xml_text(name))
        << kListEnd << std::flush;
}

}  // namespace mpm_ros
