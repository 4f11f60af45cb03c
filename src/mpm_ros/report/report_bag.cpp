#include "mpm_ros/report/report_bag.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <rosgraph_msgs/Clock.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>
#include <utility>

#include "mpm/math/input_file.hpp"
#include "mpm_ros/message/bag_damage.hpp"
#include "mpm_ros/message/bag_parts.hpp"
#include "mpm_ros/message/local_frame.hpp"
#include "mpm_ros/message/robot_messages.hpp"
#include "mpm_ros/message/topics.hpp"
#include "mpm_ros/report/reindex.hpp"

namespace mpm_ros {
namespace {

constexpr const char* kBegin = "#ROSBAG";  // beginning of a bag of any version

template <typename Message>
std::string type_of() {
  return ros::message_traits::DataType<Message>::value();
}

/// The message, or an error when the bag was written with another definition of its type.
template <typename Message>
typename Message::ConstPtr take(const rosbag::MessageInstance& instance, const std::string& path) {
  if (instance.getMD5Sum() != ros::message_traits::MD5Sum<Message>::value()) {
    throw BagError(
        fmt::format("{}: {} on {} has another definition than here; read the bag with the version of mpm_ros "
                    "that recorded it",
                    path, instance.getDataType(), instance.getTopic()));
  }
  const typename Message::ConstPtr message = instance.instantiate<Message>();
  if (!message)
    throw BagError(fmt::format("{}: {} on {} cannot be read", path, instance.getDataType(), instance.getTopic()));
  return message;
}

/// An error of the bag library, which is one line.
BagError damaged(const std::string& path, const std::string& problem) {
  return BagError(
      fmt::format("{}: damaged ({}); what is whole can be saved with: rosbag reindex {}", path, problem, path));
}

/// Reads; what rosbag and messages throw is an error of the bag. A list of a message that says to be longer than memory
/// is one, too.
template <typename Work>
void reading(const std::string& path, const Work& work) {
  constexpr const char* kTooLong = "a message in it says to be longer than there is memory for";
  try {
    work();
  } catch (const ros::Exception& error) {
    throw damaged(path, error.what());
  } catch (const std::bad_alloc&) {
    throw damaged(path, kTooLong);
  } catch (const std::length_error&) {
    throw damaged(path, kTooLong);
  }
}

/// Tells how far a view is read; counts messages.
class Count {
 public:
  Count(rosbag::View& view, const Reading& reading) : reading_(reading), size_(view.size()) {}
  void next() {
    if (reading_) reading_(static_cast<double>(done_++) / static_cast<double>(size_));
  }

