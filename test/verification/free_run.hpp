// What the verification of free rigid bodies shares: scenes as text, and what their bodies do.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "scene_run.hpp"

namespace verification {

constexpr double kGravity = 9.81;  // [m/s^2]

/// A simulation of a scene given as text.
inline mpm::Simulation run_of(const std::string& text, const std::vector<std::string>& overrides = {},
                              int threads = 1) {
  return mpm::Simulation(mpm::build(mpm::parse_scene(text, "free.yaml", overrides)), {threads});
}

/// How far a free body's momentum is from the sum of what it was given, over the sum of the magnitudes; angular
/// momentum over that of the linear parts at an arm of 0.1 m as well, since torques of a symmetric body cancel.
inline double imbalance(const mpm::FreeBodyReport& body) {
  const auto part = [&](mpm::Vec3 mpm::BodyMomentum::*of, double least) {
    const mpm::Vec3 change = body.momentum.*of - body.initial_momentum.*of;
    const mpm::Vec3 given = body.contact.*of + body.gravity.*of + body.wrench.*of + body.drive.*of;
    const double scale = least + (body.momentum.*of).norm() + (body.contact.*of).norm() + (body.gravity.*of).norm() +
                         (body.wrench.*of).norm() + (body.drive.*of).norm();
    return scale > 0.0 ? (change - given).norm() / scale : 0.0;
  };
  const double exchanged = body.contact.linear.norm() + body.gravity.linear.norm();
  return std::max(part(&mpm::BodyMomentum::linear, 0.0), part(&mpm::BodyMomentum::angular, 0.1 * exchanged));
}

/// Bodies and material together, and what contact, sliding and flow took from them, less what was done on them [J].
inline double accounted(const mpm::EnergyReport& e) {
  return e.whole() + e.plastic + e.friction + e.free_loss - e.free_work - e.load_work;
}

}  // namespace verification
