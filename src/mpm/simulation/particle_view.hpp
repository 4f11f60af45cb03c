// One particle as particle fields look at it: tensors in world axes, made once for all fields that are read, and only
// those that one of them needs.
//
// Strain is logarithmic, ln V = 1/2 ln(F F^T), in the axes that Cauchy stress is in; at small strain it is the usual
// one. Strain that brings no stress, of heat or moisture, is a part for itself, alike along all axes; the law sees what
// is left. Of this the elastic part is what the law's elasticity makes of the stress, for laws that part the two; of
// the others all of it is. The plastic part is the rest: exact where both have the same axes, as in proportional
// loading, and to first order in the elastic strain elsewhere. A body that starts under stress has that stress's strain
// in its elastic part from the start, and its plastic part is less by it.
#pragma once

#include "state.hpp"

namespace mpm {

/// Parts that a view has to hold.
enum ViewNeeds : unsigned {
  kNeedsNothing = 0,    ///< nothing, or places and velocities, which are the set's
  kNeedsVolume = 1,     ///< j
  kNeedsStress = 2,     ///< cauchy, and j
  kNeedsStrain = 4,     ///< total
  kNeedsElastic = 8,    ///< elastic, free, total
  kNeedsRotation = 16,  ///< rotation
  kNeedsHistory = 32    ///< the law's history, which is the set's
};

/// Facts that a set's particles have in common.
struct SetView {
  /// `heat`: transport of temperature, or null; `of_material`: its constants of this set.
  SetView(const ParticleSet& set, const Law& law, const MaterialDefinition& material, int index,
          const GridLayout& layout, GeometryKind geometry, const QuantityDefinition* heat,
          const TransportMaterial* of_material);

  /// Component of a vector field along a world axis; 0 across the grid's axes.
  template <class Values>
  double along(const Values& values, int axis, int p) const {
    return slot[axis] < 0 ? 0.0 : static_cast<double>(values[slot[axis]][p]);
  }
  /// 0 where the law has none (`which` < 0).
  double history(int which, int p) const {
    return which < 0 || which >= static_cast<int>(set.history.size()) ? 0.0 : set.history[which][p];
  }

  const ParticleSet& set;
  const Law& law;
  int index;
  GeometryKind geometry;
  int slot[3] = {-1, -1, -1};                                    ///< number of each world axis among the grid's
  double density = 0.0;                                          ///< initial [kg/m^3]
  int plastic_strain = -1, plastic_work = -1, temperature = -1;  ///< number of the history scalar
  double reference_temperature = 0.0;                            ///< [K]
  double heat_fraction = 0.0;                      ///< part of the plastic work that the law's elastic energy includes
  double part_as_heat = 0.0;                       ///< part of it that becomes heat, in the law or by transport
  double heat_capacity = 0.0;                      ///< at constant volume [J/(kg K)]; 0: the law has none
  const TransportMaterial* transported = nullptr;  ///< constants of a law that transport gives a temperature
  const double* temperatures = nullptr;            ///< temperatures of the particles then [K]
};

struct ParticleView {
  const SetView& set;
  int p = 0;
  double j = 1.0;
  Symmetric3<double> tau{};      ///< Kirchhoff stress over initial density [J/kg]
  Matrix3<double> f{};           ///< deformation gradient
  Symmetric3<double> cauchy{};   ///< [Pa]
  Symmetric3<double> total{};    ///< strain
  Symmetric3<double> elastic{};  ///< strain
  double free = 0.0;             ///< logarithmic strain along each axis that brings no stress
  Vec3 rotation = Vec3::Zero();  ///< rotation of the polar decomposition: axis times angle [rad]

  /// Fills what `needs` (ViewNeeds) asks for of particle `particle`.
  void look(int particle, unsigned needs);
};

}  // namespace mpm
