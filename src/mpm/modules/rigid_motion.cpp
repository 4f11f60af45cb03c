// Rigid bodies as a module: how fast they may move in a step, the energies of those that are free, where they may not
// be. Their motion within a step is the run's own, for it comes before everything else.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "mpm/boundary/periodic.hpp"
#include "mpm/definition/definition.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/modules/shipped_modules.hpp"

namespace mpm {
namespace {

class RigidMotion final : public Module {
 public:
  RigidMotion(std::vector<RigidBody>& bodies, const SimulationDefinition& definition, const GridLayout& layout)
      : bodies_(bodies), definition_(definition), layout_(layout) {
    for (const RigidBody& body : bodies_) check_periodic(body);
  }
  std::string name() const override { return "rigid_bodies"; }
  bool same_on_all_ranks() const override { return true; }

  void energies(EnergyReport& report) const override {
    for (const RigidBody& body : bodies_) {
      const FreeMotion* free = body.free_motion();
      if (free == nullptr) continue;
      const FreeBodyReport of = free->report(body.name(), definition_.gravity);
      report.add("free_kinetic", NamedEnergy::Kind::of_bodies, of.kinetic);
      report.add("free_potential", NamedEnergy::Kind::of_bodies, of.potential);
      report.add("free_work", NamedEnergy::Kind::at_bodies, of.wrench_work + of.drive_work);
      report.add("free_loss", NamedEnergy::Kind::at_bodies, of.contact_loss);
      report.add("free_set", NamedEnergy::Kind::at_bodies, of.set_work);
    }
  }
  void limit_step(const PeriodAhead& period, StepLimit& limit) const override {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (bodies_[b].link_motion() != nullptr) continue;  // its robot says how fast it may become
      StepLimit own;
      own.by = this;
      own.part = static_cast<int>(b);
      for (const double part : {0.0, 0.5, 1.0}) {
        own.speed = std::max(own.speed, largest_speed(bodies_[b], period.start, part * period.length));
      }
      own.dt = period.reach() / own.speed;
      if (own.speed > 0.0) limit.tighten(own);
    }
  }
  std::string limit_text(const StepLimit& limit) const override {
    return fmt::format("speed of '{}' ({:.4g} m/s)", bodies_[limit.part].name(), limit.speed);
  }
  void at_sync(std::int64_t time) override {
    for (RigidBody& body : bodies_) {
      body.at_sync(time);
      check_periodic(body);
    }
  }
  void serialise(StateArchive& archive) override {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const StateArchive::Group group(archive, "body_" + std::to_string(b));
      bodies_[b].serialise(archive);
    }
  }
  void hashed(std::vector<double>& numbers) const override {
    for (const RigidBody& body : bodies_) {
      for (int k = 0; k < 3; ++k) numbers.push_back(body.pose().position[k]);
      for (int k = 0; k < 4; ++k) numbers.push_back(body.pose().orientation.coeffs()[k]);
      if (body.free_motion() == nullptr) continue;
      for (int k = 0; k < 3; ++k) numbers.push_back(body.twist().linear[k]);
      for (int k = 0; k < 3; ++k) numbers.push_back(body.twist().angular[k]);
    }
  }

 private:
  /// @throws RigidError for a body at a periodic face
  void check_periodic(const RigidBody& body) const;
  /// Largest speed of the body's surface, `ahead` [s] after `start` [s]; [m/s]
  double largest_speed(const RigidBody& body, double start, double ahead) const;

  std::vector<RigidBody>& bodies_;
  const SimulationDefinition& definition_;
  const GridLayout& layout_;
};

void RigidMotion::check_periodic(const RigidBody& body) const {
  const std::string face = periodic_face_reached(body, layout_);
  if (face.empty()) return;
  throw RigidError(
      fmt::format("rigid body '{}' comes to within a cell and a half of {}, which is periodic, and rigid bodies do not "
                  "go around; keep it away from there, make it endless along {}, or use walls",
                  body.name(), face, face[0]));
}

// Speed of the body's origin plus what its rotation adds at its farthest corner. A body without end ends with the
// domain, `domain` long, and does not count along an axis that the grid does not have. With what the motion that nobody
// prescribes may gain in `ahead` [s].
double RigidMotion::largest_speed(const RigidBody& body, double start, double ahead) const {
  Vec3 domain = definition_.grid.max - definition_.grid.min;
  for (const int axis : axes_beside(definition_.geometry)) domain[axis] = 0.0;
  const Box bounds = body.surface().bounds();
  Vec3 corner = bounds.min.cwiseAbs().cwiseMax(bounds.max.cwiseAbs());
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(corner[k])) corner[k] = domain[k] > 0.0 ? domain.norm() : 0.0;
  }
  const Twist twist = body.twist_at(start + ahead);
  const BodyMotion& motion = body.motion();
  return motion.spread(body.pose()) * twist.linear.norm() + twist.angular.norm() * corner.norm() +
         ahead * motion.unprescribed_acceleration(definition_.gravity.norm());
}

}  // namespace

void add_rigid_motion(RunParts& parts) {
  if (parts.bodies.empty()) return;
  parts.modules.add(std::make_unique<RigidMotion>(parts.bodies, parts.definition, parts.layout()));
}

}  // namespace mpm
