#include "mpm_ros/record/bag_recorder.hpp"

#include <fmt/format.h>
#include <ros/message_traits.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "mpm/math/output_file.hpp"
#include "mpm_ros/message/bag_parts.hpp"
#include "mpm_ros/message/topics.hpp"
#include "mpm_ros/record/output_names.hpp"

namespace mpm_ros {

namespace {

constexpr std::uint32_t kChunkBytes = 768 * 1024;  // rosbag's own

rosbag::CompressionType compression(const std::string& name) {
  if (name == "none") return rosbag::compression::Uncompressed;
  if (name == "lz4") return rosbag::compression::LZ4;
  if (name == "bz2") return rosbag::compression::BZ2;
  throw BagError(fmt::format("there is no bag compression '{}'; use none, lz4 or bz2", name));
}

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

using FileNumber = std::pair<std::uint64_t, std::uint64_t>;

/// Device and number of the file of that name; none, with errno, where it cannot be looked at.
std::optional<FileNumber> file_at(const std::string& path) {
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) return std::nullopt;
  return FileNumber(found.st_dev, found.st_ino);
}

/// The system's reason where it has one; rosbag's own names no cause.
std::string reason_of(const rosbag::BagException& error, int code) {
  for (const int known : {ENOSPC, EFBIG, EDQUOT, EIO, EROFS, EACCES}) {
    if (code == known) return std::strerror(code);
  }
  return error.what();
}

}  // namespace

