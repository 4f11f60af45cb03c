// Markers of contact and of shapes for RViz.
#include "mpm_ros/message/markers.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mpm/scene/scene.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace markers_test {

using visualization_msgs::Marker;

TEST(ForceText, HasThreeDigitsAndAPrefix) {
  EXPECT_EQ(force_text(537.2), "537 N");
  EXPECT_EQ(force_text(53.72), "53.7 N");
  EXPECT_EQ(force_text(1.0), "1.00 N");
  EXPECT_EQ(force_text(1000.0), "1.00 kN");
  EXPECT_EQ(force_text(999.6), "1.00 kN");  // rounded before the choice of a prefix
  EXPECT_EQ(force_text(12345.0), "12.3 kN");
  EXPECT_EQ(force_text(2.5e6), "2.50 MN");
  EXPECT_EQ(force_text(0.035), "35.0 mN");
  EXPECT_EQ(force_text(4.2e-5), "42.0 uN");
  EXPECT_EQ(force_text(0.0), "0 N");
}

mpm::ContactReport contact() {
  mpm::ContactReport report;
  report.body = "blade";
  report.mean.force = {30.0, 0.0, 40.0};
  report.pressing = 50.0;
  report.origin = {1.0, 0.0, 0.0};
  report.arm = {0.0, 2.0, 0.0};
  return report;
}

TEST(ForceMarkers, ArrowBallAndSizeAtTheCentreOfPressure) {
  ForceMarkers markers(0.1, 1.0);
  const visualization_msgs::MarkerArray array = markers.markers({contact()}, "world", ros::Time(3, 0));
  ASSERT_EQ(array.markers.size(), 3U);
  const Marker &arrow = array.markers[0], &ball = array.markers[1], &text = array.markers[2];
  for (const Marker& marker : array.markers) {
    EXPECT_EQ(marker.action, Marker::ADD);
    EXPECT_EQ(marker.header.frame_id, "world");
    EXPECT_EQ(marker.header.stamp, ros::Time(3, 0));
  }
  EXPECT_EQ(arrow.type, Marker::ARROW);
  ASSERT_EQ(arrow.points.size(), 2U);
  EXPECT_EQ(arrow.points[0].x, 1.0);
  EXPECT_EQ(arrow.points[0].y, 2.0);
  EXPECT_DOUBLE_EQ(arrow.points[1].x, 1.0 + 0.1 * 30.0);
  EXPECT_DOUBLE_EQ(arrow.points[1].z, 0.1 * 40.0);
  EXPECT_EQ(ball.type, Marker::SPHERE);
  EXPECT_EQ(ball.pose.position.y, 2.0);
  EXPECT_EQ(text.type, Marker::TEXT_VIEW_FACING);
  EXPECT_EQ(text.text, "blade 50.0 N");
}

TEST(ForceMarkers, TheSizeStandsAboveTheTool) {
  ForceMarkers markers(0.1, 1.0);
  const auto height = [&](double top) {
    return markers.markers({contact()}, "world", ros::Time(), {top}).markers[2].pose.position.z;
  };
  // The arrow's head is at 0.1 m/N x 40 N, the text 0.15 arrow lengths above it or the tool.
  EXPECT_DOUBLE_EQ(height(2.0), 4.15);
  EXPECT_DOUBLE_EQ(height(5.0), 5.15);
  EXPECT_DOUBLE_EQ(height(100.0), 4.15);  // out of the picture
}

TEST(ForceMarkers, TheSizeStaysBelowTheTopOfTheDomain) {
  const auto place = [](double ceiling) {
    return ForceMarkers(0.1, 1.0, ceiling).markers({contact()}, "world", ros::Time()).markers[2].pose.position;
  };
  EXPECT_DOUBLE_EQ(place(5.0).z, 4.15);
  EXPECT_DOUBLE_EQ(place(5.0).x, 4.0);  // place of the arrow's head
  EXPECT_DOUBLE_EQ(place(3.0).z, 3.0);
  EXPECT_GT(place(3.0).x, 4.5);  // beside it
}

