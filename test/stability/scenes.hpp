// Scenes of the atlas, defined in code: a plane-strain domain, blocks and disks on the lattice of the grid, and tools
// that are boxes. Cell, density and stiffness are plain numbers, so that a test can be stated in cells and wave speeds.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "mpm/math/constants.hpp"
#include "mpm/simulation/simulation.hpp"

namespace stability {

using mpm::Vec3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
using mpm::kPi;
constexpr double kCell = 0.1;         ///< [m]
constexpr double kDensity = 1000.0;   ///< [kg/m^3]
constexpr double kWaveSpeed = 100.0;  ///< speed of pressure waves, unless a scene has another [m/s]

/// Young's modulus [Pa] of a material whose pressure waves travel at `speed` [m/s].
inline double young_of(double poisson, double speed = kWaveSpeed) {
  return kDensity * speed * speed * (1.0 + poisson) * (1.0 - 2.0 * poisson) / (1.0 - poisson);
}
inline mpm::LawDefinition neo_hookean(double poisson, double speed = kWaveSpeed) {
  return mpm::NeoHookeanDefinition{{young_of(poisson, speed), poisson}};
}
inline mpm::LawDefinition linear_elastic(double poisson, double speed = kWaveSpeed) {
  return mpm::LinearElasticDefinition{{young_of(poisson, speed), poisson}};
}

/// An empty domain of cells of kCell, plane strain, in cells; sync points every `sync` [s].
inline mpm::SimulationDefinition domain(const mpm::MethodDefinition& method, const Vec3& low, const Vec3& high,
                                        double sync) {
  mpm::SimulationDefinition d;
  d.name = "stability";
  d.geometry = mpm::GeometryKind::plane_strain;
  d.grid = {Vec3::Constant(kCell), kCell * low, kCell * high};
  d.method = method;
  d.time.sync = std::llround(sync * 1e9);
  return d;
}

/// Adds a body whose particles lie on a lattice between `low` and `high` [cells], where `inside` is true; `velocity` is
/// a function of position [m/s].
inline void add_body(mpm::SimulationDefinition& d, const std::string& name, const Vec3& low, const Vec3& high,
                     const mpm::LawDefinition& law, const std::function<Vec3(const Vec3&)>& velocity = {},
                     const std::function<bool(const Vec3&)>& inside = {}) {
  d.materials.push_back({name, kDensity, law});
  mpm::DeformableBody body;
  body.name = body.material = name;
  const double spacing = 1.0 / d.method.particles_per_direction;
  const auto nx = std::llround((high.x() - low.x()) / spacing), nz = std::llround((high.z() - low.z()) / spacing);
  for (long long i = 0; i < nx; ++i) {
    for (long long k = 0; k < nz; ++k) {
      const Vec3 place = kCell * Vec3(low.x() + (i + 0.5) * spacing, 0.0, low.z() + (k + 0.5) * spacing);
      if (inside && !inside(place)) continue;
      body.positions.push_back(place);
      if (velocity) body.velocities.push_back(velocity(place));
    }
  }
  body.particle_volume = kCell * spacing * kCell * spacing * d.thickness;
  d.bodies.push_back(body);
}

/// A box that is infinite along y, with its edges in cells.
inline mpm::RigidBodyDefinition box(const std::string& name, const Vec3& low, const Vec3& high,
                                    const Vec3& velocity = Vec3::Zero()) {
  mpm::RigidBodyDefinition body;
  body.name = name;
  body.surface = mpm::make_box({kCell * (high.x() - low.x()), kInfinity, kCell * (high.z() - low.z())});
  body.pose.position = 0.5 * kCell * (low + high);
  for (int k = 0; k < 3; ++k) body.velocity[k] = mpm::Function(velocity[k]);
  return body;
}

inline void wall(mpm::SimulationDefinition& d, const std::vector<std::string>& faces, mpm::WallKind kind) {
  for (const std::string& face : faces) {
    for (int i = 0; i < 6; ++i) {
      if (face == mpm::kWallNames[i]) d.walls[i].kind = kind;
    }
  }
}

inline std::vector<double> field(const mpm::Simulation& simulation, const std::string& name) {
  std::vector<double> values;
  simulation.particle_field(name, values);
  return values;
}
inline double seconds(const mpm::Simulation& simulation) { return 1e-9 * static_cast<double>(simulation.time()); }

/// The value between `holds` and `breaks` at which `stable` changes, to the relative accuracy `relative`.
inline double breaking_point(double holds, double breaks, double relative, const std::function<bool(double)>& stable) {
  while (std::abs(breaks - holds) > relative * holds) {
    const double middle = 0.5 * (holds + breaks);
    (stable(middle) ? holds : breaks) = middle;
  }
  return 0.5 * (holds + breaks);
}

}  // namespace stability
