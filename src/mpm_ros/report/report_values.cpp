#include "mpm_ros/report/report_values.hpp"

#include <strings.h>

#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/quantities.hpp"

namespace mpm_ros {
namespace {

class List {
 public:
  void number(const std::string& field, double value) { values_.push_back({field, field, value, {}}); }
  void word(const std::string& field, const std::string& value) { values_.push_back({field, field, 0.0, value}); }
  /// geometry_msgs/Vector3 or Point.
  template <typename Vector>
  void vector(const std::string& field, const Vector& value) {
    values_.push_back({field + " x", field, value.x, {}});
    values_.push_back({field + " y", field, value.y, {}});
    values_.push_back({field + " z", field, value.z, {}});
  }
  template <class Report, class Message>
  void numbers(const std::string& prefix, const Message& message,
               const std::vector<Quantity<Report, Message>>& quantities) {
    for (const Quantity<Report, Message>& one : quantities) {
      if (!one.compared) continue;
      const Value value = one.of_message(message);
      if (const mpm::Vec3* components = std::get_if<mpm::Vec3>(&value)) {
        vector(prefix + one.name, to_vector(*components));
      } else {
        number(prefix + one.name, std::get<double>(value));
      }
    }
    for (const NamedValue& value : others(message, quantities)) {
      for (const double component : value.value) number(prefix + value.name, component);
    }
  }
  void wrench(const std::string& field, const geometry_msgs::Wrench& value) {
    vector(field + " force", value.force);
    vector(field + " torque", value.torque);
  }
  void pose(const std::string& field, const geometry_msgs::Pose& value) {
    vector(field + " position", value.position);
    vector(field + " orientation", value.orientation);
    values_.push_back({field + " orientation w", field + " orientation", value.orientation.w, {}});
  }
  void twist(const std::string& field, const geometry_msgs::Twist& value) {
    vector(field + " velocity", value.linear);
    vector(field + " rotation rate", value.angular);
  }
  std::vector<ComparedValue> take() { return std::move(values_); }

 private:
  std::vector<ComparedValue> values_;
};

/// True for what the machine took, which is no part of the run. Names are as the scene writes them.
bool of_machine(const std::string& quantity) {
  return strcasecmp(quantity.c_str(), "elapsed time") == 0 || strcasecmp(quantity.c_str(), "cpu time") == 0;
}

}  // namespace

std::vector<ComparedValue> values_of(const ContactForces& message) {
  List list;
  for (const ContactForce& body : message.bodies) {
    list.word("name", body.name);
    list.numbers(body.name + " ", body, contact_quantities());
  }
  for (const ContactPair& pair : message.pairs) {
    list.word("name", pair.name);
    list.numbers(pair.name + " ", pair, pair_quantities());
  }
  return list.take();
}

std::vector<ComparedValue> values_of(const BodyStates& message) {
  List list;
  for (const BodyState& body : message.bodies) {
    list.word("name", body.name);
    list.pose(body.name, body.pose);
    list.twist(body.name, body.twist);
    list.number(body.name + " drive", body.drive);
    list.number(body.name + " mass", body.mass);
  }
  return list.take();
}

std::vector<ComparedValue> values_of(const SolverState& message) {
  List list;
  list.numbers("", message, state_quantities());
  list.word("dt_limited_by", message.dt_limited_by);
  for (const Impulse& impulse : message.impulses) {
    list.word("impulse", impulse.name);
    list.vector("impulse " + impulse.name, impulse.impulse);
  }
  list.number("failed", message.failed);
  list.word("failure", message.failure);
  list.word("state_hash", message.state_hash);
  return list.take();
}

std::vector<ComparedValue> values_of(const Command& message) {
  List list;
  list.word("body", message.body);
  list.number("kind", message.kind);
  list.twist(message.body, message.twist);
  list.wrench(message.body, message.wrench);
  list.pose(message.body, message.pose);
  list.number("effect_ns", static_cast<double>(message.effect_ns));
  list.number("arrival_ns", static_cast<double>(message.arrival_ns));
  return list.take();
}

std::vector<ComparedValue> values_of(const GlobalQuantities& message) {
  List list;
  for (std::size_t i = 0; i < message.names.size() && i < message.values.size(); ++i) {
    if (!of_machine(message.names[i])) list.number(message.names[i], message.values[i]);
  }
  return list.take();
}

std::vector<ComparedValue> values_of(const Cracks& message) {
  List list;
  for (const Crack& crack : message.cracks) {
    list.number(crack.name + " length", crack.length);
    list.number(crack.name + " open length", crack.open_length);
    for (std::size_t k = 0; k < crack.points.size(); ++k) {
      for (const auto& [what, place] : {std::pair{"", &crack.points[k]}, std::pair{" above", &crack.above.at(k)},
                                        std::pair{" below", &crack.below.at(k)}}) {
        list.number(crack.name + what + " x", place->x);
        list.number(crack.name + what + " z", place->z);
      }
      list.number(crack.name + " normal traction", crack.normal_traction.at(k));
      list.number(crack.name + " shear traction", crack.shear_traction.at(k));
    }
  }
  for (const CrackTip& tip : message.tips) {
    const std::string name = tip.crack + " " + tip.end + " ";
    list.numbers(name, tip, tip_quantities());
    list.word(name + "state", tip.state);
  }
  return list.take();
}

std::vector<ComparedValue> values_of(const RobotStates& message) {
  List list;
  for (const RobotState& robot : message.robots) {
    list.word("name", robot.name);
    list.pose(robot.name, robot.base);
    list.twist(robot.name, robot.base_twist);
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      const std::string joint = robot.name + "/" + robot.joints[j];
      list.number(joint + " position", robot.position.at(j));
      list.number(joint + " velocity", robot.velocity.at(j));
      list.number(joint + " effort", robot.effort.at(j));
      list.number(joint + " target", robot.target.at(j));
    }
    for (const JointWrench& sensor : robot.sensors) list.wrench(robot.name + "/" + sensor.joint, sensor.wrench);
    list.numbers(robot.name + " ", robot, robot_quantities());
  }
  return list.take();
}

}  // namespace mpm_ros
