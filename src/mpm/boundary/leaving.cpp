#include "mpm/boundary/leaving.hpp"

#include <fmt/core.h>

#include <cmath>

namespace mpm {

bool Leaving::put_back() {
  constexpr double kInside = 1e-3;  // of a cell, by which a particle is put inside the edge
  Vec3 given = Vec3::Zero();
  bool all = true;
  for (ParticleSet& set : sets_) {
    for (int p = 0; all && p < set.size(); ++p) {
      bool outside = false;
      for (int k = 0; k < layout_.dim(); ++k) {
        const double cells = layout_.in_cells(k, set.x[k][p]);
        if (cells >= set.lowest[k] && cells <= set.highest[k]) continue;
        if (!std::isfinite(cells) || !std::isfinite(set.v[k][p])) {
          all = false;
          break;
        }
        outside = true;
        const double side = cells < set.lowest[k] ? -1.0 : 1.0;
        const double inside = side < 0.0 ? set.lowest[k] + kInside : set.highest[k] - kInside;
        set.x[k][p] = layout_.origin(k) + inside * layout_.cell(k);
        const double outward = side * set.v[k][p];
        if (!(outward > 0.0)) continue;
        given[layout_.axis(k)] -= side * outward * set.mass_of(p);
        set.v[k].set(p, 0.0);
        taken_ += 0.5 * set.mass_of(p) * outward * outward;
      }
      if (!outside) continue;
      const std::uint32_t id = set.id[p];
      if (left_.size() <= id) left_.resize(id + 1, 0);
      if (left_[id] == 0 && count_ == limit_) all = false;
      count_ += left_[id] == 0 ? 1 : 0;
      left_[id] = 1;
    }
    if (!all) break;
  }
  account_.add(given);
  return all;
}

std::optional<OutsideReason> Leaving::why_outside(const GridLayout&, const ParticleSet&, int) const {
  if (count_ <= limit_) return std::nullopt;
  return OutsideReason{
      fmt::format("more than {} particles have left the grid (grid.leave.limit)", limit_),
      "enlarge grid.min/grid.max, close that face with a wall in 'boundaries', raise the limit, or lower "
      "time.cfl if the run blew up"};
}

}  // namespace mpm
