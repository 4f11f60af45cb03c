#include "mpm_ros/message/particle_colours.hpp"

#include <fmt/format.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mpm/simulation/simulation.hpp"
#include "mpm_ros/message/conversions.hpp"

namespace mpm_ros {

namespace {

constexpr double kBeyond = 0.01;     ///< part of the values that lies beyond each end
constexpr double kNarrowing = 0.05;  ///< part of the way to a narrower range, each cloud
constexpr double kBarAt = 1.17;      ///< right of the view's focus, in radii of what it shows

using Rgb = std::array<double, 3>;

/// From light to dark, as in the pictures of bag_report; the darkest can be seen on RViz's dark background: red, green,
/// blue, 0 to 255, evenly spaced.
constexpr std::array<Rgb, 4> kScale = {{{255, 232, 120}, {246, 130, 62}, {190, 60, 92}, {92, 70, 120}}};

/// `part` of the range, 0 to 1.
Rgb colour_at(double part) {
  const double place = std::clamp(part, 0.0, 1.0) * (kScale.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kScale.size() - 2);
  Rgb mixed;
  for (std::size_t k = 0; k < mixed.size(); ++k) {
    mixed[k] = kScale[below][k] + (place - static_cast<double>(below)) * (kScale[below + 1][k] - kScale[below][k]);
  }
  return mixed;
}

std::string with_unit(const std::string& field) {
  for (const auto& [name, unit] : mpm::Simulation::particle_fields()) {
    if (name == field && !unit.empty() && unit != "1") return fmt::format("{} [{}]", field, unit);
  }
  return field;
}

/// Three digits, without an exponent unless the number is very large or small; 0 for what is nothing beside `range`.
std::string end_text(double value, double range) {
  if (value == 0.0 || std::abs(value) < 5e-4 * range) return "0";
  const double rounded = std::stod(fmt::format("{:.2e}", value));
  const int power = static_cast<int>(std::floor(std::log10(std::abs(rounded)) + 1e-9));
  if (power < -4 || power > 5) return fmt::format("{:.2e}", rounded);
  return fmt::format("{:.{}f}", rounded, std::max(0, 2 - power));
}

std_msgs::ColorRGBA as_colour(const Rgb& rgb) {
  std_msgs::ColorRGBA colour;
  colour.r = static_cast<float>(rgb[0] / 255.0);
  colour.g = static_cast<float>(rgb[1] / 255.0);
  colour.b = static_cast<float>(rgb[2] / 255.0);
  colour.a = 1.0F;
  return colour;
}

}  // namespace

void ParticleColours::widen(std::vector<float>& values) {
  values.erase(std::remove_if(values.begin(), values.end(), [](float v) { return !std::isfinite(v); }), values.end());
  if (values.empty()) return;
  const auto quantile = [&values](double part) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return static_cast<double>(*at);
  };
  double low = quantile(kBeyond);
  const double high = quantile(1.0 - kBeyond);
  if (low > 0.0 && low < 0.3 * high) low = 0.0;
  if (!begun_) {
    low_ = low;
    high_ = high;
    begun_ = true;
    return;
  }
  low_ = std::min(low, low_ + kNarrowing * (low - low_));
  high_ = std::max(high, high_ + kNarrowing * (high - high_));
}

const sensor_msgs::PointCloud2& ParticleColours::colour(const sensor_msgs::PointCloud2& cloud) {
  const std::size_t count = static_cast<std::size_t>(cloud.width) * cloud.height;
  const bool there = std::any_of(cloud.fields.begin(), cloud.fields.end(), [this](const auto& field) {
    return field.name == field_ && field.datatype == sensor_msgs::PointField::FLOAT32;
  });
  values_.clear();
  if (there) {
    sensor_msgs::PointCloud2ConstIterator<float> value(cloud, field_);
    for (; value != value.end(); ++value) values_.push_back(*value);
    widen(values_);
  }
  coloured_.header = cloud.header;
  sensor_msgs::PointCloud2Modifier modifier(coloured_);
  modifier.setPointCloud2FieldsByString(2, "xyz", "rgb");
  modifier.resize(count);
  if (count == 0) return coloured_;
  sensor_msgs::PointCloud2ConstIterator<float> x(cloud, "x"), y(cloud, "y"), z(cloud, "z");
  sensor_msgs::PointCloud2ConstIterator<float> value(cloud, there ? field_ : "x");
  sensor_msgs::PointCloud2Iterator<float> to(coloured_, "x");
  sensor_msgs::PointCloud2Iterator<std::uint8_t> paint(coloured_, "rgb");
  for (; x != x.end(); ++x, ++y, ++z, ++value, ++to, ++paint) {
    to[0] = *x;
    to[1] = *y;
    to[2] = *z;
    const bool known = there && high_ > low_ && std::isfinite(*value);
    const Rgb rgb = colour_at(known ? (*value - low_) / (high_ - low_) : 0.0);
    for (int k = 0; k < 3; ++k) paint[2 - k] = static_cast<std::uint8_t>(std::lround(rgb[k]));  // blue first
  }
  return coloured_;
}

visualization_msgs::MarkerArray ParticleColours::bar(const View& view, const std::string& frame) const {
  using visualization_msgs::Marker;
  const mpm::Vec3 right = view.right(), up = view.up();
  const double radius = view.radius(), height = radius;
  const mpm::Vec3 middle = view.focus + kBarAt * radius * right;
  visualization_msgs::MarkerArray markers;
  const auto add = [&](int type, const mpm::Vec3& place) -> Marker& {
    Marker marker;
    marker.header.frame_id = frame;
    marker.ns = "colour_bar";
    marker.id = static_cast<int>(markers.markers.size());
    marker.type = type;
    marker.pose.position = to_point(place);
    marker.pose.orientation.w = 1.0;
    marker.color.r = marker.color.g = marker.color.b = marker.color.a = 1.0F;
    markers.markers.push_back(std::move(marker));
    return markers.markers.back();
  };
  // Triangles whose corners have colours are not shaded, and blend them as colour_at() does.
  Marker& scale = add(Marker::TRIANGLE_LIST, middle);
  scale.scale.x = scale.scale.y = scale.scale.z = 1.0;
  for (std::size_t i = 0; i + 1 < kScale.size(); ++i) {
    const auto corner = [&](double side, std::size_t end) {
      const double part = static_cast<double>(end) / (kScale.size() - 1);
      scale.points.push_back(to_point(mpm::Vec3(0.03 * side * radius * right + (part - 0.5) * height * up)));
      scale.colors.push_back(as_colour(kScale[end]));
    };
    corner(-1.0, i);
    corner(1.0, i);
    corner(1.0, i + 1);
    corner(-1.0, i);
    corner(1.0, i + 1);
    corner(-1.0, i + 1);
  }
  const auto write = [&](double place, const std::string& words) {
    Marker& text = add(Marker::TEXT_VIEW_FACING, middle + place * height * up);
    text.scale.z = 0.07 * radius;
    text.text = words;
  };
  write(0.66, with_unit(field_));
  write(0.55, end_text(high_, high_ - low_));
  write(-0.55, end_text(low_, high_ - low_));
  write(-0.70, fmt::format("grid {:g} m", view.grid_cell()));
  return markers;
}

}  // namespace mpm_ros
