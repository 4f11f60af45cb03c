// Periodic axes: what leaves the domain through one face comes back through the opposite one, and the nodes of both
// faces are one. The grid does it by the numbers of its blocks (grid/grid_layout.hpp): the neighbour of the last block
// is the first. Particles are put back by a whole length of the domain when they are sorted, so in between a centre may
// be a cell or so beyond a face; after it, it lies at most half a cell below the lower one.
//
// The place at the start moves along, so that displacements stay what they are: X of material that has gone around is
// that of its image.
//
// Weak: rigid bodies do not go around, and must keep a cell and a half from periodic faces or be endless along that
// axis. Along a gravity that has a part along a periodic axis, what is put back gains or loses potential energy: this
// is the work `around`.
#pragma once

#include <string>
#include <vector>

#include "mpm/grid/grid_layout.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/rigid/rigid_body.hpp"
#include "mpm/step/module.hpp"

namespace mpm {

/// Distance that centres may be beyond a periodic face between two sorts [cells]: what a tile reaches, and more.
inline constexpr double kPeriodicReach = 2.0;

/// Puts every particle where its nearest node is one of the domain, 0 to the number of cells less one, along periodic
/// axes. Those that are not finite stay. Returns the sum of mass times the way that it was put [kg m].
Vec3 put_around(std::vector<ParticleSet>& sets, const GridLayout& layout, int threads);

/// Name of the periodic face that a body reaches: "x_max"; else empty.
std::string periodic_face_reached(const RigidBody& body, const GridLayout& layout);

/// Puts particles around before every sort.
class PeriodicAxes final : public Module {
 public:
  /// `sets` and `layout` outlive this.
  PeriodicAxes(std::vector<ParticleSet>& sets, const GridLayout& layout, const Vec3& gravity, int threads)
      : sets_(sets), layout_(layout), gravity_(gravity), threads_(threads) {}
  std::string name() const override { return "periodic"; }
  void before_sort() override { work_ -= gravity_.dot(put_around(sets_, layout_, threads_)); }
  void count(Device& device) override;
  void energies(EnergyReport& report) const override {
    for (int k = 0; k < layout_.dim(); ++k) {
      if (layout_.periodic(k) && gravity_[layout_.axis(k)] != 0.0) {
        report.add("around", NamedEnergy::Kind::work, work_);
        return;
      }
    }
  }
  void serialise(StateArchive& archive) override { archive.sum("work", work_); }

 private:
  std::vector<ParticleSet>& sets_;
  const GridLayout& layout_;
  Vec3 gravity_;
  int threads_;
  double work_ = 0.0;  // against gravity [J]
};

}  // namespace mpm
