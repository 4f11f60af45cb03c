#include "mpm_ros/command/command_queue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <string>
#include <tuple>
#include <utility>

namespace mpm_ros {

bool CommandQueue::push(BodyCommand command) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!make_room(command)) return false;
  if (on_hold_) {
    outside_.push_back(std::move(command));
  } else {
    admit(std::move(command));
  }
  return true;
}

bool CommandQueue::push_past_hold(BodyCommand command) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!make_room(command)) return false;
  admit(std::move(command));
  return true;
}

void CommandQueue::hold() {
  const std::lock_guard<std::mutex> lock(mutex_);
  on_hold_ = true;
}

void CommandQueue::release() {
  const std::lock_guard<std::mutex> lock(mutex_);
  on_hold_ = false;
  for (BodyCommand& command : outside_) admit(std::move(command));
  outside_.clear();
}

CommandQueue::Stream CommandQueue::stream_of(const BodyCommand& command) {
  return {command.body, command.kind, command.sender};
}

bool CommandQueue::make_room(const BodyCommand& command) {
  if (is_ahead(command)) {
    std::size_t& ahead = ahead_[command.body];
    if (ahead >= kMost) return false;
    ++ahead;
    return true;
  }
  const Stream stream = stream_of(command);
  std::size_t& next = next_[stream];
  if (next < kMost) {
    ++next;
    return true;
  }
  // Those that are due at the next sync point stand in the order in which they came, on hold last.
  const auto same = [&](const BodyCommand& other) {
    return other.body == command.body && other.kind == command.kind && !is_ahead(other) &&
           other.sender == command.sender;
  };
  for (std::deque<BodyCommand>* commands : {&waiting_, &outside_}) {
    const auto oldest = std::find_if(commands->begin(), commands->end(), same);
    if (oldest == commands->end()) continue;
    commands->erase(oldest);
    ++dropped_;
    break;
  }
  return true;
}

void CommandQueue::count_waiting() {
  ahead_.clear();
  next_.clear();
  for (const std::deque<BodyCommand>* commands : {&waiting_, &outside_}) {
    for (const BodyCommand& command : *commands)
      ++(is_ahead(command) ? ahead_[command.body] : next_[stream_of(command)]);
  }
}

void CommandQueue::admit(BodyCommand command) {
  command.order = arrivals_++;
  // Sync points up to passed_ are used up.
  const bool past = command.stamp && !is_ahead(command);
  if (past) ++late_.past;
  if (command.late && !past) ++late_.unstamped;
  command.late = command.late || past;
  waiting_.push_back(std::move(command));
}

bool CommandQueue::is_due(const BodyCommand& command, std::int64_t now) const {
  if (!command.stamp || *command.stamp <= now) return true;
  if (command.kind != CommandKind::pose) return false;
  // A pose to come sets out when the one under way is reached, or takes its place if it is to be reached no later.
  const auto stream = streams_.find(command.body);
  if (stream == streams_.end()) return true;
  const std::int64_t under_way = stream->second.arrival;
  return under_way <= now || round_up(*command.stamp) <= under_way;
}

std::int64_t CommandQueue::arrival_of(const BodyCommand& command, std::int64_t now) {
  PoseStream& stream = streams_[command.body];
  const std::int64_t stamp = command.stamp.value_or(now);
  const std::int64_t gap = stamp - stream.last_stamp;
  if (stream.last_stamp >= 0 && gap > 0 && gap <= kLongestPeriod) stream.period = gap;
  stream.last_stamp = stamp;
  const bool to_come = command.stamp && *command.stamp > now;
  stream.arrival = round_up(to_come ? *command.stamp : now + std::max(stream.period, sync_period_));
  return stream.arrival;
}

