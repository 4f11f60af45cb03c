#include "mpm_ros/run/bag_recorder.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <ros/message_traits.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "mpm_ros/message/topics.hpp"

namespace mpm_ros {

namespace {

rosbag::CompressionType compression(const std::string& name) {
  if (name == "none") return rosbag::compression::Uncompressed;
  if (name == "lz4") return rosbag::compression::LZ4;
  if (name == "bz2") return rosbag::compression::BZ2;
  throw BagError(fmt::format("there is no bag compression '{}'; use none, lz4 or bz2", name));
}

/// Topics that players should offer to late subscribers too.
bool is_latched(const std::string& topic) { return topic == topics::kRunInfo || topic == topics::kMarkers; }

template <typename Message>
boost::shared_ptr<ros::M_string> latched_header(const std::string& topic) {
  auto header = boost::make_shared<ros::M_string>();
  (*header)["topic"] = topic;
  (*header)["type"] = ros::message_traits::datatype<Message>();
  (*header)["md5sum"] = ros::message_traits::md5sum<Message>();
  (*header)["message_definition"] = ros::message_traits::definition<Message>();
  (*header)["latching"] = "1";
  return header;
}

}  // namespace

BagRecorder::BagRecorder(const std::string& path, const BagOptions& options)
    : path_(path), prefix_(options.topics_below) {
  if (prefix_.empty() || prefix_.front() != '/') prefix_.insert(prefix_.begin(), '/');
  if (prefix_.back() != '/') prefix_.push_back('/');
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  if (!std::filesystem::is_directory(folder)) {
    throw BagError(
        fmt::format("bag {}: there is no folder {}; create it or choose another path", path, folder.string()));
  }
  if (access(folder.c_str(), W_OK) != 0) {
    throw BagError(fmt::format("bag {}: the folder {} is not writable; choose another path", path, folder.string()));
  }
  try {
    bag_.open(path, rosbag::bagmode::Write);
    bag_.setCompression(compression(options.compression));
  } catch (const rosbag::BagException& error) {
    throw BagError(fmt::format("bag {} cannot be written: {}", path, error.what()));
  }
}

BagRecorder::~BagRecorder() {
  try {
    close();
  } catch (const BagError&) {
    // Nothing is left to be done about it here; callers that want to know call close() themselves.
  }
}

void BagRecorder::close() {
  if (!bag_.isOpen()) return;
  try {
    bag_.close();
  } catch (const rosbag::BagException& error) {
    throw BagError(fmt::format("bag {} could not be closed: {}", path_, error.what()));
  }
}

std::string BagRecorder::resolve(const std::string& topic) const {
  return topic.front() == '/' ? topic : prefix_ + topic;
}

template <typename Message>
void BagRecorder::write(const std::string& topic, const ros::Time& stamp, const Message& message) {
  const std::string name = resolve(topic);
  try {
    if (is_latched(topic)) {
      bag_.write(name, stamp, message, latched_header<Message>(name));
    } else {
      bag_.write(name, stamp, message);
    }
  } catch (const rosbag::BagException& error) {
    throw BagError(fmt::format("bag {}: {} could not be written: {}; is the disk full?", path_, name, error.what()));
  }
}

void BagRecorder::put(const std::string& topic, const ros::Time& stamp, const RunInfo& message) {
  write(topic, stamp, message);
}
void BagRecorder::put(const std::string& topic, const ros::Time& stamp,
                      const visualization_msgs::MarkerArray& message) {
  write(topic, stamp, message);
}
void BagRecorder::put(const std::string& topic, const ros::Time& stamp, const ContactForces& message) {
  write(topic, stamp, message);
}
void BagRecorder::put(const std::string& topic, const ros::Time& stamp, const geometry_msgs::WrenchStamped& message) {
  write(topic, stamp, message);
}
void BagRecorder::put(const std::string& topic, const ros::Time& stamp, const BodyStates& message) {
  write(topic, stamp, message);
}
void BagRecorder::put(const std::string& topic, const ros::Time& stamp, const SolverState& message) {
  write(topic, stamp, message);
}
void BagRecorder::put(const std::string& topic, const ros::Time& stamp, const GlobalQuantities& message) {
  write(topic, stamp, message);
}
void BagRecorder::put(const std::string& topic, const ros::Time& stamp, const tf2_msgs::TFMessage& message) {
  write(topic, stamp, message);
}
void BagRecorder::put(const std::string& topic, const ros::Time& stamp, const sensor_msgs::PointCloud2& message) {
  write(topic, stamp, message);
}
void BagRecorder::put(const std::string& topic, const ros::Time& stamp, const Command& message) {
  write(topic, stamp, message);
}

std::string bag_path(const std::string& path, const std::string& scene, int run) {
  std::string result = path;
  if (path == "auto") {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    result = fmt::format("./mpm_{}_{:%Y-%m-%d-%H-%M-%S}.bag", scene, fmt::localtime(now));
  }
  if (run <= 1) return result;
  const std::filesystem::path whole(result);
  return (whole.parent_path() / fmt::format("{}_{}{}", whole.stem().string(), run, whole.extension().string()))
      .string();
}

}  // namespace mpm_ros
