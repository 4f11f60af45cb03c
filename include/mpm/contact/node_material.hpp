// One material at one node of the grid that it shares with others: what contact between materials is computed from.
//
// Source: method reference 8.1 to 8.4; manual, MultiMaterialMode.
#pragma once

#include <array>

#include "mpm/math/geometry.hpp"

namespace mpm {

struct NodeMaterial {
  double mass = 0.0;                 ///< m_i [kg]
  Vec3 velocity = Vec3::Zero();      ///< [m/s]
  double volume = 0.0;               ///< sum of V_p S, as deformed [m^3]; about an axis areas of sections [m^2]
  double start_volume = 0.0;         ///< the same, undeformed, on both sides of planes of symmetry; where asked for
  Vec3 gradient = Vec3::Zero();      ///< sum of V_p G: out of the material [m^2]; about an axis of areas [m]
  Vec3 place = Vec3::Zero();         ///< sum of m x S over m; or of displacements, as the detection asks for [m]
  Vec3 displacement = Vec3::Zero();  ///< since the start, of the material at the node itself; where asked for [m]
  bool rigid = false;                ///< moves as it is told, whatever pushes

  Vec3 momentum() const { return mass * velocity; }
};

/// Of two at the node, one of which may be rigid: m_a m_b / (m_a + m_b) [kg].
inline double reduced_mass(const NodeMaterial& a, const NodeMaterial& b) {
  if (a.rigid) return b.mass;
  if (b.rigid) return a.mass;
  return a.mass * b.mass / (a.mass + b.mass);
}

/// Both as one material: masses, volumes and gradients add, velocities and places are means by mass.
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

/// At a node on planes of symmetry (world axes that they are normal to; the axis of revolution is one): the gradient
/// has no part across, and half of the undeformed volume, which minimum volumes are held against, lies beyond. Nairn &
/// Guilkey (2015) section 3.3.
inline void mirror(NodeMaterial& material, const std::array<bool, 3>& planes) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!planes[axis]) continue;
    material.gradient[axis] = 0.0;
    material.start_volume *= 2.0;
  }
}

}  // namespace mpm
