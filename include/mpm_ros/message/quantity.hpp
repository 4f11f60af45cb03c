// A number that a run reports, described once: name, unit, how its value over an interval comes from those over parts
// of the interval, where it stands in the solver's report and in the message, its CSV column, and the figures of a
// whole run that are made of it. quantities.hpp has the lists. Messages, averages, checkpoints, CSV tables, JSON keys,
// tables of bag_report and its --same go through them, and a test holds doc/analysis.md against them: a line in a list
// is all that a new number asks for. One that has no field of its own in the message is among its `values`.
#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Vector3.h>
#include <mpm_ros/NamedValue.h>

#include <algorithm>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "mpm/math/geometry.hpp"

namespace mpm_ros {

/// One number, or a vector on world axes.
using Value = std::variant<double, mpm::Vec3>;

/// Rule by which the value over an interval comes from those over parts of it.
enum class Over {
  mean,   ///< mean over time
  place,  ///< mean by the normal impulse; not a number while nothing presses
  step,   ///< value of the step with the largest force
  sum,
  start,  ///< counted since the start of the run: the last one
  now,    ///< as the interval ended: the last one
};
const char* over_text(Over over);

/// A figure of a whole run.
struct Figure {
  enum class Of {
    peak,     ///< largest size in any interval, with its vector and time
    mean,     ///< over time
    largest,  ///< in any interval
    end,      ///< in the last interval
    ends,     ///< in the first and the last interval
  } of;
  std::string key;      ///< in JSON; empty: not there
  std::string heading;  ///< in tables
};

/// A member of a report or of a message.
template <class Access>
struct Field {
  const char* path;
  Access at;
};
inline Value value_of(const mpm::Vec3& vector) { return vector; }
inline Value value_of(const geometry_msgs::Vector3& vector) { return mpm::Vec3(vector.x, vector.y, vector.z); }
inline Value value_of(const geometry_msgs::Point& point) { return mpm::Vec3(point.x, point.y, point.z); }
template <class Number, class = std::enable_if_t<std::is_arithmetic_v<Number>>>
Value value_of(Number number) {
  return static_cast<double>(number);
}
/// Sets a member of any of these types.
template <class Member>
void assign(Member& member, const Value& value) {
  if constexpr (std::is_arithmetic_v<Member>) {
    member = static_cast<Member>(std::get<double>(value));
  } else if constexpr (std::is_same_v<Member, mpm::Vec3>) {
    member = std::get<mpm::Vec3>(value);
  } else {
    const mpm::Vec3& vector = std::get<mpm::Vec3>(value);
    member.x = vector.x();
    member.y = vector.y();
    member.z = vector.z();
  }
}

template <class Access>
Field(const char*, Access) -> Field<Access>;

/// In place of a member: there is none.
struct Nothing {};

/// A list is for one kind of report and of message.
template <class Report, class Message>
class Quantity {
 public:
  /// `report`, `message`: the member, a function that works the value out of others, or Nothing. `column`: in CSV
  /// tables, of a vector what stands before x, y, z; empty: in none.
  template <class InReport, class InMessage>
  Quantity(std::string name, std::string unit, Over over, InReport report, InMessage message, std::string column,
           std::string meaning, std::vector<Figure> figures = {})
      : name(std::move(name)),
        unit(std::move(unit)),
        over(over),
        column(std::move(column)),
        meaning(std::move(meaning)),
        figures(std::move(figures)) {
    bind(report, of_report, set_report);
    bind(message, of_message, set_message);
    if constexpr (std::is_same_v<InMessage, Nothing>) {
      bind_value();
    } else if constexpr (!std::is_invocable_v<InMessage, const Message&>) {
      message_field = message.path;
    }
  }
  /// Makes it a quantity of axisymmetric scenes alone, with components r and z.
  Quantity ring() && {
    axisymmetric = true;
    return std::move(*this);
  }
  /// Two runs that do the same differ in it.
  Quantity not_compared() && {
    compared = false;
    return std::move(*this);
  }

  std::string name, unit;
  Over over;
  std::string column, meaning;
  std::string message_field;  ///< empty: it is among `values`, or worked out
  std::vector<Figure> figures;
  bool axisymmetric = false;
  bool compared = true;                                   ///< by --same
  std::function<Value(const Report&)> of_report;          ///< empty: the solver does not know it
  std::function<void(Report&, const Value&)> set_report;  ///< empty: worked out
  std::function<Value(const Message&)> of_message;
  std::function<void(Message&, const Value&)> set_message;  ///< empty: worked out

 private:
  template <class Owner, class Source>
  static void bind(const Source& source, std::function<Value(const Owner&)>& get,
                   std::function<void(Owner&, const Value&)>& set) {
    if constexpr (std::is_invocable_v<Source, const Owner&>) {
      get = source;
    } else if constexpr (!std::is_same_v<Source, Nothing>) {
      get = [source](const Owner& owner) { return value_of(source.at(owner)); };
      set = [source](Owner& owner, const Value& value) { assign(source.at(owner), value); };
    }
  }
  void bind_value() {
    of_message = [name = name](const Message& message) -> Value {
      for (const NamedValue& one : message.values) {
        if (one.name == name && one.value.size() == 3) return mpm::Vec3(one.value[0], one.value[1], one.value[2]);
        if (one.name == name && one.value.size() == 1) return one.value[0];
      }
      return 0.0;
    };
    set_message = [name = name, unit = unit](Message& message, const Value& value) {
      NamedValue& one = message.values.emplace_back();
      one.name = name;
      one.unit = unit;
      if (const mpm::Vec3* vector = std::get_if<mpm::Vec3>(&value)) {
        one.value = {vector->x(), vector->y(), vector->z()};
      } else {
        one.value = {std::get<double>(value)};
      }
    };
  }
};

/// Fills the message with all that the report knows.
template <class Report, class Message>
void fill(Message& message, const Report& report, const std::vector<Quantity<Report, Message>>& quantities) {
  for (const Quantity<Report, Message>& one : quantities) {
    if (one.of_report && one.set_message) one.set_message(message, one.of_report(report));
  }
}

/// The values of a message that has any.
template <class Message>
auto values_in(const Message& message, int) -> decltype((message.values)) {
  return message.values;
}
template <class Message>
std::vector<NamedValue> values_in(const Message&, long) {
  return {};
}

/// Those of the message's values that the list does not describe: what a module of the solver brings by a name of its
/// own.
template <class Report, class Message>
std::vector<NamedValue> others(const Message& message, const std::vector<Quantity<Report, Message>>& quantities) {
  std::vector<NamedValue> found;
  for (const NamedValue& value : values_in(message, 0)) {
    const auto named = [&value](const auto& one) { return one.name == value.name; };
    if (std::none_of(quantities.begin(), quantities.end(), named)) found.push_back(value);
  }
  return found;
}

}  // namespace mpm_ros
