// The data of one material at a node that it shares with others, from which contact between materials is computed.
//
// Source: method reference 8.1 to 8.4; manual, MultiMaterialMode.
#pragma once

#include <array>

#include "mpm/grid/grid_layout.hpp"
#include "mpm/math/geometry.hpp"

namespace mpm {

struct NodeMaterial {
  double mass = 0.0;                 ///< m_i [kg]
  Vec3 velocity = Vec3::Zero();      ///< [m/s]
  double volume = 0.0;               ///< sum of V_p S, as deformed [m^3]; about an axis areas of sections [m^2]
  double start_volume = 0.0;         ///< the same, undeformed, with its mirror images; only if asked for
  Vec3 gradient = Vec3::Zero();      ///< sum of V_p G: out of the material [m^2]; about an axis of areas [m]
  Vec3 place = Vec3::Zero();         ///< sum of m x S over m; or of displacements, as the detection asks for [m]
  Vec3 displacement = Vec3::Zero();  ///< displacement at the node itself since the start; only if asked for [m]
  bool rigid = false;                ///< its motion is prescribed, whatever pushes

  Vec3 momentum() const { return mass * velocity; }
};

/// Reduced mass of two materials at the node, one of which may be rigid: m_a m_b / (m_a + m_b) [kg].
inline double reduced_mass(const NodeMaterial& a, const NodeMaterial& b) {
  if (a.rigid) return b.mass;
  if (b.rigid) return a.mass;
  return a.mass * b.mass / (a.mass + b.mass);
}

/// Two materials as one: masses, volumes and gradients are summed, velocities and places averaged by mass.
inline NodeMaterial lumped(const NodeMaterial& a, const NodeMaterial& b) {
  NodeMaterial sum;
  sum.mass = a.mass + b.mass;
  sum.velocity = (a.momentum() + b.momentum()) / sum.mass;
  sum.volume = a.volume + b.volume;
  sum.start_volume = a.start_volume + b.start_volume;
  sum.gradient = a.gradient + b.gradient;
  sum.place = (a.mass * a.place + b.mass * b.place) / sum.mass;
  sum.displacement = (a.mass * a.displacement + b.mass * b.displacement) / sum.mass;
  return sum;
}

/// Adds the mirror images of the material at a node on mirrors (Grid::mirrored): the gradient keeps no component across
/// them, and the undeformed volume, which minimum volumes are compared with, doubles with each. A gradient of which no
/// more than round-off is left becomes zero, for its direction would be arbitrary. Nairn & Guilkey (2015) section 3.3.
inline void mirror(NodeMaterial& material, const GridLayout& layout, const std::array<bool, 3>& across) {
  constexpr double kRoundOff = 1e-9;
  const double before = material.gradient.norm();
  for (int k = 0; k < layout.dim(); ++k) {
    if (!across[k]) continue;
    material.gradient[layout.axis(k)] = 0.0;
    material.start_volume *= 2.0;
  }
  if (material.gradient.norm() <= kRoundOff * before) material.gradient.setZero();
}

}  // namespace mpm