// A pose to come is due when it is no later than the one under way, or the first; one that sets out now without a
// stamp to come arrives a command period from now, which is kLongestPeriod at most.
std::deque<BodyCommand>::iterator CommandQueue::part_later(std::int64_t now) {
  std::map<int, std::int64_t> next;  // stamp of the first pose to come, by body
  for (const BodyCommand& command : waiting_) {
    if (command.kind != CommandKind::pose || !command.stamp || *command.stamp <= now) continue;
    const auto [first, fresh] = next.emplace(command.body, *command.stamp);
    if (!fresh) first->second = std::min(first->second, *command.stamp);
  }
  for (auto& [body, reach] : next) {
    const auto stream = streams_.find(body);
    if (stream != streams_.end()) reach = std::max(reach, stream->second.arrival);
    reach = round_up(std::max(reach, now + std::max(kLongestPeriod, sync_period_)));
  }
  return std::partition(waiting_.begin(), waiting_.end(), [&](const BodyCommand& command) {
    if (!command.stamp || *command.stamp <= now) return true;
    return command.kind == CommandKind::pose && *command.stamp <= next.at(command.body);
  });
}

std::vector<DueCommand> CommandQueue::take(std::int64_t now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  passed_ = now;
  const std::size_t before = waiting_.size();
  // A velocity that takes effect ends the poses that were received before it, those that could set out now as well.
  std::map<int, std::uint64_t> last_velocity;
  for (const BodyCommand& command : waiting_) {
    if (command.kind != CommandKind::velocity || !is_due(command, now)) continue;
    std::uint64_t& order = last_velocity[command.body];
    order = std::max(order, command.order);
  }
  const auto ended = [&](const BodyCommand& command) {
    const auto velocity = last_velocity.find(command.body);
    return command.kind == CommandKind::pose && command.stamp.value_or(now) > now && velocity != last_velocity.end() &&
           command.order < velocity->second;
  };
  waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(), ended), waiting_.end());

  // Takes the earliest of the poses to come first, since one that sets out holds back those after it.
  const auto effect = [now](const BodyCommand& command) {
    return command.late ? now : std::min(command.stamp.value_or(now), now);
  };
  const auto target = [now](const BodyCommand& command) { return std::max(command.stamp.value_or(now), now); };
  const std::string nobody;
  const auto key = [&](const BodyCommand& c) {
    const bool late = c.late || !c.stamp;
    return std::make_tuple(effect(c), c.body, target(c), late, late ? CommandKind::velocity : c.kind,
                           std::cref(late ? nobody : c.sender), c.order);
  };
  const auto later = part_later(now);
  std::sort(waiting_.begin(), later, [&](const BodyCommand& a, const BodyCommand& b) { return key(a) < key(b); });

  std::vector<DueCommand> due;
  std::deque<BodyCommand> still_waiting(std::make_move_iterator(later), std::make_move_iterator(waiting_.end()));
  waiting_.erase(later, waiting_.end());
  for (BodyCommand& command : waiting_) {
    if (!is_due(command, now)) {
      still_waiting.push_back(std::move(command));
      continue;
    }
    DueCommand next;
    if (command.kind == CommandKind::pose) {
      next.arrival = arrival_of(command, now);
    } else if (command.kind == CommandKind::velocity) {
      streams_.erase(command.body);
    }
    next.command = std::move(command);
    due.push_back(std::move(next));
  }
  // The same for whatever still waits, of either kind.
  for (const DueCommand& applied : due) {
    if (applied.command.kind == CommandKind::wrench) continue;
    const auto superseded = [&](const BodyCommand& command) {
      return command.kind != CommandKind::wrench && command.body == applied.command.body &&
             command.kind != applied.command.kind && command.order < applied.command.order;
    };
    still_waiting.erase(std::remove_if(still_waiting.begin(), still_waiting.end(), superseded), still_waiting.end());
  }
  waiting_ = std::move(still_waiting);
  if (waiting_.size() != before || !outside_.empty()) count_waiting();
  return due;
}

