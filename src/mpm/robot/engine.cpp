#include "mpm/robot/engine.hpp"

namespace mpm {
namespace {

MakeRobotEngine& registered() {
  static MakeRobotEngine make = nullptr;
  return make;
}

}  // namespace

MakeRobotEngine robot_engine() { return registered(); }
void set_robot_engine(MakeRobotEngine make) { registered() = make; }

}  // namespace mpm
