// Robots as a module: how fast their links may move in a step, their energies and their state. Their motion within a
// step is the run's own, as that of rigid bodies is.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "mpm/definition/definition.hpp"
#include "mpm/modules/shipped_modules.hpp"

namespace mpm {
namespace {

class RobotModule final : public Module {
 public:
  RobotModule(std::vector<std::unique_ptr<Robot>>& robots, const std::vector<RigidBody>& bodies) : robots_(robots) {
    for (std::size_t r = 0; r < robots_.size(); ++r) {
      const auto& contacts = robots_[r]->definition().contacts;
      for (std::size_t c = 0; c < contacts.size(); ++c) {
        const auto body = std::find_if(bodies.begin(), bodies.end(),
                                       [&](const RigidBody& other) { return other.name() == contacts[c].body; });
        links_.push_back({robots_[r].get(), c, &*body});
      }
    }
  }
  std::string name() const override { return "robots"; }
  bool same_on_all_ranks() const override { return true; }

  void energies(EnergyReport& report) const override {
    for (const auto& robot : robots_) {
      const RobotEnergies& of = robot->energies();
      report.add("robot_kinetic", NamedEnergy::Kind::of_bodies, of.kinetic);
      report.add("robot_potential", NamedEnergy::Kind::of_bodies, of.potential);
      report.add("robot_drive", NamedEnergy::Kind::at_bodies, of.drive);
      report.add("robot_joints", NamedEnergy::Kind::at_bodies, of.damping + of.friction + of.limit);
      report.add("robot_loss", NamedEnergy::Kind::at_bodies, of.loss);
      report.add("robot_set", NamedEnergy::Kind::at_bodies, of.set);
    }
  }
  void limit_step(const PeriodAhead& period, StepLimit& limit) const override {
    for (std::size_t l = 0; l < links_.size(); ++l) {
      StepLimit own;
      own.by = this;
      own.part = static_cast<int>(l);
      for (const double part : {0.0, 0.5, 1.0}) {
        const double gained = part * period.length * links_[l].body->link_motion()->unprescribed_acceleration(0.0);
        const Robot& robot = *links_[l].robot;
        own.speed = std::max(own.speed, gained + robot.largest_speed(links_[l].contact, period.start,
                                                                     part * period.length, period.length));
      }
      own.dt = period.reach() / own.speed;
      if (own.speed > 0.0) limit.tighten(own);
    }
  }
  void at_sync(std::int64_t time) override {
    for (const auto& robot : robots_) robot->at_sync(time);
  }
  std::string limit_text(const StepLimit& limit) const override {
    return fmt::format("speed of '{}' ({:.4g} m/s)", links_[limit.part].body->name(), limit.speed);
  }
  void serialise(StateArchive& archive) override {
    for (std::size_t r = 0; r < robots_.size(); ++r) {
      const StateArchive::Group group(archive, "robot_" + std::to_string(r));
      robots_[r]->serialise(archive);
    }
  }
  void hashed(std::vector<double>& numbers) const override {
    for (const auto& robot : robots_) robot->hashed(numbers);
  }

 private:
  struct Link {
    const Robot* robot;
    std::size_t contact;
    const RigidBody* body;
  };
  std::vector<std::unique_ptr<Robot>>& robots_;
  std::vector<Link> links_;
};

}  // namespace

void add_robots(RunParts& parts) {
  if (parts.robots.empty()) return;
  parts.modules.add(std::make_unique<RobotModule>(parts.robots, parts.bodies));
}

}  // namespace mpm
