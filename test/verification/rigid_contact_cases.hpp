// Helpers for the verification of contact with rigid bodies: planar scenes with a surface at any angle to the grid, and
// measurements in them. Lengths are in metres, forces in N on 1 m of thickness.
//
// Each case runs with both methods of contact. Contact at points must meet what is asked; contact at nodes, which does
// not resolve the gap, is checked for the accuracy that it reaches.
#pragma once

#include <fmt/core.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "mpm/math/constants.hpp"
#include "page.hpp"
#include "scene_run.hpp"

namespace verification {

using mpm::kPi;
constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr double kGravity = 9.81;  // [m/s^2]

/// A method of contact with rigid bodies.
struct ContactMethod {
  std::string name;
  std::function<void(mpm::SimulationDefinition&)> choose;
  bool at_nodes = true;  ///< contact is felt up to a cell early, so some limits are wider
};
inline std::vector<ContactMethod> contact_methods() {
  return {{"points", [](mpm::SimulationDefinition& d) { d.contact.method = mpm::ContactMethod::points; }, false},
          {"nodes", [](mpm::SimulationDefinition& d) { d.contact.method = mpm::ContactMethod::nodes; }, true}};
}

/// Prints a row of the page.
inline void say(const std::string& quantity, double reached, double exact, const std::string& unit) {
  fmt::print("{:<64} {:>11.5g}   exact {:>9.4g} {}\n", quantity, reached, exact, unit);
}

/// A surface that is turned clockwise by `angle` against the grid's x axis; its +x points down the slope.
struct Slope {
  double angle = 0.0;  ///< [rad]
  mpm::Vec3 along() const { return {std::cos(angle), 0.0, -std::sin(angle)}; }
  mpm::Vec3 normal() const { return {std::sin(angle), 0.0, std::cos(angle)}; }
  /// Gravity on an incline of `steepness` [rad].
  mpm::Vec3 gravity(double steepness) const {
    return kGravity * (std::sin(steepness) * along() - std::cos(steepness) * normal());
  }
  mpm::Vec3 place(double s, double n) const { return s * along() + n * normal(); }
  mpm::Quat orientation() const { return mpm::Quat(Eigen::AngleAxisd(angle, mpm::Vec3::UnitY())); }
};

/// A planar scene of neo-Hookean rubber, without gravity or bodies.
inline mpm::SimulationDefinition rubber_scene(const ContactMethod& method, double cell, double young, double sync) {
  mpm::SimulationDefinition d;
  d.name = "rigid contact";
  d.geometry = mpm::GeometryKind::plane_strain;
  d.grid.cell = mpm::Vec3::Constant(cell);
  d.time.sync = std::llround(1e9 * sync);
  d.materials = {{"rubber", 1000.0, mpm::NeoHookeanDefinition{{young, 0.3}}}};
  method.choose(d);
  return d;
}

/// Sets the domain from `low` to about `high` in whole cells, with the first node at `low`.
inline void set_domain(mpm::SimulationDefinition& d, const mpm::Vec3& low, const mpm::Vec3& high) {
  const double cell = d.grid.cell.x();
  d.grid.min = low;
  d.grid.max = low + cell * ((high - low) / cell).array().ceil().matrix();
}

/// Adds a body with particles at `places`, each of the area `area` in the plane, that moves at `velocity`.
inline void add_particles(mpm::SimulationDefinition& d, const std::string& name, std::vector<mpm::Vec3> places,
                          double area, const mpm::Vec3& velocity = mpm::Vec3::Zero()) {
  mpm::DeformableBody body;
  body.name = name;
  body.material = "rubber";
  body.velocities.assign(places.size(), velocity);
  body.positions = std::move(places);
  body.particle_volume = area * d.thickness;
  d.bodies.push_back(std::move(body));
}

/// Points of a lattice along the slope, over its rectangle from (0, 0) to (length, height).
inline std::vector<mpm::Vec3> turned_lattice(const Slope& slope, double length, double height, double spacing) {
  std::vector<mpm::Vec3> places;
  for (double s = 0.5 * spacing; s < length; s += spacing) {
    for (double n = 0.5 * spacing; n < height; n += spacing) places.push_back(slope.place(s, n));
  }
  return places;
}

/// Points of a lattice along the grid's axes within the same rectangle, whose lower side is a staircase of particles.
inline std::vector<mpm::Vec3> cut_lattice(const Slope& slope, double length, double height, double spacing) {
  std::vector<mpm::Vec3> places;
  const int reach = static_cast<int>((length + height) / spacing) + 2;
  for (int i = -reach; i <= reach; ++i) {
    for (int k = -reach; k <= reach; ++k) {
      const mpm::Vec3 place = spacing * mpm::Vec3(i + 0.5, 0.0, k + 0.5);
      const double s = place.dot(slope.along()), n = place.dot(slope.normal());
      if (s > 0.0 && s < length && n > 0.0 && n < height) places.push_back(place);
    }
  }
  return places;
}

/// A thick plate whose upper side is the slope through the origin.
inline mpm::RigidBodyDefinition plate(const Slope& slope, double friction, double length = 8.0, double depth = 0.5) {
  mpm::RigidBodyDefinition body;
  body.name = "plate";
  body.surface = mpm::make_box({length, kEndless, depth});
  body.pose = {-0.5 * depth * slope.normal(), slope.orientation()};
  body.friction.coefficient = friction;
  return body;
}

inline double mean_of(const mpm::Simulation& simulation, const std::string& name) {
  const std::vector<double> values = field(simulation, name);
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Mean component of a vector field along a direction of the plane: "v" means vx and vz, an empty name the position.
inline double mean_along(const mpm::Simulation& simulation, const std::string& name, const mpm::Vec3& direction) {
  return mean_of(simulation, name + "x") * direction.x() + mean_of(simulation, name + "z") * direction.z();
}

/// Angular velocity about y of a body of equal particles: its angular momentum over its moment of inertia [rad/s].
inline double spin(const mpm::Simulation& simulation) {
  const std::vector<double> x = field(simulation, "x"), z = field(simulation, "z"), vx = field(simulation, "vx"),
                            vz = field(simulation, "vz");
  const auto mean = [](const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
  };
  const double mx = mean(x), mz = mean(z), mvx = mean(vx), mvz = mean(vz);
  double momentum = 0.0, inertia = 0.0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    momentum += (z[p] - mz) * (vx[p] - mvx) - (x[p] - mx) * (vz[p] - mvz);
    inertia += std::pow(x[p] - mx, 2) + std::pow(z[p] - mz, 2);
  }
  return momentum / inertia;
}

/// Slope of the straight line that fits (x, y) by least squares.
inline double line_slope(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  const double mx = std::accumulate(x.begin(), x.end(), 0.0) / n, my = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xy = 0.0, xx = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mx) * (y[i] - my);
    xx += (x[i] - mx) * (x[i] - mx);
  }
  return xy / xx;
}

}  // namespace verification
