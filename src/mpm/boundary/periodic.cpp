#include "mpm/boundary/periodic.hpp"

#include <cmath>

#include "mpm/loop/loop.hpp"
#include "mpm/step/device.hpp"

namespace mpm {

Vec3 put_around(std::vector<ParticleSet>& sets, const GridLayout& layout, int threads) {
  Vec3 carried = Vec3::Zero();
  for (int k = 0; k < layout.dim(); ++k) {
    if (!layout.periodic(k)) continue;
    const int cells = layout.last_node(k);
    const double length = cells * layout.cell(k);
    for (ParticleSet& set : sets) {
      double* x = set.x[k].data();
      double* start = set.start_x.empty() ? nullptr : set.start_x[k].data();
      // Whole numbers are summed, so the order does not matter; where masses differ one thread sums.
      const bool equal = set.masses.empty();
      double mass = 0.0;
      for_parts("particles: back in the period", equal ? threads : 1, set.size(), [&](int first, int end, int) {
        double own = 0.0;
        for (int p = first; p < end; ++p) {
          const double place = layout.in_cells(k, x[p]);
          if (!(std::abs(place) < cells + kPeriodicReach + 1.0)) continue;
          const int nearest = GridLayout::nearest(place);
          const double shift = nearest < 0 ? length : (nearest >= cells ? -length : 0.0);
          if (shift == 0.0) continue;
          x[p] += shift;
          own += std::copysign(equal ? 1.0 : set.mass_of(p), shift);
          if (start != nullptr) start[p] += shift;
        }
        in_turn([&] { mass += own; });
      });
      carried[layout.axis(k)] += length * (equal ? set.mass * mass : mass);
    }
  }
  return carried;
}

std::string periodic_face_reached(const RigidBody& body, const GridLayout& layout) {
  constexpr double kCells = 1.5;
  const Box bounds = body.world_bounds();
  for (int k = 0; k < layout.dim(); ++k) {
    const int axis = layout.axis(k);
    if (!layout.periodic(k) || (std::isinf(bounds.min[axis]) && std::isinf(bounds.max[axis]))) continue;
    const double margin = kCells * layout.cell(k), low = layout.origin(k);
    const std::string name(1, "xyz"[axis]);
    if (bounds.min[axis] < low + margin) return name + "_min";
    if (bounds.max[axis] > low + layout.last_node(k) * layout.cell(k) - margin) return name + "_max";
  }
  return {};
}

void PeriodicAxes::count(Device& device) { work_ -= gravity_.dot(device.take_carried()); }

}  // namespace mpm
