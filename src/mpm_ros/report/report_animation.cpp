#include "mpm_ros/report/report_animation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "mpm/math/json_text.hpp"
#include "mpm/math/nanoseconds.hpp"
#include "mpm_ros/message/view.hpp"
#include "mpm_ros/report/report_cloud.hpp"
#include "mpm_ros/report/report_error.hpp"
#include "mpm_ros/report/report_messages.hpp"
#include "mpm_ros/report/report_plots.hpp"

namespace mpm_ros {
namespace {

constexpr std::size_t kSample = 200000;  // values kept at most, for a range

bool is_coordinate(const std::string& field) { return field == "x" || field == "y" || field == "z" || field == "id"; }

}  // namespace

std::string choose_field(const std::vector<std::string>& recorded, const std::string& wanted) {
  std::vector<std::string> fields;
  for (const std::string& field : recorded) {
    if (!is_coordinate(field)) fields.push_back(field);
  }
  const auto has = [&fields](const std::string& name) {
    return std::find(fields.begin(), fields.end(), name) != fields.end();
  };
  if (!wanted.empty()) {
    if (has(wanted)) return wanted;
    throw ReportError(fmt::format("--field {}: not recorded; there {}: {}", wanted, fields.size() == 1 ? "is" : "are",
                                  fields.empty() ? "none" : fmt::format("{}", fmt::join(fields, ", "))));
  }
  if (!fields.empty() && is_transported(fields.front())) return fields.front();
  for (const char* telling : {"speed", "ep", "mises", "p"}) {
    if (has(telling)) return telling;
  }
  return fields.empty() ? "z" : fields.front();
}

void FieldRange::particles(std::int64_t /*time*/, const sensor_msgs::PointCloud2& message) {
  const CloudField x(message, "x"), y(message, "y"), z(message, "z"), values(message, field_);
  if (!x.found() || !y.found() || !z.found() || !values.found()) return;
  for (std::size_t i = 0; i < values.size(); ++i) {
    box_.add({x.at(i), y.at(i), z.at(i)});
    if (counted_++ % stride_ != 0) continue;
    sample_.push_back(static_cast<float>(values.at(i)));
    if (sample_.size() < kSample) continue;
    for (std::size_t kept = 0; kept < kSample / 2; ++kept) sample_[kept] = sample_[2 * kept];
    sample_.resize(kSample / 2);
    stride_ *= 2;
  }
}

double FieldRange::quantile(double part) const {
  std::vector<float> sorted = sample_;
  sorted.erase(std::remove_if(sorted.begin(), sorted.end(), [](float value) { return !std::isfinite(value); }),
               sorted.end());
  if (sorted.empty()) return 0.0;
  const auto place = static_cast<std::ptrdiff_t>(part * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), sorted.begin() + place, sorted.end());
  return sorted[static_cast<std::size_t>(place)];
}

Animation::Animation(const std::string& csv, const std::string& file, const FieldRange& range, std::size_t frames)
    : field_(range.field()),
      corner_(range.box().min),
      script_({plot_script(), csv, "--animate=" + file}, {true, false}) {
  const auto corner = [](const mpm::Vec3& point) { return std::vector<double>{point.x(), point.y(), point.z()}; };
  const nlohmann::json head = {{"frames", frames},
                               {"field", field_},
                               {"unit", unit_of_field(field_)},
                               {"low", range.quantile(0.005)},
                               {"high", range.quantile(0.995)},
                               {"min", corner(range.box().min)},
                               {"max", corner(range.box().max)}};
  const std::string line = mpm::json_text(head) + "\n";
  send(line.data(), line.size());
}

void Animation::particles(std::int64_t time, const sensor_msgs::PointCloud2& message) {
  const CloudField x(message, "x"), y(message, "y"), z(message, "z"), values(message, field_);
  if (!x.found() || !y.found() || !z.found() || !values.found()) {
    throw ReportError(fmt::format("the particle snapshot at {} s has no x, y, z and {}, as the others have",
                                  mpm::nearest_seconds(time), field_));
  }
  rows_.resize(values.size());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const mpm::Vec3 place = mpm::Vec3(x.at(i), y.at(i), z.at(i)) - corner_;  // place that float32 holds anywhere
    rows_[i] = {static_cast<float>(place.x()), static_cast<float>(place.y()), static_cast<float>(place.z()),
                static_cast<float>(values.at(i))};
  }
  const double now = mpm::nearest_seconds(time);
  const std::uint64_t count = rows_.size();
  send(&now, sizeof now);
  send(&count, sizeof count);
  send(rows_.data(), rows_.size() * sizeof rows_[0]);
}

void Animation::send(const void* data, std::size_t bytes) {
  if (script_.write(data, bytes)) return;
  close();
  throw ReportError("the animation could not be made: the script stopped reading");
}

void Animation::close() {
  if (script_.finish() != 0) throw ReportError("the animation could not be made; the script's own message is above");
}

}  // namespace mpm_ros
