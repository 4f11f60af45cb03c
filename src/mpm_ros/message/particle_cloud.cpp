#include "mpm_ros/message/particle_cloud.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "mpm/math/nearest.hpp"
#include "mpm_ros/message/local_frame.hpp"

namespace mpm_ros {

namespace {

const char* const kPosition[] = {"x", "y", "z"};
constexpr std::uint32_t kScalar = 4;  // bytes of a float32 and of a uint32

void add_field(sensor_msgs::PointCloud2& cloud, const std::string& name, std::uint8_t type) {
  sensor_msgs::PointField field;
  field.name = name;
  field.offset = kScalar * static_cast<std::uint32_t>(cloud.fields.size());
  field.datatype = type;
  field.count = 1;
  cloud.fields.push_back(field);
}

}  // namespace

std::string problem_of(const ParticleSelection& selection) {
  const mpm::ParticleChoice& choice = selection.choice;
  if (choice.stride < 1) return fmt::format("the particle stride is {}; it must be 1 or more", choice.stride);
  if (choice.region && choice.region->empty()) {
    return "the particle region is empty: a maximum is below its minimum; write xmin, ymin, zmin, xmax, ymax, zmax";
  }
  std::vector<std::string> known;
  for (const auto& [name, unit] : mpm::Simulation::particle_fields()) known.push_back(name);
  for (const std::string& field : selection.fields) {
    if (std::find(known.begin(), known.end(), field) == known.end()) {
      return fmt::format("there is no particle field '{}'; {}", field, mpm::suggest(field, known));
    }
    if (std::count(selection.fields.begin(), selection.fields.end(), field) > 1) {
      return fmt::format("particle field '{}' is named twice", field);
    }
    if (std::count(std::begin(kPosition), std::end(kPosition), field) > 0) {
      return fmt::format("particle field '{}' is always written; leave it out", field);
    }
  }
  return {};
}

void fill_cloud(const std::vector<std::string>& fields, const mpm::ParticleColumns& columns,
                sensor_msgs::PointCloud2& cloud) {
  cloud.fields.clear();
  for (const char* name : kPosition) add_field(cloud, name, sensor_msgs::PointField::FLOAT32);
  add_field(cloud, "id", sensor_msgs::PointField::UINT32);
  for (const std::string& name : fields) add_field(cloud, name, sensor_msgs::PointField::FLOAT32);

  const std::size_t points = columns.ids.size();
  const std::size_t point_step = kScalar * cloud.fields.size();
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(points);
  cloud.is_bigendian = 0;
  cloud.is_dense = 1;
  cloud.point_step = static_cast<std::uint32_t>(point_step);
  cloud.row_step = static_cast<std::uint32_t>(point_step * points);
  cloud.data.resize(point_step * points);

  std::uint8_t* out = cloud.data.data();
  for (std::size_t point = 0; point < points; ++point) {
    for (std::size_t column = 0; column < 3 + fields.size(); ++column) {
      // The id stands between the position and the other fields.
      const std::size_t slot = column < 3 ? column : column + 1;
      std::memcpy(out + kScalar * slot, &columns.values[column][point], kScalar);
    }
    std::memcpy(out + kScalar * 3, &columns.ids[point], kScalar);
    out += point_step;
  }
}

ParticleCloud::ParticleCloud(ParticleSelection selection)
    : selection_(std::move(selection)), names_(std::begin(kPosition), std::end(kPosition)) {
  names_.insert(names_.end(), selection_.fields.begin(), selection_.fields.end());
  const std::size_t written = names_.size();
  for (std::size_t column = 0; column < written && selection_.origin != mpm::Vec3::Zero(); ++column) {
    const std::string name = names_[column];
    if (!is_place(name)) continue;
    places_.push_back({column, names_.size(), selection_.origin[name.front() - 'x']});
    names_.push_back(name + " rest");
  }
}

void ParticleCloud::move_places() {
  for (const Place& place : places_) {
    std::vector<float>& values = columns_.values[place.column];
    const std::vector<float>& rests = columns_.values[place.rest];
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double whole = static_cast<double>(values[i]) + static_cast<double>(rests[i]);
      values[i] = static_cast<float>(whole - place.origin);
    }
  }
}

const sensor_msgs::PointCloud2& ParticleCloud::read(const mpm::Simulation& simulation) {
  simulation.read_particles(names_, selection_.choice, columns_);
  move_places();
  fill_cloud(selection_.fields, columns_, cloud_);
  return cloud_;
}

const sensor_msgs::PointCloud2& ParticleCloud::read_own(const mpm::Simulation& simulation) {
  simulation.read_own_particles(names_, selection_.choice, columns_);
  move_places();
  fill_cloud(selection_.fields, columns_, cloud_);
  return cloud_;
}

}  // namespace mpm_ros
