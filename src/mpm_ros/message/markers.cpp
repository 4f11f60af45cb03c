#include "mpm_ros/message/markers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "mpm_ros/message/conversions.hpp"

namespace mpm_ros {

namespace {

std_msgs::ColorRGBA color(float red, float green, float blue, float alpha) {
  std_msgs::ColorRGBA value;
  value.r = red;
  value.g = green;
  value.b = blue;
  value.a = alpha;
  return value;
}

/// Colour of a face of a rigid body: seen through, since material and contact lie behind; lighter or darker by where it
/// faces, but in no light so dark as to be lost on RViz's dark background.
std_msgs::ColorRGBA face_color(const std::array<mpm::Vec3, 3>& triangle) {
  const mpm::Vec3 light = mpm::Vec3(0.35, -0.45, 0.8).normalized();
  const mpm::Vec3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
  const auto shade = static_cast<float>(0.7 + 0.3 * normal.dot(light));
  return color(0.80F * shade, 0.85F * shade, 0.92F * shade, 0.5F);
}

constexpr double kCrackWidth = 0.004;  ///< part of a crack's length

}  // namespace

visualization_msgs::MarkerArray crack_markers(const std::vector<mpm::CrackReport>& cracks,
                                              const std::string& world_frame, const ros::Time& stamp) {
  visualization_msgs::MarkerArray markers;
  int id = 0;
  for (const mpm::CrackReport& crack : cracks) {
    for (const std::vector<mpm::Vec3>* face : {&crack.above, &crack.below}) {
      visualization_msgs::Marker marker;
      marker.header.frame_id = world_frame;
      marker.header.stamp = stamp;
      marker.ns = "crack/" + crack.name;
      marker.id = id++;
      marker.type = visualization_msgs::Marker::LINE_STRIP;
      marker.pose.orientation.w = 1.0;
      marker.scale.x = kCrackWidth * crack.length;
      marker.color = color(0.95F, 0.15F, 0.10F, 1.0F);
      for (const mpm::Vec3& place : *face) {
        geometry_msgs::Point point;
        point.x = place.x();
        point.y = place.y();
        point.z = place.z();
        marker.points.push_back(point);
      }
      markers.markers.push_back(marker);
    }
  }
  return markers;
}

visualization_msgs::MarkerArray shape_markers(const mpm::Simulation& simulation) {
  visualization_msgs::MarkerArray markers;
  // Bodies are endless along axes that the scene does not have: drawn as slices of a cell, so that they do not hide the
  // material. In an axisymmetric scene they are drawn whole, round the plane of the material.
  const mpm::GeometryKind geometry = simulation.definition().geometry;
  const std::vector<int> beside = mpm::axisymmetric(geometry) ? std::vector<int>() : mpm::axes_beside(geometry);
  const double half_slice = 0.5 * simulation.definition().grid.cell.x();
  const int count = static_cast<int>(simulation.bodies().size());
  for (int body = 0; body < count; ++body) {
    const mpm::RigidBody& rigid = simulation.rigid_body(body);
    visualization_msgs::Marker marker;
    // No stamp: RViz takes the frame where it is now. With one it drops the marker when it came later than that.
    marker.header.frame_id = rigid.name();
    marker.ns = "shape";
    marker.id = body;
    marker.type = visualization_msgs::Marker::TRIANGLE_LIST;
    marker.action = visualization_msgs::Marker::ADD;
    marker.pose.orientation.w = 1.0;
    marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
    marker.color = color(0.80F, 0.85F, 0.92F, 0.5F);
    marker.frame_locked = 1;
    for (const std::array<mpm::Vec3, 3>& triangle : rigid.surface().triangles()) {
      for (mpm::Vec3 vertex : triangle) {
        for (const int axis : beside) vertex[axis] = std::clamp(vertex[axis], -half_slice, half_slice);
        marker.points.push_back(to_point(vertex));
        marker.colors.push_back(face_color(triangle));
      }
    }
    markers.markers.push_back(std::move(marker));
  }
  return markers;
}

std::vector<double> tops_of(const mpm::Simulation& simulation) {
  std::vector<double> tops;
  for (int body = 0; body < static_cast<int>(simulation.bodies().size()); ++body) {
    const mpm::RigidBody& rigid = simulation.rigid_body(body);
    const mpm::Box bounds = rigid.surface().bounds();
    const mpm::Vec3 up = rigid.pose().orientation.conjugate() * mpm::Vec3::UnitZ();
    double top = rigid.pose().position.z();
    for (int k = 0; k < 3; ++k) {
      if (up[k] != 0.0) top += std::max(up[k] * bounds.min[k], up[k] * bounds.max[k]);
    }
    tops.push_back(top);
  }
  return tops;
}

std::string force_text(double newtons) {
  if (!std::isfinite(newtons) || newtons == 0.0) return fmt::format("{:g} N", newtons);
  // Rounded to three digits first: 999.6 N is 1.00 kN.
  const double rounded = std::stod(fmt::format("{:.2e}", newtons));
  constexpr std::array<const char*, 5> prefixes{"u", "m", "", "k", "M"};
  const int thousands = std::clamp(static_cast<int>(std::floor(std::log10(std::abs(rounded)) / 3.0 + 1e-9)), -2, 2);
  const double value = rounded / std::pow(1000.0, thousands);
  const int before_point = std::max(1, static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9)) + 1);
  return fmt::format("{:.{}f} {}N", value, std::max(0, 3 - before_point), prefixes[thousands + 2]);
}

