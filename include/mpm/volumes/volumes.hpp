// A module that counts the material in volumes of space, which stand or move with rigid bodies: at each sync point a
// particle whose centre lies in a volume is in it, with all of its mass. What came in and went out follows from where
// each particle was at the sync point before; each remembers that in a bit for every volume, which sorting, checkpoints
// and other ranks get with the particle.
//
// Weak: a particle that crosses a volume between two sync points is not seen.
#pragma once

#include <string>
#include <vector>

#include "mpm/grid/grid_layout.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/ranks/communicator.hpp"
#include "mpm/rigid/rigid_body.hpp"
#include "mpm/step/module.hpp"
#include "mpm/volumes/volume_definition.hpp"

namespace mpm {

/// All outlive the module.
struct VolumeParts {
  std::vector<ParticleSet>& sets;
  const std::vector<RigidBody>& bodies;
  const GridLayout& layout;
  GeometryKind geometry;
  std::vector<double> densities;  ///< at the start, of each set [kg/m^3]
  int threads;
  Communicator* ranks;  ///< null in a process that is alone
};

class Volumes : public Module {
 public:
  Volumes(const std::vector<VolumeDefinition>& volumes, VolumeParts parts);

  std::string name() const override { return "volumes"; }
  bool same_on_all_ranks() const override { return true; }
  void numbers(std::vector<NamedNumber>& list) const override;
  void at_sync(std::int64_t time) override;
  void serialise(StateArchive& archive) override;
  /// As of the last sync point.
  const std::vector<VolumeReport>& reports() const { return reports_; }

 private:
  /// Sums over the particles of a group, or of all.
  struct Sums {
    double mass = 0.0, volume = 0.0, came = 0.0, went = 0.0;
    Vec3 moment = Vec3::Zero();
    Sums& operator+=(const Sums& other);
  };
  /// Place of a volume now.
  struct Place {
    Pose pose;
    Box bounds;
  };

  void find_places();
  /// Counts, and remembers where each particle is.
  void count(bool first);
  void count(const ParticleSet& set, std::size_t number, PaddedArray<double>& inside, int first, int end, Sums* sums);
  Vec3 place_of(const ParticleSet& set, int particle) const;

  const std::vector<VolumeDefinition> volumes_;
  VolumeParts parts_;
  std::vector<int> carriers_;           // rigid body of each; negative: none
  std::vector<std::size_t> remembers_;  // number in each set's `brought`
  std::vector<Place> places_;
  std::vector<Sums> sums_;  // sums of each group and volume
  std::vector<VolumeReport> reports_;
};

}  // namespace mpm
