#include "mpm_ros/message/markers.hpp"

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

/// Infinite edges of planar bodies are drawn this far from the origin [m].
constexpr double kFarAway = 1.0;

geometry_msgs::Point drawable(const mpm::Vec3& vertex) {
  mpm::Vec3 point = vertex;
  for (double& component : point) {
    if (!std::isfinite(component)) component = std::signbit(component) ? -kFarAway : kFarAway;
  }
  return to_point(point);
}

}  // namespace

visualization_msgs::MarkerArray shape_markers(const mpm::Simulation& simulation) {
  visualization_msgs::MarkerArray markers;
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
    marker.color = color(0.55F, 0.60F, 0.66F, 1.0F);
    marker.frame_locked = 1;
    for (const std::array<mpm::Vec3, 3>& triangle : rigid.surface().triangles()) {
      for (const mpm::Vec3& vertex : triangle) marker.points.push_back(drawable(vertex));
    }
    markers.markers.push_back(std::move(marker));
  }
  return markers;
}

visualization_msgs::MarkerArray ForceMarkers::arrows(const std::vector<mpm::ContactReport>& contacts,
                                                     const std::vector<mpm::BodyState>& bodies,
                                                     const std::string& world_frame, const ros::Time& stamp) {
  for (const mpm::ContactReport& contact : contacts) {
    largest_force_ = std::max(largest_force_, contact.mean.force.norm());
  }
  const double scale = scale_ > 0.0 ? scale_ : (largest_force_ > 0.0 ? longest_ / largest_force_ : 0.0);

  visualization_msgs::MarkerArray markers;
  for (std::size_t body = 0; body < contacts.size(); ++body) {
    const mpm::Vec3 arrow = scale * contacts[body].mean.force;
    visualization_msgs::Marker marker;
    marker.header.frame_id = world_frame;
    marker.header.stamp = stamp;
    marker.ns = "contact_force";
    marker.id = static_cast<int>(body);
    marker.type = visualization_msgs::Marker::ARROW;
    marker.action = arrow.isZero() ? visualization_msgs::Marker::DELETE : visualization_msgs::Marker::ADD;
    marker.pose.orientation.w = 1.0;
    marker.points = {to_point(bodies[body].pose.position), to_point(bodies[body].pose.position + arrow)};
    marker.scale.x = 0.03 * longest_;  // shaft
    marker.scale.y = 0.08 * longest_;  // head
    marker.color = color(0.85F, 0.15F, 0.10F, 1.0F);
    markers.markers.push_back(std::move(marker));
  }
  return markers;
}

}  // namespace mpm_ros
