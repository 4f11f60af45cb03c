#include "mpm_ros/message/view.hpp"

#include <fmt/format.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "mpm/math/constants.hpp"
#include "mpm/transport/definition.hpp"

namespace mpm_ros {

namespace {

/// Distance of the eye over the radius of what is to be seen: RViz's field of view is 45 degrees high.
constexpr double kDistance = 2.4;
/// Distance right of the focus that the camera looks when a colour bar stands there, in radii of what is to be seen.
constexpr double kAside = 0.15;
/// Particles below this part of that radius are too small for their shape to be seen.
constexpr double kSmall = 0.01;

std::string choose_field(const sensor_msgs::PointCloud2& cloud, const std::string& wished) {
  std::vector<std::string> names;
  for (const sensor_msgs::PointField& field : cloud.fields) names.push_back(field.name);
  const auto there = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (there(wished)) return wished;
  const std::string first = names.size() > 4 ? names[4] : std::string();  // after x, y, z and id
  if (is_transported(first)) return first;                                // field that the scene is about
  for (const char* name : {"speed", "p"}) {
    if (there(name)) return name;
  }
  return first;
}

/// The usual distance of a particle from the one before it, which is its neighbour in the row it was laid in.
double spacing_of(const std::vector<mpm::Vec3>& points) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < points.size(); ++i) steps.push_back((points[i] - points[i - 1]).norm());
  if (steps.empty()) return View().particle_size;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

/// 1, 2 or 5 times a power of ten: the one below `size`.
double round_size(double size) {
  const double power = std::pow(10.0, std::floor(std::log10(size)));
  return power * (size >= 5.0 * power ? 5.0 : size >= 2.0 * power ? 2.0 : 1.0);
}

void set_point(YAML::Node node, const mpm::Vec3& point) {
  node["X"] = point.x();
  node["Y"] = point.y();
  node["Z"] = point.z();
}

void fit_particles(YAML::Node display, const View& view) {
  display["Size (m)"] = view.particle_size;
  if (view.planar && view.particle_size < kSmall * view.radius()) {
    // Without shades, which would change colours, and without gaps, which make patterns; RViz tilts large ones.
    display["Style"] = "Flat Squares";
    display["Size (m)"] = 1.25 * view.particle_size;
  }
  if (view.field.empty()) {
    display["Color Transformer"] = "FlatColor";
  } else if (!view.coloured.empty()) {
    display["Topic"] = view.coloured;
    display["Color Transformer"] = "RGB8";
    display["Name"] = "Colour: " + view.field;
  } else {
    display["Channel Name"] = view.field;
    display["Name"] = "Colour: " + view.field;
  }
}

YAML::Node bar_display(const std::string& topic) {
  YAML::Node display;
  display["Class"] = "rviz/MarkerArray";
  display["Name"] = "Colour bar";
  display["Enabled"] = true;
  display["Marker Topic"] = topic;
  display["Queue Size"] = 2;
  return display;
}

void fit_grid(YAML::Node display, const View& view) {
  const double cell = view.grid_cell();
  display["Cell Size"] = cell;
  display["Plane"] = view.planar ? "XZ" : "XY";
  mpm::Vec3 offset;
  for (int k = 0; k < 3; ++k) offset[k] = cell * std::round(view.focus[k] / cell);
  if (view.planar) {
    offset.y() = view.focus.y() + 0.05 * view.distance;
  } else {
    offset.z() = view.floor - 0.5 * view.particle_size;
  }
  set_point(display["Offset"], offset);
}

}  // namespace

bool is_transported(const std::string& field) {
  return std::any_of(std::begin(mpm::kTransported), std::end(mpm::kTransported),
                     [&](const mpm::TransportedTraits& of) { return of.name == field; });
}

double View::radius() const { return distance / kDistance; }

mpm::Vec3 View::right() const { return {-std::sin(yaw), std::cos(yaw), 0.0}; }

mpm::Vec3 View::up() const {
  return {-std::cos(yaw) * std::sin(pitch), -std::sin(yaw) * std::sin(pitch), std::cos(pitch)};
}

double View::grid_cell() const { return round_size(0.15 * distance); }

View view_of(const sensor_msgs::PointCloud2& cloud, const std::string& field, const mpm::Box& domain) {
  std::vector<mpm::Vec3> points;
  mpm::Box box;
  sensor_msgs::PointCloud2ConstIterator<float> x(cloud, "x"), y(cloud, "y"), z(cloud, "z");
  for (; x != x.end(); ++x, ++y, ++z) {
    const mpm::Vec3 point(*x, *y, *z);
    if (!point.allFinite()) continue;
    points.push_back(point);
    box.add(point);
  }
  View view;
  view.frame = cloud.header.frame_id;
  view.field = choose_field(cloud, field);
  if (points.empty()) return view;
  view.planar = box.size().y() == 0.0;
  mpm::Box seen = domain.empty() ? box : domain;
  if (view.planar) seen.min.y() = seen.max.y() = box.min.y();
  view.focus = seen.center();
  view.distance = kDistance * std::max(0.5 * seen.size().norm(), 1e-3);
  view.yaw = view.planar ? 1.5 * mpm::kPi : 4.5;
  view.pitch = view.planar ? 0.0 : 0.6;
  view.floor = box.min.z();
  view.particle_size = spacing_of(points);
  return view;
}

std::string with_view(const std::string& configuration, const View& view, const std::string& name_space) {
  try {
    YAML::Node root = YAML::Load(configuration);
    YAML::Node manager = root["Visualization Manager"];
    for (YAML::Node display : manager["Displays"]) {
      for (const char* key : {"Topic", "Marker Topic"}) {
        if (!display[key]) continue;
        const auto topic = display[key].as<std::string>();
        display[key] = name_space + topic.substr(topic.rfind('/') + 1);
      }
      const auto type = display["Class"].as<std::string>();
      if (type == "rviz/PointCloud2") fit_particles(display, view);
      if (type == "rviz/Grid") fit_grid(display, view);
      if (type == "rviz/TF") display["Marker Scale"] = 0.12 * view.distance;
    }
    // RViz reckons in float32 from the origin of this frame.
    if (!view.frame.empty()) manager["Global Options"]["Fixed Frame"] = view.frame;
    if (!view.bar.empty()) manager["Displays"].push_back(bar_display(view.bar));
    YAML::Node eye = manager["Views"]["Current"];
    eye["Distance"] = view.distance;
    eye["Yaw"] = view.yaw;
    eye["Pitch"] = view.pitch;
    const double aside = view.bar.empty() ? 0.0 : kAside * view.radius();
    set_point(eye["Focal Point"], view.focus + aside * view.right());
    return YAML::Dump(root);
  } catch (const YAML::Exception& error) {
    throw std::runtime_error(fmt::format("the RViz configuration cannot be used: {}", error.what()));
  }
}

}  // namespace mpm_ros