BagRecorder::BagRecorder(const std::string& path, const BagOptions& options)
    : path_(path), options_(options), prefix_(options.topics_below) {
  if (prefix_.empty() || prefix_.front() != '/') prefix_.insert(prefix_.begin(), '/');
  if (prefix_.back() != '/') prefix_.push_back('/');
  compression(options.compression);
  const std::filesystem::path folder = std::filesystem::path(absolute_path(path)).parent_path();
  if (!std::filesystem::is_directory(folder)) {
    throw BagError(
        fmt::format("bag {}: there is no folder {}; create it or choose another path", path, folder.string()));
  }
  if (access(folder.c_str(), W_OK) != 0) {
    throw BagError(fmt::format("bag {}: the folder {} is not writable; choose another path", path, folder.string()));
  }
  if (const std::string refused = mpm::refused_output(path); !refused.empty()) {
    throw BagError(fmt::format("bag {}: cannot be written: {}", path, refused));
  }
  std::error_code ignored;
  replaced_ = std::filesystem::is_regular_file(path, ignored);
  replaced_ = remove_later_parts(path) > 0 || replaced_;
  try {
    open();
  } catch (const rosbag::BagException& error) {
    static_cast<void>(bag_.release());  // as in give_up()
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

void BagRecorder::open() {
  bag_ = std::make_unique<rosbag::Bag>();
  bag_->open(part_path(path_, part_), rosbag::bagmode::Write);
  opened_ = file_at(part_path(path_, part_)).value_or(FileNumber());
  bag_->setCompression(compression(options_.compression));
  bag_->setChunkThreshold(kChunkBytes);
  chunk_began_ = std::chrono::steady_clock::now();
  cut_ = false;
}

template <typename Work>
void BagRecorder::on_disk(const Work& work) {
  errno = 0;
  try {
    work();
  } catch (const rosbag::BagException& error) {
    give_up(reason_of(error, errno));
  }
}

void BagRecorder::give_up(const std::string& reason) {
  // Never destroyed: rosbag's destructor writes the index, and an error in it would end the process.
  static_cast<void>(bag_.release());
  const std::string part = part_path(path_, part_);
  failure_ = fmt::format(
      "bag {}: cannot be written any further ({}); make room, or record to another disk. What is in it up to the last "
      "whole chunk is kept: bag_report reads it, `rosbag reindex {}` repairs it",
      part, reason, part);
  if (options_.required) throw BagError(failure_);
}

void BagRecorder::sync_point() {
  if (!bag_) return;
  const auto now = std::chrono::steady_clock::now();
  if (!started_ || now - chunk_began_ >= options_.chunk_period) {
    started_ = true;
    chunk_began_ = now;
    // Setting the threshold ends the present chunk. Its index is still in the stream's buffer, which rosbag gives
    // nobody: all streams are flushed, for a chunk without its index is not read. The chunk's bytes stay in memory
    // until a message is above the threshold; the next one is.
    on_disk([this] { bag_->setChunkThreshold(1); });
    if (!bag_) return;
    check_there();
    if (!bag_) return;
    cut_ = true;
    std::fflush(nullptr);
  }
  const bool large = options_.split_size > 0 && bag_->getSize() >= options_.split_size;
  const bool late = options_.split_duration > 0 && last_.toNSec() >= end_;
  part_over_ = large || late;
}

void BagRecorder::close() {
  if (!bag_) return;
  on_disk([this] {
    bag_->close();
    bag_.reset();
  });
  if (failure_.empty()) check_there();
}

void BagRecorder::check_there() {
  const std::string part = part_path(path_, part_);
  const std::optional<FileNumber> there = file_at(part);
  if (there ? *there == opened_ : errno != ENOENT && errno != ENOTDIR) return;
  // Closes a file without a name, to which all is written; this frees its space.
  try {
    if (bag_) bag_->close();
    bag_.reset();
  } catch (const rosbag::BagException&) {
    static_cast<void>(bag_.release());  // as in give_up()
  }
  failure_ = fmt::format(
      "bag {}: it is not there any more: it, or its folder, was removed, renamed or replaced while it was written; "
      "leave it in its place, and run again",
      part);
  if (options_.required) throw BagError(failure_);
}

void BagRecorder::begin_part(const ros::Time& stamp) {
  part_over_ = false;
  const auto duration = static_cast<std::uint64_t>(options_.split_duration);
  while (duration > 0 && end_ <= last_.toNSec()) end_ += duration;
  bag_->close();
  ++part_;
  open();
  if (info_) {
    info_->header.stamp = stamp;
    info_->part = static_cast<std::uint32_t>(part_);
    write_latched(topics::kRunInfo, stamp, *info_);
  }
  if (frames_) write_latched(topics::kTfStatic, stamp, *frames_);
  if (markers_) write_latched(topics::kMarkers, stamp, *markers_);
}

std::string BagRecorder::resolve(const std::string& topic) const {
  return topic.front() == '/' ? topic : prefix_ + topic;
}

template <typename Message>
void BagRecorder::to_bag(const std::string& name, const ros::Time& stamp, const Message& message,
                         const boost::shared_ptr<ros::M_string>& header) {
  bag_->write(name, stamp, message, header);
  if (!cut_) return;
  cut_ = false;
  bag_->setChunkThreshold(kChunkBytes);
}

template <typename Message>
void BagRecorder::write_latched(const std::string& topic, const ros::Time& stamp, const Message& message) {
  const std::string name = resolve(topic);
  to_bag(name, stamp, message, latched_header<Message>(name));
}

template <typename Message>
void BagRecorder::write(const std::string& topic, const ros::Time& stamp, const Message& message) {
  if (!bag_) return;
  on_disk([&] {
    if (part_over_) begin_part(stamp);
    if (end_ == 0) {
      // Time zero may be stamped a nanosecond late.
      const std::uint64_t begin = stamp == ros::TIME_MIN ? 0 : stamp.toNSec();
      end_ = begin + static_cast<std::uint64_t>(options_.split_duration);
    }
    to_bag(resolve(topic), stamp, message);
    last_ = stamp;
  });
}

void BagRecorder::put(const std::string& topic, const ros::Time& stamp, const RunInfo& message) {
  if (!bag_) return;
  info_ = message;
  info_->part = static_cast<std::uint32_t>(part_);
  on_disk([&] { write_latched(topic, stamp, *info_); });
}
void BagRecorder::put(const std::string& topic, const ros::Time& stamp,
                      const visualization_msgs::MarkerArray& message) {
  if (topic != topics::kMarkers) return write(topic, stamp, message);
  if (!bag_) return;
  markers_ = message;
  on_disk([&] { write_latched(topic, stamp, message); });
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
void BagRecorder::put(const std::string& topic, const ros::Time& stamp, const Cracks& message) {
  write(topic, stamp, message);
}
void BagRecorder::put(const std::string& topic, const ros::Time& stamp, const sensor_msgs::JointState& message) {
  write(topic, stamp, message);
}
void BagRecorder::put(const std::string& topic, const ros::Time& stamp, const RobotStates& message) {
  write(topic, stamp, message);
}
void BagRecorder::put(const std::string& topic, const ros::Time& stamp, const tf2_msgs::TFMessage& message) {
  if (topic != topics::kTfStatic) return write(topic, stamp, message);
  if (!bag_) return;
  frames_ = message;
  on_disk([&] { write_latched(topic, stamp, message); });
}
void BagRecorder::put(const std::string& topic, const ros::Time& stamp, const sensor_msgs::PointCloud2& message) {
  write(topic, stamp, message);
}
void BagRecorder::put(const std::string& topic, const ros::Time& stamp, const JointCommand& message) {
  write(topic, stamp, message);
}
void BagRecorder::put(const std::string& topic, const ros::Time& stamp, const StateSet& message) {
  write(topic, stamp, message);
}
void BagRecorder::put(const std::string& topic, const ros::Time& stamp, const Command& message) {
  write(topic, stamp, message);
}
void BagRecorder::put(const std::string& topic, const ros::Time& stamp, const Volumes& message) {
  write(topic, stamp, message);
}
void BagRecorder::put(const std::string& topic, const ros::Time& stamp, const HeightMap& message) {
  write(topic, stamp, message);
}

}  // namespace mpm_ros
