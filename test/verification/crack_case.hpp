// Helpers that the tests of explicit cracks share: the material of the crack reference, loads that grow smoothly to a
// constant, and what the tips report.
//
// Displacements are so small (strain of 1e-5) that exact solutions of small strain hold. Loads grow as half a wave of a
// cosine within 0.6 periods of the slowest vibration, which grid damping near its critical rate takes out.
#pragma once

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "mpm/math/constants.hpp"
#include "mpm/scene/scene.hpp"
#include "scene_run.hpp"

namespace verification {
namespace crack_case {

constexpr double kHalfTurn = mpm::kPi;
constexpr double kDegree = kHalfTurn / 180.0;
constexpr double kYoung = 2500e6, kPoisson = 0.33;             // crack reference 7 [Pa]
constexpr double kPlane = kYoung / (1 - kPoisson * kPoisson);  // E' [Pa]
constexpr double kDensity = 1000.0, kBarSpeed = 1581.14;       // [kg/m^3], sqrt(E / density) [m/s]

/// Head of a scene, with lengths in metres; `fracture`: further keys of the material.
inline std::string head(double cell, const std::vector<double>& box, double end, double sync, double damping,
                        const std::string& fracture = {}) {
  return fmt::format(
      "geometry: plane_strain\nthickness: 0.001\n"
      "grid: {{cell: {:.12g}, min: [{:.12g}, {:.12g}], max: [{:.12g}, {:.12g}]}}\n"
      "time: {{end: {:.9g}, cfl: 0.6, sync: {:.9g}}}\n"
      "method: {{shape: ugimp, update: usavg, transfer: flip, particles_per_cell: 4, damping: {{grid: {:.6g}}}}}\n"
      "materials: [{{name: polymer, law: linear_elastic, density: {}, young: {}, poisson: {}{}}}]\n",
      cell, box[0], box[1], box[2], box[3], end, sync, damping, kDensity, kYoung, kPoisson, fracture);
}

/// A value that grows from 0 within `ramp` [s] and then stays.
inline std::string ramped(double value, double ramp) {
  return fmt::format("\"{:.12g}*(t < {:.12g} ? 0.5-0.5*cos(3.14159265358979*t/{:.12g}) : 1)\"", value, ramp, ramp);
}

/// A traction along z on a face of the body; `region`: of the face, empty for all of it.
inline std::string traction(const std::string& edge, const std::string& value, const std::string& region = {}) {
  return fmt::format("  - {{traction: {{body: plate, edge: {}, {}traction: [0, {}]}}}}\n", edge,
                     region.empty() ? "" : "region: {box: {" + region + "}}, ", value);
}

inline std::string body(double x0, double z0, double x1, double z1) {
  return fmt::format(
      "bodies: [{{name: plate, material: polymer, shape: {{box: {{min: [{:.12g}, {:.12g}], max: [{:.12g}, "
      "{:.12g}]}}}}}}]\n",
      x0, z0, x1, z1);
}

/// Time between sync points, whole nanoseconds, that divides a run of about `time` [s] into `parts`.
inline double sync_of(double time, int parts) { return 1e-9 * std::round(1e9 * time / parts); }

struct Tip {
  double j = 0.0, one = 0.0, two = 0.0, opening = 0.0;                       ///< [J/m^2], [Pa m^0.5], [m]
  double phase() const { return std::atan2(std::abs(two), one) / kDegree; }  ///< [degrees]
};

inline Tip tip(const mpm::Simulation& simulation, const std::string& end) {
  const auto of = [&](const char* name) { return number(simulation, "crack 1 " + end + " " + name); };
  Tip tip{of("j"), of("k_one"), of("k_two"), of("opening")};
  EXPECT_GT(tip.j, 0.0) << "no J at the " << end;
  return tip;
}

inline mpm::Simulation made(const std::string& text) {
  return mpm::Simulation(mpm::build(mpm::parse_scene(text, "crack")), {1});
}

}  // namespace crack_case
}  // namespace verification
