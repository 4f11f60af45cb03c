#include "mpm_ros/report/report_same.hpp"

#include <fmt/format.h>
#include <rosbag/view.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <ostream>

#include "mpm/math/nanoseconds.hpp"
#include "mpm_ros/message/topics.hpp"
#include "mpm_ros/report/report_cloud.hpp"
#include "mpm_ros/report/report_statistics.hpp"
#include "mpm_ros/report/report_values.hpp"

namespace mpm_ros {
namespace {

/// The same bits; of numbers that are not, any two.
bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof(a)) == 0 || (std::isnan(a) && std::isnan(b)); }

/// Something that differs, and when.
struct Difference {
  std::int64_t time = 0;  ///< [ns]
  std::string what;
};

/// The largest difference of one kind of value, and its size.
struct Worst {
  double difference = 0.0, size = 0.0;
  std::int64_t time = 0;
  std::string field;
};

/// Differences of one topic's messages.
class Comparison {
 public:
  explicit Comparison(bool to_the_bit) : to_the_bit_(to_the_bit) {}

  /// Says of something that is there in one run alone.
  void differ(std::int64_t time, const std::string& what) {
    if (!first_) first_ = Difference{time, what};
  }
  void compare(std::int64_t time, const std::string& field, const std::string& kind, double a, double b) {
    if (to_the_bit_) {
      if (!first_ && !same_bits(a, b)) {
        differ(time, fmt::format("{}: {} and {}, {:.3g} apart", field, a, b, std::abs(a - b)));
      }
      return;
    }
    if (std::isnan(a) && std::isnan(b)) return;
    if (!std::isfinite(a) || !std::isfinite(b)) {
      if (!same_bits(a, b)) differ(time, fmt::format("{}: {} and {}", field, a, b));
      return;
    }
    Worst& worst = worst_[kind];
    worst.size = std::max({worst.size, std::abs(a), std::abs(b)});
    if (std::abs(a - b) <= worst.difference) return;
    worst.difference = std::abs(a - b);
    worst.time = time;
    worst.field = field;
  }
  void compare(std::int64_t time, const std::vector<ComparedValue>& a, const std::vector<ComparedValue>& b) {
    if (a.size() != b.size()) {
      differ(time, fmt::format("{} and {} values: not the same bodies, or not the same sources", a.size(), b.size()));
      return;
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (to_the_bit_ && a[i].word != b[i].word) {
        differ(time, fmt::format("{}: '{}' and '{}'", a[i].field, a[i].word, b[i].word));
      }
      if (a[i].field != b[i].field) {
        differ(time, fmt::format("{} and {} in one place", a[i].field, b[i].field));
        return;
      }
      compare(time, a[i].field, a[i].kind, a[i].number, b[i].number);
    }
  }

  const std::optional<Difference>& first() const { return first_; }
  /// The kind that differs most for its size, and by what part of it.
  std::pair<Worst, double> worst() const {
    std::pair<Worst, double> found;
    for (const auto& [kind, worst] : worst_) {
      const double part = worst.size > 0.0 ? worst.difference / worst.size : 0.0;
      if (part > found.second) found = {worst, part};
    }
    return found;
  }

 private:
  bool to_the_bit_;
  std::optional<Difference> first_;
  std::map<std::string, Worst> worst_;
};

void compare_messages(std::int64_t time, const sensor_msgs::PointCloud2& a, const sensor_msgs::PointCloud2& b,
                      Comparison& comparison) {
  if (a.fields.size() == b.fields.size() && a.data == b.data && a.width == b.width) return;
  const CloudColumns first = columns_of(a), second = columns_of(b);
  std::vector<std::size_t> in_a, in_b;  // places of the particles, in order of id
  const auto order = [](const CloudColumns& cloud) {
    std::vector<std::size_t> places(cloud.ids.size());
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = i;
    std::sort(places.begin(), places.end(), [&](std::size_t i, std::size_t j) { return cloud.ids[i] < cloud.ids[j]; });
    return places;
  };
  in_a = order(first);
  in_b = order(second);
  for (std::size_t i = 0; i < std::max(in_a.size(), in_b.size()); ++i) {
    const bool both = i < in_a.size() && i < in_b.size();
    if (both && first.ids[in_a[i]] == second.ids[in_b[i]]) continue;
    comparison.differ(time, fmt::format("{} and {} particles, not the same", in_a.size(), in_b.size()));
    return;
  }
  if (first.columns.size() != second.columns.size()) comparison.differ(time, "not the same particle fields");
  for (const ParticleColumn& column : first.columns) {
    const auto same = std::find_if(second.columns.begin(), second.columns.end(),
                                   [&](const ParticleColumn& other) { return other.name == column.name; });
    if (same == second.columns.end()) {
      comparison.differ(time, "particle field " + column.name + " is in one of them alone");
      continue;
    }
    for (std::size_t i = 0; i < in_a.size(); ++i) {
      const float x = column.values[in_a[i]], y = same->values[in_b[i]];
      if (x == y) {
        comparison.compare(time, column.name, column.name, x, y);  // for its size
        continue;
      }
      comparison.compare(time, fmt::format("{} of particle {}", column.name, first.ids[in_a[i]]), column.name, x, y);
    }
  }
}

