#include "mpm_ros/report/report_momentum.hpp"

#include <fmt/format.h>

#include <cmath>
#include <new>
#include <numeric>

#include "mpm/math/error.hpp"
#include "mpm/math/nanoseconds.hpp"
#include "mpm/shape/ring.hpp"
#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/report/report_cloud.hpp"

namespace mpm_ros {
namespace {

constexpr double kHalfUnit = 1.0 / (1 << 24);  // a velocity is rounded to a float32: relative error at most 2^-24
const char* const kVelocities[] = {"vx", "vy", "vz"};

}  // namespace

MomentumCheck::MomentumCheck(const std::optional<RunInfo>& info) {
  if (!info || info->scene_text.empty()) {
    obstacle_ = "the bag has no scene, from which the particles' masses are known";
    return;
  }
  try {
    const SceneFacts facts = scene_facts(*info);
    if (facts.ground_follows) {
      obstacle_ = "the scene's ground follows bodies, so that particles come and go between the clouds";
      return;
    }
    masses_ = particle_masses(*info);
    gravity_ = facts.gravity;
    audit_limit_ = audit_limit(facts.precision);
  } catch (const mpm::Error& error) {
    obstacle_ = fmt::format("the particles' masses are not known: {}", error.what());
    return;
  } catch (const std::bad_alloc&) {
    obstacle_ = "there is not enough memory to make the scene's particles, whose masses it needs";
    return;
  }
  total_mass_ = std::accumulate(masses_.begin(), masses_.end(), 0.0);
}

void MomentumCheck::contact_forces(std::int64_t time, const ContactForces& message) {
  contact_time_ = time;
  for (const ContactForce& body : message.bodies) {
    // In an axisymmetric scene what is exchanged outwards cancels in the force, but not in the sum of m v_r.
    const mpm::Vec3 outwards(mpm::kTurn * body.per_radian.x, 0.0, 0.0);
    on_bodies_ += (from_message(body.wrench.force) + outwards) * body.interval;
  }
  compare();
}

void MomentumCheck::solver_state(std::int64_t time, const SolverState& message) {
  state_ = message;
  state_time_ = time;
  compare();
}

std::optional<MomentumCheck::Sums> MomentumCheck::sums_of(const sensor_msgs::PointCloud2& cloud) {
  const CloudField ids(cloud, "id");
  if (!ids.found() || ids.size() != masses_.size()) {
    obstacle_ = fmt::format("the clouds hold {} of {} particles", ids.found() ? ids.size() : 0, masses_.size());
    return std::nullopt;
  }
  Sums sums;
  axes_.clear();
  for (int axis = 0; axis < 3; ++axis) {
    const CloudField velocity(cloud, kVelocities[axis]);
    if (!velocity.found()) continue;
    axes_ += static_cast<char>('x' + axis);
    for (std::size_t particle = 0; particle < masses_.size(); ++particle) {
      const auto id = static_cast<std::uint64_t>(ids.at(particle));
      if (id >= masses_.size()) {
        obstacle_ = fmt::format("a particle has the number {}, where the scene makes {}", id, masses_.size());
        return std::nullopt;
      }
      const double momentum = masses_[id] * velocity.at(particle);
      sums.momentum[axis] += momentum;
      sums.size[axis] += std::abs(momentum);
    }
  }
  if (axes_.empty()) {
    obstacle_ = "no velocity is recorded; add vx, vy, vz to output.particle_fields";
    return std::nullopt;
  }
  return sums;
}

void MomentumCheck::particles(std::int64_t time, const sensor_msgs::PointCloud2& message) {
  if (!obstacle_.empty()) return;
  const std::optional<Sums> sums = sums_of(message);
  if (!sums) return;
  cloud_ = Account{time, *sums, mpm::Vec3::Zero(), mpm::Vec3::Zero()};
  compare();
}

void MomentumCheck::compare() {
  if (!cloud_ || !state_ || state_time_ != cloud_->time || contact_time_ != cloud_->time) return;
  Account now = *cloud_;
  cloud_.reset();
  now.on_bodies = on_bodies_;
  for (const Impulse& impulse : state_->impulses) {
    if (impulse.name != "gravity" && impulse.name.rfind("contact/", 0) != 0) {
      now.others += from_message(impulse.impulse);
    }
  }
  if (!first_) {
    first_ = now;
    return;
  }
  const mpm::Vec3 weight = total_mass_ * mpm::nearest_seconds(now.time - first_->time) * gravity_;
  const mpm::Vec3 expected = weight + (now.others - first_->others) - (now.on_bodies - first_->on_bodies);
  const mpm::Vec3 found = now.sums.momentum - first_->sums.momentum;
  for (const char name : axes_) {
    const int axis = name - 'x';
    const double residual = std::abs(found[axis] - expected[axis]);
    const double allowed =
        kHalfUnit * (now.sums.size[axis] + first_->sums.size[axis]) + audit_limit_ * state_->momentum_exchanged;
    const double scale = state_->momentum_exchanged > 0.0 ? state_->momentum_exchanged : 1.0;
    if (residual / scale > worst_) {
      worst_ = residual / scale;
      rounding_ = allowed / scale;
    }
    if (!(residual <= allowed) && failure_.empty()) {
      failure_ = fmt::format(
          "at {} s: the particles' momentum along {} has changed by {:.6g} N s, forces, weight and walls give {:.6g} "
          "N s",
          mpm::nearest_seconds(now.time), name, found[axis], expected[axis]);
    }
  }
  ++checked_;
}

CheckResult MomentumCheck::result() const {
  CheckResult result;
  result.name = "momentum";
  if (!failure_.empty()) {
    result.passed = false;
    result.detail = failure_;
  } else if (!obstacle_.empty() || checked_ == 0) {
    result.made = false;
    result.detail = obstacle_.empty() ? "no two particle snapshots at the time of a state" : obstacle_;
  } else {
    result.detail = fmt::format(
        "along {}, {} snapshots: particles moved as forces, weight and walls say, within {:.2g} of the momentum "
        "exchanged (rounding of the recorded velocities allows {:.2g})",
        axes_, checked_, worst_, rounding_);
  }
  return result;
}

}  // namespace mpm_ros