visualization_msgs::MarkerArray ForceMarkers::markers(const std::vector<mpm::ContactReport>& contacts,
                                                      const std::string& world_frame, const ros::Time& stamp,
                                                      const std::vector<double>& tops) {
  using visualization_msgs::Marker;
  for (const mpm::ContactReport& contact : contacts) {
    largest_force_ = std::max(largest_force_, contact.mean.force.norm());
  }
  const double scale = scale_ > 0.0 ? scale_ : (largest_force_ > 0.0 ? longest_ / largest_force_ : 0.0);

  visualization_msgs::MarkerArray markers;
  for (std::size_t body = 0; body < contacts.size(); ++body) {
    const mpm::ContactReport& contact = contacts[body];
    const bool pressed = contact.centre_of_pressure().allFinite();
    const auto add = [&](const char* name, int type) -> Marker& {
      Marker marker;
      marker.header.frame_id = world_frame;
      marker.header.stamp = stamp;
      marker.ns = name;
      marker.id = static_cast<int>(body);
      marker.type = type;
      marker.action = pressed ? Marker::ADD : Marker::DELETE;
      marker.pose.orientation.w = 1.0;
      markers.markers.push_back(std::move(marker));
      return markers.markers.back();
    };
    const mpm::Vec3 foot = pressed ? contact.centre_of_pressure() : mpm::Vec3(mpm::Vec3::Zero());
    const mpm::Vec3 head = foot + scale * contact.mean.force;

    Marker& arrow = add("contact_force", Marker::ARROW);
    arrow.points = {to_point(foot), to_point(head)};
    arrow.scale.x = 0.05 * longest_;  // shaft
    arrow.scale.y = 0.12 * longest_;  // head
    arrow.color = color(0.85F, 0.15F, 0.10F, 1.0F);

    Marker& ball = add("centre_of_pressure", Marker::SPHERE);
    ball.pose.position = to_point(foot);
    ball.scale.x = ball.scale.y = ball.scale.z = 0.12 * longest_;
    ball.color = color(0.98F, 0.80F, 0.10F, 1.0F);

    Marker& text = add("contact_force_size", Marker::TEXT_VIEW_FACING);
    mpm::Vec3 place = head;
    // A body that reaches far beyond the picture leaves the size at the head.
    if (body < tops.size() && tops[body] < head.z() + 2.0 * longest_) place.z() = std::max(place.z(), tops[body]);
    place.z() += 0.15 * longest_;
    if (place.z() > ceiling_) {  // beside the arrow, which would cover it
      place.z() = std::max(ceiling_, foot.z());
      place.x() += 0.6 * longest_;
    }
    text.pose.position = to_point(place);
    text.scale.z = 0.15 * longest_;
    text.color = color(1.0F, 1.0F, 1.0F, 1.0F);
    text.text = contact.body + " " + force_text(contact.mean.force.norm());
  }
  return markers;
}

}  // namespace mpm_ros