TEST(ForceMarkers, TheLargestForceMetIsDrawnAsLongAsItMayBe) {
  ForceMarkers markers(0.0, 0.5);
  const auto length = [&](const mpm::ContactReport& report) {
    const Marker arrow = markers.markers({report}, "world", ros::Time()).markers[0];
    return std::hypot(arrow.points[1].x - arrow.points[0].x, arrow.points[1].z - arrow.points[0].z);
  };
  EXPECT_DOUBLE_EQ(length(contact()), 0.5);
  mpm::ContactReport half = contact();
  half.mean.force /= 2.0;
  EXPECT_DOUBLE_EQ(length(half), 0.25);
}

TEST(ForceMarkers, AllGoWhenTheContactEnds) {
  ForceMarkers markers(0.0, 1.0);
  const visualization_msgs::MarkerArray there = markers.markers({contact()}, "world", ros::Time());
  const visualization_msgs::MarkerArray gone = markers.markers({mpm::ContactReport()}, "world", ros::Time());
  ASSERT_EQ(gone.markers.size(), there.markers.size());
  for (std::size_t i = 0; i < gone.markers.size(); ++i) {
    EXPECT_EQ(gone.markers[i].action, Marker::DELETE);
    EXPECT_EQ(gone.markers[i].ns, there.markers[i].ns);  // namespace and number identify a marker
    EXPECT_EQ(gone.markers[i].id, there.markers[i].id);
    // RViz refuses markers that are not finite, whatever their action.
    EXPECT_TRUE(std::isfinite(gone.markers[i].pose.position.x));
  }
}

TEST(ShapeMarkers, KnowTheTopsOfTilted) {
  // The plate, 0.04 m high at 0.065 m, and the rod, a disc of 15 mm at 0.1 m; then the plate, 0.14 m long, upright.
  const mpm::Scene scene = mpm::load_scene(data_file("press.yaml"));
  const std::vector<double> tops = tops_of(mpm::Simulation(mpm::build(scene), {1}));
  ASSERT_EQ(tops.size(), 2U);
  EXPECT_NEAR(tops[0], 0.085, 1e-12);
  EXPECT_NEAR(tops[1], 0.115, 1e-12);
  const mpm::Scene turned =
      mpm::load_scene(data_file("press.yaml"), {"rigid_bodies.plate.pose={position: [0.1, 0.2], rpy: [0, 90 deg, 0]}"});
  EXPECT_NEAR(tops_of(mpm::Simulation(mpm::build(turned), {1}))[0], 0.27, 1e-12);
}

TEST(ShapeMarkers, PlanarBodiesAreSlices) {
  const mpm::Scene scene = mpm::load_scene(data_file("press.yaml"));
  const mpm::Simulation simulation(mpm::build(scene), {1});
  const visualization_msgs::MarkerArray array = shape_markers(simulation);
  ASSERT_EQ(array.markers.size(), 2U);
  for (const Marker& marker : array.markers) {
    ASSERT_FALSE(marker.points.empty());
    // The shape is as thick as a cell, 0.01 m.
    for (const geometry_msgs::Point& point : marker.points) EXPECT_LE(std::abs(point.y), 0.005);
    ASSERT_EQ(marker.colors.size(), marker.points.size());  // otherwise RViz ignores them
    for (const std_msgs::ColorRGBA& color : marker.colors) {
      EXPECT_EQ(color.a, 0.5F);
      EXPECT_GT(color.g, 0.3F);  // twice the background's 43 / 255 at least, whichever way the face looks
    }
  }
  EXPECT_EQ(array.markers[0].header.frame_id, "plate");
  EXPECT_EQ(std::abs(array.markers[0].points[0].y), 0.005);
}

}  // namespace markers_test
}  // namespace mpm_ros
