// Contact of one node with a surface of infinite mass: it sticks, slides or is free.
//
// Whether a node is in contact is decided where force and momentum meet, on v^{n+1}: pressed nodes approach. Strain has
// to be taken from the same state. A raw velocity does not tell it: in a rebound the particles already move away while
// the node is still pressed, and releasing it there would keep the stress from relaxing while the surface goes on
// pushing, which creates energy (a block rebounded with half as much again as the energy of its fall). So a node that
// was held stays held when strain is updated next, and one that was free is held if it approaches.
//
// Weak: a node is in contact or not, so a surface between two rows of nodes is felt up to a cell early.
// Source: Nairn, GIMP notes (3.12)-(3.20) with the cone limit and the sense of the tangent of method reference 8.3
// (erratum 24), divided here by the nodal mass; that a held node stays held for the strain is our addition.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "mpm/math/geometry.hpp"
#include "mpm/math/state_archive.hpp"
#include "mpm/ranks/lists.hpp"
#include "mpm/rigid/rigid_body.hpp"

namespace mpm {

/// State of contact of a node.
enum class Hold : std::uint8_t { free, slide, stick };

struct ContactChange {
  Vec3 velocity;  ///< change of the node's velocity [m/s]
  Hold hold;
};

/// The change of velocity by contact, from approach and friction. `relative`: velocity of the material minus that of
/// the surface [m/s]; `normal`: out of the surface, towards the material.
inline ContactChange contact_change(const Vec3& relative, const Vec3& normal, const FrictionLaw& law) {
  const double approach = relative.dot(normal);
  if (!(approach < 0.0)) return {Vec3::Zero(), Hold::free};
  if (law.stick) return {-relative, Hold::stick};
  const Vec3 tangential = relative - approach * normal;
  const double sliding = tangential.norm();
  const double limit = -law.coefficient * approach;
  if (sliding <= limit) return {-relative, Hold::stick};
  return {-approach * normal - tangential * (limit / sliding), Hold::slide};
}

/// The change of velocity for the strain: a held node follows the surface, a free one is held if it approaches.
inline Vec3 strain_change(const Vec3& relative, const Vec3& normal, const FrictionLaw& law, Hold hold) {
  if (hold == Hold::stick) return -relative;
  if (hold == Hold::slide) return -relative.dot(normal) * normal;
  return contact_change(relative, normal, law).velocity;
}

/// The change of velocity of a held node later in the step, when contact has been decided: removes the held components
/// of `velocity`, which is relative to the surface or an increment.
inline Vec3 held_part(const Vec3& velocity, const Vec3& normal, Hold hold) {
  if (hold == Hold::free) return Vec3::Zero();
  return hold == Hold::stick ? Vec3(-velocity) : Vec3(-velocity.dot(normal) * normal);
}

/// The nodes that were held in the previous step, by the key of their block, so that sorting does not invalidate them.
class HeldNodes {
 public:
  static std::uint64_t id(std::uint64_t block_key, int node) { return block_key * 64 + node; }
  static std::uint64_t block_key(std::uint64_t id) { return id / 64; }
  static int node(std::uint64_t id) { return static_cast<int>(id % 64); }
  void clear() { held_.clear(); }
  void reserve(std::size_t nodes) { held_.reserve(nodes); }
  /// Nodes have to be added in ascending order of id.
  void add(std::uint64_t id, Hold hold) { held_.push_back({id, hold}); }
  /// Shares the values among all ranks, each of which knows some.
  void share(Communicator& ranks) {
    held_ = gather_list(ranks, held_);
    put_in_order();
  }
  void serialise(StateArchive& archive) {
    archive.rows("held", held_);
    archive.column("held/node", held_, &Entry::id);
    archive.column("held/hold", held_, &Entry::hold);
    if (archive.merging()) put_in_order();
  }
  /// visit(id, hold) for each, in ascending order of id.
  template <class Visit>
  void each(Visit&& visit) const {
    for (const Entry& entry : held_) visit(entry.id, entry.hold);
  }
  Hold find(std::uint64_t id) const {
    const auto it = std::lower_bound(held_.begin(), held_.end(), id,
                                     [](const Entry& entry, std::uint64_t wanted) { return entry.id < wanted; });
    return it != held_.end() && it->id == id ? it->hold : Hold::free;
  }

 private:
  struct Entry {
    std::uint64_t id;
    Hold hold;
  };
  void put_in_order() {
    const auto before = [](const Entry& a, const Entry& b) { return a.id < b.id; };
    const auto same = [](const Entry& a, const Entry& b) { return a.id == b.id; };
    std::sort(held_.begin(), held_.end(), before);
    held_.erase(std::unique(held_.begin(), held_.end(), same), held_.end());
  }
  std::vector<Entry> held_;
};

}  // namespace mpm