template <typename Message>
void compare_messages(std::int64_t time, const Message& a, const Message& b, Comparison& comparison) {
  comparison.compare(time, values_of(a), values_of(b));
}

/// The messages of one topic, one after the other.
template <typename Message>
class Messages {
 public:
  Messages(const RunBag& bag, const std::string& topic) : bag_(bag) {
    bag.select(view_, {bag.name_space() + "/" + topic});
    next_ = view_.begin();
  }
  /// False at the end.
  bool read() {
    if (next_ == view_.end()) return false;
    message_ = next_->instantiate<Message>();
    if (!message_) throw BagError(bag_.path() + ": " + next_->getTopic() + " has another definition than here");
    ++next_;
    return true;
  }
  const Message& message() const { return *message_; }
  std::int64_t time() const { return bag_.stamps().time_of(message_->header.stamp); }

 private:
  const RunBag& bag_;
  rosbag::View view_;
  rosbag::View::iterator next_;
  typename Message::ConstPtr message_;
};

template <typename Message>
Comparison compare_topic(const RunBag& a, const RunBag& b, const char* topic, bool to_the_bit) {
  Comparison comparison(to_the_bit);
  Messages<Message> of_a(a, topic), of_b(b, topic);
  while (!(to_the_bit && comparison.first())) {
    const bool more_a = of_a.read(), more_b = of_b.read();
    if (!more_a && !more_b) break;
    if (!more_a || !more_b) {
      comparison.differ(more_a ? of_a.time() : of_b.time(), fmt::format("{} has no more messages", more_a ? "B" : "A"));
      break;
    }
    if (of_a.time() != of_b.time()) {
      comparison.differ(std::min(of_a.time(), of_b.time()),
                        fmt::format("a message at {} s and one at {} s", mpm::nearest_seconds(of_a.time()),
                                    mpm::nearest_seconds(of_b.time())));
      break;
    }
    compare_messages(of_a.time(), of_a.message(), of_b.message(), comparison);
  }
  return comparison;
}

}  // namespace

bool same_runs(RunBag& a, RunBag& b, std::optional<double> tolerance, std::ostream& out) {
  const bool to_the_bit = !tolerance;
  out << "A: " << a.path() << "\nB: " << b.path() << "\n";
  std::vector<std::pair<std::string, Comparison>> topics;
  const auto add = [&](const char* topic, Comparison comparison) { topics.emplace_back(topic, std::move(comparison)); };
  try {
    add(topics::kCommands, compare_topic<Command>(a, b, topics::kCommands, to_the_bit));
    add(topics::kBodies, compare_topic<BodyStates>(a, b, topics::kBodies, to_the_bit));
    add(topics::kContactForces, compare_topic<ContactForces>(a, b, topics::kContactForces, to_the_bit));
    add(topics::kSolverState, compare_topic<SolverState>(a, b, topics::kSolverState, to_the_bit));
    add(topics::kGlobalQuantities, compare_topic<GlobalQuantities>(a, b, topics::kGlobalQuantities, to_the_bit));
    add(topics::kCracks, compare_topic<Cracks>(a, b, topics::kCracks, to_the_bit));
    add(topics::kRobots, compare_topic<RobotStates>(a, b, topics::kRobots, to_the_bit));
    add(topics::kParticles, compare_topic<sensor_msgs::PointCloud2>(a, b, topics::kParticles, to_the_bit));
  } catch (const ros::Exception& error) {
    throw BagError(fmt::format("{} or {} is damaged: {}", a.path(), b.path(), error.what()));
  }
  bool same = true;
  const std::pair<std::string, Comparison>* earliest = nullptr;
  for (const auto& topic : topics) {
    const auto& [name, comparison] = topic;
    if (comparison.first()) {
      same = false;
      if (earliest == nullptr || comparison.first()->time < earliest->second.first()->time) earliest = &topic;
    }
    if (to_the_bit) continue;
    const auto [worst, part] = comparison.worst();
    const bool within = part <= *tolerance && !comparison.first();
    same = same && within;
    out << fmt::format("{:<5} {:<18}", within ? "PASS" : "FAIL", name);
    if (comparison.first())
      out << fmt::format("at {} s: {}; ", mpm::nearest_seconds(comparison.first()->time), comparison.first()->what);
    out << (part > 0.0 ? fmt::format("worst {:.3g} of its largest, {:.3g}: {} at {} s\n", part, worst.size, worst.field,
                                     mpm::nearest_seconds(worst.time))
                       : std::string("no numbers apart\n"));
  }
  if (to_the_bit && earliest != nullptr) {
    out << fmt::format("FAIL  first difference: {} at {} s: {}\n", earliest->first,
                       mpm::nearest_seconds(earliest->second.first()->time), earliest->second.first()->what);
  }
  if (same) out << (to_the_bit ? "PASS  the same, to the bit\n" : "PASS  the same, within the tolerance\n");
  return same;
}

}  // namespace mpm_ros
