// The data that contact at points keeps from step to step, one entry for each particle and body that had a point.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "mpm/contact/contact_point.hpp"
#include "mpm/math/state_archive.hpp"
#include "mpm/step/coulomb.hpp"

namespace mpm {

class PointMemory {
 public:
  struct Entry {
    std::uint64_t id;           ///< computed from particle and body
    Vec3 force = Vec3::Zero();  ///< on the material [N]
    Vec3 slip = Vec3::Zero();   ///< velocity of the material along the surface at the end of the step [m/s]
    double slid = 0.0;          ///< slip since the point was at rest [m]
    double overlap = 0.0;       ///< initial overlap, <= 0, from which the gap is counted [m]
    Hold hold = Hold::free;
  };

  static std::uint64_t id_of(const ContactPoint& point) {
    return (static_cast<std::uint64_t>(point.particle) << 16) + point.body;
  }
  void clear() { entries_.clear(); }
  /// Forgets the points of a body.
  void forget(int body) {
    const auto of_body = [&](const Entry& entry) { return static_cast<int>(entry.id & 0xffffU) == body; };
    entries_.erase(std::remove_if(entries_.begin(), entries_.end(), of_body), entries_.end());
  }
  void add(const Entry& entry) { entries_.push_back(entry); }
  /// Call when all entries have been added: sorts them by id.
  void close() {
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.id < b.id; });
  }
  /// Null if there was no such point in the step before.
  const Entry* find(const ContactPoint& point) const {
    const std::uint64_t id = id_of(point);
    const auto entry = std::lower_bound(entries_.begin(), entries_.end(), id,
                                        [](const Entry& one, std::uint64_t wanted) { return one.id < wanted; });
    return entry != entries_.end() && entry->id == id ? &*entry : nullptr;
  }
  void serialise(StateArchive& archive) {
    archive.rows("points", entries_);
    archive.column("points/id", entries_, &Entry::id);
    archive.column("points/force", entries_, &Entry::force);
    archive.column("points/slip", entries_, &Entry::slip);
    archive.column("points/slid", entries_, &Entry::slid);
    archive.column("points/overlap", entries_, &Entry::overlap);
    archive.column("points/hold", entries_, &Entry::hold);
  }

 private:
  std::vector<Entry> entries_;  ///< by id
};

}  // namespace mpm
