// Finds where the material's surface is near rigid bodies: on each particle near a body, the point of its domain that
// is nearest to it (particle_reach.hpp).
//
// Blocks of particles, then groups of neighbours within them, are skipped where a ball around them stays clear of the
// body, so that few particles besides those near a body are tested against its surface.
//
// A sharp edge separates the material on its two sides: for a particle beside an edge its centre counts, not its reach.
// Weak: a particle has one point for each body; in an inner corner it is the one at the nearer face.
#pragma once

#include <vector>

#include "mpm/contact/contact_point.hpp"
#include "mpm/grid/fields.hpp"
#include "mpm/grid/node_choice.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/ranks/communicator.hpp"
#include "mpm/rigid/rigid_body.hpp"

namespace mpm {

class PointSearch {
 public:
  /// Bodies, sets and fields must outlive this object. `across`: thickness [m] of a plane, area [m^2] of a line.
  /// `ranks`: where the run is over several, else null. `choice`: of particles near cracks; null without cracks.
  PointSearch(const std::vector<const RigidBody*>& bodies, const std::vector<ParticleSet>& sets, const Fields& fields,
              GeometryKind geometry, double across, int threads, Communicator* ranks = nullptr,
              const NodeChoice* choice = nullptr)
      : bodies_(bodies),
        sets_(sets),
        fields_(fields),
        geometry_(geometry),
        across_(across),
        threads_(threads),
        ranks_(ranks),
        choice_(choice) {}

  /// A particle farther than this from a body has no point in this step [m].
  static double reach(const std::vector<ParticleSet>& sets, const GridLayout& layout);

  /// Points that are near a body, or come near to it within `dt` [s]. The law of a body against a set is the one at
  /// (place of the body) * (number of sets) + (place of the set). The order does not depend on the number of threads.
  /// Over several ranks they are those of all, on each of them, in the order that they have in one process.
  const std::vector<ContactPoint>& find(double dt);

 private:
  /// The particles of one block, or of a patch near a crack, which may be near one body.
  struct Job {
    int field, owner, body;  ///< the owner among those of its field; patches have the field NodeChoice::number()
  };
  void find_jobs(double band);
  /// The grid of a field, or that of the patches.
  const Grid& grid_of(int field) const {
    return field < static_cast<int>(fields_.size()) ? *fields_[field] : choice_->grid();
  }
  template <class Geometry>
  void find_in(double dt);
  /// `farthest`: the largest reach of a particle from its centre [m].
  template <class Geometry>
  void search(const Job& job, double dt, double farthest, std::vector<ContactPoint>& found) const;
  /// Takes the points that other ranks have found, too.
  void gather();
  /// True if the surface may be at most `band` from one of the particles [begin, end) of a set.
  bool near(const RigidBody& body, const ParticleSet& set, int begin, int end, double band) const;

  const std::vector<const RigidBody*>& bodies_;
  const std::vector<ParticleSet>& sets_;
  const Fields& fields_;
  GeometryKind geometry_;
  double across_;
  int threads_;
  Communicator* ranks_;
  const NodeChoice* choice_;
  std::vector<Job> jobs_;
  std::vector<std::vector<ContactPoint>> of_job_;
  std::vector<ContactPoint> points_;
};

}  // namespace mpm