 private:
  const Reading& reading_;
  std::uint64_t size_;
  std::uint64_t done_ = 0;
};

/// Everything before "/solver_state".
std::string parent(const std::string& topic) { return topic.substr(0, topic.rfind('/')); }

}  // namespace

bool is_bag(const std::string& path) {
  std::ifstream file;
  if (!mpm::open_input(file, path).empty()) return false;
  std::string begin(std::strlen(kBegin), ' ');
  return file.read(begin.data(), static_cast<std::streamsize>(begin.size())) && begin == kBegin;
}

RunBag::RunBag(const std::string& path, const std::string& name_space) : path_(path) {
  reading(path_, [&] {
    open();
    find_run(name_space);
    find_start();
    check_parts();
    find_frames();
    find_fields();
  });
}

void RunBag::open() {
  for (const std::string& part : parts_of(path_)) {
    if (!open_part(part, bags_.empty())) break;
  }
}

bool RunBag::open_part(const std::string& path, bool first) {
  std::error_code error;
  if (const std::string refused = mpm::refused_input(path); !refused.empty()) throw BagError(path + ": " + refused);
  if (std::filesystem::file_size(path, error) == 0) {
    if (!first) return false;
    throw BagError(path + ": an empty file, not a bag; was the recording stopped before it began?");
  }
  if (const std::string damage = bag_damage(path); !damage.empty()) {
    throw BagError(fmt::format("{}: {}; what is whole can be saved with: rosbag reindex {}", path, damage, path));
  }
  auto bag = std::make_unique<rosbag::Bag>();
  try {
    bag->open(path, rosbag::bagmode::Read);
  } catch (const rosbag::BagException& problem) {
    if (!is_bag(path)) {
      throw BagError(fmt::format("{}: not a bag ({}); give a file that the simulator or run_scene recorded", path,
                                 problem.what()));
    }
    try {
      open_copy(path, *bag);
    } catch (const BagError&) {
      if (first) throw;
      return false;
    }
  }
  bags_.push_back(std::move(bag));
  return true;
}

void RunBag::open_copy(const std::string& path, rosbag::Bag& bag) {
  if (!copy_) copy_.emplace();
  const std::string copy = reindexed_copy(path, copy_->path());
  try {
    bag.close();  // the file stays open when it could not be read
    bag.open(copy, rosbag::bagmode::Read);
    if (rosbag::View(bag).size() > 0) return;
  } catch (const ros::Exception& problem) {
    throw BagError(fmt::format("{}: damaged ({}); record again", path, problem.what()));
  }
  throw BagError(path + ": cut short before its first messages were written; nothing in it can be read");
}

void RunBag::select(rosbag::View& view, const std::vector<std::string>& topics) const {
  for (const auto& bag : bags_) view.addQuery(*bag, rosbag::TopicQuery(topics));
}

void RunBag::find_run(const std::string& wanted) {
  rosbag::View view;
  for (const auto& bag : bags_) view.addQuery(*bag);
  if (view.size() == 0) throw BagError(path_ + ": a bag without messages; was anything published while it recorded?");
  for (const rosbag::ConnectionInfo* connection : view.getConnections())
    types_[connection->topic] = connection->datatype;

  std::set<std::string> runs;
  for (const auto& [name, type] : types_) {
    const std::string above = parent(name);
    if (type == type_of<SolverState>() && name == above + "/" + topics::kSolverState) runs.insert(above);
  }
  if (runs.empty()) {
    std::vector<std::string> names;
    for (const auto& [name, type] : types_) names.push_back(name);
    throw BagError(fmt::format("{}: not a recording of this package: no topic */solver_state of type {} among {}",
                               path_, type_of<SolverState>(), fmt::join(names, ", ")));
  }
  if (wanted.empty()) {
    if (runs.size() > 1) {
      throw BagError(
          fmt::format("{}: holds several runs; choose one with --namespace: {}", path_, fmt::join(runs, ", ")));
    }
    name_space_ = *runs.begin();
  } else {
    name_space_ = wanted == "/" ? "" : (wanted.front() == '/' ? wanted : "/" + wanted);
    if (runs.count(name_space_) == 0) {
      throw BagError(
          fmt::format("{}: no run under namespace '{}'; there is: '{}'", path_, wanted, fmt::join(runs, "', '")));
    }
  }

  std::vector<std::string> needed;
  const std::pair<const char*, std::string> expected[] = {{topics::kContactForces, type_of<ContactForces>()},
                                                          {topics::kBodies, type_of<BodyStates>()}};
  for (const auto& [name, type] : expected) {
    const auto found = types_.find(topic(name));
    if (found == types_.end() || found->second != type) needed.push_back(topic(name) + " (" + type + ")");
  }
  if (!needed.empty()) {
    throw BagError(fmt::format("{}: no topic {}; record it beside {}", path_, fmt::join(needed, ", "),
                               topic(topics::kSolverState)));
  }
  for (const char* name : {topics::kRunInfo, topics::kParticles}) {
    if (types_.count(topic(name)) == 0) missing_.push_back(topic(name));
  }
}

void RunBag::find_start() {
  rosbag::View infos;
  select(infos, {topic(topics::kRunInfo)});
  if (infos.begin() != infos.end()) {
    info_ = *take<RunInfo>(*infos.begin(), path_);
    stamps_ = Stamps(info_->start);
    return;
  }
  rosbag::View states;
  select(states, {topic(topics::kSolverState)});
  if (states.begin() == states.end()) throw BagError(path_ + ": the run has no message; was it stopped at its start?");
  const SolverState::ConstPtr first = take<SolverState>(*states.begin(), path_);
  if (first->header.stamp == ros::TIME_MIN) return;  // stands for time zero of a run with origin zero
  const std::int64_t origin =
      static_cast<std::int64_t>(first->header.stamp.toNSec()) - mpm::nanoseconds_of(first->time);
  ros::Time start;
  start.fromNSec(static_cast<std::uint64_t>(std::max<std::int64_t>(origin, 0)));
  stamps_ = Stamps(start);
}

void RunBag::check_parts() const {
  for (std::size_t i = 1; info_ && i < bags_.size(); ++i) {
    rosbag::View infos(*bags_[i], rosbag::TopicQuery(topic(topics::kRunInfo)));
    if (infos.begin() == infos.end()) continue;
    const RunInfo::ConstPtr info = take<RunInfo>(*infos.begin(), path_);
    if (info->part == i + info_->part && info->start == info_->start && info->scene_text == info_->scene_text) continue;
    throw BagError(fmt::format("{}: {} is no part of this recording; move it to another folder", path_,
                               part_path(path_, static_cast<int>(i) + 1)));
  }
}

void RunBag::find_frames() {
  const auto type = types_.find(topics::kTfStatic);
  if (type == types_.end() || type->second != type_of<tf2_msgs::TFMessage>()) return;
  rosbag::View frames;
  select(frames, {topics::kTfStatic});
  for (const rosbag::MessageInstance& instance : frames)
    for (const auto& [name, origin] : origins_of(*take<tf2_msgs::TFMessage>(instance, path_))) origins_[name] = origin;
}

void RunBag::find_fields() {
  rosbag::View clouds;
  select(clouds, {topic(topics::kParticles)});
  if (clouds.begin() == clouds.end()) return;
  const auto first = take<sensor_msgs::PointCloud2>(*clouds.begin(), path_);
  for (const sensor_msgs::PointField& field : first->fields) particle_fields_.push_back(field.name);
}

template <typename Message>
void RunBag::hand_on(const rosbag::MessageInstance& instance, const std::vector<RunVisitor*>& visitors,
                     void (RunVisitor::*receive)(std::int64_t, const Message&)) const {
  const typename Message::ConstPtr message = take<Message>(instance, path_);
  for (RunVisitor* visitor : visitors) (visitor->*receive)(stamps_.time_of(message->header.stamp), *message);
}

void RunBag::hand_on_cloud(const rosbag::MessageInstance& instance, const std::vector<RunVisitor*>& visitors) const {
  const auto message = take<sensor_msgs::PointCloud2>(instance, path_);
  const auto origin = origins_.find(message->header.frame_id);
  const std::int64_t time = stamps_.time_of(message->header.stamp);
  if (origin == origins_.end()) {
    for (RunVisitor* visitor : visitors) visitor->particles(time, *message);
    return;
  }
  const sensor_msgs::PointCloud2 cloud = in_world(*message, origin->second);
  for (RunVisitor* visitor : visitors) visitor->particles(time, cloud);
}

void RunBag::hand_on_robots(const rosbag::MessageInstance& instance, const std::vector<RunVisitor*>& visitors) const {
  const auto message = take<RobotStates>(instance, path_);
  for (const RobotState& robot : message->robots) {
    if (const std::string problem = problem_of(robot); !problem.empty())
      throw BagError(fmt::format("{}: {}: {}", path_, instance.getTopic(), problem));
  }
  for (RunVisitor* visitor : visitors) visitor->robots(stamps_.time_of(message->header.stamp), *message);
}

void RunBag::read(const std::vector<RunVisitor*>& visitors, const Reading& told) {
  std::vector<std::string> names;
  for (const char* name : {topics::kContactForces, topics::kBodies, topics::kSolverState, topics::kGlobalQuantities,
                           topics::kCracks, topics::kRobots, topics::kCommands, topics::kJointCommands,
                           topics::kParticles, topics::kTerrain, topics::kMarkers}) {
    names.push_back(topic(name));
  }
  names.emplace_back(topics::kClock);
  reading(path_, [&] {
    rosbag::View view;
    select(view, names);
    bool shaped = false;
    Count count(view, told);
    for (const rosbag::MessageInstance& instance : view) {
      count.next();
      if (instance.getTopic() == topics::kClock) {
        const auto message = take<rosgraph_msgs::Clock>(instance, path_);
        for (RunVisitor* visitor : visitors) visitor->clock(stamps_.time_of(message->clock));
        continue;
      }
      const std::string name = instance.getTopic().substr(name_space_.size() + 1);
      if (name == topics::kContactForces) {
        hand_on(instance, visitors, &RunVisitor::contact_forces);
      } else if (name == topics::kBodies) {
        hand_on(instance, visitors, &RunVisitor::bodies);
      } else if (name == topics::kSolverState) {
        hand_on(instance, visitors, &RunVisitor::solver_state);
      } else if (name == topics::kGlobalQuantities) {
        hand_on(instance, visitors, &RunVisitor::global_quantities);
      } else if (name == topics::kCracks) {
        hand_on(instance, visitors, &RunVisitor::cracks);
      } else if (name == topics::kRobots) {
        hand_on_robots(instance, visitors);
      } else if (name == topics::kCommands) {
        hand_on(instance, visitors, &RunVisitor::command);
      } else if (name == topics::kJointCommands) {
        hand_on(instance, visitors, &RunVisitor::joint_command);
      } else if (name == topics::kTerrain) {
        hand_on(instance, visitors, &RunVisitor::terrain);
      } else if (name == topics::kParticles) {
        hand_on_cloud(instance, visitors);
      } else if (!std::exchange(shaped, true)) {  // each part has them again
        const auto message = take<visualization_msgs::MarkerArray>(instance, path_);
        for (RunVisitor* visitor : visitors) visitor->markers(*message);
      }
    }
  });
}

void RunBag::read_states_and_commands(RunVisitor& visitor) {
  reading(path_, [&] {
    rosbag::View view;
    select(view, {topic(topics::kSolverState), topic(topics::kCommands), topic(topics::kJointCommands),
                  topic(topics::kStatesSet)});
    for (const rosbag::MessageInstance& instance : view) {
      if (instance.getDataType() == type_of<Command>()) {
        hand_on(instance, {&visitor}, &RunVisitor::command);
      } else if (instance.getDataType() == type_of<JointCommand>()) {
        hand_on(instance, {&visitor}, &RunVisitor::joint_command);
      } else if (instance.getDataType() == type_of<StateSet>()) {
        hand_on(instance, {&visitor}, &RunVisitor::state_set);
      } else {
        hand_on(instance, {&visitor}, &RunVisitor::solver_state);
      }
    }
  });
}

void RunBag::read_snapshots(const std::set<std::size_t>& chosen, RunVisitor& visitor, const Reading& told) {
  reading(path_, [&] {
    rosbag::View view;
    select(view, {topic(topics::kParticles)});
    Count count(view, told);
    std::size_t index = 0;
    for (const rosbag::MessageInstance& instance : view) {
      count.next();
      if (chosen.count(index++) == 0) continue;
      hand_on_cloud(instance, {&visitor});
    }
  });
}

}  // namespace mpm_ros
