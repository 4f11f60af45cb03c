#include "mpm/boundary/periodic.hpp"

#include <cmath>

namespace mpm {

void put_around(std::vector<ParticleSet>& sets, const GridLayout& layout, int threads) {
  for (int k = 0; k < layout.dim(); ++k) {
    if (!layout.periodic(k)) continue;
    const int cells = layout.last_node(k);
    const double length = cells * layout.cell(k);
    for (ParticleSet& set : sets) {
      double* x = set.x[k].data();
      double* start = set.start_x.empty() ? nullptr : set.start_x[k].data();
      const int size = set.size();
#pragma omp parallel for schedule(static) num_threads(threads)
      for (int p = 0; p < size; ++p) {
        const double place = layout.in_cells(k, x[p]);
        if (!(std::abs(place) < cells + kPeriodicReach + 1.0)) continue;
        const int nearest = GridLayout::nearest(place);
        const double shift = nearest < 0 ? length : (nearest >= cells ? -length : 0.0);
        if (shift == 0.0) continue;
        x[p] += shift;
        if (start != nullptr) start[p] += shift;
      }
    }
  }
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

}  // namespace mpm
