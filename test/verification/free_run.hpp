// Helpers for the verification of free rigid bodies: simulations of scenes given as text, and balances.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "scene_run.hpp"

namespace verification {

constexpr double kFreeGravity = 9.81;  // [m/s^2]

/// A simulation of a scene given as text.
inline mpm::Simulation run_of(const std::string& text, const std::vector<std::string>& overrides = {},
                              int threads = 1) {
  return mpm::Simulation(mpm::build(mpm::parse_scene(text, "free.yaml", overrides)), {threads});
}

/// Difference between a free body's momentum and the sum of its accounts, over the sum of their magnitudes. For angular
/// momentum the magnitudes include the linear parts at an arm of 0.1 m, since torques on a symmetric body cancel.
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

/// Energy of bodies and material, plus the energy dissipated by contact, friction and plastic flow, less the work done
/// on them [J].
inline double accounted(const mpm::EnergyReport& e) {
  return e.whole() + e.of("plastic") + e.of("friction") + e.of("free_loss") - e.of("free_work") - e.of("load_work");
}

}  // namespace verification
