// The sinks of a run: a message goes to those that want it, stamped with the present sync point.
#pragma once

#include <std_msgs/Header.h>

#include <algorithm>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "mpm/simulation/simulation.hpp"
#include "mpm_ros/message/message_sink.hpp"
#include "mpm_ros/message/stamps.hpp"

namespace mpm_ros {

class OutputSinks {
 public:
  /// Both must outlive it.
  OutputSinks(const mpm::Simulation& simulation, const Stamps& stamps, std::string world_frame)
      : simulation_(simulation), stamps_(stamps), world_frame_(std::move(world_frame)) {}

  OutputSinks(const OutputSinks&) = delete;  // writers refer to it
  OutputSinks& operator=(const OutputSinks&) = delete;

  /// Kept by reference.
  void add(MessageSink& sink) { sinks_.push_back(&sink); }

  ros::Time stamp() const { return stamps_.at(simulation_.time()); }
  std_msgs::Header header(const std::string& frame) const;
  /// In the world frame.
  std_msgs::Header header() const { return header(world_frame_); }

  /// True if a sink of this rank wants it.
  bool wanted(const std::string& topic) const { return wanted(topic, kAll); }
  /// The same of those that are `meant`.
  template <typename Meant>
  bool wanted(const std::string& topic, const Meant& meant) const {
    const auto wants = [&](const MessageSink* sink) { return meant(sink) && sink->wants(topic); };
    return std::any_of(sinks_.begin(), sinks_.end(), wants);
  }
  /// The same of any rank: where all ranks have to read what is written.
  bool wanted_anywhere(const std::string& topic) const { return simulation_.on_any_rank(wanted(topic)); }

  template <typename Message>
  void put(const std::string& topic, const Message& message) {
    put_to(topic, message, kAll);
  }
  /// To those sinks alone that want it, and are `meant`.
  template <typename Message, typename Meant>
  void put_to(const std::string& topic, const Message& message, const Meant& meant) {
    try {
      for (MessageSink* sink : sinks_) {
        if (sink->wants(topic) && meant(sink)) sink->put(topic, stamp(), message);
      }
    } catch (...) {
      if (simulation_.ranks() == nullptr) throw;
      failed_ = std::current_exception();  // others go on reading for what comes next
    }
  }
  /// Throws on all ranks if a sink has failed on one. @throws BagError on the others
  void end_writing();

 private:
  static constexpr auto kAll = [](const MessageSink*) { return true; };

  const mpm::Simulation& simulation_;
  const Stamps& stamps_;
  const std::string world_frame_;
  std::vector<MessageSink*> sinks_;
  std::exception_ptr failed_;  ///< over several ranks: why, until all know
};

}  // namespace mpm_ros