void CommandQueue::clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  waiting_.clear();
  outside_.clear();
  streams_.clear();
  passed_ = -1;
  count_waiting();
}

LateCommands CommandQueue::late() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return late_;
}

std::uint64_t CommandQueue::dropped() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return dropped_;
}

std::int64_t CommandQueue::passed() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return passed_;
}

std::size_t CommandQueue::waiting() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return waiting_.size() + outside_.size();
}

void CommandQueue::serialise(mpm::StateArchive& archive) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const mpm::StateArchive::Group group(archive, "queue");
  archive.rows("waiting", waiting_);
  archive.column("waiting/body", waiting_, &BodyCommand::body);
  archive.column("waiting/kind", waiting_, &BodyCommand::kind);
  archive.column("waiting/linear", waiting_, [](BodyCommand& one) -> mpm::Vec3& { return one.twist.linear; });
  archive.column("waiting/angular", waiting_, [](BodyCommand& one) -> mpm::Vec3& { return one.twist.angular; });
  archive.column("waiting/force", waiting_, [](BodyCommand& one) -> mpm::Vec3& { return one.wrench.force; });
  archive.column("waiting/torque", waiting_, [](BodyCommand& one) -> mpm::Vec3& { return one.wrench.torque; });
  archive.column("waiting/position", waiting_, [](BodyCommand& one) -> mpm::Vec3& { return one.pose.position; });
  archive.column("waiting/orientation", waiting_, [](BodyCommand& one) -> mpm::Quat& { return one.pose.orientation; });
  archive.column("waiting/frame_body", waiting_, &BodyCommand::frame_body);
  archive.column("waiting/sec", waiting_, [](BodyCommand& one) -> std::uint32_t& { return one.requested.sec; });
  archive.column("waiting/nsec", waiting_, [](BodyCommand& one) -> std::uint32_t& { return one.requested.nsec; });
  for (std::size_t i = 0; i < waiting_.size(); ++i) archive.value(fmt::format("sender{}", i), waiting_[i].sender);
  std::vector<std::int64_t> stamps;
  std::vector<std::uint8_t> has_stamp;
  for (const BodyCommand& one : waiting_) {
    has_stamp.push_back(one.stamp ? 1 : 0);
    stamps.push_back(one.stamp.value_or(0));
  }
  archive.list("waiting/has_stamp", has_stamp);
  archive.list("waiting/stamp", stamps);
  for (std::size_t i = 0; archive.reading() && i < waiting_.size(); ++i) {
    waiting_[i].stamp.reset();
    if (has_stamp[i] != 0) waiting_[i].stamp = stamps[i];
  }
  archive.column("waiting/late", waiting_, &BodyCommand::late);
  archive.column("waiting/order", waiting_, &BodyCommand::order);
  std::vector<std::pair<int, PoseStream>> streams(streams_.begin(), streams_.end());
  archive.rows("poses", streams);
  archive.column("poses/body", streams, [](auto& one) -> int& { return one.first; });
  archive.column("poses/last_stamp", streams, [](auto& one) -> std::int64_t& { return one.second.last_stamp; });
  archive.column("poses/period", streams, [](auto& one) -> std::int64_t& { return one.second.period; });
  archive.column("poses/arrival", streams, [](auto& one) -> std::int64_t& { return one.second.arrival; });
  if (archive.reading()) streams_ = std::map<int, PoseStream>(streams.begin(), streams.end());
  archive.value("passed", passed_);
  archive.value("arrivals", arrivals_);
  if (archive.reading()) count_waiting();
}

void CommandQueue::take_over(const CommandQueue& other) {
  const std::scoped_lock lock(mutex_, other.mutex_);
  sync_period_ = other.sync_period_;
  waiting_ = other.waiting_;
  streams_ = other.streams_;
  passed_ = other.passed_;
  arrivals_ = other.arrivals_;
  count_waiting();
}

}  // namespace mpm_ros
