// Strain within a cell that follows the free strain. With GIMP and CPDI the gradient along an axis is that of the
// particle's cell, while its free strain is its own; the difference would be stress, of one sign on one side of the
// cell's middle and of the other on the other, and of first order in the cell: 1.4 % of E alpha dT in a bar of 20 cells
// that nothing holds. So the gradient of each increment is enhanced: where the free strain e is linear, a free body has
// d^2 u_i / d x_i d x_j = d e / d x_j, and d^2 u_i / d x_j^2 = - d e / d x_i for i other than j. What the gradient
// along j misses is that times the distance from the particle to the place whose slope it takes
// (ScalarTransfer::slope_lead). Splines need none: their gradient is exact for parabolas.
//
// It comes with the free strain and at the same pace, and it is an increment: a body that moves on keeps its strain.
// Over a full cell of particles in a regular order it has no mean, so that forces on nodes hardly change. Its work
// against the stress is booked with that of the free strain, by the mean of the stress before and after.
//
// The slope is that of ln(1 + e), of means by mass on the nodes, over the slope of the places of these masses: exact
// where the quantity is linear, at the edges of bodies too. The latter, which changes slowly, is that of the last sync
// point.
//
// Weak: where a body is held across the axis, stress across it varies in the cell, and what Poisson's ratio makes of
// that along the axis stays, as it does in a loaded body without any heat. The slope is that of the place where a body
// is when the quantity changes: growth by a fifth at once leaves up to a third of the error
// (test/unit/thermal_stress_test.cpp). Along a periodic axis the places of masses are taken for those of the nodes.
// With average_dilatation the sum of the three strains is the mean's, and the work is booked as if it were not. It
// takes 5 numbers a particle along each axis, and one for each quantity. Source: strain beside that of the
// displacement, J. C. Simo, M. S. Rifai (1990), Int. J. Numer. Meth. Eng. 29, 1595-1638; here it is known beforehand
// and not solved for.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "mpm/transport/transported_field.hpp"

namespace mpm {

class EnhancedStrain {
 public:
  /// Makes the sets remember what is theirs, in ParticleSet::brought. `expanding`: the quantities by which sets that
  /// have a free strain expand; they outlive this. `transfer`: of the fields and sets of `parts`.
  EnhancedStrain(const TransportParts& parts, std::vector<const TransportedField*> expanding,
                 std::unique_ptr<ScalarTransfer> transfer);

  /// Takes the slopes of what the quantities have changed by since the last call. Momentum has been gathered, and
  /// particles have not moved since.
  void look();
  /// Finds anew what follows motion, when it is asked for the next time: so that a run that goes on from here does what
  /// it would have done.
  void at_sync() {
    masses_moved_ = true;
    parts_given_ = 0;
  }
  /// Finds the places of masses anew at the next look: some have fallen asleep or woken.
  void masses_changed() { masses_moved_ = true; }
  /// Gives all particles a part of what is left, at the same time. Returns half of the work that it does against the
  /// stress as it is [J].
  double give(double part);
  /// Returns the other half, against the stress that has taken what was given since the last call [J].
  double book();

 private:
  /// Numbers that an expanding set remembers along each axis, from ParticleSet::enhanced_strain on: slope of the free
  /// strain that the next increment takes [1/m], distance to the place of the slope [m], slope that was given and not
  /// booked [1/m], slope that is left [1/m], and slope of the places of masses.
  enum Kind { slope_next, lead, given_slope, slope_left, of_places, kKinds };

  double* numbers(ParticleSet& set, Kind kind, int axis) const {
    return set.brought[set.enhanced_strain + kind * dim_ + axis].values.data();
  }
  template <class Visit>
  void each_group(Visit&& visit);
  void find_leads();
  /// Masses of nodes without what sleeps.
  void find_masses();
  void find_slopes_of_places();
  void add_slopes(std::size_t quantity);
  /// Half of the sum over particles of stress times strain, by slope(particle, axis) from slopes(set) [J].
  template <class Slopes>
  double half_work(Slopes&& slopes);
  /// Nodal numbers by mass, of the scratch.
  void spread(std::vector<NodalField>& to);
  void over_mass(std::vector<NodalField>& numbers);

  TransportParts parts_;
  int dim_;
  std::vector<const TransportedField*> expanding_;
  std::unique_ptr<ScalarTransfer> transfer_;
  std::vector<std::size_t> seen_;  ///< places in each set's `brought` of the quantities as they were at the last look
  std::vector<NodalField> masses_, numbers_, places_;  ///< numbers on the nodes of each velocity field
  bool masses_moved_ = true;
  int parts_given_ = 0;  ///< since the sync point
  /// Scratch of each set, along each axis: numbers to spread, and gradients.
  std::vector<std::array<PaddedArray<double>, 3>> gradients_;
  ScalarTransfer::Given given_;
  ScalarTransfer::Taken taken_;
  std::vector<double> sums_;
};

}  // namespace mpm
