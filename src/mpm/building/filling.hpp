// The particles of a body, one after another: places of its lattice in its region, moved by jitter, without those that
// are cut out. A walk over them finds them anew, the same on each, so that nobody has to hold all of them. Together
// they have the volume of what they fill. Private to this folder.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "body_lattice.hpp"
#include "cut_cells.hpp"
#include "mpm/math/stopped.hpp"
#include "mpm/scene/scene.hpp"

namespace mpm {

/// A rigid body as it stands at the start, asked about many places.
class StandingTool {
 public:
  explicit StandingTool(const RigidBodyDefinition& rigid);
  const std::string& name() const { return rigid_->name; }
  /// True if a place lies in it by more than `depth` [m]; `deep` is then how far.
  bool holds(const Vec3& place, double depth, double& deep) const;
  /// False where no place within `reach` [m] along each axis lies in it.
  bool may_hold(const Vec3& place, double reach) const;

 private:
  const RigidBodyDefinition* rigid_;
  Box bounds_;
};

class Filling {
 public:
  /// Both outlive it. `interrupt`: as build() has it. @throws SceneError for a body without a place, or one that
  /// something is cut out of that is not there; StoppedError
  Filling(const BodyDefinition& body, const Scene& scene, const std::function<bool()>& interrupt);

  double particle_volume() const { return volume_; }  ///< [m^3], as DeformableBody::particle_volume
  bool cuts() const { return !cut_.empty(); }         ///< some particles have a part of it, or more
  /// Lattice of the particles if it is not the grid's.
  std::optional<ParticleLattice> lattice() const;
  /// Difference of the particles from those of the grid's lattice; empty if there is none.
  std::string text() const;
  std::size_t places() const { return places_; }  ///< before any is cut out
  /// Refuses a body of which nothing is left. @throws SceneError
  void check_left(std::uint64_t particles) const;
  /// visit(const FilledPlace&) for every particle, in the order of their numbers.
  template <class Visit>
  void each(Visit&& visit) const {
    std::mt19937_64 random(body_->seed > 0 ? body_->seed : std::mt19937_64::default_seed);
    each_place([&](FilledPlace place) {
      if (body_->jitter > 0.0) place.centre = jittered(place.centre, random);
      if (!is_cut_out(place.centre)) visit(place);
    });
  }
  /// The same for particles whose places lie in a box along x and y or beside it, of a body without jitter.
  template <class Visit>
  void each_in(const Box& bounds, Visit&& visit) const {
    std::array<Lattice, 3> part = lattices_;
    for (const int axis : axes_) {
      if (axis == 2) continue;
      Lattice& along = part[axis];
      const auto place = [&](double at) { return std::floor((at - along.origin) / along.spacing); };
      const double first = static_cast<double>(along.first), last = static_cast<double>(along.last);
      along.first = static_cast<std::int64_t>(std::clamp(place(bounds.min[axis]) - 1.0, first, last + 1.0));
      along.last = static_cast<std::int64_t>(std::clamp(place(bounds.max[axis]) + 1.0, first - 1.0, last));
    }
    each_place(part, [&](const FilledPlace& place) {
      if (!is_cut_out(place.centre)) visit(place);
    });
  }
  /// The lattice's first corner and spacing [m]; 0 along axes that the grid does not have.
  Vec3 origin() const { return {lattices_[0].origin, lattices_[1].origin, lattices_[2].origin}; }
  Vec3 spacing() const { return {lattices_[0].spacing, lattices_[1].spacing, lattices_[2].spacing}; }
  /// True if a body without jitter has a particle beside that at `place` along an axis.
  bool has_neighbour(const Vec3& place, int axis, bool above) const;

 private:
  // x runs fastest, as in the numbering of grid blocks.
  template <class Visit>
  void each_place(Visit&& visit) const {
    each_place(lattices_, visit);
  }
  template <class Visit>
  void each_place(const std::array<Lattice, 3>& places, Visit&& visit) const {
    const Lattice &x = places[0], &y = places[1], &z = places[2];
    for (std::int64_t k = z.first; k <= z.last; ++k) {
      for (std::int64_t j = y.first; j <= y.last; ++j) {
        for (std::int64_t i = x.first; i <= x.last; ++i) {
          const Vec3 point(x.center(i), y.center(j), z.center(k));
          check_stop_();
          if (cut_.holds(i, j, k) || body_->region.contains(point)) visit(cut_.at(point, i, j, k));
        }
      }
    }
  }
  Vec3 jittered(const Vec3& point, std::mt19937_64& random) const;
  bool is_cut_out(const Vec3& place) const;
  /// Factor by which a volume about the axis counts at that radius; else 1.
  double turn(double x) const;
  /// Volume of the region that lies in what is cut out [m^3].
  double cut_out_volume() const;
  /// Gives the particles the volume of what they fill.
  void share_volume();

  mutable StopCheck check_stop_;
  const BodyDefinition* body_;
  const Scene* scene_;
  std::vector<int> axes_;
  std::array<Lattice, 3> lattices_;
  CutCells cut_;  ///< none in a body with jitter
  std::vector<StandingTool> cut_out_;
  double volume_ = 1.0, scale_ = 1.0;  ///< scale_: of a particle's volume over that of its place
  std::size_t places_ = 0;
};

/// Checks of whether a body's particles lie in other bodies.
class FillingChecks {
 public:
  /// `half_spacing` of particles [m]: so deep they may lie in rigid bodies.
  FillingChecks(const BodyDefinition& body, const Scene& scene, double half_spacing);
  /// For every particle.
  void look(const Vec3& place);
  /// @throws SceneError
  void end() const;

 private:
  struct Overlap {
    const BodyDefinition* other;
    std::size_t count = 0;
    Vec3 place = Vec3::Zero();  ///< the first
  };
  struct Inside {
    StandingTool tool;
    std::string doubt;  ///< about its size
    std::size_t count = 0;
    double deepest = 0.0;
  };
  const BodyDefinition* body_;
  double half_spacing_;
  std::vector<Overlap> overlaps_;
  std::vector<Inside> inside_;
};

}  // namespace mpm
