// Strain within a cell that follows the free strain. With GIMP and CPDI the strain of a particle along an axis is that
// of its cell, while its free strain is its own; the difference would be stress, of one sign on one side of the cell's
// middle and of the other on the other, and of first order in the cell: 1.4 % of E alpha dT in a bar of 20 cells that
// nothing holds. So the strain along each axis is enhanced by the slope of the free strain along that axis, times the
// distance to the place whose slope the gradient takes (ScalarTransfer::slope_lead): strain and free strain along an
// axis are then taken at the same place. Strains across the axis need none, as the shape functions themselves vary
// there, nor do functions whose gradient is exact for parabolas (bspline2).
//
// It comes with the free strain and at the same pace, and it is an increment: a body that moves on keeps its strain. It
// has no mean over a cell, so that forces on nodes change by what is of second order. Its work against the stress is
// booked with that of the free strain, by the mean of the stress before and after.
//
// The slope is that of means by mass on the nodes, over the slope of the places of these masses: exact where free
// strain is linear, at the edges of bodies too. The latter, which changes slowly, is that of the last sync point.
//
// Weak: where a body is held across the axis, stress across it varies in the cell, and what Poisson's ratio makes of
// that along the axis stays, as it does in a loaded body without any heat. Along a periodic axis the places of masses
// are taken for those of the nodes. Source: strain beside that of the displacement, J. C. Simo, M. S. Rifai (1990),
// Int. J. Numer. Meth. Eng. 29, 1595-1638; here it is known beforehand and not solved for.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "mpm/transport/transported_field.hpp"

namespace mpm {

class EnhancedStrain {
 public:
  /// Makes the sets that have a free strain remember what is theirs, in ParticleSet::brought after its numbers.
  /// `expanding`: the quantities by which they expand; they outlive this. `transfer`: of the fields and sets of
  /// `parts`.
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

  /// Gives all particles a part of what is left, at the same time. Returns half of the work that it does against the
  /// stress as it is [J].
  double give(double part);
  /// Returns the other half, against the stress that has taken what was given since the last call [J].
  double book();

 private:
  /// Numbers that a set remembers along each axis, from ParticleSet::kEnhanced on: strain that the next increment
  /// takes, strain that has been given and not booked, the slope of the free strain that is left [1/m], the slope of
  /// the places of masses, and the distance to the place of the slope [m]; and after these each quantity at the last
  /// look.
  enum Kind { taken_next, given, slope_left, of_places, lead, kKinds };

  static std::size_t place(const ParticleSet& set, int kind_and_axis) {
    return set.free_strain + ParticleSet::kEnhanced + kind_and_axis;
  }
  double* numbers(ParticleSet& set, Kind kind, int axis) const {
    return set.brought[place(set, kind * dim_ + axis)].values.data();
  }
  PaddedArray<double>& seen(ParticleSet& set, std::size_t quantity) const {
    return set.brought[place(set, kKinds * dim_ + static_cast<int>(quantity))].values;
  }
  template <class Visit>
  void each_group(Visit&& visit);
  void find_leads();
  /// Masses of nodes without what sleeps.
  void find_masses();
  void find_slopes_of_places();
  void add_slopes(std::size_t quantity);
  /// Half of the sum over particles of stress times strain(set, axis, particle) [J].
  template <class Strain>
  double half_work(Strain&& strain);
  /// Nodal numbers by mass, of the scratch.
  void spread(std::vector<NodalField>& to);
  void over_mass(std::vector<NodalField>& numbers);

  TransportParts parts_;
  int dim_;
  std::vector<const TransportedField*> expanding_;
  std::unique_ptr<ScalarTransfer> transfer_;
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
